"""The bundled benchmark `visibility-physical`: its file, and short runs by day and by night."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import WaterUpdaterSpec, n_levels
from uwsim.cli import main
from uwsim.results.result import Result
from uwsim.results.result_file import load


def run(out: Path, *words: str) -> Result:
    """Run two levels of the benchmark with one seed."""
    levels = ("--level", "attenuationLengths=0.5", "--level", "attenuationLengths=4")
    command = ["bench", "visibility-physical", "--seed", "1", *levels, *words, "--out", str(out)]
    assert main(command) == 0
    return load(out)


def test_the_file_sweeps_attenuation_lengths_finely() -> None:
    spec = read_benchmark(bundled_files("benchmarks")["visibility-physical"])
    updater = spec.scene_updater
    assert isinstance(updater, WaterUpdaterSpec)
    assert (updater.quantity, updater.exposure) == ("attenuationLengths", "automatic")
    assert (updater.camera, updater.target) == ("bowtech1", "blackbox")
    assert n_levels(updater) == 31
    assert updater.values()[0] == 0.5
    assert updater.values()[-1] == 8.0
    assert spec.mode == "sequential"


@pytest.mark.parametrize(("lamp", "status"), [("0", "ok"), ("0.1", "lost")])
def test_a_tracker_keeps_its_target_by_day_and_not_with_a_lamp_beside_the_lens(
    tmp_path: Path, lamp: str, status: str
) -> None:
    result = run(tmp_path / "out", "--algorithm", "esm", "--xacro", f"lamp:={lamp}")
    assert result.numbers("attenuationLengths") == (0.5, 4.0)
    assert result.values("status") == ("ok", status)
    clear_error = result.numbers("corners")[0]
    assert clear_error is not None
    assert clear_error < 0.5  # px
    column = result.columns[result.index("attenuationLengths")]
    assert (column.kind, column.unit) == ("level", None)  # a pure number
