"""The kernel as MuJoCo's callback for passive forces, and a stepping loop without the callback.

MuJoCo calls ``mjcb_passive`` after it has factorised the mass matrix and before anything uses it
for accelerations. There the wrapper rebuilds M if it has had its water (the callback may run twice
on one state, as in ``mjd_transitionFD``), adds the water, factorises again, and projects the
constraints again where the solver needs it. The slot is one per process; models without our tables
pass through it untouched, so several models live beside one another, in any number of threads.

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
_AT = layout.offsets()


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
    model = mujoco.MjModel.from_xml_string(_SMALL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    layout.check(model, data, _AT)
    return _AT


def _add_water(m: int, d: int) -> None:
    if kernel.has_tables(m, _AT):
        if kernel.has_water(d, _AT):
            _make(m, d)
        kernel.add_water(m, d, _AT)
        _factor(m, d)
        if kernel.needs_projection(m, _AT):
            _project(m, d)


@functools.cache
def wrapper() -> Any:
    """Compile the C function ``void (const mjModel*, mjData*)``, or read it from the disk."""
    offsets()
    link_library(library()._name)  # where MuJoCo's functions are
    return compile_c_function(_add_water, _SIGNATURE)


@functools.cache
def stepper() -> Callable[[int, int, int], None]:
    """Compile a loop of ``mj_step1``, water, ``mj_step2``: what the callback does, without it."""
    at = offsets()
    one, two, make, factor, project = (
        _native(name)
        for name in ("mj_step1", "mj_step2", "mj_makeM", "mj_factorM", "mj_projectConstraint")
    )
    add_water, needs_projection = kernel.add_water, kernel.needs_projection
    has_water = kernel.has_water
    to_the_middle, to_the_end = free_bodies.to_the_middle, free_bodies.to_the_end

    def loop(m: int, d: int, n: int) -> None:
        for _ in range(n):
            to_the_middle(m, d, at)
            one(m, d)
            if has_water(d, at):
                make(m, d)
            add_water(m, d, at)
            factor(m, d)
            if needs_projection(m, at):
                project(m, d)
            two(m, d)
            to_the_end(m, d, at)

    compiled: Callable[[int, int, int], None] = numba.njit(nogil=True)(loop)
    return compiled


def has_slot() -> bool:
    """Whether this MuJoCo exports the slot of the callback."""
    try:
        _slot()
    except ValueError:
        return False
    return True


def is_installed() -> bool:
    """Whether our function is installed in the slot."""
    return has_slot() and _slot().value == _address()


def install() -> None:
    """Put our function into the slot; again after ``mj_resetCallbacks``.

    Raises:
        CallbackTaken: there is another one.
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

    It is a twentieth of a step, and nobody reads ``data.timer`` unless they ask for it: a clock set
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
    """Call what the callback calls, once, on ``data`` as ``mj_forward`` without it left it."""
    function = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(wrapper().address)
    function(model._address, data._address)


def to_the_middle(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """The part of the step before MuJoCo's; see `free_bodies`."""
    free_bodies.to_the_middle(model._address, data._address, offsets())


def to_the_end(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """The part of the step after MuJoCo's; see `free_bodies`."""
    free_bodies.to_the_end(model._address, data._address, offsets())


def water_wrenches(model: mujoco.MjModel, data: mujoco.MjData) -> Floats:
    """Torque and force of the water on each subtree; see `kernel.water_wrenches`, (nbody, 6)."""
    wrenches = np.zeros((model.nbody, 6))
    kernel.water_wrenches(model._address, data._address, offsets(), wrenches)
    return wrenches


@functools.cache
def function_address(name: str) -> int:
    """Return the address of a function of MuJoCo by its name."""
    return ctypes.cast(getattr(library(), name), ctypes.c_void_p).value or 0


@functools.cache
def _address() -> int:
    """Of our function."""
    return int(wrapper().address)


@functools.cache
def _slot() -> ctypes.c_void_p:
    return ctypes.c_void_p.in_dll(library(), "mjcb_passive")


def _native(name: str) -> Any:
    function = getattr(library(), name)
    function.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    function.restype = None
    signature = types.void(types.intp, types.intp)
    return types.ExternalFunctionPointer(
        signature, get_pointer=lambda _: ctypes.cast(function, ctypes.c_void_p).value or 0
    )


_SMALL = """
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
