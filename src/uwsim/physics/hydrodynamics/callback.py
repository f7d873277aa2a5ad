"""The kernel as MuJoCo's callback for passive forces, and a stepping loop without the callback.

MuJoCo calls ``mjcb_passive`` after it has factorised the mass matrix M, before it computes
accelerations. The wrapper adds the water to M and to the passive forces, factorises M again, and
projects the constraints again if the solver needs it. If M contains the water already, as when the
callback runs twice on one state (``mjd_transitionFD``), M is recomputed first. A process has one
slot for the callback. The wrapper does not change models without the tables of `columns`, so
several models can exist at once, in any number of threads.

MuJoCo skips the callback if springs and dampers are both disabled.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numba
import numpy as np
from numba import types

from ...base.numerics.jit import compile_c_function, link_library
from ...base.numerics.memory import Floats, Ints64
from ...errors import UwsimError
from .kernel import free_bodies, kernel, layout

_SIGNATURE = types.void(types.intp, types.intp)
_make: Any
_factor: Any
_project: Any
_make, _factor, _project = (
    types.ExternalFunction(name, _SIGNATURE)
    for name in ("mj_makeM", "mj_factorM", "mj_projectConstraint")
)
_OFFSETS = layout.offsets()


class CallbackTaken(UwsimError):
    """Another function is installed in MuJoCo's slot for passive forces."""


@functools.cache
def library() -> ctypes.CDLL:
    """Load MuJoCo's shared library, which its Python bindings have loaded already."""
    folder = Path(mujoco.__file__).parent
    patterns = ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll")
    for pattern in patterns:
        for path in sorted(folder.glob(pattern)):
            return ctypes.CDLL(str(path))
    raise layout.MujocoChanged(f"no library {' or '.join(patterns)} in the mujoco package")


@functools.cache
def offsets() -> Ints64:
    """Return the field offsets of the installed MuJoCo, after a check on a small model."""
    model = mujoco.MjModel.from_xml_string(_SMALL_MODEL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    layout.check(model, data, _OFFSETS)
    return _OFFSETS


def _add_water(m: int, d: int) -> None:
    if kernel.has_tables(m, _OFFSETS):
        if kernel.has_water(d, _OFFSETS):
            _make(m, d)
        kernel.add_water(m, d, _OFFSETS)
        _factor(m, d)
        if kernel.needs_projection(m, _OFFSETS):
            _project(m, d)


@functools.cache
def wrapper() -> Any:
    """Compile the C function ``void (const mjModel*, mjData*)``, or load it from the disk cache."""
    offsets()
    link_library(library()._name)  # for MuJoCo's functions
    return compile_c_function(_add_water, _SIGNATURE)


@functools.cache
def stepper() -> Callable[[int, int, int], None]:
    """Compile a loop of steps without the callback: ``mj_step1``, water, ``mj_step2``."""
    o = offsets()
    step1, step2, make, factor, project = (
        _native_function(name)
        for name in ("mj_step1", "mj_step2", "mj_makeM", "mj_factorM", "mj_projectConstraint")
    )
    add_water, needs_projection = kernel.add_water, kernel.needs_projection
    has_water = kernel.has_water
    move_to_middle, move_to_end = free_bodies.move_to_middle, free_bodies.move_to_end

    def loop(m: int, d: int, n: int) -> None:
        for _ in range(n):
            move_to_middle(m, d, o)
            step1(m, d)
            if has_water(d, o):
                make(m, d)
            add_water(m, d, o)
            factor(m, d)
            if needs_projection(m, o):
                project(m, d)
            step2(m, d)
            move_to_end(m, d, o)

    compiled_loop: Callable[[int, int, int], None] = numba.njit(nogil=True)(loop)
    return compiled_loop


def has_slot() -> bool:
    """Return whether the installed MuJoCo exports the slot of the callback."""
    try:
        _slot()
    except ValueError:
        return False
    return True


def is_installed() -> bool:
    """Return whether the kernel is installed in the slot."""
    return has_slot() and _slot().value == _address()


def install() -> None:
    """Install the kernel in the slot; needed again after ``mj_resetCallbacks``.

    Raises:
        CallbackTaken: another function is installed.
    """
    slot, address = _slot(), _address()
    if slot.value == address:
        return
    if slot.value is not None:
        raise CallbackTaken(
            "MuJoCo's callback for passive forces (mjcb_passive) is taken by another function; "
            "remove it with mujoco.set_mjcb_passive(None), or step with `Hydrodynamics.step`."
        )
    slot.value = address


@functools.cache
def stop_profiler() -> None:
    """Remove the clock with which MuJoCo's bindings time every stage of a step.

    The clock takes a twentieth of a step, and uwsim does not read ``data.timer``. A clock that was
    set with ``mujoco.set_mjcb_time`` is kept.
    """
    if mujoco.get_mjcb_time() is None:
        with contextlib.suppress(ValueError):  # not exported
            ctypes.c_void_p.in_dll(library(), "mjcb_time").value = None


def remove() -> None:
    """Empty the slot if the kernel is installed in it."""
    if is_installed():
        _slot().value = None


def add_water(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Add the water once to ``data``, after ``mj_forward`` without the callback."""
    function = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(wrapper().address)
    function(model._address, data._address)


def move_to_middle(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Move free bodies by half a step, before MuJoCo's step; see `free_bodies`."""
    free_bodies.move_to_middle(model._address, data._address, offsets())


def move_to_end(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Move free bodies to the end of a step, after MuJoCo's step; see `free_bodies`."""
    free_bodies.move_to_end(model._address, data._address, offsets())


def water_wrenches(model: mujoco.MjModel, data: mujoco.MjData) -> Floats:
    """Return the wrenches of the water on subtrees, (nbody, 6); see `kernel.water_wrenches`."""
    wrenches = np.zeros((model.nbody, 6))
    kernel.water_wrenches(model._address, data._address, offsets(), wrenches)
    return wrenches


@functools.cache
def function_address(name: str) -> int:
    """Return the address of a function in MuJoCo's library."""
    return ctypes.cast(getattr(library(), name), ctypes.c_void_p).value or 0


@functools.cache
def _address() -> int:
    return int(wrapper().address)


@functools.cache
def _slot() -> ctypes.c_void_p:
    return ctypes.c_void_p.in_dll(library(), "mjcb_passive")


def _native_function(name: str) -> Any:
    function = getattr(library(), name)
    function.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    function.restype = None
    signature = types.void(types.intp, types.intp)
    return types.ExternalFunctionPointer(
        signature, get_pointer=lambda _: ctypes.cast(function, ctypes.c_void_p).value or 0
    )


_SMALL_MODEL = """
<mujoco>
  <size nuser_body="2" nuser_actuator="3" nuserdata="5"/>
  <option timestep="0.003" noslip_iterations="2" integrator="implicitfast" gravity="1 2 -9.8"/>
  <worldbody>
    <geom size="0.1" pos="0 0 -0.15"/>
    <body name="a"><freejoint/><geom size="0.1"/><site name="s"/>
      <body name="b" pos="0.3 0 0"><joint name="j"/><geom size="0.1"/></body></body>
  </worldbody>
  <actuator>
    <general site="s" gear="1 0 0 0 0 0" dyntype="filterexact" dynprm="0.2" ctrlrange="-1 1"/>
    <motor joint="j"/>
  </actuator>
</mujoco>
"""
