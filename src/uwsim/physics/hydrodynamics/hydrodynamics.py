"""The hydrodynamics of a compiled model: installation, water motion, thrusters, fins and steps."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.numerics.memory import Floats
from ...errors import UnknownName, UwsimError
from . import callback
from . import columns as c
from .inverse_weights import correct_inverse_weights
from .self_test import self_test


class NoWater(UwsimError):
    """A model without hydrodynamics, or with options that exclude them."""


class Hydrodynamics:
    """The hydrodynamics of a compiled model; methods take the state as ``data``.

    A thruster has two numbers: its actuator id in the model, and its index among the thrusters.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self._uses_callback = callback.has_slot()
        self.thrusters = tuple(
            int(i)
            for i in range(model.nactuator)
            if model.nuser_actuator == c.ACTUATOR_COLUMNS
            and model.actuator_user[i, c.ROLE] == c.PROPELLER
        )
        """The actuator ids of the thrusters, in the order of the model."""
        in_flow = _bodies_in_flow(model)
        self.bodies = tuple(
            int(i)
            for i in range(1, model.nbody)
            if model.body_user[i, c.KIND] != c.DRY_BODY or i in in_flow
        )
        """The ids of the bodies that the water acts on."""
        self._controls = model.actuator_ctrladr[list(self.thrusters)]  # (n,) addresses in ctrl

    @property
    def surface(self) -> float:
        """The height of the still water's surface [m]."""
        return float(self.model.body_user[0, c.SURFACE])

    @property
    def density(self) -> float:
        """The density of the water [kg/m3]."""
        return float(self.model.body_user[0, c.DENSITY])

    def water(self, data: mujoco.MjData) -> Floats:
        """Return a view of the water's motion at every body, (nbody, `columns.WATER_COLUMNS`)."""
        n = c.WATER_COLUMNS * self.model.nbody
        rows: Floats = data.userdata[:n].reshape(self.model.nbody, c.WATER_COLUMNS)
        return rows

    def set_current(
        self,
        data: mujoco.MjData,
        velocity: Sequence[float] | Floats,
        acceleration: Sequence[float] | Floats = (0.0, 0.0, 0.0),
        rotation: Sequence[float] | Floats = (0.0, 0.0, 0.0),
        *,
        body: int | npt.NDArray[np.int64] | None = None,
    ) -> None:
        """Set the motion of the water at one body, several bodies or all bodies.

        W is the world frame. Vectors for several bodies may be different, (n, 3), or equal, (3,).

        Args:
            data: the engine's state.
            velocity: the velocity of the water in W, (3,) or (n, 3) [m/s].
            acceleration: the acceleration of the water in W, (3,) or (n, 3) [m/s2].
            rotation: the angular velocity of the water, half its vorticity, in W [rad/s].
            body: the body id in the model, or (n,) ids; None for all bodies.
        """
        rows = self.water(data)
        row = slice(None) if body is None else body
        rows[row, 0:3] = velocity
        rows[row, 3:6] = acceleration
        rows[row, c.OMEGA : c.OMEGA + 3] = rotation

    def reference_point(self, body: int) -> Floats:
        """Return the point at which the water acts on a body, in the body's frame, (3,) [m].

        It is the centre of buoyancy, or the reference point of a body that displaces no water.
        """
        row = self.model.body_user[body]
        point = row[c.REFERENCE : c.REFERENCE + 3].copy()
        if row[c.DISPLACED_MASS] > 0.0:
            point += row[c.CENTRE : c.CENTRE + 3]
        return np.asarray(point)

    def set_thruster(self, data: mujoco.MjData, index: int, command: float) -> None:
        """Set the command of a thruster, by its index among the thrusters [1]."""
        data.ctrl[self._controls[index]] = command

    def set_thrusters(
        self,
        data: mujoco.MjData,
        commands: Sequence[float] | npt.NDArray[np.float64],
        indices: slice | Sequence[int] = slice(None),
    ) -> None:
        """Set the commands of all thrusters, or of those with some indices, (n,) [1]."""
        data.ctrl[self._controls[indices]] = commands

    def stop_thruster(self, data: mujoco.MjData, index: int) -> None:
        """Stop a thruster and its rotor at once, by its index among the thrusters."""
        self.set_thruster(data, index, 0.0)
        self.set_rotor(data, index, 0.0)

    def set_rotor(self, data: mujoco.MjData, index: int, speed: float) -> None:
        """Set a rotor at once to the speed of a lasting command, if it has a lag [1]."""
        address = int(self.model.actuator_actadr[self.thrusters[index]])
        if address >= 0:
            data.act[address] = speed

    def set_loss(self, data: mujoco.MjData, index: int, loss: float) -> None:
        """Set the fraction of its thrust that a thruster loses, by index: 0 healthy, 1 dead."""
        data.userdata[c.WATER_COLUMNS * self.model.nbody + self.thrusters[index]] = loss

    def turn_fin(self, data: mujoco.MjData, name: str, angle: float) -> None:
        """Set the commanded angle of a fin, by its actuator's name [rad]."""
        data.userdata[c.WATER_COLUMNS * self.model.nbody + self._fin(name)] = angle

    def stop_fin(self, data: mujoco.MjData, name: str) -> None:
        """Set the angle of a fin and its command to 0."""
        self.turn_fin(data, name, 0.0)
        data.act[self.model.actuator_actadr[self._fin(name)]] = 0.0

    def _fin(self, name: str) -> int:
        return int(self.model.actuator(name).id)

    def thruster(self, name: str) -> int:
        """Return the index of a thruster among the thrusters, by its actuator's name."""
        names = [self.model.actuator(i).name for i in self.thrusters]
        if name not in names:
            raise UnknownName("thruster", name, names)
        return names.index(name)

    def step(self, data: mujoco.MjData, n: int = 1) -> None:
        """Advance by ``n`` steps, with the callback if MuJoCo exports it."""
        if self._uses_callback:
            callback.install()  # mj_resetCallbacks may have emptied the slot
            for _ in range(n):
                callback.move_to_middle(self.model, data)
                mujoco.mj_step(self.model, data)
                callback.move_to_end(self.model, data)
        else:
            self.step_without_callback(data, n)

    def step_without_callback(self, data: mujoco.MjData, n: int = 1) -> None:
        """Advance by ``n`` steps of ``mj_step1``, water and ``mj_step2``; not possible for RK4."""
        if self.model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
            raise NoWater("RK4 needs MuJoCo's callback; this MuJoCo does not export it.")
        callback.remove()
        callback.stepper()(self.model._address, data._address, n)

    def wrenches(self, data: mujoco.MjData) -> Floats:
        """Return the torque [N m] and force [N] of the water on each subtree of bodies, (nbody, 6).

        Forces of thrusters and fins are included. The wrenches are those of the last forward pass,
        in world axes, about ``data.subtree_com`` of the tree's root. ``data.cacc`` must be up to
        date: it is if the model has an accelerometer, force or torque sensor; else call
        ``mujoco.mj_rnePostConstraint`` first.
        """
        return callback.water_wrenches(self.model, data)


def install(model: mujoco.MjModel) -> Hydrodynamics:
    """Install the hydrodynamics of a compiled model.

    This checks MuJoCo's layout and the kernel, installs the kernel in MuJoCo's callback slot, and
    corrects the model's inverse weights. A second call changes nothing.

    Raises:
        NoWater: the model was not prepared, or its options exclude the callback.
        CallbackTaken: another function is installed in the slot.
        MujocoChanged: the layout of this MuJoCo differs from what the kernel expects.
    """
    _check(model)
    water = attach(model)
    correct_inverse_weights(model)
    _set_rotor_dynamics(model)
    return water


def attach(model: mujoco.MjModel) -> Hydrodynamics:
    """Return the hydrodynamics of a copy of a model that `install` has corrected.

    Raises:
        CallbackTaken: another function is installed in the slot.
        MujocoChanged: the layout of this MuJoCo differs from what the kernel expects.
    """
    self_test()
    if callback.has_slot():
        callback.install()
    callback.stop_profiler()
    return Hydrodynamics(model)


def _set_rotor_dynamics(model: mujoco.MjModel) -> None:
    """Replace the exact filter of rotors by a filter that RK4 integrates in its stages.

    With MuJoCo's exact filter, RK4 would apply the lag in the stages and again at the end of the
    step, with an error of first order. A lag shorter than a step counts as a step, as RK4 is
    unstable for lags below a third of a step.
    """
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_RK4:
        return
    if model.nuser_actuator != c.ACTUATOR_COLUMNS:
        return
    lags = model.actuator_user[:, c.LAG]
    rotors = (model.actuator_user[:, c.ROLE] == c.PROPELLER) & (lags > 0.0)
    model.actuator_dyntype[rotors] = mujoco.mjtDyn.mjDYN_FILTER
    model.actuator_dynprm[rotors, 0] = np.maximum(lags[rotors], model.opt.timestep)


def _bodies_in_flow(model: mujoco.MjModel) -> set[int]:
    """Return the bodies with fins, or with propellers whose thrust depends on the flow."""
    if model.nuser_actuator != c.ACTUATOR_COLUMNS:
        return set()
    rows = model.actuator_user
    needs_flow = (rows[:, c.ROLE] == c.FIN) | (
        (rows[:, c.ROLE] == c.PROPELLER) & (rows[:, c.N_ADVANCE] > 0.0)
    )
    return set(model.site_bodyid[model.actuator_trnid[needs_flow, 0]].tolist())


def _check(model: mujoco.MjModel) -> None:
    if model.nuser_body != c.BODY_COLUMNS or model.body_user[0, c.MAGIC] != c.MAGIC_NUMBER:
        raise NoWater("The model has no hydrodynamics; call prepare() before compiling it.")
    if model.nuserdata < c.WATER_COLUMNS * model.nbody + 2 * model.nactuator:
        raise NoWater(
            f"The model has {model.nuserdata} numbers of userdata for {model.nbody} bodies and "
            f"{model.nactuator} actuators; call prepare() last, after every body was added."
        )
    flags = mujoco.mjtDisableBit.mjDSBL_SPRING | mujoco.mjtDisableBit.mjDSBL_DAMPER
    if model.opt.disableflags & flags == flags:
        raise NoWater("Springs and dampers are both disabled: MuJoCo then skips the water too.")
    if model.opt.density or model.opt.viscosity:
        raise NoWater("option density and viscosity must be 0: MuJoCo's own fluid is not used.")
    for body in range(1, model.nbody):
        if model.body_user[body, c.KIND] == c.DRY_BODY or model.body_treeid[body] < 0:
            continue
        weld = int(model.body_weldid[body])
        dofs = range(model.body_dofadr[weld], model.body_dofadr[weld] + model.body_dofnum[weld])
        if any(model.dof_simplenum[dof] for dof in dofs) and len(dofs) > 1:
            name = model.body(body).name
            raise NoWater(f"Body {name!r} is 'simple' to MuJoCo; prepare() must see it first.")
