r"""The view of bodies that the still surface mirrors.

A camera sees in the mirror what its image on the other side of the surface sees directly. With the
reflection :math:`S` at the surface, the rotation :math:`R` and the position :math:`p`, the camera
of the mirror has the rotation :math:`S R F` and the position :math:`S p`. :math:`F` turns the y
axis round, so that it is a rotation again; rows of the image are reversed. The range of a pixel is
the whole way by the mirror. The slopes of waves shift the look-up (`water_surface.frag.glsl`).

Not modelled: the elevation of waves, which moves the image of near bodies, and images of images.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base.geometry import Intrinsics, Pose

MIRROR_RATIO, WAVY_MIRROR_RATIO = 2, 4
"""The edges of a pixel of the mirror in pixels of the image, of a surface without and with waves,
which break up the image."""


def find_mirror_view(
    world_from_camera: Pose,
    intrinsics: Intrinsics,
    surface_height: float,
    max_range: float,
    *,
    has_waves: bool = False,
) -> tuple[Pose, Intrinsics]:
    """Return the pose and the pinhole of the camera of the mirror.

    Args:
        world_from_camera: the pose of the camera; OpenGL axes.
        intrinsics: the pinhole of the camera.
        surface_height: the height of the still surface in W [m].
        max_range: the range beyond which nothing is visible in the mirror [m].
        has_waves: True if the surface has waves.
    """
    position, rotation = world_from_camera.position, world_from_camera.rotation
    mirrored_position = np.array(
        [position[0], position[1], 2.0 * surface_height - float(position[2])]
    )
    mirrored_rotation = rotation * np.array([[1.0, -1.0, 1.0]])
    mirrored_rotation[2] *= -1.0
    ratio = WAVY_MIRROR_RATIO if has_waves else MIRROR_RATIO
    width = -(-intrinsics.width // ratio)
    height = -(-intrinsics.height // ratio)
    # The first pixel's corner stays; the last pixel may reach beyond the image.
    scale_x, scale_y = width / intrinsics.width, height / intrinsics.height
    cx = (intrinsics.cx + 0.5) * scale_x - 0.5
    cy = (intrinsics.cy + 0.5) * scale_y - 0.5
    lens = replace(
        intrinsics,
        width=width,
        height=height,
        fx=intrinsics.fx * scale_x,
        fy=intrinsics.fy * scale_y,
        cx=cx,
        cy=height - 1.0 - cy,
        skew=-intrinsics.skew * scale_x,
        far=max(min(intrinsics.far, max_range), 2.0 * intrinsics.near),
        lens=None,
    )
    return Pose(mirrored_position, mirrored_rotation), lens
