"""The bodies of a scene that may move against each other, and their poses as rows of numbers.

Links that fixed joints hold together are one body, called after the link nearest to the root. What
would have the name of something before it gets ``#2``, ``#3``, ... behind its own.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array, Pose, quaternion_from_rotation, rotation_from_quaternion
from ..model.parts import Part
from ..scene.urdf.robot import RobotSpec
from .live_scene import LiveScene
from .unique_names import unique


class TrackedBodies:
    """What a motion track follows.

    Args:
        world: whose bodies they are.
    """

    def __init__(self, world: LiveScene) -> None:
        self._poses = world.engine.poses
        self._leaders = {i: leaders(robot) for i, robot in world.model.robots.items()}
        links = [
            (i, link)
            for i, leader_of in self._leaders.items()
            for link in dict.fromkeys(leader_of.values())
        ]
        movable = [i for i in range(len(world.model.scene.objects)) if not self._poses.is_fixed(i)]
        self._loose = [i for i in movable if self._poses.loose_body(i) is not None]
        self._placed = [i for i in movable if i not in self._loose]
        self._numbers = np.array(
            [self._poses.link_body(*link) for link in links]
            + [self._poses.loose_body(i) for i in self._loose],
            dtype=np.intp,
        )
        objects = [*self._loose, *self._placed]
        self._row_of = {link: row for row, link in enumerate(links)}
        self._row_of_object = {i: len(links) + k for k, i in enumerate(objects)}
        of_link, of_object = body_names(world)
        self.names = (*(of_link[link] for link in links), *(of_object[i] for i in objects))
        """Name of each: ``vehicle/link``, or an object's."""

    def body_of(self, part: Part) -> int | None:
        """Return the number of the body that a part of the scene moves with; None: it stays."""
        if part.vehicle is not None:
            return self._row_of[part.vehicle, self._leaders[part.vehicle][part.link]]
        assert part.object is not None
        return self._row_of_object.get(part.object)

    def rows(self) -> Array:
        """Return position in W [m] and quaternion (wxyz) of each, (n, 7)."""
        rows = self._poses.read_frames(self._numbers)
        if not self._placed and not self._poses.state.carriers:
            return rows
        rows = np.concatenate([rows, np.zeros((len(self._placed), 7))])
        for i in [*self._placed, *self._poses.state.carriers]:
            pose = self._poses.object(i)
            rows[self._row_of_object[i], :3] = pose.position
            rows[self._row_of_object[i], 3:] = quaternion_from_rotation(pose.rotation)
        return rows

    def show(self, rows: Array) -> None:
        """Put all of them where rows (n, 7), as of `rows`, say, for images."""
        n = len(self._numbers)
        self._poses.set_frames(self._numbers, rows[:n])
        for i, row in zip(self._placed, rows[n:], strict=True):
            self._poses.place_object(i, Pose(row[:3].copy(), rotation_from_quaternion(row[3:])))


def vehicle_labels(world: LiveScene) -> tuple[str, ...]:
    """Return a name of its own for each vehicle."""
    return unique(vehicle.name for vehicle in world.model.scene.vehicles)


def body_names(world: LiveScene) -> tuple[dict[tuple[int, str], str], dict[int, str]]:
    """Return a name of its own for each body: of a vehicle's leading links, and of objects."""
    labels, things = vehicle_labels(world), world.model.scene.objects
    links = [
        (i, each)
        for i, robot in world.model.robots.items()
        for each in set(leaders(robot).values())
    ]
    links.sort()
    names = unique([*(f"{labels[i]}/{each}" for i, each in links), *(each.name for each in things)])
    return dict(zip(links, names, strict=False)), dict(enumerate(names[len(links) :]))


def leaders(robot: RobotSpec) -> dict[str, str]:
    """Return for each link the one nearest to the root that no moving joint lies between."""
    found = {robot.root: robot.root}
    waiting = list(robot.joints)
    while waiting:
        known = [joint for joint in waiting if joint.parent in found]
        if not known:
            break
        for joint in known:
            found[joint.child] = joint.child if joint.moves else found[joint.parent]
        waiting = [joint for joint in waiting if joint not in known]
    return found | {link.name: link.name for link in robot.links if link.name not in found}
