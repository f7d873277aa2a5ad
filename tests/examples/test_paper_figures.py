"""The paper's figures are drawn from what was simulated."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from paper.figures import visibility_loss

SCRIPT = Path(__file__).parents[2] / "examples" / "paper_figures.py"


def load() -> ModuleType:
    spec = importlib.util.spec_from_file_location("paper_figures", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def plates() -> Iterator[Any]:
    made = load().Plates()
    yield made
    made.close()


@pytest.mark.parametrize("fog", [0.1, 0.5, 1.05, 2.0])
@pytest.mark.parametrize("distance", [0.3, 1.0, 1.36, 3.0, 6.0])
def test_visibility_measured_from_two_plates_is_within_a_hundredth_of_the_law(
    plates: Any, fog: float, distance: float
) -> None:
    assert plates.visibility(fog, distance) == pytest.approx(
        visibility_loss(fog, distance), abs=0.01
    )


def test_clear_water_takes_nothing_away(plates: Any) -> None:
    assert plates.visibility(0.0, 6.0) == pytest.approx(0.0, abs=0.01)


def test_the_originals_clip_distance_is_seen_by_the_same_measurement() -> None:
    # clip-space z is about 0.36 m short of the distance: 1 - exp(-(1.1 * 1.0)^2) at 1.36 m
    made = load().Plates(fog_distance="clip")
    measured = made.visibility(1.1, 1.36)
    made.close()
    assert measured == pytest.approx(visibility_loss(1.1, 1.0), abs=0.02)


@pytest.mark.slow
def test_all_nine_figures_come_out_in_quick_mode(tmp_path: Path) -> None:
    command = [sys.executable, "-W", "error", str(SCRIPT), str(tmp_path), "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    drawn = sorted(path.name[:9] for path in tmp_path.glob("*.png"))
    assert drawn == [f"figure-{number:02}" for number in range(3, 12)]
