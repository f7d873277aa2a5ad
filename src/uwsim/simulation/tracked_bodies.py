"""The bodies of a scene that can move relative to each other, and their poses as rows of numbers.

Links that are connected by fixed joints are one body, named after the link nearest to the root. A
second body with the same name has the suffix ``#2``, the third ``#3``, and so on.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array, Pose, quaternion_from_rotation, rotation_from_quaternion
from ..model.parts import Part
from ..model.ray_bodies import Owner
from ..model.segment_names import segment_names
from ..scene.urdf.robot import RobotSpec
from .live_scene import LiveScene
from .unique_names import make_unique


class TrackedBodies:
    """The bodies whose poses a motion track records: rigid groups of links, and movable objects."""

    def __init__(self, world: LiveScene) -> None:
        self._poses = world.engine.poses
        self._group_links = {i: rigid_group_links(robot) for i, robot in world.model.robots.items()}
        links = [
            (i, link)
            for i, leader_of in self._group_links.items()
            for link in dict.fromkeys(leader_of.values())
        ]
        movable_ids = [
            i for i in range(len(world.model.scene.objects)) if not self._poses.is_fixed(i)
        ]
        self._loose_objects = [i for i in movable_ids if self._poses.loose_body(i) is not None]
        self._placed_objects = [i for i in movable_ids if i not in self._loose_objects]
        segments = [body for body, _ in segment_names(world.model.scene)]
        self._numbers = np.array(
            [self._poses.link_body(*link) for link in links]
            + [self._poses.loose_body(i) for i in self._loose_objects]
            + [self._poses.segment_body(segment) for segment in segments],
            dtype=np.intp,
        )
        keys: list[Owner] = [
            *((vehicle, link, None) for vehicle, link in links),
            *((None, "", i) for i in self._loose_objects),
            *((None, segment, None) for segment in segments),
            *((None, "", i) for i in self._placed_objects),
        ]
        self._body_rows = {key: row for row, key in enumerate(keys)}
        names = body_names(world)
        self.names = tuple(names[key] for key in keys)
        """The unique name of each body: ``vehicle/link``, the name of an object, or the name of a
        tether and the number of a segment."""

    def body_number(self, part: Part) -> int | None:
        """Return the row of the body with which a visible part moves; None if the part is fixed."""
        if part.vehicle is not None:
            leader = self._group_links[part.vehicle][part.link]
            return self._body_rows[part.vehicle, leader, None]
        return self._body_rows.get((None, part.link, part.object))

    def rows(self) -> Array:
        """Return the position in W [m] and the quaternion (wxyz) of each body, (n, 7)."""
        rows = self._poses.read_frames(self._numbers)
        if not self._placed_objects and not self._poses.state.carriers:
            return rows
        rows = np.concatenate([rows, np.zeros((len(self._placed_objects), 7))])
        for i in [*self._placed_objects, *self._poses.state.carriers]:
            pose = self._poses.object(i)
            row = rows[self._body_rows[None, "", i]]
            row[:3] = pose.position
            row[3:] = quaternion_from_rotation(pose.rotation)
        return rows

    def show(self, rows: Array) -> None:
        """Set the poses of all bodies, for rendering, to (n, 7) numbers as `rows` returns them."""
        n = len(self._numbers)
        self._poses.set_frames(self._numbers, rows[:n])
        for i, row in zip(self._placed_objects, rows[n:], strict=True):
            self._poses.place_object(i, Pose(row[:3].copy(), rotation_from_quaternion(row[3:])))


def vehicle_labels(world: LiveScene) -> tuple[str, ...]:
    """Return a unique name for each vehicle."""
    return make_unique(vehicle.name for vehicle in world.model.scene.vehicles)


def body_names(world: LiveScene) -> dict[Owner, str]:
    """Return unique names of the bodies: of links, objects and segments of forces."""
    labels, scene = vehicle_labels(world), world.model.scene
    links = [
        (i, name)
        for i, robot in world.model.robots.items()
        for name in set(rigid_group_links(robot).values())
    ]
    names: dict[Owner, str] = {(i, name, None): f"{labels[i]}/{name}" for i, name in sorted(links)}
    names |= {(None, "", i): spec.name for i, spec in enumerate(scene.objects)}
    names |= {(None, body, None): name for body, name in segment_names(scene)}
    return dict(zip(names, make_unique(names.values()), strict=True))


def rigid_group_links(robot: RobotSpec) -> dict[str, str]:
    """Return, for each link, the link nearest to the root to which it is rigidly connected."""
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
