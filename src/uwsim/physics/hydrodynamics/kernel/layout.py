"""Offsets of the fields of MuJoCo's C structs, computed from `mujoco.introspect`.

The kernel receives only the addresses of ``mjModel`` and ``mjData``. The offsets of the fields that
it reads follow from the declarations of the structs by C's rules of alignment. `check` compares
them with the arrays of the Python bindings, so that another layout is an error.
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
"""The fields of the model that the kernel reads."""

DATA_FIELDS = (
    "qpos", "qvel", "act", "ctrl", "userdata", "xpos", "xmat", "site_xpos", "site_xmat",
    "subtree_com", "cdof", "cdof_dot", "cvel", "cacc", "cinert", "crb", "M", "cfrc_int",
    "qfrc_passive", "qfrc_applied", "qfrc_bias", "qfrc_spring", "qfrc_damper", "qfrc_actuator",
    "tree_awake", "qacc", "qacc_smooth", "nefc", "solver_niter", "ncon", "contact",
)  # fmt: skip
"""The fields of the data that the kernel reads and writes."""

CONTACT_FIELDS = ("pos", "frame", "geom")
"""The fields of a contact that the kernel reads."""

_STRUCT_NAMES = ("opt.", "nefc", "solver_niter", "ncon")
"""The prefixes of names of fields that are 32-bit integers, or arrays within the struct."""

_SIZES = {
    "char": 1, "mjtByte": 1, "mjtBool": 1, "int": 4, "float": 4, "mjtNum": 8, "double": 8,
    "mjtSize": 8, "size_t": 8, "uintptr_t": 8, "uint64_t": 8,
}  # fmt: skip


class MujocoChanged(UwsimError):
    """The memory layout of the installed MuJoCo differs from the layout that the kernel expects."""


def offsets() -> npt.NDArray[np.int64]:
    """Return the byte offsets of all fields, (n,).

    They are the offsets of `MODEL_FIELDS` in ``mjModel``, of `DATA_FIELDS` in ``mjData`` and of
    `CONTACT_FIELDS` in ``mjContact``, then the size of ``mjContact``.
    """
    model, data = _fields("mjModel"), _fields("mjData")
    option = _fields("mjOption")
    numbers = []
    for name in MODEL_FIELDS:
        head, _, tail = name.partition(".")
        numbers.append(
            _find(model, "mjModel", head) + (_find(option, "mjOption", tail) if tail else 0)
        )
    numbers += [_find(data, "mjData", name) for name in DATA_FIELDS]
    contact: dict[str, int] = {}
    size, _ = _walk(structs.STRUCTS["mjContact"].fields, contact)
    numbers += [*(_find(contact, "mjContact", name) for name in CONTACT_FIELDS), size]
    return np.array(numbers, dtype=np.int64)


def check(model: mujoco.MjModel, data: mujoco.MjData, offsets: npt.NDArray[np.int64]) -> None:
    """Compare offsets with the addresses and values of a live model.

    Args:
        model: a model.
        data: data of the model, with at least one contact.
        offsets: the offsets.

    Raises:
        MujocoChanged: a pointer or a number is not at its offset.
    """
    names, n_contact = (*MODEL_FIELDS, *DATA_FIELDS), len(CONTACT_FIELDS) + 1
    for name, offset in zip(names, offsets[:-n_contact].tolist(), strict=True):
        is_data = name in DATA_FIELDS
        address = (data if is_data else model)._address + offset
        value = data if is_data else model
        for part in name.split("."):
            value = getattr(value, part)
        if name == "contact":
            right = _has_contact_layout(
                value, _read(address, ctypes.c_uint64), offsets[-n_contact:]
            )
        elif isinstance(value, np.ndarray) and name.startswith(_STRUCT_NAMES):
            right = value.ctypes.data == address
        elif isinstance(value, np.ndarray):
            right = value.size == 0 or value.ctypes.data == _read(address, ctypes.c_uint64)
        elif isinstance(value, float):
            right = value == _read(address, ctypes.c_double)
        else:
            width = ctypes.c_int32 if name.startswith(_STRUCT_NAMES) else ctypes.c_int64
            right = int(value) == _read(address, width)
        if not right:
            raise MujocoChanged(
                f"MuJoCo {mujoco.__version__} has {name!r} at another offset than its description "
                "states; the hydrodynamics need mujoco>=4.0,<4.1."
            )


@cache
def data_slices() -> tuple[dict[str, slice], int]:
    """Return the slice of bytes of each field of ``mjData`` by name, and the size of ``mjData``."""
    starts: dict[str, int] = {}
    fields = structs.STRUCTS["mjData"].fields
    size, _ = _walk(fields, starts)
    return {
        field.name: slice(starts[field.name], starts[field.name] + _size(field.type)[0])
        for field in fields
    }, size


def _has_contact_layout(contacts: Any, address: int, layout: npt.NDArray[np.int64]) -> bool:
    """Compare the offsets of `CONTACT_FIELDS` and the size of a contact with live contacts."""
    *offsets, size = layout.tolist()
    fields = [getattr(contacts, name) for name in CONTACT_FIELDS]  # views, one row per contact
    return len(contacts) > 0 and all(
        (field.ctypes.data, field.strides[0]) == (address + offset, size)
        for field, offset in zip(fields, offsets, strict=True)
    )


def _read(address: int, kind: Any) -> Any:
    return kind.from_address(address).value


def _find(fields: dict[str, int], struct: str, name: str) -> int:
    if name not in fields:
        raise MujocoChanged(
            f"MuJoCo {mujoco.__version__} has no field {struct}.{name}; the hydrodynamics need "
            "mujoco>=4.0,<4.1."
        )
    return fields[name]


def _fields(struct: str) -> dict[str, int]:
    """Return the byte offsets of the fields of a struct by name."""
    starts: dict[str, int] = {}
    _walk(structs.STRUCTS[struct].fields, starts)
    return starts


def _walk(fields: Any, starts: dict[str, int]) -> tuple[int, int]:
    """Return the size and alignment of a struct; write the offsets of its fields to ``starts``."""
    end, max_alignment = 0, 1
    for field in fields:
        size, alignment = _size(field.type)
        end = -(-end // alignment) * alignment
        starts[field.name] = end
        end += size
        max_alignment = max(max_alignment, alignment)
    return -(-end // max_alignment) * max_alignment, max_alignment


def _size(kind: Any) -> tuple[int, int]:
    """Return the size and alignment of a type of `mujoco.introspect` [bytes]."""
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
