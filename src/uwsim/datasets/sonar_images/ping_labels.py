r"""The labels of a sonar image: masks, boxes, keypoints and visibility of each instance.

The instance of a bin of range and bearing is that of the strongest return,

.. math:: \operatorname*{argmax}_i P_i(r, \phi), \qquad P_i > P_\mathrm{noise}

with the mean power :math:`P_i` of the echoes of the instance i alone, in the shadows of all others,
and that of the noise. A bin without an echo above the noise has 0. Speckle changes no label. Not
modelled: the paths by the water's surface, whose echoes have no label.

The visibility is the share of rays to points of the instance's surface in the fan that meet the
instance first. The truncation is the share of these points outside of the fan.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import arctan2
from ...base.numerics.linear import length
from ...sensors.sonar.echoes import MICROPASCAL
from ...simulation import Simulation
from ..instances import Instance, InstanceTable
from ..labels import round_values
from ..pixel_counts import number_image, pixel_box
from .dataset_sonar import DatasetSonar

HIT_TOLERANCE = 0.02
"""The distance by which rays are longer than to a point [m]."""


@dataclass(frozen=True, eq=False)
class PingLabels:
    """The labels of a sonar image."""

    instance_mask: npt.NDArray[np.uint16]
    """The number of the instance in each bin and beam, (bins, beams); 0: no echo."""
    class_mask: npt.NDArray[np.uint8]
    """The number of the class in each bin and beam, (bins, beams); 0: no echo."""
    instances: list[dict[str, Any]]
    """The record of each thing with an echo, by number."""


def label_ping(
    simulation: Simulation, table: InstanceTable, sonar: DatasetSonar, world_from_sonar: Pose
) -> PingLabels:
    """Return the labels of a ping from a pose."""
    numbers = find_strongest(sonar, world_from_sonar, table.instance_numbers)
    n = len(table.instances) + 1
    class_numbers = np.zeros(n, np.uint8)
    for instance in table.instances:
        class_numbers[instance.number] = 1 + table.classes.index(instance.label)
    masks = number_image(numbers, np.arange(n, dtype=np.uint16), class_numbers, n)
    return PingLabels(
        instance_mask=masks.instance_mask,
        class_mask=masks.class_mask,
        instances=[
            _describe(
                simulation, table, sonar, world_from_sonar, instance, masks.rows[instance.number]
            )
            for instance in table.boxed_instances
            if masks.rows[instance.number, 0] > 0
        ],
    )


def find_strongest(
    sonar: DatasetSonar, world_from_sonar: Pose, instance_numbers: npt.NDArray[np.uint16]
) -> npt.NDArray[np.uint16]:
    """Return the instance of the strongest return in each bin and beam, (bins, beams)."""
    spec = sonar.sonar.spec
    noise = 10.0 ** (0.05 * (spec.noise_level + MICROPASCAL))
    max_amplitudes = np.full((spec.bins, spec.beams), noise, np.float32)
    numbers = np.zeros((spec.bins, spec.beams), np.uint16)
    groups = sonar.sonar.echoes.separate_amplitudes(world_from_sonar, instance_numbers)
    for number, amplitudes in groups.items():
        is_stronger = amplitudes > max_amplitudes
        numbers[is_stronger] = number
        max_amplitudes[is_stronger] = amplitudes[is_stronger]
    return np.ascontiguousarray(numbers[:, ::-1])


def _describe(
    simulation: Simulation,
    table: InstanceTable,
    sonar: DatasetSonar,
    world_from_sonar: Pose,
    instance: Instance,
    row: npt.NDArray[np.int64],
) -> dict[str, Any]:
    """Return the record of a thing in a sonar image."""
    sonar_from_world = world_from_sonar.inverse()
    sonar_from_box = sonar_from_world @ instance.world_from_box
    centre = sonar_from_box.position
    corners = sonar_from_world.transform(instance.corners)
    is_inside = np.isfinite(sonar.project(sonar_from_world.transform(instance.points))[:, 0])
    visibility = 0.0
    if is_inside.any():
        _, owners = _cast_to(simulation, table, world_from_sonar, instance.points[is_inside])
        visibility = float((owners == instance.number).mean())
    return {
        "number": instance.number,
        "name": instance.name,
        "class": instance.label,
        "box": list(pixel_box(row)),
        "visible_pixels": int(row[0]),
        "visibility": round_values(visibility),
        "truncation": round_values(1.0 - is_inside.mean()),
        "distance": round_values(length(centre)),
        "azimuth": round_values(arctan2(centre[1:2], centre[:1])[0]),
        "box_3d": {
            "centre": round_values(centre),
            "size": round_values(instance.size),
            "quaternion_wxyz": round_values(sonar_from_box.quaternion),
            "corners": round_values(corners),
        },
        "keypoints": _flag_keypoints(simulation, table, sonar, world_from_sonar, instance),
    }


def _flag_keypoints(
    simulation: Simulation,
    table: InstanceTable,
    sonar: DatasetSonar,
    world_from_sonar: Pose,
    instance: Instance,
) -> list[list[float]]:
    """Return column, row and COCO's flag of each keypoint; 0, 0, 0 outside of the fan."""
    points, tolerance = table.find_keypoints(instance)
    pixels = sonar.project(world_from_sonar.inverse().transform(points))
    gaps, _ = _cast_to(simulation, table, world_from_sonar, points)
    return [
        [0.0, 0.0, 0]
        if np.isnan(u)
        else [round_values(u), round_values(v), 1 if gap > tolerance else 2]
        for (u, v), gap in zip(pixels.tolist(), gaps.tolist(), strict=True)
    ]


def _cast_to(
    simulation: Simulation, table: InstanceTable, world_from_sonar: Pose, points: Array
) -> tuple[Array, npt.NDArray[np.int64]]:
    """Cast rays to points in W, (n, 3) [m].

    Returns:
        The distance by which each ray ends before its point, at most 0 if it does not (n,) [m],
        and the number of the instance that it meets (n,); 0: none.
    """
    eye = world_from_sonar.position
    offsets = points - eye
    distances = np.maximum(np.sqrt((offsets * offsets).sum(axis=1)), 1e-6)
    hits = simulation.world.rays.cast(
        Pose(eye, np.eye(3)),
        offsets / distances[:, None],
        float(distances.max()) + HIT_TOLERANCE,
    )
    numbers = table.instance_numbers
    is_known = (hits.surface >= 0) & (hits.surface < len(numbers)) & np.isfinite(hits.distance)
    owners = np.where(is_known, numbers[np.where(is_known, hits.surface, 0)], 0).astype(np.int64)
    gaps = np.where(np.isfinite(hits.distance), distances - hits.distance, -np.inf)
    return gaps, owners
