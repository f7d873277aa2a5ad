"""Contacts between bodies that MuJoCo found at the beginning of the last step.

In the first step of a contact, the approach speed is the impact speed. It decreases in later steps
while the bodies press into each other. The *owner* of a shape or body is the vehicle or object to
which it belongs, such as ``vehicle/0`` or ``object/1``.
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
ContactArrays = tuple[npt.NDArray[np.int32], npt.NDArray[np.int32], Array, Array]


@dataclass(slots=True)
class EngineContactsState(Record):
    """The validity of the engine's contacts."""

    are_current: bool = False
    """True if the engine's contacts were computed in the last step, and no pose was set since."""


class EngineContacts:
    """The contacts that MuJoCo found in the last step.

    Args:
        scene_model: the model of the scene.
        model: the engine's model.
        data: the engine's state.
        poses: the poses of all bodies.
    """

    def __init__(
        self, scene_model: SceneModel, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses
    ) -> None:
        self._model, self._data, self._poses = model, data, poses
        owners, self._owner_numbers = scene_model.shape_owners
        self._names = [owner_name(scene_model.scene, owner) for owner in owners]
        self._numbers = {owner: i for i, owner in enumerate(owners)}
        self._labels = sorted(set(self._names))
        labels = {name: i for i, name in enumerate(self._labels)}
        own_labels = np.array([labels[name] for name in self._names], np.int64)
        self._name_numbers = own_labels[self._owner_numbers]
        self._owners_with_shapes = frozenset(owner_of(name) for name in scene_model.shapes)
        self.state = EngineContactsState()
        """The validity of the engine's contacts."""
        self._arrays: ContactArrays | None = None

    def invalidate(self, *, are_current: bool) -> None:
        """Discard contacts that were read; to be called after every step and change of a pose.

        Args:
            are_current: true if the engine's contacts are valid for the present poses.
        """
        self.state.are_current = are_current
        self.clear_cache()

    def clear_cache(self) -> None:
        """Drop the views into the engine's memory."""
        self._arrays = None

    def find_contacts(self, kind: Literal["vehicle", "object"], index: int) -> list[Contact] | None:
        """Return the contacts of a vehicle or object; None if it has no collision shape."""
        owner = f"{kind}/{index}"
        if owner not in self._owners_with_shapes:
            return None
        if not self.state.are_current:
            return []
        is_own = self._owner_numbers == self._numbers.get(owner, -1)
        return _find_contacts(self._model, self._data, is_own, self._owner_numbers, self._names)

    def forces(self, kind: Literal["vehicle", "object"], index: int) -> dict[str, Array]:
        """Return the contact forces on a vehicle or object in W, (3,) [N].

        They are summed by the name of the vehicle or object that exerts them.
        """
        forces_by_name: dict[str, Array] = {}
        if not self.state.are_current or self._data.ncon == 0:
            return forces_by_name
        owner = self._numbers.get(f"{kind}/{index}")
        if owner is None:
            return forces_by_name
        geoms, addresses, frames, pressures = self._read_arrays()
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
            forces_by_name[self._labels[label]] = force
        return forces_by_name

    def _read_arrays(self) -> ContactArrays:
        """Return the shapes, addresses, frames and forces of the contacts, read once per step."""
        if self._arrays is None:
            contact = self._data.contact
            self._arrays = contact.geom, contact.efc_address, contact.frame, self._data.efc_force
        return self._arrays

    def wrench_sampler(self, body: int, mount: Mount) -> Sampler:
        """Return a sampler of the wrench of the contacts on a link; see `contact_sampler`.

        Args:
            body: the MuJoCo body ID of the link.
            mount: the frame on the link.
        """
        return contact_sampler(self._model, self._data, body, mount, self._prepare)

    def _prepare(self) -> bool:
        """Update the poses; return whether the engine's contacts are valid for them."""
        self._poses.refresh()
        return self.state.are_current


@njit
def _sum_forces(
    geoms: npt.NDArray[np.int32],
    addresses: npt.NDArray[np.int32],
    frames: Array,
    pressures: Array,
    owners: Numbers,
    names: Numbers,
    owner: int,
    labels: Numbers,
    forces: Array,
) -> int:
    """Sum the forces of n contacts on an owner by the name of the other owner.

    Args:
        geoms: the indices of both shapes of each contact, (n, 2).
        addresses: the index of the first force of each contact in ``pressures``, (n,); negative
            without a force.
        frames: the normal and the tangents of each contact by rows, in W, (n, 9).
        pressures: the forces along normal and tangents of all contacts [N]: ``efc_force``.
        owners: the index of the owner of each shape.
        names: the index of the name of each shape's owner.
        owner: the index of the owner on which the forces act.
        labels: receives the indices of the names, (n,).
        forces: receives the forces on the owner, in W, (n, 3) [N].

    Returns:
        The number of names.
    """
    n = 0
    for i in range(len(geoms)):
        is_first = owners[geoms[i, 0]] == owner
        start = addresses[i]
        if is_first == (owners[geoms[i, 1]] == owner) or start < 0 or start + 2 >= len(pressures):
            continue
        label = names[geoms[i, 1 if is_first else 0]]
        row = 0
        while row < n and labels[row] != label:
            row += 1
        for k in range(3):
            force = pressures[start] * frames[i, k]
            force = force + pressures[start + 1] * frames[i, 3 + k]
            force = force + pressures[start + 2] * frames[i, 6 + k]
            if is_first:  # the force is that of the first shape on the second
                force = -force
            forces[row, k] = force if row == n else forces[row, k] + force
        if row == n:
            labels[n] = label
            n += 1
    return n


def owner_name(scene: SceneSpec, owner: str) -> str:
    """Return the name of an owner in the scene."""
    kind, _, index = owner.partition("/")
    if kind == "vehicle":
        return scene.vehicles[int(index)].name
    return scene.objects[int(index)].name if kind == "object" else ""


def body_name(scene: SceneSpec, body: str) -> str:
    """Return the name of a body in the scene: ``girona500/part0`` or the name of an object."""
    link = body.split("/")[2:]
    return "/".join([owner_name(scene, owner_of(body)), *link])


def _find_contacts(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    is_own: npt.NDArray[np.bool_],
    owners: Numbers,
    names: Sequence[str],
) -> list[Contact]:
    """Return the contacts of an owner's bodies with other bodies.

    Args:
        model: the engine's model.
        data: the engine's state after a step.
        is_own: the mask of the shapes of the owner, (ngeom,).
        owners: the index of the owner of each shape, (ngeom,).
        names: the name of each owner.
    """
    if data.ncon == 0:
        return []
    contact = data.contact
    bodies = model.geom_bodyid[contact.geom]  # (n, 2)
    own_shapes = is_own[contact.geom]  # (n, 2)
    is_pressing = (np.asarray(contact.efc_address) >= 0) & (np.asarray(contact.dist) < 0.0)
    contacts: list[Contact] = []
    for i in np.flatnonzero(is_pressing & (own_shapes[:, 0] != own_shapes[:, 1])).tolist():
        first_body, second_body = bodies[i].tolist()
        normal = contact.frame[i][:3]  # from the first to the second, W
        v_first = dot(normal, _velocity(model, data, first_body, contact.pos[i]))
        v_second = dot(normal, _velocity(model, data, second_body, contact.pos[i]))
        is_first = bool(own_shapes[i, 0])
        contacts.append(
            Contact(
                approach_speed=v_first - v_second,
                own_speed=v_first if is_first else -v_second,
                is_first=is_first,
                other=names[owners[contact.geom[i][1 if is_first else 0]]],
                position=tuple(contact.pos[i].tolist()),
            )
        )
    return contacts


def _velocity(model: mujoco.MjModel, data: mujoco.MjData, body: int, point: Array) -> Array:
    """Return the velocity in W of the body-fixed point at ``point`` in W, (3,) [m/s]."""
    twist = data.cvel[body]
    lever = point - data.subtree_com[model.body_rootid[body]]
    velocity: Array = twist[3:] + cross(twist[:3], lever)
    return velocity
