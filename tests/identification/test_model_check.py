"""The check of a model: other readings of a log, noise, and logs that are given twice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.identification.vehicles import bluerov2, log_of
from uwsim.errors import BadSetting
from uwsim.identification import Identification, IdentifySettings, WindowSettings, identify
from uwsim.identification.noise import measured_noise
from uwsim.identification.windows import cut_windows
from uwsim.logs import MotionSeries, VehicleLog
from uwsim.physics.hydrodynamics import columns as c

SETTINGS = IdentifySettings(
    free_names=("added_mass[surge]", "quadratic_damping"), windows=WindowSettings(step=0.02),
    n_starts=1, n_folds=0,
)  # fmt: skip


def motion_of(log: VehicleLog) -> MotionSeries:
    assert log.motion is not None
    return log.motion


def reverse_thruster(log: VehicleLog) -> VehicleLog:
    signs = np.ones(8)
    signs[6] = -1.0
    (part,) = log.commands
    return replace(log, commands=(replace(part, values=part.values * signs),))


def turn_positions_up(log: VehicleLog) -> VehicleLog:
    motion = motion_of(log)
    return replace(log, motion=replace(motion, positions=motion.positions * [1.0, 1.0, -1.0]))


def state_microseconds(log: VehicleLog) -> VehicleLog:
    (part,) = log.commands
    return replace(log, commands=(replace(part, values=1500.0 + 400.0 * part.values),))


def state_degrees(log: VehicleLog) -> VehicleLog:
    motion = motion_of(log)
    assert motion.twists is not None
    twists = motion.twists * np.repeat([1.0, 180.0 / np.pi], 3)
    return replace(log, motion=replace(motion, twists=twists))


def turn_body(log: VehicleLog) -> VehicleLog:
    motion = motion_of(log)
    assert motion.twists is not None
    twists = motion.twists * [1.0, -1.0, -1.0, 1.0, -1.0, -1.0]
    return replace(log, motion=replace(motion, twists=twists))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (reverse_thruster, "down_stern_starboard with the opposite sign"),
        (turn_positions_up, "positions with z up"),
        (state_microseconds, "microseconds"),
        (state_degrees, "angular velocities in degrees"),
        (turn_body, "a body forward, left, up"),
    ],
)
def test_a_mistake_in_a_log_is_named(
    change: Callable[[VehicleLog], VehicleLog], words: str
) -> None:
    result = identify([change(log_of())], bluerov2(), SETTINGS)
    assert words in result.check.warnings[0]
    assert any("does not explain the logs" in sentence for sentence in result.check.warnings)


def fit_truth() -> Identification:
    return identify([log_of()], bluerov2(), SETTINGS)


def test_a_log_that_the_model_explains_has_no_warning() -> None:
    check = fit_truth().check
    assert check.warnings == ()
    assert (check.noise_ratios > 0.4).all()
    assert (check.noise_ratios < 1.3).all()


def test_the_noise_of_measurements_does_not_depend_on_the_model() -> None:
    """Allow for fast turns, which count as noise of the angular velocity."""
    windows = cut_windows([log_of()], bluerov2(), WindowSettings())
    expected = np.repeat([0.005, 0.0035, 0.003, 0.00175], 3)
    ratios = measured_noise(windows, {}) / expected
    np.testing.assert_allclose(ratios[:9], 1.0, rtol=0.35)
    assert (ratios[9:] < 2.5).all()


def test_a_log_that_is_given_twice_is_refused() -> None:
    log = replace(log_of(), sha256="ab" * 32)
    with pytest.raises(BadSetting, match="give each log once"):
        identify([log, log], bluerov2(), SETTINGS)


def test_a_vehicle_that_rises_and_one_at_the_surface_are_named() -> None:
    model = bluerov2()
    bodies = model.numbers.bodies.copy()
    bodies[:, c.DISPLACED_MASS] *= 1.2
    log, motion = log_of(), motion_of(log_of())
    shallow_log = replace(
        log, motion=replace(motion, positions=motion.positions - [0.0, 0.0, 50.0])
    )
    light = replace(model, numbers=model.numbers._replace(bodies=bodies))
    text = " ".join(identify([shallow_log], light, SETTINGS).check.warnings)
    assert "rises with 25 N, 19 % of its weight" in text
    assert "deep water" in text
