"""The bodies of a scene that may move against each other, and their poses as rows of numbers.

Links that fixed joints connect are one body, named after the link nearest to the root. The second
body of a name has ``#2`` behind it, the next ``#3``, ...
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array, Pose, quaternion_from_rotation, rotation_from_quaternion
from ..model.parts import Part
from ..scene.urdf.robot import RobotSpec
from .live_scene import LiveScene
from .unique_names import make_unique


class TrackedBodies:
    """The bodies that a motion track records."""

    def __init__(self, world: LiveScene) -> None:
        self._poses = world.engine.poses
        self._leaders = {i: leading_links(robot) for i, robot in world.model.robots.items()}
        links = [
            (i, link)
            for i, leader_of in self._leaders.items()
            for link in dict.fromkeys(leader_of.values())
        ]
        movable_ids = [
            i for i in range(len(world.model.scene.objects)) if not self._poses.is_fixed(i)
        ]
        self._loose_objects = [i for i in movable_ids if self._poses.loose_body(i) is not None]
        self._placed_objects = [i for i in movable_ids if i not in self._loose_objects]
        self._numbers = np.array(
            [self._poses.link_body(*link) for link in links]
            + [self._poses.loose_body(i) for i in self._loose_objects],
            dtype=np.intp,
        )
        objects = [*self._loose_objects, *self._placed_objects]
        self._link_rows = {link: row for row, link in enumerate(links)}
        self._object_rows = {i: len(links) + k for k, i in enumerate(objects)}
        link_names, object_names = body_names(world)
        self.names = (*(link_names[link] for link in links), *(object_names[i] for i in objects))
        """The name of each: ``vehicle/link``, or that of an object."""

    def body_number(self, part: Part) -> int | None:
        """Return the number of the body that a part of the scene moves with; None: it is fixed."""
        if part.vehicle is not None:
            return self._link_rows[part.vehicle, self._leaders[part.vehicle][part.link]]
        assert part.object is not None
        return self._object_rows.get(part.object)

    def rows(self) -> Array:
        """Return position in W [m] and quaternion (wxyz) of each, (n, 7)."""
        rows = self._poses.read_frames(self._numbers)
        if not self._placed_objects and not self._poses.state.carriers:
            return rows
        rows = np.concatenate([rows, np.zeros((len(self._placed_objects), 7))])
        for i in [*self._placed_objects, *self._poses.state.carriers]:
            pose = self._poses.object(i)
            rows[self._object_rows[i], :3] = pose.position
            rows[self._object_rows[i], 3:] = quaternion_from_rotation(pose.rotation)
        return rows

    def show(self, rows: Array) -> None:
        """Set the poses of all bodies to rows (n, 7), as of `rows`, for example for images."""
        n = len(self._numbers)
        self._poses.set_frames(self._numbers, rows[:n])
        for i, row in zip(self._placed_objects, rows[n:], strict=True):
            self._poses.place_object(i, Pose(row[:3].copy(), rotation_from_quaternion(row[3:])))


def vehicle_labels(world: LiveScene) -> tuple[str, ...]:
    """Return a unique name for each vehicle."""
    return make_unique(vehicle.name for vehicle in world.model.scene.vehicles)


def body_names(world: LiveScene) -> tuple[dict[tuple[int, str], str], dict[int, str]]:
    """Return a unique name for each body: of a vehicle's leading links, and of objects."""
    labels, objects = vehicle_labels(world), world.model.scene.objects
    links = [
        (i, name)
        for i, robot in world.model.robots.items()
        for name in set(leading_links(robot).values())
    ]
    links.sort()
    names = make_unique(
        [*(f"{labels[i]}/{name}" for i, name in links), *(spec.name for spec in objects)]
    )
    return dict(zip(links, names, strict=False)), dict(enumerate(names[len(links) :]))


def leading_links(robot: RobotSpec) -> dict[str, str]:
    """Return for each link the nearest one to the root with no moving joint between them."""
    leaders = {robot.root: robot.root}
    joints = list(robot.joints)
    while joints:
        reached_joints = [joint for joint in joints if joint.parent in leaders]
        if not reached_joints:
            break
        for joint in reached_joints:
            leaders[joint.child] = joint.child if joint.moves else leaders[joint.parent]
        joints = [joint for joint in joints if joint not in reached_joints]
    return leaders | {link.name: link.name for link in robot.links if link.name not in leaders}
