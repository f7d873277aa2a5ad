"""Figures of station keeping say what was measured, and theory beside it."""

from __future__ import annotations

import numpy as np
import pytest

from paper.station_figures import Line, draw_over_current, draw_over_time
from paper.station_keeping import Loop, StationError, SwingingCurrent, predict_error


def test_every_panel_has_its_lines_and_theory_where_there_is_one() -> None:
    time = np.linspace(0.0, 60.0, 7)
    with_theory = Line(name="P", time=time, values=0.1 * time, theory=time)
    plain = Line(name="PI", time=time, values=-time)
    drawn = draw_over_time({"still": [plain], "0.2 m/s": [with_theory, plain]}, label="error [m]")
    left, right = drawn.axes
    assert [len(axes.lines) for axes in (left, right)] == [1, 3]
    assert right.lines[1].get_ydata() == pytest.approx(time)
    assert left.get_ylabel() == "error [m]"
    assert [text.get_text() for text in drawn.texts] == ["thin lines: theory (closed forms)"]
    assert right.get_xlim() == pytest.approx((0.0, 60.0))


def test_theory_that_is_not_drawn_is_not_spoken_of() -> None:
    time = np.linspace(0.0, 12.0, 7)
    line = Line(name="P", time=time, values=time, theory=np.full(7, np.nan))
    drawn = draw_over_time({"still": [line]}, label="error [m]", note="one seed")
    assert [text.get_text() for text in drawn.texts] == ["one seed"]


def station(mean: float) -> StationError:
    return StationError(
        along_mean=mean, along_amplitude=0.0, across_mean=0.0, across_amplitude=mean / 2.0
    )


def test_the_error_over_the_current_has_means_over_seeds_on_the_line_of_theory() -> None:
    loop = Loop(kp=0.4)
    kept = {"P": {0.0: [station(0.0), station(0.0)], 0.2: [station(0.3), station(0.5)]}}
    drawn = draw_over_current(kept, {"P": loop})
    points, line = (axes_line.get_ydata() for axes_line in drawn.axes[0].lines[::3])
    assert points == pytest.approx([0.0, 0.4])
    assert line[-1] == pytest.approx(predict_error(loop, SwingingCurrent(speed=0.2)).along_mean)
    assert "2 seeds" in drawn.texts[-1].get_text()


def test_one_seed_has_no_bars_and_says_so() -> None:
    drawn = draw_over_current({"P": {0.1: [station(0.2)]}}, {"P": Loop(kp=0.4)})
    assert "one seed" in drawn.texts[-1].get_text()
