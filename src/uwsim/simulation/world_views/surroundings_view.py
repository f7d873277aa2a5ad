"""The view of the lines, holes and surfaces of a scene, for measures."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...errors import UnknownName
from ..physical_scene import PhysicalScene


class SurroundingsView:
    """The lines, holes and surfaces of a running scene (`uwsim.world.Surroundings`)."""

    def __init__(self, scene: PhysicalScene) -> None:
        self._spec = scene.model.scene
        self.rays = scene.rays
        """The ray caster against the surfaces of the scene at their present poses."""

    def course(self, name: str) -> Array:
        """Return the line of an object with a ``<u:course>``, (n, 3) in W [m]."""
        scene = self._spec
        courses = {item.name: item for item in reversed(scene.objects) if item.course is not None}
        if name not in courses:
            raise UnknownName("object with a <u:course>", name, courses)
        item = courses[name]
        assert item.course is not None
        return (scene.world_from_localized @ item.localized_from_object).transform(item.course.line)

    def holes(self, name: str) -> Array:
        """Return the centre in W and the radius of each hole of a ``<u:net>``, (n, 4) [m]."""
        scene = self._spec
        nets = {item.name: item for item in reversed(scene.objects) if item.net is not None}
        if name not in nets:
            raise UnknownName("object with a <u:net>", name, nets)
        item = nets[name]
        assert item.net is not None
        circles = item.net.circles
        places = np.stack([circles[:, 0], np.zeros(len(circles)), circles[:, 1]], axis=1)
        world_from_object = scene.world_from_localized @ item.localized_from_object
        return np.concatenate([world_from_object.transform(places), circles[:, 2:]], axis=1)
