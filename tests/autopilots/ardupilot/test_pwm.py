"""The curve from pulse width to command."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.autopilots.ardupilot import read_pwm_curve
from uwsim.errors import UwsimError

WITH_DEAD_BAND = (1100.0, -1.0, 1475.0, 0.0, 1525.0, 0.0, 1900.0, 1.0)


@pytest.mark.parametrize(
    ("pwm", "command"),
    [(1000, -1.0), (1100, -1.0), (1300, -0.5), (1500, 0.0), (1700, 0.5), (1900, 1.0), (2100, 1.0)],
)
def test_the_usual_curve_is_a_line_with_ends(pwm: int, command: float) -> None:
    curve = read_pwm_curve((1100.0, -1.0, 1500.0, 0.0, 1900.0, 1.0))
    assert curve.command(pwm) == pytest.approx(command, abs=1e-15)
    assert curve.negate().command(pwm) == pytest.approx(-command, abs=1e-15)


@given(st.integers(1475, 1525))
def test_a_dead_band_stops_the_thruster(pwm: int) -> None:
    assert read_pwm_curve(WITH_DEAD_BAND).command(pwm) == 0.0


def test_no_signal_is_no_command() -> None:
    assert read_pwm_curve((1000.0, 0.5, 2000.0, 1.0)).command(0) == 0.0


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ((1500.0,), "expected pairs"),
        ((1500.0, 0.0), "expected pairs"),
        ((1500.0, 0.0, 1400.0, 1.0), "expected numbers that rise"),
        ((0.0, 0.0, 1400.0, 1.0), "expected numbers that rise"),
        ((1400.0, 0.0, 70000.0, 1.0), "expected numbers that rise"),
        ((1400.0, 0.0, 1500.0, 1.5), "expected numbers from -1 to 1"),
    ],
)
def test_an_invalid_curve_is_an_error(numbers: tuple[float, ...], message: str) -> None:
    with pytest.raises(UwsimError, match=message):
        read_pwm_curve(numbers)
