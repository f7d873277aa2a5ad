"""A result of three short levels, and its trial, for films."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import run, write_benchmark
from uwsim.viewer.recorded import RecordedTrial


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("film")
    run(write_benchmark(folder, "0.4"), folder / "out", seed=3)
    return folder / "out"


@pytest.fixture(scope="module")
def trial(result: Path) -> RecordedTrial:
    return RecordedTrial.open(result, 0)
