"""Files as the original has them, played with the bundled trackers and controllers."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.cli import main
from uwsim.results.result import Result
from uwsim.results.result_file import load

FILES = Path(__file__).parents[2] / "benchmark" / "files"
CAMERA = "vehicle[girona500].virtualCamera[bowtech1]"
SMALL = ["--set", f"{CAMERA}.resw=320", "--set", f"{CAMERA}.resh=240"]


def tracked(
    folder: Path, algorithm: str, mode: str, *, currents: tuple[float, float], seconds: float
) -> Result:
    """Play the original's benchmark of currents, in steps of 0.05 m/s, with shorter levels."""
    file, out = folder / "tracking.xml", folder / f"{algorithm}-{mode}"
    text = (FILES / "tracking-auto.xml").read_text()
    for tag, value in (
        ("initialValue", currents[0]), ("finalValue", currents[1] + 0.01), ("step", 0.05),
        ("interval", seconds),
    ):  # fmt: skip
        text = re.sub(f"<{tag}>[^<]*<", f"<{tag}>{value:g}<", text)
    file.write_text(text)
    words = ["--scene", "currents-scene", "--algorithm", algorithm, "--mode", mode, *SMALL]
    assert main(["bench", str(file), *words, "--seed", "1", "--out", str(out)]) == 0
    return load(out)


def lost(result: Result) -> set[float | None]:
    ended = zip(result.numbers("current"), result.values("status"), strict=True)
    return {level for level, status in ended if status != "ok"}


@pytest.mark.slow
def test_a_tracker_goes_on_after_the_vehicle_was_put_back(tmp_path: Path) -> None:
    result = tracked(tmp_path, "esm", "sequential", currents=(0.1, 0.15), seconds=4.0)
    assert result.values("status") == ("ok", "ok")
    assert result.numbers("ended_at") == pytest.approx([4.0, 8.0])
    assert all(error is not None and error < 10.0 for error in result.numbers("corners"))


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["esm", "p", "pi"])
def test_a_sweep_of_currents_loses_no_level_that_is_not_lost_alone(
    tmp_path: Path, algorithm: str
) -> None:
    in_turn, alone = (
        tracked(tmp_path, algorithm, mode, currents=(0.0, 0.2), seconds=7.0)
        for mode in ("sequential", "independent")
    )
    assert len(in_turn.rows) == len(alone.rows) == 5
    assert lost(in_turn) <= lost(alone)
    assert len(lost(alone)) < 5


@pytest.mark.slow
def test_a_tracker_gets_the_constant_corners_of_a_file(tmp_path: Path) -> None:
    out = tmp_path / "out"
    words = ["--scene", "visibility-scene", "--algorithm", "esm", "--out", str(out)]
    chosen = ["--level", "fog=0", "--level", "fog=0.05"]
    assert main(["bench", str(FILES / "vision.xml"), *words, *chosen]) == 0
    result = load(out)
    assert result.values("status") == ("ok", "ok")
    told = result.run.parameters["corners"]  # type: ignore[index]
    assert told == "215 149 300 149 300 176 215 176"
    assert result.numbers("corners") == pytest.approx([0.0, 0.0], abs=1.0)


@pytest.mark.slow
def test_corners_of_the_command_line_come_before_those_of_the_file(tmp_path: Path) -> None:
    out, corners = tmp_path / "out", "210 140 300 140 300 176 210 176"
    words = ["--scene", "visibility-scene", "--algorithm", "frozen", "--out", str(out)]
    asked = ["--set", f"algorithm.corners={corners}", "--level", "fog=0"]
    assert main(["bench", str(FILES / "vision.xml"), *words, *asked]) == 0
    assert load(out).numbers("corners") == pytest.approx([(2 * 5**2 + 2 * 9**2) ** 0.5])
