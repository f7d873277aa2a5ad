"""Files that were damaged by chance end in clean errors; `scripts/fuzz` does many more of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.fuzzed_files import TARGETS, trial


@pytest.mark.parametrize("target", sorted(TARGETS))
def test_a_damaged_file_ends_in_a_clean_error(target: str, tmp_path: Path) -> None:
    n = 3 if target in ("benchmark", "scene") else 20
    wrong = {seed: trial(tmp_path, target, seed) for seed in range(n)}
    assert {seed: said for seed, said in wrong.items() if said is not None} == {}


@pytest.mark.parametrize("name", ["cheat_trials", "fuzz", "kill_trials"])
def test_trials_are_started_with_the_projects_own_python(name: str) -> None:
    text = (Path(__file__).parents[1] / "scripts" / name).read_text()
    assert text.startswith("#!/usr/bin/env bash\n")
    assert "exec .venv/bin/python " in text
