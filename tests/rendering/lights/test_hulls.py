"""Hulls of wrecks: shadows of the sun and of diffuse light in physical water."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.rendering.models import block, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.optics import HenyeyGreenstein, Medium
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

DEPTH = 16.0
MEDIUM = Medium(
    absorption=(0.05,) * 3, scattering=(0.05,) * 3, phase_function=HenyeyGreenstein(0.9)
)


def measure_floor(renderer: Renderer, x: float, *, sky_share: float, shadows: bool) -> float:
    """Return the light of the floor at a place, from 1 m above it."""
    water = PhysicalWater(
        medium=MEDIUM,
        daylight=Daylight(elevation=0.5 * math.pi, sky_share=sky_share),
        transfer="linear",
        has_blur=False,
        exposure=1.0,
    )
    image = renderer.draw(
        Pose(np.array([x, 0.0, 1.0 - DEPTH]), np.eye(3)), Intrinsics.from_fovy(16, 16, 0.2),
        Water(physical_water=water), Light(shadows=shadows), targets={"colour"}, colour="linear16",
    )  # fmt: skip
    assert image.colour is not None
    return float(image.colour[..., :3].mean() / 65535.0)


def show_roof(renderer: Renderer, length: float, height: float, z: float) -> None:
    """Show a block above a floor."""
    renderer.clear()
    renderer.place(renderer.add(plate(100.0, 100.0), 1), placed(z=-DEPTH))
    renderer.place(renderer.add(block((length, 8.0, height)), 2), placed(z=z))


@pytest.mark.parametrize("sky_share", [0.0, 1.0])
def test_the_floor_under_a_hull_is_dark(renderer: Renderer, sky_share: float) -> None:
    show_roof(renderer, 20.0, 5.0, -10.0)
    lit, shaded, open_floor = (
        measure_floor(renderer, x, sky_share=sky_share, shadows=shadows)
        for x, shadows in ((0.0, False), (0.0, True), (30.0, True))
    )
    assert open_floor == pytest.approx(lit, rel=0.02)
    # light that the water between floor and camera scatters is left
    assert shaded < 0.3 * lit


def test_diffuse_light_grows_towards_the_edge_of_a_hull(renderer: Renderer) -> None:
    show_roof(renderer, 20.0, 5.0, -10.0)
    places = (6.0, 9.0, 10.2, 10.9, 13.0)
    light = [measure_floor(renderer, x, sky_share=1.0, shadows=True) for x in places]
    assert light[0] < 0.3 * light[2]
    assert light[2] < 0.9 * light[4]
    assert np.all(np.diff(light) >= -1e-3)


@pytest.mark.parametrize(
    ("length", "height", "z"),
    [(20.0, 1.0, -10.0), (60.0, 15.0, -8.0), (20.0, 5.0, -1.0)],
    ids=["flat ground", "too large", "through the surface"],
)
def test_tanks_and_ground_cast_no_shadow(
    renderer: Renderer, length: float, height: float, z: float
) -> None:
    show_roof(renderer, length, height, z)
    lit, shaded = (
        measure_floor(renderer, 0.0, sky_share=0.3, shadows=shadows) for shadows in (False, True)
    )
    assert shaded == pytest.approx(lit)
