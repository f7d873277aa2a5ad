"""The table of a suite has an entry for each family of reference algorithms."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.cli import main
from uwsim.suites.entry import Seeds
from uwsim.suites.seeds import public_seeds
from uwsim.suites.site.collect import Conditions, collect_submissions
from uwsim.suites.submission import load_submission
from uwsim.suites.suite import Suite, read_suite
from uwsim.suites.table import reference_entries


def test_a_family_has_the_tasks_for_which_the_suite_names_an_algorithm(suite: Suite) -> None:
    seeds = Seeds(split="validation", first=0, count=2)
    algorithms = {
        name: dict(entry.algorithms)
        for name, entry in reference_entries(suite, seeds, is_short=False)
    }
    assert algorithms == {
        "baseline-1": {"near-v1": "position-p", "far-v1": "position-p"},
        "baseline-2": {"far-v1": "position-pi"},
        "expert": {"far-v1": "position-lqr"},
        "control": {"near-v1": "nothing", "far-v1": "nothing"},
    }


@pytest.mark.slow
def test_the_command_writes_entries_for_a_page(
    small_suite: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["suite", "table", str(small_suite), "--short", "--workers", "0"]
    assert main([*words, "--out", str(tmp_path)]) == 0
    assert re.search(r"\d+ s of CPU time in total", capsys.readouterr().out)
    submissions = {path.name: load_submission(path) for path in tmp_path.iterdir()}
    kinds = {name: submission.kind for name, submission in submissions.items()}
    assert kinds == {
        "baseline-1": "baseline",
        "baseline-2": "baseline",
        "expert": "expert",
        "control": "control",
    }
    assert {submission.seeds.count for submission in submissions.values()} == {1}
    assert submissions["baseline-2"].tasks["far-v1"].algorithm == "position-pi"
    suite = read_suite(small_suite)
    conditions = Conditions(suite=suite, seeds=public_seeds(suite, "validation", 1), is_short=True)
    assert len(collect_submissions(tmp_path, conditions).candidates) == 4
