"""Step responses against closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from uwsim.benchmark.metrics.step_response import StepResponse

DT = 1e-3


def response(
    error: Callable[[np.ndarray], np.ndarray],
    seconds: float,
    *,
    band: float = 0.02,
    least_step: float = 0.01,
    holds: bool = False,
    direction: tuple[float, ...] = (1.0,),
) -> StepResponse:
    """Sample ``error(t)`` along a direction at every step."""
    found = StepResponse(DT, band=band, least_step=least_step, is_constant=holds)
    times = np.arange(round(seconds / DT) + 1) * DT
    for k, value in enumerate(error(times).tolist()):
        found.add(value * np.array(direction), 1 if k else 0)
    return found


def second_order(zeta: float, omega: float) -> Callable[[np.ndarray], np.ndarray]:
    """The error after a unit step, Ogata (5-12)."""
    damped = omega * math.sqrt(1.0 - zeta**2)

    def error(t: np.ndarray) -> np.ndarray:
        wave = np.cos(damped * t) + zeta / math.sqrt(1.0 - zeta**2) * np.sin(damped * t)
        return np.exp(-zeta * omega * t) * wave

    return error


@pytest.mark.parametrize("zeta", [0.2, 0.4, 0.6, 0.8])
def test_overshoot_and_settling_of_a_second_order_system(zeta: float) -> None:
    damped = 5.0  # so that a sample falls near the peak at pi / 5
    omega = damped / math.sqrt(1.0 - zeta**2)
    found, reasons = response(second_order(zeta, omega), 40.0).shape()
    overshoot = math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2))
    curvature = omega**2 * overshoot  # of the error at its peak
    assert found["step"] == 1.0
    assert found["overshoot"] == pytest.approx(overshoot, abs=0.5 * curvature * (DT / 2) ** 2)
    assert found["overshoot_percent"] == pytest.approx(100.0 * found["overshoot"])
    fine = np.arange(0.0, 40.0, DT / 50)
    outside = np.flatnonzero(np.abs(second_order(zeta, omega)(fine)) > 0.02)
    assert found["settling_time"] == pytest.approx(fine[outside[-1]], abs=DT)
    assert found["steady_state_error"] == pytest.approx(0.0, abs=1e-6)
    assert reasons == {}


def test_overshoot_is_exact_where_a_sample_falls_on_the_peak() -> None:
    zeta = 0.5
    damped = math.pi / 0.6  # the peak is at 0.6 s
    omega = damped / math.sqrt(1.0 - zeta**2)
    found, _ = response(second_order(zeta, omega), 10.0).shape()
    assert found["overshoot"] == pytest.approx(
        math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2)), abs=1e-9
    )


def test_a_first_order_system_rises_settles_and_integrates_as_its_exponential() -> None:
    tau, size, end = 0.8, 3.0, 20.0
    found = response(lambda t: size * np.exp(-t / tau), end)
    shape, _ = found.shape()
    assert shape["overshoot"] == 0.0
    assert shape["rise_time"] == pytest.approx(tau * math.log(9.0), abs=DT)
    assert shape["settling_time"] == pytest.approx(tau * math.log(50.0), abs=DT)
    left = math.exp(-end / tau)
    trapezoid = DT**2 / 12.0 * size / tau  # Euler and Maclaurin
    assert found.iae == pytest.approx(size * tau * (1.0 - left) + trapezoid, abs=1e-9)
    assert found.ise == pytest.approx(size**2 * tau / 2.0, abs=1e-6)
    assert found.itae == pytest.approx(size * tau**2, abs=1e-6)


def test_integrals_of_an_error_that_runs_straight_are_exact() -> None:
    found = response(lambda t: 4.0 - 2.0 * t, 2.0)
    assert found.iae == pytest.approx(4.0, abs=1e-9)
    assert found.ise == pytest.approx(32.0 / 3.0, abs=1e-9)


def test_integrals_of_an_error_that_holds_are_exact() -> None:
    found = StepResponse(0.5, band=0.02, least_step=0.0, is_constant=True)
    for error, steps in ((2.0, 0), (-1.0, 4), (0.0, 2)):
        found.add(np.array([error]), steps)
    assert found.ise == pytest.approx(4.0 * 2.0 + 1.0 * 1.0, abs=1e-12)
    assert found.iae == pytest.approx(2.0 * 2.0 + 1.0 * 1.0, abs=1e-12)
    assert found.itae == pytest.approx(2.0 * 0.5 * 4.0 + 1.0 * 0.5 * (9.0 - 4.0), abs=1e-12)


def test_a_wider_band_is_reached_sooner() -> None:
    error = second_order(0.3, 4.0)
    times = [response(error, 20.0, band=band).shape()[0]["settling_time"] for band in (0.02, 0.05)]
    assert times[1] is not None
    assert times[0] is not None
    assert times[1] < times[0]


def test_a_response_in_space_has_the_numbers_of_the_same_response_on_a_line() -> None:
    error = second_order(0.4, 3.0)
    line = response(error, 15.0)
    space = response(error, 15.0, direction=(2 / 3, -2 / 3, 1 / 3))
    assert space.shape()[0] == pytest.approx(line.shape()[0], abs=1e-9)
    assert (space.ise, space.iae, space.itae) == pytest.approx((line.ise, line.iae, line.itae))


def test_going_aside_is_no_overshoot_but_keeps_from_settling() -> None:
    found = StepResponse(DT, band=0.02, least_step=0.01, is_constant=False)
    for k, t in enumerate(np.arange(0.0, 10.0, DT)):
        found.add(np.array([math.exp(-5.0 * t), 0.1]) - [0.0, 0.1 * (k == 0)], int(k > 0))
    shape, reasons = found.shape()
    assert shape["overshoot"] == 0.0
    assert shape["settling_time"] is None
    assert reasons == {"settling_time": "not within 0.02 of the step at the end"}
    assert shape["steady_state_error"] == pytest.approx(0.1, abs=1e-6)


def test_a_steady_state_error_is_the_mean_of_the_last_tenth() -> None:
    found = response(
        lambda t: np.where(t < 9.0 - 1e-9, 1.0, 0.25 + 0.1 * np.sin(20 * np.pi * t)), 10.0
    )
    shape, _ = found.shape()
    assert shape["steady_state_error"] == pytest.approx(0.25, abs=1e-3)


def test_what_never_rises_and_never_settles_has_no_such_times_and_says_why() -> None:
    shape, reasons = response(lambda t: 1.0 - 0.05 * t, 10.0).shape()
    assert shape["overshoot"] == 0.0
    assert (shape["rise_time"], shape["settling_time"]) == (None, None)
    assert reasons == {
        "rise_time": "never rose to 90% of the step",
        "settling_time": "not within 0.02 of the step at the end",
    }


def test_without_a_step_there_is_no_shape_but_there_are_integrals() -> None:
    found = response(lambda t: 0.005 + 0.0 * t, 2.0)
    shape, reasons = found.shape()
    assert shape["step"] == pytest.approx(0.005)
    assert shape["steady_state_error"] == pytest.approx(0.005)
    assert set(reasons) == {"overshoot", "overshoot_percent", "rise_time", "settling_time"}
    assert set(reasons.values()) == {"no step: the error was 0.005 at the start"}
    assert found.iae == pytest.approx(0.01)


def test_before_a_sample_there_is_nothing() -> None:
    found = StepResponse(DT, band=0.02, least_step=0.0, is_constant=False)
    assert (found.n, found.size) == (0, None)
    assert set(found.shape()[0].values()) == {None}
