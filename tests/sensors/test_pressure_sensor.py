"""Depth and pressure against the weight of the water above."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier
from uwsim.base.geometry import Pose
from uwsim.sensors.pressure_sensor import PressureSensor, PressureSensorSpec, column_mass

LEVELS = np.array([[5.0, 1000.0], [15.0, 1020.0]])


def make(
    z: float, seed: int = 0, compatibility: frozenset[str] = frozenset(), **fields: object
) -> PressureSensor:
    """At the height z in W, under a surface at 2 m; L has its z axis down."""
    world = AcousticWorld(seed=seed, surface_height=2.0, compatibility=compatibility)
    spec = PressureSensorSpec(name="depth", relative_to="base", **fields)  # type: ignore[arg-type]
    carrier = FakeCarrier(Pose(np.array([1.0, 2.0, z]), np.eye(3)))
    return spec.bind(world, carrier)  # type: ignore[arg-type]


def test_the_depth_is_that_below_the_surface_and_never_above_it() -> None:
    assert make(-3.0).sample(0.0).pressure == 5.0
    assert make(2.5).sample(0.0).pressure == 0.0


def test_the_original_gives_z_of_the_frame_of_the_file() -> None:
    message = make(-3.0, compatibility=frozenset({"pressure-z"})).sample(0.0)
    assert (message.pressure, message.header.frame_id) == (3.0, "world")


def test_pressure_is_the_weight_of_the_water_above_and_the_air() -> None:
    """Uniform water of 1000 kg/m3 over 5 m."""
    assert make(-3.0, measures="gauge").sample(0.0).pressure == pytest.approx(49_050.0)
    absolute = make(-3.0, measures="pressure", atmosphere=100_000.0)
    assert absolute.sample(0.0).pressure == pytest.approx(149_050.0)
    assert make(3.0, measures="pressure").sample(0.0).pressure == 101_325.0


@pytest.mark.parametrize(
    ("depth", "mass"),
    [(0.0, 0.0), (4.0, 4e3), (5.0, 5000.0), (10.0, 10_025.0), (15.0, 15_100.0), (20.0, 20_200.0)],
)  # fmt: skip
def test_stratified_water_is_integrated(depth: float, mass: float) -> None:
    assert column_mass(LEVELS, depth) == pytest.approx(mass, rel=1e-14)


def test_noise_has_its_standard_deviation() -> None:
    """2000 samples: within 6 %, 3.8 standard errors (99.98 %)."""
    sensor = make(-3.0, std=0.02)
    depths = [sensor.sample(0.0).pressure for _ in range(2000)]
    assert np.std(depths) == pytest.approx(0.02, rel=0.06)
    assert np.mean(depths) == pytest.approx(5.0, abs=4 * 0.02 / np.sqrt(2000))
