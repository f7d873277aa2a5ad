"""The page about testing a controller: its controller works, its theory is what is computed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from paper.station_keeping import Loop, SwingingCurrent, predict_error
from uwsim.algorithms import load_algorithm
from uwsim.algorithms.control import StationKeeper

PAGE = (Path(__file__).parents[3] / "docs" / "testing-a-controller.md").read_text()


def swing_left(law: Any, *, time: float = 300.0, dt: float = 0.05) -> float:
    """Largest error [m] of a pure integrator in its last period, in a swing of 30 s."""
    position, seen = np.zeros(2), []
    for i in range(round(time / dt)):
        current = 0.1 * np.sin(2.0 * np.pi / 30.0 * i * dt)
        position = position + (law.step(-position, dt) + current) * dt
        seen.append(abs(position[0]))
    return float(max(seen[-round(30.0 / dt) :]))


def test_the_controller_of_the_page_learns_a_swing_that_p_lets_through(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)[0]
    (tmp_path / "resonant_of_the_page.py").write_text(code)
    monkeypatch.syspath_prepend(tmp_path)
    own: Any = load_algorithm("resonant_of_the_page:Resonant")()
    p = swing_left(StationKeeper(kp=0.4, ki=0.0, limit=0.5))
    assert p == pytest.approx(0.1 / np.hypot(0.4, 2.0 * np.pi / 30.0), rel=0.02)
    assert swing_left(own.law()) < 0.05 * p


def test_theory_on_the_page_is_what_the_closed_forms_say_and_is_met_within_5_percent() -> None:
    loops = {"P": Loop(kp=0.4), "PI": Loop(kp=0.4, ki=0.04), "PI, K_i 0.2": Loop(kp=0.4, ki=0.2)}
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in PAGE.splitlines()
        if line.startswith("| 0.")
    ]
    checked = 0
    for speed, controller, along, along_theory, across, across_theory in rows:
        if controller not in loops:
            continue
        swing = SwingingCurrent(speed=float(speed))
        theory, p = predict_error(loops[controller], swing), predict_error(loops["P"], swing)
        assert float(along_theory) == pytest.approx(theory.along_mean, abs=5e-5)
        assert float(across_theory) == pytest.approx(theory.across_amplitude, abs=5e-5)
        assert float(along) == pytest.approx(theory.along_mean, abs=0.05 * p.along_mean)
        assert float(across) == pytest.approx(
            theory.across_amplitude, abs=0.05 * p.across_amplitude
        )
        checked += 1
    assert checked == 5
