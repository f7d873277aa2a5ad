"""The tables of the hydrodynamics, written into the spec of a model before it is compiled."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import quaternion_from_rotation
from ...base.numerics.linear import length
from ...scene.hydrodynamics.checks import body_errors, density_errors, thruster_errors
from ...scene.hydrodynamics.fin_checks import fin_errors
from ...scene.hydrodynamics.spec import (
    BadHydrodynamics,
    BodyHydrodynamics,
    FinSpec,
    ThrusterSpec,
    matrix,
)
from . import columns as c

_SHAPES = {
    "sphere": c.SPHERE, "ellipsoid": c.ELLIPSOID, "box": c.BOX, "cylinder": c.CYLINDER,
    "shrinking-sphere": c.SHRINKING_SPHERE,
}  # fmt: skip
_LAWS = {
    "axes": c.DRAG_BY_AXIS, "speed": c.DRAG_BY_SPEED,
    "x": c.DRAG_ABOUT_X, "y": c.DRAG_ABOUT_Y, "z": c.DRAG_ABOUT_Z,
}  # fmt: skip


def prepare(
    spec: mujoco.MjSpec,
    bodies: Mapping[str, BodyHydrodynamics],
    thrusters: Mapping[str, tuple[str, ThrusterSpec]] | None = None,
    fins: Mapping[str, tuple[str, FinSpec]] | None = None,
    *,
    surface: float = 0.0,
    density: float = 1000.0,
    levels: Sequence[tuple[float, float]] = (),
) -> None:
    """Write hydrodynamics into the spec of a model that is about to be compiled.

    Call it after all bodies and actuators were added, as it counts them.

    Args:
        spec: the spec of the model.
        bodies: the hydrodynamics of bodies, by the name of the body in ``spec``.
        thrusters: the body name and the spec of each thruster, by the name of the actuator to add.
        fins: the body name and the spec of each fin, by the name of the actuator to add.
        surface: the height of the still water's surface in W [m].
        density: the density of water to which the bodies' hydrodynamics refer [kg/m3].
        levels: the levels of stratified water as depth [m] and density [kg/m3], from the top down;
            at least two, or none for uniform water.

    Raises:
        BadHydrodynamics: the hydrodynamics are invalid; with every error.
    """
    propellers, foils = thrusters or {}, fins or {}
    _check(spec, bodies, propellers, foils, density)
    spec.nuser_body = c.BODY_COLUMNS
    spec.nuser_actuator = max(spec.nuser_actuator, c.ACTUATOR_COLUMNS)
    if spec.nuser_actuator != c.ACTUATOR_COLUMNS:
        raise BadHydrodynamics([f"nuser_actuator must be at most {c.ACTUATOR_COLUMNS}"])
    water = np.zeros(c.BODY_COLUMNS)
    water[[c.MAGIC, c.SURFACE, c.DENSITY]] = c.MAGIC_NUMBER, surface, density
    water[c.N_LEVELS] = len(levels)
    for i, (depth, level_density) in enumerate(levels):
        water[c.LEVELS + 2 * i : c.LEVELS + 2 * i + 2] = depth, level_density / density - 1.0
    spec.worldbody.userdata = water
    for name, body in bodies.items():
        _prepare_body(spec.body(name), body, density)
    for name, (link, thruster) in propellers.items():
        _add_thruster(spec, name, spec.body(link), thruster)
    for name, (link, fin) in foils.items():
        _add_fin(spec, name, spec.body(link), fin)
    spec.nuserdata = c.WATER_COLUMNS * len(spec.bodies) + 2 * len(spec.actuators)


def body_row(body: BodyHydrodynamics, density: float) -> npt.NDArray[np.float64]:
    """Return the row of a body, with the columns of `columns`, (160,)."""
    row = np.zeros(c.BODY_COLUMNS)
    linear, quadratic = matrix(body.linear_damping), matrix(body.quadratic_damping)
    added_mass, lift = matrix(body.added_mass), matrix(body.body_lift)
    is_full = any(np.any(m - np.diag(np.diag(m))) for m in (added_mass, linear, quadratic))
    is_full = is_full or bool(np.any(lift))
    row[c.KIND] = c.FULL_MATRICES if is_full else c.DIAGONAL_MATRICES
    row[c.DRAG_IMPLICITNESS] = body.implicitness
    row[c.LAW] = _LAWS[body.drag_law]
    row[c.DISPLACED_MASS] = density * body.volume
    row[c.REFERENCE : c.REFERENCE + 3] = body.reference
    row[c.CENTRE : c.CENTRE + 3] = np.array(body.centre_of_buoyancy) - body.reference
    row[c.SHAPE] = _SHAPES[body.shape]
    size = body.size or (max(0.75 * body.volume / math.pi, 1e-12) ** (1.0 / 3.0),)
    row[c.SIZE : c.SIZE + len(size)] = size
    row[c.REACH] = _max_radius(body.shape, size)
    row[c.M_A : c.M_A + 36] = (0.5 * (added_mass + added_mass.T)).ravel()
    row[c.LINEAR : c.LINEAR + 36] = linear.ravel()
    row[c.QUADRATIC : c.QUADRATIC + 36] = quadratic.ravel()
    row[c.LIFT : c.LIFT + 36] = lift.ravel()
    return row


def _max_radius(shape: str, size: tuple[float, ...]) -> float:
    if shape == "box":
        return 0.5 * math.hypot(*size)
    if shape == "cylinder":
        return math.hypot(size[0], 0.5 * size[1])
    return max(size)


def thruster_row(thruster: ThrusterSpec) -> npt.NDArray[np.float64]:
    """Return the row of a thruster, with the columns of `columns`, (68,)."""
    row = np.zeros(c.ACTUATOR_COLUMNS)
    row[c.ROLE] = c.PROPELLER
    row[c.DEAD_ZONE] = thruster.dead_zone
    row[c.MIN_THRUST], row[c.MAX_THRUST] = thruster.saturation or (-math.inf, math.inf)
    row[c.TORQUE], row[c.RADIUS], row[c.LAG] = (
        thruster.torque, thruster.radius, thruster.time_constant,
    )  # fmt: skip
    backward = thruster.forward if thruster.backward is None else thruster.backward
    row[c.FORWARD : c.FORWARD + len(thruster.forward)] = thruster.forward
    row[c.BACKWARD : c.BACKWARD + len(backward)] = backward
    row[c.WAKE], row[c.N_ADVANCE] = thruster.wake, len(thruster.advance) // 2
    row[c.ADVANCE : c.ADVANCE + len(thruster.advance)] = thruster.advance
    return row


def fin_row(fin: FinSpec) -> npt.NDArray[np.float64]:
    """Return the row of a fin, with the columns of `columns`, (68,)."""
    row = np.zeros(c.ACTUATOR_COLUMNS)
    row[c.ROLE] = c.FIN
    row[c.MIN_ANGLE], row[c.MAX_ANGLE] = fin.limits
    row[c.RATE], row[c.LAG] = fin.rate or math.inf, fin.time_constant
    row[c.AREA], row[c.SLOPE], row[c.STALL] = fin.area, fin.slope, fin.stall
    row[c.DRAG], row[c.PLATE] = fin.drag, fin.plate_drag
    row[c.INDUCED_DRAG] = fin.induced_drag_slope
    row[c.N_COEFFICIENTS] = len(fin.coefficients) // 3
    row[c.IS_EVEN] = float(all(angle >= 0.0 for angle in fin.coefficients[::3]))
    row[c.COEFFICIENTS : c.COEFFICIENTS + len(fin.coefficients)] = fin.coefficients
    return row


def _check(
    spec: mujoco.MjSpec,
    bodies: Mapping[str, BodyHydrodynamics],
    thrusters: Mapping[str, tuple[str, ThrusterSpec]],
    fins: Mapping[str, tuple[str, FinSpec]],
    density: float,
) -> None:
    errors = density_errors(density)
    errors += [error for body in bodies.values() for error in body_errors(body)]
    errors += [error for _, part in thrusters.values() for error in thruster_errors(part)]
    errors += [error for _, part in fins.values() for error in fin_errors(part)]
    links = [link for link, _ in (*thrusters.values(), *fins.values())]
    for name in (*bodies, *links):
        if name == "world" or spec.body(name) is None:
            errors.append(f"the model has no body {name!r} that the water could act on")
    if spec.option.density or spec.option.viscosity:
        errors.append("option density and viscosity must be 0: MuJoCo's own fluid is not used")
    if errors:
        raise BadHydrodynamics(errors)


def _prepare_body(node: mujoco.MjsBody, body: BodyHydrodynamics, density: float) -> None:
    node.userdata = body_row(body, density)
    if list(node.joints):  # else MuJoCo may keep only the diagonal of M for a lone body
        node.simple = mujoco.mjtLimited.mjLIMITED_FALSE
    if body.mass is not None:
        node.mass = body.mass
        node.explicitinertial = True
    if body.centre_of_mass is not None:
        node.ipos = list(body.centre_of_mass)
        node.explicitinertial = True
    elif node.mass > 0.0 and math.isnan(node.ipos[0]):
        node.ipos = [0.0, 0.0, 0.0]  # else MuJoCo takes the body's own position
    if body.inertia is not None:
        node.fullinertia = list(body.inertia)
        node.inertia = [0.0, 0.0, 0.0]
        node.iquat = [1.0, 0.0, 0.0, 0.0]
        node.explicitinertial = True


def _add_thruster(
    spec: mujoco.MjSpec, name: str, body: mujoco.MjsBody, thruster: ThrusterSpec
) -> None:
    """Add a site whose x axis is the direction of thrust, and an actuator with a rotor state.

    MuJoCo integrates the state. The gain of the actuator is 0, as the kernel computes the force.
    """
    body.add_site(name=name, pos=list(thruster.position), quat=_quat_to(thruster.direction))
    actuator = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_SITE)
    actuator.gear = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    actuator.gaintype = mujoco.mjtGain.mjGAIN_FIXED
    actuator.gainprm[0] = 0.0
    actuator.biastype = mujoco.mjtBias.mjBIAS_NONE
    actuator.ctrllimited = mujoco.mjtLimited.mjLIMITED_TRUE
    actuator.ctrlrange = list(thruster.limits)
    if thruster.time_constant > 0.0:
        actuator.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
        actuator.dynprm[0] = thruster.time_constant
    actuator.userdata = thruster_row(thruster)


def _add_fin(spec: mujoco.MjSpec, name: str, body: mujoco.MjsBody, fin: FinSpec) -> None:
    """Add a site with the chord along x and the span along z, and an actuator with a fin angle.

    MuJoCo integrates the angle. The kernel sets its rate, and computes the force.
    """
    span = np.array(fin.axis) / math.hypot(*fin.axis)
    normal = np.cross(span, fin.chord)
    normal /= length(normal)
    axes = np.stack([np.cross(normal, span), normal, span], axis=1)
    quat = quaternion_from_rotation(axes).tolist()
    body.add_site(name=name, pos=list(fin.position), quat=quat)
    actuator = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_SITE)
    actuator.gear = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    actuator.gaintype = mujoco.mjtGain.mjGAIN_FIXED
    actuator.gainprm[0] = 0.0
    actuator.biastype = mujoco.mjtBias.mjBIAS_NONE
    actuator.dyntype = mujoco.mjtDyn.mjDYN_INTEGRATOR
    actuator.userdata = fin_row(fin)


def _quat_to(direction: tuple[float, float, float]) -> list[float]:
    """Return a quaternion (wxyz) of a rotation from the x axis to ``direction``."""
    quat = np.zeros(4)
    unit = np.array(direction) / math.hypot(*direction)
    half = np.array([1.0, 0.0, 0.0]) + unit
    if length(half) < 1e-6:
        return [0.0, 0.0, 0.0, 1.0]
    half /= length(half)
    quat[0] = half[0]
    quat[1:] = np.cross([1.0, 0.0, 0.0], half)
    return [float(value) for value in quat]
