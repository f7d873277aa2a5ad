"""The silhouettes of instances: their pixels as if nothing else were in the scene.

Several instances are drawn in one image if the rectangles around their projected boxes do not
touch, so that none hides another. The ids of the renderer alone decide about pixels.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.geometry import Intrinsics, Pose
from ..simulation import Simulation
from .instances import Instance, InstanceTable
from .pixel_counts import measure_ids

Rectangle = tuple[float, float, float, float]
"""The least and the greatest column, and the least and the greatest row [px]."""
MARGIN = 2.0
"""The margin around a projected box [px]."""


def measure_silhouettes(
    simulation: Simulation, table: InstanceTable, pose: Pose, intrinsics: Intrinsics
) -> npt.NDArray[np.int64]:
    """Return the pixel count and the box of each instance's silhouette, as `measure_ids`.

    Instances that are no things, or not in the view, have 0 pixels.
    """
    n = len(table.instances) + 1
    result = np.zeros((n, 5), np.int64)
    rectangles = {}
    for instance in table.boxed_instances:
        rectangle = find_rectangle(instance, pose, intrinsics)
        if rectangle is not None:
            rectangles[instance.number] = rectangle
    for numbers in group_apart(rectangles):
        shown_ids = frozenset(id for k in numbers for id in table.instances[k - 1].part_ids)
        image = simulation.world.scenery.render_clean(
            pose, intrinsics, targets={"ids"}, hidden_ids=table.all_ids - shown_ids
        )
        assert image.ids is not None
        group_rows = measure_ids(image.ids, table.instance_numbers, n)
        result[numbers] = group_rows[numbers]
    return result


def find_rectangle(instance: Instance, pose: Pose, intrinsics: Intrinsics) -> Rectangle | None:
    """Return a rectangle of the image that contains a thing; None if it is out of view.

    It is the whole image if the box reaches behind the near plane, or if the camera has a lens.
    """
    corners = pose.inverse().transform(instance.corners)
    whole_image = (0.0, float(intrinsics.width), 0.0, float(intrinsics.height))
    depths = -corners[:, 2]
    if depths.max() <= intrinsics.near:
        return None
    if intrinsics.lens is not None or depths.min() <= intrinsics.near:
        return whole_image
    pixels = intrinsics.project(corners)
    low, high = pixels.min(axis=0) - MARGIN, pixels.max(axis=0) + MARGIN
    rectangle = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    return rectangle if _overlap(rectangle, whole_image) else None


def group_apart(rectangles: dict[int, Rectangle]) -> Sequence[list[int]]:
    """Return groups of numbers whose rectangles do not overlap, as few as come greedily."""
    groups: list[list[int]] = []
    for number, rectangle in rectangles.items():
        for group in groups:
            if not any(_overlap(rectangle, rectangles[other]) for other in group):
                group.append(number)
                break
        else:
            groups.append([number])
    return groups


def _overlap(a: Rectangle, b: Rectangle) -> bool:
    return a[0] <= b[1] and b[0] <= a[1] and a[2] <= b[3] and b[2] <= a[3]
