r"""The labels of an image: masks, boxes, keypoints and visibility of each instance.

The masks are the renderer's ids, mapped to instances and classes. The visibility of an instance is

.. math:: v = \frac{n_\mathrm{visible}}{n_\mathrm{silhouette}}

with its pixels in the image and those of its silhouette (`silhouettes`), both inside of the image.
The truncation is the share of the rectangle around the projected 3-D box that is outside of the
image; it is None if the box reaches behind the camera.

Keypoints are declared points, or the corners of the 3-D box, with COCO's flags: 0 outside of the
image, 1 hidden, 2 visible. A point is hidden if the surface in its pixel is nearer by more than a
tolerance, which is greater for corners: these are rarely on the surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import length
from ..rendering.rendered_image import RenderedImage
from ..simulation import Simulation
from .camera import world_from_optical
from .instances import Instance, InstanceTable
from .pixel_counts import number_image, pixel_box
from .silhouettes import measure_silhouettes

N_DIGITS = 6
"""The number of decimals of lengths [m] and pixels in records."""


@dataclass(frozen=True, eq=False)
class ImageLabels:
    """The labels of an image."""

    instance_mask: npt.NDArray[np.uint16]
    """The number of the visible instance in each pixel, (h, w); 0: no surface."""
    class_mask: npt.NDArray[np.uint8]
    """The number of the visible class in each pixel, (h, w); 0: no surface."""
    depth: npt.NDArray[np.float32]
    """The distance along the optical axis of each pixel, (h, w) [m]; inf: no surface."""
    instances: list[dict[str, Any]]
    """The record of each thing with a silhouette in the image, by number."""


def label_image(
    simulation: Simulation, table: InstanceTable, pose: Pose, image: RenderedImage
) -> ImageLabels:
    """Return the labels of an image with ranges and part numbers; poses have OpenGL axes in W."""
    assert image.ids is not None
    masks = number_image(
        image.ids, table.instance_numbers, table.class_numbers, len(table.instances) + 1
    )
    silhouettes = measure_silhouettes(simulation, table, pose, image.intrinsics)
    depth = image.depth
    return ImageLabels(
        instance_mask=masks.instance_mask,
        class_mask=masks.class_mask,
        depth=depth,
        instances=[
            _describe(
                table,
                instance,
                image,
                depth,
                pose,
                masks.rows[instance.number],
                silhouettes[instance.number],
            )
            for instance in table.boxed_instances
            if silhouettes[instance.number, 0] > 0
        ],
    )


def _describe(
    table: InstanceTable,
    instance: Instance,
    image: RenderedImage,
    depth: npt.NDArray[np.float32],
    pose: Pose,
    visible_row: npt.NDArray[np.int64],
    silhouette_row: npt.NDArray[np.int64],
) -> dict[str, Any]:
    """Return the record of a thing in an image."""
    optical_from_world = world_from_optical(pose).inverse()
    optical_from_box = optical_from_world @ instance.world_from_box
    corners = optical_from_world.transform(instance.corners)
    pixels = project_optical(image.intrinsics, corners)
    world_points, tolerance = table.find_keypoints(instance)
    points = optical_from_world.transform(world_points)
    n_visible, n_silhouette = int(visible_row[0]), int(silhouette_row[0])
    return {
        "number": instance.number,
        "name": instance.name,
        "class": instance.label,
        "box": list(pixel_box(visible_row)) if n_visible else None,
        "amodal_box": list(pixel_box(silhouette_row)),
        "visible_pixels": n_visible,
        "silhouette_pixels": n_silhouette,
        "visibility": round_values(n_visible / n_silhouette),
        "truncation": _truncation(pixels, image.intrinsics),
        "distance": round_values(length(optical_from_box.position)),
        "box_3d": {
            "centre": round_values(optical_from_box.position),
            "size": round_values(instance.size),
            "quaternion_wxyz": round_values(optical_from_box.quaternion),
            "corners": round_values(corners),
        },
        "keypoints": _flag_keypoints(
            project_optical(image.intrinsics, points), points, depth, tolerance
        ),
    }


def project_optical(intrinsics: Intrinsics, points: Array) -> Array:
    """Return the pixels (n, 2) of points in the camera's optical axes (n, 3) [m]; NaN: behind."""
    return intrinsics.project(points * [1.0, -1.0, -1.0])


def round_values(value: Any) -> Any:
    """Return a number, or an array as lists, with `N_DIGITS` decimals; -0 becomes 0."""
    values = np.round(np.asarray(value, dtype=np.float64), N_DIGITS) + 0.0
    return values.tolist()


def _truncation(pixels: Array, intrinsics: Intrinsics) -> float | None:
    if not np.isfinite(pixels).all():
        return None
    edges = np.array([intrinsics.width, intrinsics.height], dtype=np.float64)
    low, high = pixels.min(axis=0) + 0.5, pixels.max(axis=0) + 0.5
    sides = high - low
    visible_sides = np.clip(high, 0.0, edges) - np.clip(low, 0.0, edges)
    area = float(sides[0] * sides[1])
    return (
        0.0
        if area <= 0.0
        else float(round_values(1.0 - visible_sides[0] * visible_sides[1] / area))
    )


def _flag_keypoints(
    pixels: Array, points: Array, depth: npt.NDArray[np.float32], tolerance: float
) -> list[list[float]]:
    """Return u, v [px] and COCO's flag of each point; 0, 0, 0 outside of the image."""
    height, width = depth.shape
    keypoints = []
    for (u, v), point in zip(pixels.tolist(), points.tolist(), strict=True):
        if not (-0.5 <= u < width - 0.5 and -0.5 <= v < height - 0.5):  # also NaN
            keypoints.append([0.0, 0.0, 0])
            continue
        surface = float(depth[int(np.floor(v + 0.5)), int(np.floor(u + 0.5))])
        flag = 1 if surface < point[2] - tolerance else 2
        keypoints.append([round_values(u), round_values(v), flag])
    return keypoints
