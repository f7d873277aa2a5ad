"""Contacts between bodies, as MuJoCo found them at the beginning of the last step.

At the first step of a contact the approach speed is the one at which the two met; later ones are
what is left of it while they press into each other.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Literal

import mujoco
import numpy as np
import numpy.typing as npt

from ...geometry import Array
from ...numerics.linear import dot, turned_back
from ...scene.spec import SceneSpec
from ...world import Contact

_NORMAL_AND_TANGENTS = np.arange(3)
"""Places of a contact's force in ``efc_force``, of an elliptic cone."""


class EngineContacts:
    """Contacts that MuJoCo found in the last step.

    Args:
        scene: spec of the scene.
        model: of the scene.
        data: its state.
        shapes: names of the bodies that have shapes.
    """

    STATE = ("hold",)
    """Attributes of its state, for snapshots."""

    def __init__(
        self,
        scene: SceneSpec,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        shapes: Collection[str],
    ) -> None:
        self._model, self._data = model, data
        owners = [owner_of(model.geom(i).name) for i in range(model.ngeom)]
        self._owners = np.array(owners)
        self._names = [name_of(scene, owner) for owner in owners]
        self._touchable = frozenset(owner_of(name) for name in shapes)
        self._masks: dict[str, npt.NDArray[np.bool_]] = {}
        self.hold = False
        """Whether the engine's contacts are those of its state."""

    def of(self, kind: Literal["vehicle", "object"], index: int) -> list[Contact] | None:
        """Where a vehicle or object touches others; None if it has no shape to be touched."""
        owner = f"{kind}/{index}"
        if owner not in self._touchable:
            return None
        if not self.hold:
            return []
        return contacts_of(self._model, self._data, self._owners == owner, self._names)

    def forces(self, kind: Literal["vehicle", "object"], index: int) -> dict[str, Array]:
        """Forces on a vehicle or object of what it touches, by its name, (3,) in W [N]."""
        found: dict[str, Array] = {}
        if not self.hold or self._data.ncon == 0:
            return found
        contacts, owner = self._data.contact, f"{kind}/{index}"
        if owner not in self._masks:
            self._masks[owner] = self._owners == owner
        geoms = contacts.geom  # (n, 2)
        is_own = self._masks[owner][geoms]  # (n, 2)
        address = np.asarray(contacts.efc_address)
        chosen = np.flatnonzero((is_own[:, 0] != is_own[:, 1]) & (address >= 0))
        if len(chosen) == 0:
            return found
        own = self._data.efc_force[address[chosen, None] + _NORMAL_AND_TANGENTS]  # (k, 3)
        frames = contacts.frame[chosen].reshape(-1, 3, 3)  # rows, in W
        forces = own[:, :1] * frames[:, 0] + own[:, 1:2] * frames[:, 1] + own[:, 2:] * frames[:, 2]
        seconds = is_own[chosen, 1]  # the force is the first's on the second
        forces = np.where(seconds[:, None], forces, -forces)
        others = geoms[chosen, np.where(seconds, 0, 1)]
        for other, force in zip(others.tolist(), forces, strict=True):
            name = self._names[other]
            found[name] = found[name] + force if name in found else force
        return found

    def wrench(self, body: int, point: Array) -> Array:
        """Force and torque of the contacts on a body, by its number, in W, (6,) [N, N m].

        Args:
            body: the engine's number.
            point: about which the torque is, in W, (3,) [m].
        """
        total = np.zeros(6)
        if not self.hold or self._data.ncon == 0:
            return total
        found, own = self._data.contact, np.zeros(6)
        is_own = self._model.geom_bodyid[found.geom] == body  # (n, 2)
        for i in np.flatnonzero(is_own[:, 0] != is_own[:, 1]).tolist():
            mujoco.mj_contactForce(self._model, self._data, i, own)
            axes = found.frame[i].reshape(3, 3)  # rows, in W
            sign = 1.0 if is_own[i, 1] else -1.0  # the force of the first on the second
            force = sign * turned_back(axes, own[:3])
            total[:3] += force
            total[3:] += sign * turned_back(axes, own[3:]) + np.cross(found.pos[i] - point, force)
        return total


def owner_of(name: str) -> str:
    """``vehicle/1`` or ``object/1``, what the body or shape of that name belongs to."""
    return "/".join(name.split("/")[:2])


def name_of(scene: SceneSpec, owner: str) -> str:
    """Its name in the scene."""
    kind, _, index = owner.partition("/")
    if kind == "vehicle":
        return scene.vehicles[int(index)].name
    return scene.objects[int(index)].name if kind == "object" else ""


def body_name(scene: SceneSpec, body: str) -> str:
    """How the scene calls a body of the model: ``girona500/part0``, an object's name."""
    link = body.split("/")[2:]
    return "/".join([name_of(scene, owner_of(body)), *link])


def contacts_of(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    is_own: npt.NDArray[np.bool_],
    names: Sequence[str],
) -> list[Contact]:
    """Return the contacts of some bodies with others.

    Args:
        model: the model.
        data: its state after a step.
        is_own: which shapes are asked for, (ngeom,).
        names: name of what each shape belongs to, (ngeom,).
    """
    if data.ncon == 0:
        return []
    found = data.contact
    bodies = model.geom_bodyid[found.geom]  # (n, 2)
    own = is_own[found.geom]  # (n, 2)
    presses = (np.asarray(found.efc_address) >= 0) & (np.asarray(found.dist) < 0.0)
    contacts: list[Contact] = []
    for i in np.flatnonzero(presses & (own[:, 0] != own[:, 1])).tolist():
        first, second = bodies[i].tolist()
        normal = found.frame[i][:3]  # from the first to the second, W
        v_first = dot(normal, _velocity(model, data, first, found.pos[i]))
        v_second = dot(normal, _velocity(model, data, second, found.pos[i]))
        is_first = bool(own[i, 0])
        contacts.append(
            Contact(
                approach_speed=v_first - v_second,
                own_speed=v_first if is_first else -v_second,
                is_first=is_first,
                other=names[found.geom[i][1 if is_first else 0]],
                position=tuple(found.pos[i].tolist()),
            )
        )
    return contacts


def _velocity(model: mujoco.MjModel, data: mujoco.MjData, body: int, point: Array) -> Array:
    """Velocity of a body's point, W, (3,) [m/s]."""
    twist = data.cvel[body]
    lever = point - data.subtree_com[model.body_rootid[body]]
    velocity: Array = twist[3:] + np.cross(twist[:3], lever)
    return velocity
