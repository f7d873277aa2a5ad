"""The observer of waves predicts them, and the feed-forward opposes what it predicts."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.control import Feedforward
from uwsim.algorithms.control.wave_observer import WaveObserver
from uwsim.base.rng import stream
from uwsim.messages import DVL, TwistStamped, floats
from uwsim.waves import JonswapSpec, SeaSettings, wave_numbers

PERIOD, STEP, HORIZON = 5.0, 0.1, 0.56  # [s]


def sea_velocity(height: float, n: int) -> np.ndarray:
    """Return the horizontal velocity of the water 1.9 m deep in a sea, every 0.1 s, (n,) [m/s]."""
    sea = SeaSettings(depth=5.0, wind=(0, 0), wind_speed=0, reflection_damping=0, wave_scale=0)
    spec = JonswapSpec(significant_height=height, peak_period=PERIOD)
    parts = spec.components(sea, stream(2, "scene/waves/0"))
    omega, k = parts.angular_frequency, wave_numbers(parts.angular_frequency, 5.0)
    speed = parts.amplitude * omega * np.cosh(3.1 * k) / np.sinh(5.0 * k)
    times = STEP * np.arange(n)
    return (speed * np.cos(parts.phase - omega * times[:, None])).sum(axis=1)


def prediction_errors(velocity: np.ndarray, noise: float = 0.0) -> np.ndarray:
    """Return the error of the prediction by the horizon after each measurement [m/s]."""
    observer, rng = WaveObserver(period=PERIOD, damping=0.1), np.random.default_rng(1)
    ahead, errors = HORIZON / STEP, []
    times = np.arange(len(velocity))
    for i in range(len(velocity) - 8):
        measured = velocity[i] + noise * rng.standard_normal()
        observer.update(np.array([measured, -measured]), i * STEP)
        surge, sway = observer.predict(i * STEP + HORIZON)
        assert sway == pytest.approx(-surge)
        errors.append(surge - np.interp(i + ahead, times, velocity))
    return np.array(errors)


def test_a_regular_wave_is_predicted() -> None:
    """The oscillator's damping draws a prediction to 0, by 7 % over the horizon."""
    velocity = 0.3 * np.sin(2.0 * math.pi / PERIOD * STEP * np.arange(600))
    assert np.abs(prediction_errors(velocity)[300:]).max() < 0.12 * 0.3


def test_a_sea_is_predicted_better_than_by_the_newest_measurement() -> None:
    velocity = sea_velocity(0.4, 3000)
    errors = prediction_errors(velocity, noise=0.02)[300:]
    n = len(errors)
    ahead = round(HORIZON / STEP)
    held = velocity[300 : 300 + n] - velocity[300 + ahead : 300 + ahead + n]
    assert errors.std() < 0.45 * velocity.std()
    assert errors.std() < 0.65 * held.std()


def test_a_current_is_not_taken_for_a_wave() -> None:
    observer = WaveObserver(period=PERIOD, damping=0.1)
    for i in range(600):
        observer.update(np.array([0.2, 0.0]), i * STEP)
    for time in (60.0, 61.0, 64.0):
        assert observer.predict(time) == pytest.approx([0.2, 0.0], abs=0.01)


def test_before_a_measurement_the_water_is_still() -> None:
    assert not WaveObserver(period=PERIOD, damping=0.1).predict(3.0).any()


def test_the_defaults_are_those_of_linear_theory() -> None:
    """See the docstring of the module for the layer, its beams, and the velocity loops."""
    omega = 2.0 * math.pi / PERIOD
    k = float(wave_numbers(np.array([omega]), 5.0)[0])
    layer = math.cosh(2.2 * k) / math.cosh(3.1 * k) * (1.0 - k * math.tanh(2.2 * k))
    s, time_constant = 1j * omega, 0.2  # of the thrusters [s]
    kv, ki = 0.32 / time_constant, 0.032 / time_constant**2
    numerator = s**2 + kv * s + ki
    loop = numerator / (time_constant * s**3 + numerator) / (1.0 + 2.5 * time_constant * s)
    lag = -float(np.angle(loop)) / omega
    assert Feedforward.PARAMETERS["gain"] == pytest.approx(1.0 / (abs(loop) * layer), abs=0.005)
    assert Feedforward.PARAMETERS["horizon"] == pytest.approx(lag + 0.05, abs=0.005)


def commands(status: str) -> list[float]:
    """Return the surge command for a centred target in water that comes from ahead [m/s]."""
    node = FakeNode()
    Feedforward().start(node)
    k = np.array([400.0, 0.0, 320.0, 0.0, 400.0, 240.0, 0.0, 0.0, 1.0])
    node.readers["/uwsim/camera1_info"](SimpleNamespace(k=k))
    for i in range(300):
        node.now = i * STEP
        track = DVL(ws_longitudinal=0.2, bs_status="A", ws_status=status)
        node.readers["/dvl"](track)
    node.readers["centroidTopic"](floats(np.array([320.0, 240.0])))
    return [
        message.twist.linear.x for _, message in node.published if isinstance(message, TwistStamped)
    ]


def test_the_command_opposes_the_water() -> None:
    """It moves at -0.2 m/s, the vehicle at 0 over the bottom: 0.2 m/s through the water."""
    (surge,) = commands("A")
    assert surge == pytest.approx(1.18 * 0.2, abs=0.01)


def test_an_invalid_track_is_not_used() -> None:
    assert commands("V") == [0.0]
