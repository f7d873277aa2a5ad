"""Contacts between bodies: from the engine, and from overlaps of kinematic bodies.

The engine computes contacts between the bodies that it simulates: vehicles with dynamics and solid
objects. For other bodies `uwsim.physics.collision.kinematic_contacts` computes overlaps of shapes,
from the first request on.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Literal

from ...base.geometry import Array, Pose
from ...base.record import LazyPart, Record
from ...errors import UwsimError
from ...model.scene_model import SceneModel
from ...physics.collision.kinematic_contacts import KinematicContacts
from ...physics.engine import Engine
from ...world import Contact
from ..bodies import find_contact_body, no_contacts_error


@dataclass(slots=True)
class ContactsState(Record):
    """The state of contacts that is not part of the engine's state."""

    overlaps: LazyPart[KinematicContacts]
    """The overlaps of kinematic bodies, from the first request on."""
    step: int = 0
    """The present step."""


class Contacts:
    """The contacts of a scene."""

    def __init__(self, model: SceneModel, engine: Engine) -> None:
        self._model, self._engine = model, engine
        self._contact_bodies: dict[str, tuple[Literal["vehicle", "object"], int]] = {}
        self._overlaps = LazyPart(self._make_overlaps)
        self.state = ContactsState(self._overlaps)
        """The state that is not part of the engine's state."""

    def is_possible(self, name: str) -> bool:
        """Return whether there is a vehicle or object with this name that can have contacts.

        A body without a collision shape cannot, as in the original UWSim without physics.
        """
        try:
            kind, index = find_contact_body(name, self._model.scene)
        except UwsimError:
            return False
        return kind == "object" or any(link.solids for link in self._model.robots[index].links)

    @property
    def has_overlaps(self) -> bool:
        """True if overlaps of kinematic bodies are computed at every step."""
        return self._overlaps.part is not None

    def update(self, step: int) -> None:
        """Record the poses of all bodies; to be called at every step."""
        self.state.step = step
        if self._overlaps.part is not None:
            self._overlaps.part.record(step)

    def find(self, name: str) -> list[Contact]:
        """Return the present contacts of the vehicle or object with this name.

        Raises:
            UnknownName: there is no such vehicle or object.
            UwsimError: it cannot have contacts.
        """
        kind, index = find_contact_body(name, self._model.scene)
        contacts = self._engine.contacts.find_contacts(kind, index)
        if contacts is None:
            if self._overlaps.part is None:
                self._overlaps.get_or_make().record(self.state.step)
            contacts = self._overlaps.get_or_make().contacts(kind, index)
        if contacts is None:
            reason = "none of its links has a <collision> or a <visual>"
            raise no_contacts_error(name, reason if kind == "vehicle" else "its mesh is empty")
        return contacts

    def forces(self, name: str) -> Mapping[str, Array]:
        """Return the contact forces on the vehicle or object with this name, in W, (3,) [N].

        The keys are the names of the other bodies.

        Raises:
            UnknownName: there is no such vehicle or object.
        """
        if name not in self._contact_bodies:
            self._contact_bodies[name] = find_contact_body(name, self._model.scene)
        return self._engine.contacts.forces(*self._contact_bodies[name])

    def _make_overlaps(self) -> KinematicContacts:
        scene, engine, shapes = self._model.scene, self._engine, self._model.all_shapes
        poses: dict[str, Callable[[], Pose]] = {}
        for body in shapes:
            kind, number, *link = body.split("/")
            poses[body] = (
                partial(engine.poses.link, int(number), "/".join(link))
                if kind == "vehicle"
                else partial(engine.poses.object, int(number))
            )
        names = {f"vehicle/{i}": vehicle.name for i, vehicle in enumerate(scene.vehicles)}
        names |= {f"object/{i}": spec.name for i, spec in enumerate(scene.objects)}
        timestep = self._model.timestep
        return KinematicContacts(shapes, poses, names, lambda: engine.poses.version, timestep)
