"""The kernel as MuJoCo's callback for passive forces, and a stepping loop without the callback.

MuJoCo calls ``mjcb_passive`` after it has factorised the mass matrix and before it is used for
accelerations. There the wrapper recomputes M if it has its water already (the callback may run
twice on one state, as in ``mjd_transitionFD``). It adds the water, factorises again, and projects
the constraints again where the solver needs it. A process has one slot. The wrapper does not change
models without our tables, so several models can exist at once, in any number of threads.

MuJoCo skips the callback when springs and dampers are both disabled.
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
    """MuJoCo's own library: the one that the bindings have loaded."""
    folder = Path(mujoco.__file__).parent
    patterns = ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll")
    for pattern in patterns:
        for path in sorted(folder.glob(pattern)):
            return ctypes.CDLL(str(path))
    raise layout.MujocoChanged(f"no library {' or '.join(patterns)} in the mujoco package")


@functools.cache
def offsets() -> Ints64:
    """The field offsets of this MuJoCo, checked on a small model once."""
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
    """Compile the C function ``void (const mjModel*, mjData*)``, or load it from the disk."""
    offsets()
    link_library(library()._name)  # it has MuJoCo's functions
    return compile_c_function(_add_water, _SIGNATURE)


@functools.cache
def stepper() -> Callable[[int, int, int], None]:
    """Compile a loop of ``mj_step1``, water, ``mj_step2``: the steps without the callback."""
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
    """Return whether this MuJoCo exports the slot of the callback."""
    try:
        _slot()
    except ValueError:
        return False
    return True


def is_installed() -> bool:
    """Return whether our function is installed in the slot."""
    return has_slot() and _slot().value == _address()


def install() -> None:
    """Install our function in the slot; again after ``mj_resetCallbacks``.

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
    """Remove, once, the timer with which MuJoCo's bindings time every stage of a step.

    It takes a twentieth of a step, and ``data.timer`` has no other reader: a clock that was set
    with ``mujoco.set_mjcb_time`` stays.
    """
    if mujoco.get_mjcb_time() is None:
        with contextlib.suppress(ValueError):  # not exported
            ctypes.c_void_p.in_dll(library(), "mjcb_time").value = None


def remove() -> None:
    """Empty the slot, if it is ours."""
    if is_installed():
        _slot().value = None


def add_water(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Call the callback's function once, on ``data`` after ``mj_forward`` without it."""
    function = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(wrapper().address)
    function(model._address, data._address)


def move_to_middle(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Carry out the part of the step before MuJoCo's; see `free_bodies`."""
    free_bodies.move_to_middle(model._address, data._address, offsets())


def move_to_end(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Carry out the part of the step after MuJoCo's; see `free_bodies`."""
    free_bodies.move_to_end(model._address, data._address, offsets())


def water_wrenches(model: mujoco.MjModel, data: mujoco.MjData) -> Floats:
    """Return torque and force of the water on subtrees, (nbody, 6): `kernel.water_wrenches`."""
    wrenches = np.zeros((model.nbody, 6))
    kernel.water_wrenches(model._address, data._address, offsets(), wrenches)
    return wrenches


@functools.cache
def function_address(name: str) -> int:
    """Return the address of a function of MuJoCo by its name."""
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
