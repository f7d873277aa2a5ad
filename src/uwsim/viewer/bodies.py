"""The bodies of the head: what the page draws, and what carries sensors, lamps and cameras."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.geometry import Pose
from ..base.numerics.linear import product
from ..model.parts import Part
from ..simulation.live_scene import LiveScene
from ..simulation.tracked_bodies import body_names, rigid_group_links, vehicle_labels
from .models import Models

Json = dict[str, Any]


class Bodies:
    """The bodies that the page draws, or that carry a sensor, lamp or camera.

    Args:
        world: the scene.
    """

    def __init__(self, world: LiveScene) -> None:
        self._world = world
        self._leaders = {i: rigid_group_links(robot) for i, robot in world.model.robots.items()}
        self._names = body_names(world)
        self.labels = vehicle_labels(world)
        """The unique names of the vehicles."""
        self.rows: list[Json] = []
        """The entries of the bodies so far, as in the head."""
        self._poses: dict[str, Pose] = {}
        self._n_parts = 0

    def link(self, index: int, link: str) -> str:
        """Return the name of the body to which a link belongs; add the body if it is new."""
        leader = self._leaders[index][link]
        pose = self._world.engine.poses.link(index, leader)
        return self._body(self._names[index, leader, None], pose, self.labels[index])

    def named_link(self, vehicle: str, link: str) -> str:
        """Return the name of the body of a link, of the first vehicle with that name."""
        return self.link(self._world.vehicles.names.index(vehicle), link)

    def pose(self, name: str) -> Pose:
        """Return the pose of a body in W, by the name that `link` returned."""
        return self._poses[name]

    def part_body(self, part: Part) -> str:
        """Return the name of the body of a part of the scene; add the body if it is new."""
        if part.vehicle is not None:
            return self.link(part.vehicle, part.link)
        poses = self._world.engine.poses
        pose = poses.segment(part.link) if part.object is None else poses.object(part.object)
        return self._body(self._names[None, part.link, part.object], pose, None)

    def add(self, part: Part, models: Models) -> None:
        """Add the visuals of a part of the scene to its body."""
        name = self.part_body(part)
        body_from_mesh = product(
            self._poses[name].inverse().matrix, self._world.scenery.world_from_mesh(part)
        )
        matrix = [float(f"{value:.9g}") for value in body_from_mesh.ravel()]
        row = next(row for row in self.rows if row["name"] == name)
        self._n_parts += 1
        row["visuals"] += [
            {"part": self._n_parts, **visual, "matrix": matrix, "hidden": part.is_hidden}
            for visual in models.visuals(part.model)
        ]

    def add_fixed(self, name: str, visuals: list[Json]) -> None:
        """Add a body whose vertices are in W."""
        self._body(name, Pose.identity(), None)
        matrix = np.eye(4).ravel().tolist()
        self._n_parts += 1
        fields = {"part": self._n_parts, "matrix": matrix, "hidden": False}
        self.rows[-1]["visuals"] = [{**fields, **visual} for visual in visuals]

    def _body(self, name: str, pose: Pose, vehicle: str | None) -> str:
        if name not in self._poses:
            self._poses[name] = pose
            self.rows.append(
                {"name": name, "vehicle": vehicle, "pose": pose_row(pose), "visuals": []}
            )
        return name


def pose_row(pose: Pose) -> list[float]:
    """Return a pose as x y z w x y z, with nine digits."""
    return [float(f"{value:.9g}") for value in (*pose.position, *pose.quaternion)]
