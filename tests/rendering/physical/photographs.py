"""Photographs of simple targets in physical water, as radiance, for the tests of this folder."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from tests.rendering.models import Colour, placed, plate
from uwsim.assets.mesh import Mesh, Model
from uwsim.base.geometry import Intrinsics, Pose, image_centre
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.physical_water import PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

FloatArray = npt.NDArray[np.float64]
AT_ORIGIN = Pose.identity()
SHADOWLESS = Light(shadows=False)


def camera_of(focal: float, width: int, height: int) -> Intrinsics:
    """Return a camera with the focal length [px]."""
    cx, cy = image_centre(width, height)
    return Intrinsics(
        width=width, height=height, fx=focal, fy=focal, cx=cx, cy=cy, near=0.05, far=100.0
    )


def photograph(
    renderer: Renderer, water: PhysicalWater, camera: Intrinsics, lamps: Sequence[Lamp] = ()
) -> FloatArray:
    """Return the radiance of each pixel in linear light, (h, w, 3)."""
    image = renderer.draw(
        AT_ORIGIN, camera, Water(physical_water=water), SHADOWLESS,
        targets={"colour"}, colour="linear16", contents=ViewContents(lamps=lamps),
    )  # fmt: skip
    assert image.colour is not None
    return image.colour[..., :3] / 65535.0 / water.exposure


def show_plane(renderer: Renderer, distance: float, colour: Colour) -> None:
    """Show nothing but a wide plane at a distance along the optical axis."""
    renderer.clear()
    renderer.place(renderer.add(plate(400.0, 400.0, colour), 1), placed(z=-distance))


def show_stripes(renderer: Renderer, distance: float, edges: Sequence[float]) -> None:
    """Show a black plane with white stripes from the first edge to the second, and so on [m]."""
    show_plane(renderer, distance, (0.0, 0.0, 0.0))
    renderer.place(renderer.add(stripes(edges), 2), placed(z=-distance + 1e-4 * distance))


def stripes(edges: Sequence[float]) -> Model:
    """Return white stripes along y in the x-y plane, which face +z."""
    vertices, triangles = [], []
    for left, right in zip(edges[::2], edges[1::2], strict=True):
        first = len(vertices)
        vertices += [[left, -200, 0], [right, -200, 0], [right, 200, 0], [left, 200, 0]]
        triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    mesh = Mesh(
        vertices=np.array(vertices, np.float32),
        normals=np.tile(np.array([0, 0, 1], np.float32), (len(vertices), 1)),
        uvs=np.zeros((len(vertices), 2), np.float32),
        triangles=np.array(triangles, np.uint32),
        colour=(1.0, 1.0, 1.0),
    )
    return Model(name="stripes", meshes=(mesh,), source="stand-in")


def lamp_beside_camera(offset: float, half_angle: float = math.radians(30.0)) -> Lamp:
    """Return a lamp of 1 W/sr in a hard cone along the optical axis."""
    return Lamp(
        world_from_lamp=Pose(np.array([offset, 0.0, 0.0]), np.eye(3)),
        half_angle=half_angle,
        softness=0.0,
        intensity=1.0 / math.pi,
        casts_shadow=False,
    )
