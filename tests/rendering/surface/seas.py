"""Seas, cameras and photographs above and below the surface, for the tests of this folder."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from uwsim.base.geometry import Array, Intrinsics, Pose
from uwsim.optics import Medium
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water
from uwsim.waves import JonswapSpec, SeaSettings, Waves

FloatArray = npt.NDArray[np.float64]
BLACK_WATER = Medium(absorption=(5.0, 5.0, 5.0), scattering=(0.0, 0.0, 0.0))
CLEAR_WATER = Medium(absorption=(0.0, 0.0, 0.0), scattering=(0.0, 0.0, 0.0))
OVERCAST = Daylight(sky_share=1.0)
SEA = SeaSettings(
    depth=30.0,
    wind=(0.04, 0.04),
    wind_speed=12.0,
    reflection_damping=0.35,
    wave_scale=1e-7,
)


def make_waves(height: float, *, period: float = 5.0) -> Waves:
    """Return waves of 200 components over a depth of 30 m."""
    spec = JonswapSpec(significant_height=height, peak_period=period, direction=0.4, spreading=10.0)
    components = spec.components(SEA, np.random.Generator(np.random.Philox(3)))
    return Waves(components, SEA.depth, Pose.identity(), 0.0, np.ones(1))


def water_of(medium: Medium, daylight: Daylight, *, visibility: float = 1e6) -> PhysicalWater:
    """Return water with a surface and a linear curve."""
    return PhysicalWater(
        medium=medium,
        daylight=daylight,
        exposure=0.25,
        transfer="linear",
        has_surface=True,
        visibility=visibility,
    )


def look(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Pose:
    """Return the pose of an upright camera at a point that looks at another."""
    back = np.subtract(eye, target)
    back = back / math.sqrt(float((back * back).sum()))
    upright = np.array([0.0, 0.0, 1.0]) if abs(back[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(upright, back)
    right /= math.sqrt(float((right * right).sum()))
    return Pose(np.array(eye), np.stack([right, np.cross(back, right), back], axis=1))


def take(
    renderer: Renderer,
    water: PhysicalWater,
    pose: Pose,
    lens: Intrinsics,
    surface: MovingSurface | None = None,
) -> FloatArray:
    """Return the radiance of each pixel, (h, w, 3)."""
    image = renderer.draw(
        pose, lens, Water(physical_water=water), Light(shadows=False),
        targets={"colour"}, colour="linear16", contents=ViewContents(surface=surface),
    )  # fmt: skip
    assert image.colour is not None
    return image.colour[..., :3] / 65535.0 / water.exposure


def project(pose: Pose, lens: Intrinsics, points: Array) -> Array:
    """Return the image coordinates of points in W, (n, 2) [px]."""
    inside = (points - pose.position) @ pose.rotation
    return np.stack(
        [
            lens.fx * inside[:, 0] / -inside[:, 2] + lens.cx,
            -lens.fy * inside[:, 1] / -inside[:, 2] + lens.cy,
        ],
        axis=1,
    )
