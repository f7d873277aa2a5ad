"""Columns of logs carry the units that their measures know."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.short_benchmark import bench_of, write_benchmark
from uwsim.benchmark.measures import Measure
from uwsim.results.log import load_log, logs_of
from uwsim.runs.executors.executor import run_all
from uwsim.runs.trial.log_columns import log_columns


class Fake(Measure):
    """A measure that logs what it is told."""

    unit = "m"

    def __init__(self, *header: str, details: dict[str, str] | None = None) -> None:
        self._header = header
        self.detail_units = details or {}  # type: ignore[misc]

    def start(self) -> None:
        pass

    def update(self) -> None:
        pass

    @property
    def value(self) -> float | None:
        return None

    @property
    def details(self) -> dict[str, float | None]:
        return {"x.mean": None, "share": None, "n": None, "power": None}

    @property
    def log_header(self) -> tuple[str, ...]:
        return self._header


@pytest.mark.parametrize(
    ("name", "column"),
    [
        ("value", "value [m]"),
        ("total", "total [m]"),
        ("x", "x [m]"),
        ("power", "power [W]"),
        ("share", "share"),
        ("n", "n"),
        ("depth [km]", "depth [km]"),
        ("of_a_plugin", "of_a_plugin"),
    ],
)
def test_a_column_has_the_unit_of_its_detail_or_of_the_measure(name: str, column: str) -> None:
    measure = Fake(name, details={"power": "W", "share": "1"})
    assert log_columns(measure) == (column,)


def test_logs_that_are_written_have_units(tmp_path: Path) -> None:
    file = write_benchmark(tmp_path, "0.2")
    timed = "<name>taskTime</name> <log>0.1</log>"
    file.write_text(file.read_text().replace("<name>taskTime</name>", timed))
    run_all([bench_of(file, tmp_path / "o", levels=["fog=0"])])
    headers = {log.measure: log.header for log in map(load_log, logs_of(tmp_path / "o"))}
    assert headers["taskTime"] == ("fog [1/m]", "time [s]", "value [s]")
    assert headers["corners"][:4] == ("fog [1/m]", "time [s]", "total [px]", "nw_x [px]")
