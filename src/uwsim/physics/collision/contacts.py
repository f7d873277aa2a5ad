"""Contacts between bodies, as MuJoCo found them at the beginning of the last step.

At the first step of a contact the approach speed is the one at which the two met; later ones are
what is left of it while they press into each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import cross, dot
from ...base.record import Record
from ...base.sampling import Sampler
from ...model.body_names import owner_of
from ...model.scene_model import SceneModel
from ...scene.spec import SceneSpec
from ...world import Contact
from ..poses import Mount, Poses
from .contact_wrench import contact_sampler

Numbers = npt.NDArray[np.int64]
Pressing = tuple[npt.NDArray[np.int32], npt.NDArray[np.int32], Array, Array]


@dataclass(slots=True)
class EngineContactsState(Record):
    """Whether the contacts hold."""

    hold: bool = False
    """Whether the engine's contacts are those of its state."""


class EngineContacts:
    """Contacts that MuJoCo found in the last step.

    Args:
        scene_model: the model of the scene.
        model: that of the engine.
        data: its state.
        poses: where everything is.
    """

    def __init__(
        self, scene_model: SceneModel, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses
    ) -> None:
        self._model, self._data, self._poses = model, data, poses
        owners, self._owner_numbers = scene_model.shape_owners
        self._names = [name_of(scene_model.scene, owner) for owner in owners]
        self._numbers = {owner: i for i, owner in enumerate(owners)}
        self._labels = sorted(set(self._names))
        labels = {name: i for i, name in enumerate(self._labels)}
        own_labels = np.array([labels[name] for name in self._names], np.int64)
        self._name_numbers = own_labels[self._owner_numbers]
        self._touchable = frozenset(owner_of(name) for name in scene_model.shapes)
        self.state = EngineContactsState()
        """Whether they hold."""
        self._looked_up: Pressing | None = None

    def look_again(self, *, hold: bool) -> None:
        """Look up the contacts when they are next asked for; to be called after every step.

        Args:
            hold: whether there are contacts of the bodies where they are.
        """
        self.state.hold = hold
        self.forget()

    def forget(self) -> None:
        """Forget what was looked up in the engine's memory."""
        self._looked_up = None

    def of(self, kind: Literal["vehicle", "object"], index: int) -> list[Contact] | None:
        """Where a vehicle or object touches others; None if it has no shape to be touched."""
        owner = f"{kind}/{index}"
        if owner not in self._touchable:
            return None
        if not self.state.hold:
            return []
        is_own = self._owner_numbers == self._numbers.get(owner, -1)
        return _contacts_of(self._model, self._data, is_own, self._owner_numbers, self._names)

    def forces(self, kind: Literal["vehicle", "object"], index: int) -> dict[str, Array]:
        """Forces on a vehicle or object of what it touches, by its name, (3,) in W [N]."""
        found: dict[str, Array] = {}
        if not self.state.hold or self._data.ncon == 0:
            return found
        owner = self._numbers.get(f"{kind}/{index}")
        if owner is None:
            return found
        geoms, addresses, frames, pressures = self._pressing()
        labels, forces = np.empty(len(geoms), np.int64), np.empty((len(geoms), 3))
        n = _sum_forces(
            geoms,
            addresses,
            frames,
            pressures,
            self._owner_numbers,
            self._name_numbers,
            owner,
            labels,
            forces,
        )
        for label, force in zip(labels[:n].tolist(), forces, strict=False):
            found[self._labels[label]] = force
        return found

    def _pressing(self) -> Pressing:
        """Shapes, addresses, frames and forces of the engine's contacts; looked up once a step."""
        if self._looked_up is None:
            found = self._data.contact
            self._looked_up = found.geom, found.efc_address, found.frame, self._data.efc_force
        return self._looked_up

    def wrench_sampler(self, body: int, mount: Mount) -> Sampler:
        """Return a sampler of the wrench of the contacts on a link; see `contact_sampler`.

        Args:
            body: the engine's number of the link.
            mount: the frame on the link.
        """
        return contact_sampler(self._model, self._data, body, mount, self._prepare)

    def _prepare(self) -> bool:
        """Update the poses; return whether the contacts are those of these poses."""
        self._poses.refresh()
        return self.state.hold


@njit
def _sum_forces(
    geoms: npt.NDArray[np.int32],
    addresses: npt.NDArray[np.int32],
    frames: Array,
    pressures: Array,
    owners: Numbers,
    names: Numbers,
    own: int,
    labels: Numbers,
    forces: Array,
) -> int:
    """Add up the forces on an owner by the names of what touches it; how many names there are.

    Args:
        geoms: both shapes of each contact, (n, 2).
        addresses: where each contact begins in the forces, (n,); negative: it does not press.
        frames: rows are normal and tangents of each, in W, (n, 9).
        pressures: forces along them, of an elliptic cone.
        owners: number of the owner of each shape.
        names: number of the name of each shape's owner.
        own: number of the owner.
        labels: into which the numbers of the names are written, (n,).
        forces: into which their forces on it are written, in W, (n, 3) [N].
    """
    n = 0
    for i in range(len(geoms)):
        is_first = owners[geoms[i, 0]] == own
        at = addresses[i]
        if is_first == (owners[geoms[i, 1]] == own) or at < 0 or at + 2 >= len(pressures):
            continue
        label = names[geoms[i, 1 if is_first else 0]]
        place = 0
        while place < n and labels[place] != label:
            place += 1
        for k in range(3):
            force = pressures[at] * frames[i, k]
            force = force + pressures[at + 1] * frames[i, 3 + k]
            force = force + pressures[at + 2] * frames[i, 6 + k]
            if is_first:  # the force is the first's on the second
                force = -force
            forces[place, k] = force if place == n else forces[place, k] + force
        if place == n:
            labels[n] = label
            n += 1
    return n


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


def _contacts_of(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    is_own: npt.NDArray[np.bool_],
    owners: Numbers,
    names: Sequence[str],
) -> list[Contact]:
    """Return the contacts of some bodies with others.

    Args:
        model: the model.
        data: its state after a step.
        is_own: which shapes are asked for, (ngeom,).
        owners: number of what each shape belongs to, (ngeom,).
        names: the name of each of those.
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
                other=names[owners[found.geom[i][1 if is_first else 0]]],
                position=tuple(found.pos[i].tolist()),
            )
        )
    return contacts


def _velocity(model: mujoco.MjModel, data: mujoco.MjData, body: int, point: Array) -> Array:
    """Velocity of a body's point, W, (3,) [m/s]."""
    twist = data.cvel[body]
    lever = point - data.subtree_com[model.body_rootid[body]]
    velocity: Array = twist[3:] + cross(twist[:3], lever)
    return velocity
