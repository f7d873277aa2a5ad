"""Offsets of the fields of MuJoCo's C structs, computed from `mujoco.introspect`.

The kernel gets nothing but the addresses of ``mjModel`` and ``mjData``. The offset of every field
it reads follows from the declarations by C's rules of alignment; `check` holds the offsets
against the live arrays that the Python bindings give out, so that a change of MuJoCo is refused,
never misread.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import mujoco
import numpy as np
import numpy.typing as npt
from mujoco.introspect import structs

from ....errors import UwsimError

MODEL_FIELDS = (
    "opt.timestep", "opt.gravity", "opt.integrator", "opt.solver", "opt.noslip_iterations",
    "opt.disableflags", "opt.enableflags",
    "nq", "nv", "nu", "nbody", "nactuator", "nuser_body", "nuser_actuator", "nuserdata",
    "ntree", "tree_bodyadr", "tree_bodynum", "tree_dofadr", "tree_dofnum",
    "body_parentid", "body_rootid", "body_treeid", "body_jntnum", "body_jntadr", "body_dofnum",
    "body_dofadr", "body_user", "jnt_qposadr", "geom_bodyid",
    "dof_bodyid", "M_rownnz", "M_rowadr", "M_colind",
    "actuator_user", "actuator_trnid", "actuator_actadr", "actuator_ctrladr", "actuator_ctrlrange",
    "site_bodyid",
)  # fmt: skip
"""What the kernel reads of the model."""

DATA_FIELDS = (
    "qpos", "qvel", "act", "ctrl", "userdata", "xpos", "xmat", "site_xpos", "site_xmat",
    "subtree_com", "cdof", "cdof_dot", "cvel", "cacc", "cinert", "crb", "M", "cfrc_int",
    "qfrc_passive", "qfrc_applied", "qfrc_bias", "qfrc_spring", "qfrc_damper", "qfrc_actuator",
    "tree_awake", "qacc", "qacc_smooth", "nefc", "solver_niter", "ncon", "contact",
)  # fmt: skip
"""What the kernel reads and writes of the data."""

CONTACT_FIELDS = ("pos", "frame", "geom")
"""The fields of a contact that the kernel reads."""

_INSIDE = ("opt.", "nefc", "solver_niter", "ncon")
"""Beginnings of the names of numbers of 32 bits, and of arrays that lie in the struct itself."""

_SIZES = {
    "char": 1, "mjtByte": 1, "mjtBool": 1, "int": 4, "float": 4, "mjtNum": 8, "double": 8,
    "mjtSize": 8, "size_t": 8, "uintptr_t": 8, "uint64_t": 8,
}  # fmt: skip


class MujocoChanged(UwsimError):
    """The memory layout of this MuJoCo differs from that of the kernel."""


def offsets() -> npt.NDArray[np.int64]:
    """Return the byte offsets of all fields, (n,).

    Those of `MODEL_FIELDS` in mjModel, `DATA_FIELDS` in mjData and `CONTACT_FIELDS` in mjContact,
    and the size of mjContact.
    """
    model, data = _fields("mjModel"), _fields("mjData")
    option = _fields("mjOption")
    found = []
    for name in MODEL_FIELDS:
        head, _, tail = name.partition(".")
        found.append(
            _find(model, "mjModel", head) + (_find(option, "mjOption", tail) if tail else 0)
        )
    found += [_find(data, "mjData", name) for name in DATA_FIELDS]
    contact: dict[str, int] = {}
    size, _ = _walk(structs.STRUCTS["mjContact"].fields, contact)
    found += [*(_find(contact, "mjContact", name) for name in CONTACT_FIELDS), size]
    return np.array(found, dtype=np.int64)


def check(model: mujoco.MjModel, data: mujoco.MjData, at: npt.NDArray[np.int64]) -> None:
    """Compare the offsets with live arrays and numbers.

    Args:
        model: the model.
        data: its state, with a contact.
        at: the offsets.

    Raises:
        MujocoChanged: a pointer or a number is not where it should be.
    """
    names, n_contact = (*MODEL_FIELDS, *DATA_FIELDS), len(CONTACT_FIELDS) + 1
    for name, offset in zip(names, at[:-n_contact].tolist(), strict=True):
        is_data = name in DATA_FIELDS
        place = (data if is_data else model)._address + offset
        live = data if is_data else model
        for part in name.split("."):
            live = getattr(live, part)
        if name == "contact":
            right = _has_contact_layout(live, _read(place, ctypes.c_uint64), at[-n_contact:])
        elif isinstance(live, np.ndarray) and name.startswith(_INSIDE):
            right = live.ctypes.data == place
        elif isinstance(live, np.ndarray):
            right = live.size == 0 or live.ctypes.data == _read(place, ctypes.c_uint64)
        elif isinstance(live, float):
            right = live == _read(place, ctypes.c_double)
        else:
            width = ctypes.c_int32 if name.startswith(_INSIDE) else ctypes.c_int64
            right = int(live) == _read(place, width)
        if not right:
            raise MujocoChanged(
                f"MuJoCo {mujoco.__version__} keeps {name!r} elsewhere than its own description "
                "says; the hydrodynamics need mujoco>=4.0,<4.1."
            )


@cache
def data_places() -> tuple[dict[str, slice], int]:
    """The bytes of every field of mjData by its name, and the size of mjData."""
    places: dict[str, int] = {}
    fields = structs.STRUCTS["mjData"].fields
    size, _ = _walk(fields, places)
    return {
        each.name: slice(places[each.name], places[each.name] + _size(each.type)[0])
        for each in fields
    }, size


def _has_contact_layout(contacts: Any, address: int, layout: npt.NDArray[np.int64]) -> bool:
    """Check offsets of `CONTACT_FIELDS`, and the size of a contact, against live contacts."""
    *offsets, size = layout.tolist()
    fields = [getattr(contacts, name) for name in CONTACT_FIELDS]  # views, one row per contact
    return len(contacts) > 0 and all(
        (field.ctypes.data, field.strides[0]) == (address + offset, size)
        for field, offset in zip(fields, offsets, strict=True)
    )


def _read(place: int, kind: Any) -> Any:
    return kind.from_address(place).value


def _find(fields: dict[str, int], struct: str, name: str) -> int:
    if name not in fields:
        raise MujocoChanged(
            f"MuJoCo {mujoco.__version__} has no field {struct}.{name}; the hydrodynamics need "
            "mujoco>=4.0,<4.1."
        )
    return fields[name]


def _fields(struct: str) -> dict[str, int]:
    """Name -> byte offset."""
    places: dict[str, int] = {}
    _walk(structs.STRUCTS[struct].fields, places)
    return places


def _walk(fields: Any, places: dict[str, int]) -> tuple[int, int]:
    """Size and alignment of a struct; fills ``places``."""
    end, widest = 0, 1
    for field in fields:
        size, alignment = _size(field.type)
        end = -(-end // alignment) * alignment
        places[field.name] = end
        end += size
        widest = max(widest, alignment)
    return -(-end // widest) * widest, widest


def _size(kind: Any) -> tuple[int, int]:
    """Size and alignment of a type of `mujoco.introspect`."""
    if hasattr(kind, "fields"):
        return _walk(kind.fields, {})
    if hasattr(kind, "extents"):
        size, alignment = _size(kind.inner_type)
        return size * int(np.prod(kind.extents)), alignment
    if not hasattr(kind, "name"):
        return 8, 8  # a pointer
    if kind.name in _SIZES:
        return _SIZES[kind.name], _SIZES[kind.name]
    if kind.name in structs.STRUCTS:
        return _walk(structs.STRUCTS[kind.name].fields, {})
    return 4, 4  # an enumeration
