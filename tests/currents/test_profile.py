"""Depth profiles: their laws, at the surface and at the ground, whichever way z points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.base.rng import stream
from uwsim.currents import (
    CurrentSpec,
    LayerSpec,
    LayersSpec,
    LogProfileSpec,
    PowerProfileSpec,
    SceneContext,
)
from uwsim.errors import BadSetting

SURFACE = (0.4, -0.2, 0.0)
POWER = PowerProfileSpec(velocity=SURFACE, depth=20.0)
LOG = LogProfileSpec(velocity=SURFACE, depth=20.0, roughness=0.002)
LAYERS = LayersSpec(
    layers=(
        LayerSpec(depth=1.0, velocity=(0.5, 0.0, 0.0)),
        LayerSpec(depth=5.0, velocity=(0.1, 0.2, 0.0)),
        LayerSpec(depth=9.0, velocity=(0.0, 0.0, 0.0)),
    )
)


def downward() -> SceneContext:
    """Return a scene whose file has z down from the surface: north, east, down."""
    return SceneContext(
        stream=lambda name: stream(0, name),
        world_from_localized=Pose.from_xyz((0.0, 0.0, 0.0), (math.pi, 0.0, -math.pi / 2.0)),
    )


def at_depths(spec: CurrentSpec, *depths: float) -> np.ndarray:
    points = np.array([[3.0, -2.0, depth] for depth in depths])
    return spec.bind(downward()).velocity(points, 5.0)


def test_the_power_law_is_the_seventh_root_of_the_height_over_ground() -> None:
    depths = np.array([0.0, 5.0, 10.0, 19.0])
    expected = ((20.0 - depths) / 20.0)[:, None] ** (1.0 / 7.0) * np.array(SURFACE)
    assert at_depths(POWER, *depths) == pytest.approx(expected)


def test_the_power_law_may_have_another_exponent() -> None:
    spec = PowerProfileSpec(velocity=SURFACE, depth=20.0, exponent=1.0)
    assert at_depths(spec, 15.0)[0] == pytest.approx(np.array(SURFACE) / 4.0)


def test_the_mean_of_the_seventh_root_over_depth_is_seven_eighths() -> None:
    depths = (np.arange(4000) + 0.5) / 200.0
    assert at_depths(POWER, *depths)[:, 0].mean() == pytest.approx(0.4 * 7.0 / 8.0, rel=1e-4)


def test_the_log_law_is_the_law_of_the_wall() -> None:
    friction = math.hypot(*SURFACE) * 0.41 / math.log(20.0 / 0.002)
    speeds = np.linalg.norm(at_depths(LOG, 19.0, 10.0, 0.0), axis=1)
    assert speeds == pytest.approx(friction / 0.41 * np.log(np.array([1.0, 10.0, 20.0]) / 0.002))


def test_layers_are_joined_straight_and_even_beyond_the_outermost() -> None:
    assert at_depths(LAYERS, 0.0, 1.0, 3.0, 5.0, 8.0, 30.0) == pytest.approx(
        np.array(
            [[0.5, 0, 0], [0.5, 0, 0], [0.3, 0.1, 0], [0.1, 0.2, 0], [0.025, 0.05, 0], [0, 0, 0]]
        )
    )


@pytest.mark.parametrize("spec", [POWER, LOG], ids=["power", "log"])
def test_above_the_surface_is_as_at_the_surface_and_the_ground_stands_still(
    spec: CurrentSpec,
) -> None:
    above, ground, below = at_depths(spec, -1.0, 20.0, 25.0)
    assert above == pytest.approx(SURFACE)
    assert ground.tolist() == below.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("spec", [POWER, LOG, LAYERS], ids=["power", "log", "layers"])
def test_depth_counts_from_the_surface_whichever_way_the_file_has_z(spec: CurrentSpec) -> None:
    upward = SceneContext(
        stream=lambda name: stream(0, name),
        world_from_localized=Pose.from_xyz((5.0, 1.0, 2.0), (0.0, 0.0, 0.3)),
        surface_height=7.0,
    )
    points = np.array([[0.0, 0.0, 5.0 - depth] for depth in (0.5, 4.0, 12.0)])
    assert spec.bind(upward).velocity(points, 0.0) == pytest.approx(at_depths(spec, 0.5, 4.0, 12.0))


def test_profiles_are_steady() -> None:
    points = np.array([[0.0, 0.0, 4.0]])
    layers = LAYERS.bind(downward())
    assert layers.is_steady
    assert layers.acceleration(points, 3.0).tolist() == [[0.0, 0.0, 0.0]]


def test_layers_out_of_order_are_an_error() -> None:
    spec = LayersSpec(layers=LAYERS.layers[::-1])
    with pytest.raises(BadSetting, match=r"depth 5 m follows one of 9 m; expected .* top down"):
        spec.bind(downward())


def test_ground_rougher_than_the_water_is_deep_is_an_error() -> None:
    spec = LogProfileSpec(velocity=SURFACE, depth=0.001, roughness=0.002)
    with pytest.raises(BadSetting, match=r"depth 0\.001 m and roughness 0\.002 m"):
        spec.bind(downward())
