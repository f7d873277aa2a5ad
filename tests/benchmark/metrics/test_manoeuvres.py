"""The numbers of manoeuvres, against closed forms of simple vehicles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from uwsim.benchmark.metrics.manoeuvres import (
    ManoeuvreTrack,
    SpiralPoint,
    fit_decay,
    fit_resistance,
    judge,
    measure_crash_stop,
    measure_pull_out,
    measure_spiral,
    measure_turning_circle,
    measure_zigzag,
)

LENGTH, SPEED = 2.0, 1.5  # [m], [m/s]
GAIN, TIME = 0.8, 1.2  # of Nomoto: [1/s], [s]


def track_of(
    times: np.ndarray, headings: np.ndarray, rudders: np.ndarray, speeds: np.ndarray | None = None
) -> ManoeuvreTrack:
    """Return the track of a vehicle that moves along its heading, on a course of 30 degrees."""
    speeds = np.full(len(times), SPEED) if speeds is None else speeds
    course = headings + math.radians(30.0)
    rates = np.gradient(headings, times)
    velocity = np.column_stack([speeds * np.cos(course), speeds * np.sin(course)])
    steps = 0.5 * (velocity[1:] + velocity[:-1]) * np.diff(times)[:, None]
    positions = np.array([5.0, -3.0]) + np.vstack([[0.0, 0.0], np.cumsum(steps, axis=0)])
    zeros = np.zeros(len(times))
    return ManoeuvreTrack(
        length=LENGTH, times=times, positions=positions, headings=course, surge=speeds,
        sway=zeros, yaw_rates=rates, rudders=rudders, depths=zeros,
    )  # fmt: skip


def nomoto_turn(rudder: float, duration: float = 60.0) -> ManoeuvreTrack:
    """Return a turn of the linear vehicle T r' + r = K delta (Nomoto 1957), in closed form."""
    times = np.arange(-2.0, duration, 0.005)
    t = np.maximum(times, 0.0)
    headings = GAIN * rudder * (t - TIME * (1.0 - np.exp(-t / TIME)))
    return track_of(times, headings, np.where(times >= 0.0, rudder, 0.0))


@pytest.mark.parametrize("rudder", [0.3, -0.3])
def test_a_steady_turn_of_a_linear_vehicle_has_the_radius_of_nomoto(rudder: float) -> None:
    turn = measure_turning_circle(nomoto_turn(rudder))
    assert turn.steady_diameter == pytest.approx(2.0 * SPEED / (GAIN * 0.3), rel=1e-3)
    assert turn.yaw_rate == pytest.approx(GAIN * rudder, rel=1e-3)
    assert turn.speed_loss == pytest.approx(0.0, abs=1e-9)
    assert turn.drift_angle == 0.0
    # K delta (t - T (1 - exp(-t / T))) = pi / 2
    assert turn.time_90 is not None
    t = turn.time_90
    expected = GAIN * 0.3 * (t - TIME * (1.0 - math.exp(-t / TIME)))
    assert expected == pytest.approx(0.5 * math.pi, rel=1e-4)


def test_a_turn_at_a_constant_rate_has_advance_radius_and_tactical_diameter() -> None:
    times = np.arange(0.0, 40.0, 0.01)
    turn = measure_turning_circle(track_of(times, 0.3 * times, np.full(len(times), 0.2)))
    radius = SPEED / 0.3
    assert turn.advance == pytest.approx(radius, rel=1e-4)
    assert turn.transfer == pytest.approx(radius, rel=1e-4)
    assert turn.tactical_diameter == pytest.approx(2.0 * radius, rel=1e-4)
    assert turn.steady_diameter == pytest.approx(2.0 * radius, rel=1e-4)


def test_a_turn_that_ends_early_has_no_tactical_diameter() -> None:
    times = np.arange(0.0, 8.0, 0.01)
    turn = measure_turning_circle(track_of(times, 0.3 * times, np.full(len(times), 0.2)))
    assert turn.advance is not None
    assert turn.tactical_diameter is None
    assert turn.steady_diameter is None
    (_, diameter) = judge(LENGTH, turns=(turn,))
    assert not diameter.is_met


def nomoto_zigzag(rudder: float, heading: float) -> tuple[ManoeuvreTrack, list[float]]:
    """Return a zig-zag of the linear vehicle, solved piece by piece, and its executions."""
    dt, psi, rate, order = 0.002, 0.0, 0.0, rudder
    rows, executions = [], [0.0]
    for k in range(int(40.0 / dt)):
        if len(executions) < 5 and math.copysign(1.0, order) * psi >= heading:
            order = -order
            executions.append(k * dt)
        rows.append((k * dt, psi, order))
        # exact over a step with a constant rudder
        decay = math.exp(-dt / TIME)
        psi += GAIN * order * dt + (rate - GAIN * order) * TIME * (1.0 - decay)
        rate = GAIN * order + (rate - GAIN * order) * decay
    times, headings, rudders = np.array(rows).T
    return track_of(times, headings, rudders), executions


def test_the_overshoots_of_a_linear_vehicle_are_those_of_its_closed_form() -> None:
    rudder = heading = math.radians(10.0)
    track, executions = nomoto_zigzag(rudder, heading)
    zigzag = measure_zigzag(track, heading)
    assert zigzag.initial_turning_time == pytest.approx(executions[1], abs=0.005)
    assert zigzag.initial_turning_distance == pytest.approx(SPEED * executions[1], rel=1e-3)
    # at the second execution the rate is r1; then r = (r1 + K d) exp(-t / T) - K d
    first_rate = GAIN * rudder * (1.0 - math.exp(-executions[1] / TIME))
    to_check = TIME * math.log((first_rate + GAIN * rudder) / (GAIN * rudder))
    angle = first_rate * TIME - GAIN * rudder * to_check
    first = zigzag.overshoots[0]
    assert first.time_to_check == pytest.approx(to_check, abs=0.005)
    assert first.angle == pytest.approx(angle, rel=5e-3)
    assert first.peak > 0.0 > zigzag.overshoots[1].peak
    assert zigzag.period == pytest.approx(executions[3] - executions[1], abs=0.005)


def test_a_zigzag_begins_to_port_as_well() -> None:
    rudder = heading = math.radians(10.0)
    track, _ = nomoto_zigzag(rudder, heading)
    mirrored = track_of(track.times, math.radians(30.0) - track.headings, -track.rudders)
    one, other = measure_zigzag(track, heading), measure_zigzag(mirrored, heading)
    assert [x.angle for x in one.overshoots] == pytest.approx([x.angle for x in other.overshoots])
    assert other.rudder == -one.rudder


def spiral_of(shift: float) -> list[SpiralPoint]:
    """Return a spiral of r + r^3 = K (delta + shift) of an imagined stable vehicle."""
    angles = np.radians([20, 10, 5, 2, 1, 0, -1, -2, -5, -10, -20])
    way = [*angles, *angles[-2::-1]]
    return [SpiralPoint(rudder=float(a), yaw_rate=0.5 * float(a + shift)) for a in way]


def test_a_stable_vehicle_has_no_loop_and_a_neutral_angle() -> None:
    spiral = measure_spiral(spiral_of(math.radians(-1.5)))
    assert spiral.loop_width == 0.0
    assert spiral.neutral_angle == pytest.approx(math.radians(1.5), abs=1e-9)


def test_the_loop_of_an_unstable_vehicle_is_that_of_its_cubic() -> None:
    """r^3 - a r = c delta (Nomoto and Bech): it folds at delta = 2 (a / 3)^1.5 / c."""
    a, c = 0.01, 0.05
    fold = 2.0 * (a / 3.0) ** 1.5 / c

    def steady_rate(delta: float, begin: float) -> float:
        rate = begin
        for _ in range(20000):
            rate += 0.2 * (c * delta - rate**3 + a * rate)
        return rate

    angles = np.radians(np.arange(10.0, -10.05, -0.2))
    points, rate = [], 0.2
    for delta in [*angles, *angles[-2::-1]]:
        rate = steady_rate(float(delta), rate)
        points.append(SpiralPoint(rudder=float(delta), yaw_rate=rate))
    rates = np.arange(-0.15, 0.151, 0.0025)
    reverse = [SpiralPoint(rudder=float((r**3 - a * r) / c), yaw_rate=float(r)) for r in rates]
    spiral = measure_spiral(points, reverse)
    assert spiral.loop_width is not None
    assert spiral.loop_width == pytest.approx(2.0 * fold, abs=1.01 * spiral.resolution)
    assert spiral.reverse_width == pytest.approx(2.0 * fold, rel=0.01)
    assert spiral.loop_height == pytest.approx(2.0 * math.sqrt(a), rel=0.01)


def test_the_pull_out_of_an_unstable_vehicle_leaves_a_rate() -> None:
    times = np.arange(0.0, 60.0, 0.05)
    starboard = track_of(times, 0.1 * times, np.zeros(len(times)))
    port = track_of(times, -0.06 * times, np.zeros(len(times)))
    assert measure_pull_out(starboard, port).residual_rate == pytest.approx(0.08)


def test_a_crash_stop_has_the_exact_integral_of_quadratic_drag_and_constant_thrust() -> None:
    mass, drag, thrust = 31.4, 1.62, 3.86
    speed = math.sqrt(thrust / drag)
    solution = solve_ivp(
        lambda _, u: -(drag * u * abs(u) + thrust) / mass, (0.0, 15.0), [speed],
        t_eval=np.arange(0.0, 15.0, 0.01), rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    times = np.concatenate([[-1.0], solution.t])
    speeds = np.concatenate([[speed], solution.y[0]])
    zeros = np.zeros(len(times))
    stop = measure_crash_stop(track_of(times, zeros, zeros, speeds))
    expected = mass / (2.0 * drag) * math.log(1.0 + drag * speed**2 / thrust)
    assert stop.track_reach == pytest.approx(expected, rel=1e-4)
    assert stop.head_reach == pytest.approx(expected, rel=1e-4)
    assert stop.lateral_deviation == pytest.approx(0.0, abs=1e-9)
    time = mass / math.sqrt(drag * thrust) * math.atan(speed * math.sqrt(drag / thrust))
    assert stop.time == pytest.approx(time, rel=1e-4)


@pytest.mark.parametrize(
    ("linear", "quadratic", "omega"), [(0.1, 0.0, 2.0), (0.0, 2.6, 1.7), (2.2, 1.3, 1.9)]
)
def test_a_decay_gives_the_coefficients_of_its_equation(
    linear: float, quadratic: float, omega: float
) -> None:
    times = np.arange(0.0, 40.0, 0.02)
    angles = solve_ivp(
        lambda _, y: [y[1], -linear * y[1] - quadratic * abs(y[1]) * y[1] - omega**2 * y[0]],
        (0.0, 40.0), [0.17, 0.0], t_eval=times, rtol=1e-10, atol=1e-12,
    ).y[0]  # fmt: skip
    decay = fit_decay(times, angles)
    assert decay is not None
    assert decay.period == pytest.approx(2.0 * math.pi / omega, rel=2e-3)
    assert decay.linear == pytest.approx(linear, abs=0.015 * max(linear, 1.0))
    assert decay.quadratic == pytest.approx(quadratic, abs=0.03 * max(quadratic, 0.1))


def test_the_logarithmic_decrement_of_a_linear_oscillator_is_its_damping_ratio() -> None:
    ratio, omega = 0.05, 2.0
    times = np.arange(0.0, 60.0, 0.02)
    damped = omega * math.sqrt(1.0 - ratio**2)
    angles = 0.17 * np.exp(-ratio * omega * times) * (
        np.cos(damped * times) + ratio * omega / damped * np.sin(damped * times)
    )  # fmt: skip
    decay = fit_decay(times, angles)
    assert decay is not None
    assert decay.damping_ratio(0.05) == pytest.approx(ratio, rel=0.01)


def test_a_vehicle_that_does_not_return_has_no_decay() -> None:
    times = np.arange(0.0, 40.0, 0.02)
    assert fit_decay(times, np.full(len(times), 0.17)) is None


def test_tows_give_linear_and_quadratic_damping() -> None:
    speeds = np.array([0.1, 0.3, 0.6, 1.0])
    found = fit_resistance(speeds, 13.7 * speeds + 141.0 * speeds**2)
    assert (found.linear, found.quadratic) == pytest.approx((13.7, 141.0))


@pytest.mark.parametrize(
    ("ratio", "first", "second"), [(1.0, 10.0, 25.0), (20.0, 15.0, 32.5), (40.0, 20.0, 40.0)]
)
def test_the_limits_of_overshoots_depend_on_length_over_speed(
    ratio: float, first: float, second: float
) -> None:
    """IMO resolution MSC.137(76), 5.3.3: 10 and 25 deg below L/V = 10 s, 20 and 40 from 30 s on."""
    rudder = heading = math.radians(10.0)
    zigzag = measure_zigzag(nomoto_zigzag(rudder, heading)[0], heading)
    criteria = judge(ratio * SPEED, zigzag_10=zigzag)
    assert [criterion.limit for criterion in criteria] == [2.5, first, second]
