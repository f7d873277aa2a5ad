"""Materials from height maps: base colour, normal, occlusion, roughness and metallic share."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from uwsim.assets.mesh import Texture

from .parts import Maps, Part
from .shapes import CREASE, Shape, mesh
from .textures import Grey, Pixels, to_texture

OCCLUSION_RADII = (2.0, 5.0, 12.0)
"""The deviations of the blurs that occlusion compares heights with [px]."""


@dataclass(frozen=True, eq=False)
class Material:
    """The images of a material, which its parts share."""

    colour: Texture
    """The base colour."""
    maps: Maps
    """The other maps."""

    def cover(self, *shapes: Shape, crease: float = CREASE, two_sided: bool = False) -> Part:
        """Return a part of this material; edges below the angle ``crease`` [rad] are smooth."""
        triangles = mesh(*shapes, texture=self.colour, crease=crease, two_sided=two_sided)
        return Part(mesh=triangles, maps=self.maps)


def make_material(
    name: str,
    image: Pixels,
    height: Grey,
    roughness: Grey | float,
    *,
    pixel: tuple[Grey | float, Grey | float],
    metallic: Grey | float = 0.0,
    repeats: bool = True,
    occlusion_depth: float | None = None,
) -> Material:
    """Make a material from a colour image and a height map.

    Args:
        name: the name of the material, which is unique.
        image: the base colour, (h, w, 3), 0..1.
        height: the height of the surface, (h, w) [m].
        roughness: the roughness, 0..1.
        pixel: the size of a pixel along u and v, everywhere or for each pixel [m].
        metallic: the metallic share, 0..1.
        repeats: True if opposite sides fit together.
        occlusion_depth: the depth of a pit that is dark [m]; by default of the heights.

    The map of occlusion, roughness and metal has half the resolution.
    """
    shape = height.shape
    depth = occlusion_depth or 2.0 * float(height.std()) + 1e-9
    channels = (find_occlusion(height, depth, tiles=repeats), roughness, metallic)
    channels_image = np.stack([np.broadcast_to(np.float32(c), shape) for c in channels], axis=2)
    half_size = (shape[1] // 2, shape[0] // 2)
    channels_image = np.asarray(cv2.resize(channels_image, half_size, interpolation=cv2.INTER_AREA))
    maps = Maps(
        normal=to_texture(
            f"{name}/normal", find_normals(height, pixel, tiles=repeats), repeats=repeats
        ),
        surface=to_texture(f"{name}/surface", channels_image, repeats=repeats),
        metallic=1.0 if np.max(metallic) > 0.0 else 0.0,
    )
    return Material(to_texture(name, image, repeats=repeats), maps)


def find_normals(height: Grey, pixel: tuple[Grey | float, Grey | float], *, tiles: bool) -> Pixels:
    r"""Return the normal map of a height map, 0..1, (h, w, 3).

    .. math:: n = (-\partial h/\partial u, -\partial h/\partial v, 1) / |\cdot|

    with v upwards, against the rows.
    """
    border = cv2.BORDER_WRAP if tiles else cv2.BORDER_REPLICATE
    bordered_map = cv2.copyMakeBorder(height, 1, 1, 1, 1, border)
    slope_u = (bordered_map[1:-1, 2:] - bordered_map[1:-1, :-2]) / (2.0 * np.float32(pixel[0]))
    slope_v = (bordered_map[:-2, 1:-1] - bordered_map[2:, 1:-1]) / (2.0 * np.float32(pixel[1]))
    normals = np.stack([-slope_u, -slope_v, np.ones_like(height)], axis=2)
    normals /= np.sqrt((normals * normals).sum(axis=2, keepdims=True))
    image: Pixels = normals * np.float32(0.5) + np.float32(0.5)
    return image


def find_occlusion(height: Grey, depth: float, *, tiles: bool) -> Grey:
    """Return the open share of the sky, 0..1, from heights below their surroundings.

    Not modelled: the direction; a pit of ``depth`` [m] below its surroundings is dark.
    """
    border = cv2.BORDER_WRAP if tiles else cv2.BORDER_REFLECT
    pit = np.zeros_like(height)
    for radius in OCCLUSION_RADII:
        margin = int(3 * radius)
        bordered_map = cv2.copyMakeBorder(height, margin, margin, margin, margin, border)
        blurred_map = cv2.GaussianBlur(bordered_map, (0, 0), radius)[margin:-margin, margin:-margin]
        pit += np.clip(blurred_map - height, 0.0, None) / np.float32(len(OCCLUSION_RADII))
    share: Grey = np.clip(1.0 - pit / np.float32(depth), 0.25, 1.0)
    return share
