"""The instances of a scene: vehicles and objects, with their classes and their shape."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Pose
from ..base.numerics.linear import cross, dot, length, transform_points
from ..errors import BadSetting, UnknownName
from ..model.parts import Part
from ..simulation import Simulation
from .keypoints import Keypoints

MAX_CLASSES = 255
"""The greatest number of classes: semantic masks have 8 bit, and 0 is no surface."""
MAX_RADIUS = 10.0
"""The half diagonal of a box above which an object is no target by default [m]."""
N_SURFACE_POINTS = 64
"""The number of points of an instance's surface by which its visibility is estimated."""
CORNER_TOLERANCE = 0.05
"""The distance, over the diagonal of a box, by which a surface in front of a corner hides it."""
POINT_TOLERANCE = 0.02
"""The distance, over the diagonal of a box, by which a surface hides a declared keypoint."""
SAND = "sand"
"""The class of heaps of sand."""


@dataclass(frozen=True, eq=False)
class Instance:
    """A vehicle or an object of a scene."""

    number: int
    """The number in instance masks, from 1."""
    name: str
    """The unique name."""
    label: str
    """The class."""
    part_ids: frozenset[int]
    """The ids of its parts in rendered images."""
    has_boxes: bool
    """True if it has boxes; False for the ground and for sand."""
    world_from_instance: Pose
    """The pose of its frame in W: that of the vehicle's base or of the object."""
    lower: Array
    """The least coordinates of its meshes in its frame, (3,) [m]."""
    upper: Array
    """The greatest coordinates of its meshes in its frame, (3,) [m]."""
    points: Array
    """Points of its surface in W, (n, 3) [m]."""

    @property
    def size(self) -> Array:
        """The lengths of the edges of the box, (3,) [m]."""
        size: Array = self.upper - self.lower
        return size

    @property
    def radius(self) -> float:
        """The half diagonal of the box [m]."""
        return 0.5 * length(self.size)

    @property
    def world_from_box(self) -> Pose:
        """The pose of the box in W: its centre, and the axes of the instance."""
        centre = self.world_from_instance.transform(0.5 * (self.lower + self.upper)[None])[0]
        return Pose(centre, self.world_from_instance.rotation)

    @property
    def corners(self) -> Array:
        """The corners of the box in W, (8, 3) [m]; x varies fastest, z slowest."""
        bounds = np.stack([self.lower, self.upper])
        corners = np.array(
            [[bounds[i & 1, 0], bounds[i >> 1 & 1, 1], bounds[i >> 2, 2]] for i in range(8)]
        )
        return self.world_from_instance.transform(corners)


@dataclass(frozen=True, eq=False)
class InstanceTable:
    """The instances of a scene, and the numbers of the parts in rendered images."""

    instances: tuple[Instance, ...]
    """The instances; number i + 1 is at index i."""
    classes: tuple[str, ...]
    """The classes; number i + 1 of semantic masks is at index i."""
    instance_numbers: npt.NDArray[np.uint16]
    """The number of the instance of each id of a rendered image."""
    class_numbers: npt.NDArray[np.uint8]
    """The number of the class of each id of a rendered image."""
    declared_points: Mapping[str, Array] = field(default_factory=dict)
    """The declared keypoints of classes, in the frames of their instances, (n, 3) [m]."""

    @property
    def boxed_instances(self) -> tuple[Instance, ...]:
        """The instances that have boxes."""
        return tuple(instance for instance in self.instances if instance.has_boxes)

    def find_keypoints(self, instance: Instance) -> tuple[Array, float]:
        """Return the keypoints of an instance in W, (n, 3) [m], and the tolerance of their flags.

        A keypoint is hidden if a surface in front of it is nearer by more than the tolerance [m].
        """
        if instance.label not in self.declared_points:
            return instance.corners, CORNER_TOLERANCE * length(instance.size)
        points = instance.world_from_instance.transform(self.declared_points[instance.label])
        return points, POINT_TOLERANCE * length(instance.size)

    def with_keypoints(self, keypoints: Keypoints) -> InstanceTable:
        """Return the table with declared keypoints; raise UnknownName for an unknown class."""
        for label, _ in keypoints:
            if label not in self.classes:
                raise UnknownName("class", label, self.classes)
        points = {label: np.array([point for _, point in rows]) for label, rows in keypoints}
        return replace(self, declared_points=points)

    @property
    def all_ids(self) -> frozenset[int]:
        """The ids of all parts."""
        return frozenset(id for instance in self.instances for id in instance.part_ids)

    def find_targets(self, names: Sequence[str]) -> tuple[Instance, ...]:
        """Return the instances with these names; without names, all that are not landscape.

        Raises:
            UnknownName: there is no such vehicle or object.
            BadSetting: the scene has neither.
        """
        by_name = {instance.name: instance for instance in self.instances}
        for name in names:
            if name not in by_name:
                raise UnknownName("vehicle or object", name, by_name)
        if names:
            return tuple(by_name[name] for name in names)
        small_instances = tuple(t for t in self.boxed_instances if t.radius <= MAX_RADIUS)
        targets = small_instances or self.boxed_instances or self.instances
        if not targets:
            raise BadSetting("The scene has no vehicle and no object; there is nothing to view.")
        return targets


def read_classes(
    instance_names: Sequence[tuple[str, bool]], classes: Sequence[tuple[str, str]]
) -> dict[str, str]:
    """Return the class of each instance: by the first pattern that fits, else its own name.

    The suffix ``#2`` of the second vehicle or object of a name is not part of its class.

    Args:
        instance_names: the name of each instance, and True for a heap of sand.
        classes: patterns of names, as ``rock*``, and the class of each.

    Raises:
        BadSetting: a pattern fits no name.
    """
    plain_names = {
        name: SAND if is_sand else re.sub(r"#\d+$", "", name) for name, is_sand in instance_names
    }
    for pattern, _ in classes:
        if not any(fnmatchcase(name, pattern) for name in plain_names):
            raise BadSetting(
                f"--class {pattern}: no vehicle or object has such a name. Known: "
                f"{', '.join(sorted(plain_names))}."
            )
    return {
        name: next((c for pattern, c in classes if fnmatchcase(name, pattern)), plain_name)
        for name, plain_name in plain_names.items()
    }


def find_instances(
    simulation: Simulation, classes: Sequence[tuple[str, str]] = ()
) -> InstanceTable:
    """Return the instances of a scene at its present poses.

    Raises:
        BadSetting: a pattern of a class fits no name, or there are too many classes.
    """
    scenery = simulation.world.scenery
    names = scenery.part_names
    groups: dict[str, list[Part]] = {}
    for part in scenery.parts:
        if not part.is_hidden:
            name = names[part.id]
            if part.vehicle is not None:
                vehicle_name = simulation.world.model.scene.vehicles[part.vehicle].name
                name = name.removesuffix(part.name.removeprefix(vehicle_name))
            groups.setdefault(name, []).append(part)
    known_ids = {part.id for part in scenery.parts}
    sand = {name: number for number, name in names.items() if number not in known_ids}
    labels = read_classes(
        [*((name, False) for name in groups), *((name, True) for name in sand)], classes
    )
    instances = [
        _make_instance(simulation, number, name, labels[name], parts)
        for number, (name, parts) in enumerate(groups.items(), start=1)
    ]
    for name, id in sand.items():
        instances.append(
            Instance(
                number=len(instances) + 1,
                name=name,
                label=labels[name],
                part_ids=frozenset({id}),
                has_boxes=False,
                world_from_instance=Pose.identity(),
                lower=np.zeros(3),
                upper=np.zeros(3),
                points=np.zeros((0, 3)),
            )
        )
    return _make_table(instances)


def _make_table(instances: list[Instance]) -> InstanceTable:
    labels = tuple(sorted({instance.label for instance in instances}))
    if len(labels) > MAX_CLASSES:
        raise BadSetting(
            f"The scene has {len(labels)} classes; at most {MAX_CLASSES} fit into the masks. "
            "Group objects with --class PATTERN=CLASS."
        )
    n_ids = 1 + max((id for instance in instances for id in instance.part_ids), default=0)
    instance_numbers, class_numbers = np.zeros(n_ids, np.uint16), np.zeros(n_ids, np.uint8)
    for instance in instances:
        for id in instance.part_ids:
            instance_numbers[id] = instance.number
            class_numbers[id] = 1 + labels.index(instance.label)
    return InstanceTable(tuple(instances), labels, instance_numbers, class_numbers)


def _make_instance(
    simulation: Simulation, number: int, name: str, label: str, parts: list[Part]
) -> Instance:
    """Return an instance; its box contains all vertices of its parts."""
    scenery = simulation.world.scenery
    world_from_instance = _find_frame(simulation, name, parts[0])
    vertices = np.concatenate(
        [
            transform_points(mesh.vertices.astype(np.float64), matrix[:3, :3], matrix[:3, 3])
            for part in parts
            for matrix in [scenery.world_from_mesh(part)]
            for mesh in part.model.meshes
        ]
    )
    local_points = world_from_instance.inverse().transform(vertices)
    point_indices = np.linspace(0, len(vertices) - 1, min(N_SURFACE_POINTS, len(vertices))).astype(
        int
    )
    is_ground = parts[0].object is not None and (
        simulation.world.model.scene.objects[parts[0].object].is_ground
    )
    return Instance(
        number=number,
        name=name,
        label=label,
        part_ids=frozenset(part.id for part in parts),
        has_boxes=not is_ground,
        world_from_instance=world_from_instance,
        lower=local_points.min(axis=0),
        upper=local_points.max(axis=0),
        points=vertices[point_indices],
    )


def _find_frame(simulation: Simulation, name: str, part: Part) -> Pose:
    """Return the frame of an instance in W: a vehicle's base, or the axes of an object's mesh."""
    world = simulation.world
    if part.vehicle is not None and name == world.model.scene.vehicles[part.vehicle].name:
        return world.bodies.find(name).world_from_body
    matrix = world.scenery.world_from_mesh(part)
    x, y = matrix[:3, 0] / length(matrix[:3, 0]), matrix[:3, 1]
    y = y - dot(x, y) * x
    y /= length(y)
    return Pose(matrix[:3, 3].copy(), np.stack([x, y, cross(x, y)], axis=1))
