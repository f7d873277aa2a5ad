r"""A step of one free vehicle in deep water, on plain arrays: no engine, no contacts.

A vehicle is one free body whose links do not move relative to each other, with any number of links
in the water, thrusters and fins. A step is that of the engine with `kernel` and `free_bodies`: the
same functions of `equations`, `inertias`, `thrusters`, `fins` and `midpoint` in the same order, for
one row of numbers in place of MuJoCo's memory. It takes well below a microsecond on one core, for
fits and batches that need millions of steps. Nothing is allocated in a step.

The equations are in `kernel`, and the rule of the step in `midpoint`: the body moves by half a step
with its velocity, forces and the implicit midpoint rule for Coriolis terms give the new velocity,
and the body moves by the other half.

Not modelled: the surface, stratified water, contacts, moving joints, water that rotates.
"""

from __future__ import annotations

from typing import NamedTuple

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from .. import columns as c
from . import fields as f
from .equations import (
    Six,
    Three,
    add_wrench,
    bias_acceleration,
    buoyancy,
    coriolis,
    diagonal_force,
    diagonal_momentum,
    drag_slopes,
    drag_speeds,
    full_force,
    move_wrench,
    read_six,
    reference_point,
    relative_twist,
    subtract,
    to_body,
    to_world,
)
from .fins import foil_force, servo_speed
from .free_motion import (
    add_rigid_body,
    convert_rate,
    fill_inertia,
    fill_motion,
    rotate_attitude,
    rotate_velocity,
)
from .inertias import (
    add_diagonal_inertia,
    add_full_inertia,
    diagonal_inertia,
    is_significant,
    subtract_added_mass,
)
from .midpoint import NUMBERS, RATE, solve_rate
from .thrusters import inflow_loss, lag_share, static_thrust

POSITION, QUATERNION, VELOCITY, ANGULAR_VELOCITY, ACTUATORS = 0, 3, 7, 10, 13
"""The columns of a row of the state: the position of the base in W [m], its attitude (wxyz), its
velocity in W [m/s], its angular velocity in base axes [rad/s], then the state of each actuator: the
command that its rotor has actuator_state [1], or the angle of a fin [rad]."""
RIGID_BODY = 10
"""The length of a row of `FreeVehicle.rigid_body`."""
POSE = 12
"""The length of a pose: the position [m], and the rotation (3, 3) by rows."""
HALF_STEP_SHARE, STEP_SHARE, LOSS, ROTOR = 0, 1, 2, 3
"""The columns of a row for a thruster: the fractions of a step input that its rotor reaches in half
a step and in a step, the loss of thrust from 0 (healthy) to 1 (dead); and the length of the row."""

_SCRATCH = f.ROW
_DRAG = _SCRATCH + f.SCRATCH
_AXES = _DRAG + f.DRAG
_PART_AXES = _AXES + 9
_PART_POSITION = _PART_AXES + 9
_COM = _PART_POSITION + 3
_ORIGIN = _COM + 3
_TWIST = _ORIGIN + 3
_CRB = _TWIST + 6
_B = _CRB + 10
WORK = _B + NUMBERS
"""The length of the scratch memory of a step."""


class FreeVehicle(NamedTuple):
    """The numbers of a vehicle that a step reads."""

    rigid_body: Floats
    """The mass [kg], the centre of mass in the base (3) [m], and the moments of inertia about it in
    base axes (xx yy zz xy xz yz) [kg m2], (`RIGID_BODY`,)."""
    bodies: Floats
    """The rows of the links in the water (`columns`), (n, 160)."""
    poses: Floats
    """The poses of these links in the base, (n, `POSE`)."""
    actuators: Floats
    """The rows of thrusters and fins (`columns`), (k, 68)."""
    sites: Floats
    """The poses of their sites in the base, (k, `POSE`)."""
    limits: Floats
    """The minimum and maximum command of each thruster, (k, 2)."""
    gravity: Floats
    """The acceleration of gravity in W, (3,) [m/s2]."""
    density: float
    """The density of the water [kg/m3]."""


@njit_borrowed
def fill_rotors(vehicle: FreeVehicle, h: float, rotors: Floats) -> None:
    """Compute the fractions of a step input that the lag of each rotor reaches, once for a run.

    Args:
        vehicle: the numbers of the vehicle.
        h: the length of a step [s].
        rotors: receives the fractions in its first columns, (k, `ROTOR`).
    """
    for i in range(len(vehicle.actuators)):
        lag = vehicle.actuators[i, c.LAG]
        rotors[i, HALF_STEP_SHARE], rotors[i, STEP_SHARE] = (
            lag_share(lag, 0.5 * h),
            lag_share(lag, h),
        )


@njit_borrowed
def step_one(
    vehicle: FreeVehicle,
    rotors: Floats,
    state: Floats,
    commands: Floats,
    water: Floats,
    h: float,
    work: Floats,
) -> None:
    """Advance one vehicle by a step.

    Args:
        vehicle: the numbers of the vehicle.
        rotors: the numbers of `fill_rotors`, and the losses of the thrusters, (k, `ROTOR`).
        state: the row of the state, (`ACTUATORS` + k,), which is changed.
        commands: the commands of the thrusters [1] and fins [rad], (k,).
        water: the row of the water in W in the middle of the step (`columns`), (12,).
        h: the length of the step [s].
        work: scratch memory, (`WORK`,).
    """
    q, v = state[:7], state[VELOCITY:ACTUATORS]
    b = work[_B:]
    for i in range(3):
        q[i] += 0.5 * h * v[i]
    rotate_velocity(v, q, water, 0.5 * h, 0.5 * h)
    rotate_attitude(q, v, 0.5 * h)
    for i in range(_AXES):
        work[i] = 0.0
    axes, com, twist = work[_AXES:_PART_AXES], work[_COM:_ORIGIN], work[_TWIST:_CRB]
    write_axes(q, axes)
    for i in range(3):
        work[_ORIGIN + i] = q[i]
    lever = _place_body(vehicle.rigid_body, q, v, axes, com, twist)
    crb = work[_CRB:_B]
    _rotate_rigid(vehicle.rigid_body, axes, crb)
    # the spatial acceleration of the free joint without accelerations, as MuJoCo's cdof_dot qvel
    bias_x = v[1] * twist[2] - v[2] * twist[1]
    bias_y = v[2] * twist[0] - v[0] * twist[2]
    bias_z = v[0] * twist[1] - v[1] * twist[0]
    bias = (0.0, 0.0, 0.0, bias_x, bias_y, bias_z)
    bodies, poses, weight = vehicle.bodies, vehicle.poses, vehicle.gravity
    for part in range(len(bodies)):
        _place_part(poses[part], q, axes, work)
        _add_part(bodies[part], weight, bias, water, h, work)
    _add_actuators(vehicle, rotors, state, commands, water, h, work)
    fill_inertia(crb, work, f.FF, _DRAG, b)
    fill_motion(twist, water, lever, work, 0, b)
    known_rate = (b[RATE + 3], b[RATE + 4], b[RATE + 5])  # the rate without accelerations
    gravity = (vehicle.gravity[0], vehicle.gravity[1], vehicle.gravity[2])
    turn = (twist[0], twist[1], twist[2], twist[3], twist[4], twist[5])
    add_rigid_body(crb, turn, bias, gravity, (water[0], water[1], water[2]), b)
    solve_rate(b, h)
    convert_rate(lever, h, b)
    for i in range(3):
        b[RATE + 3 + i] -= known_rate[i]
    _apply_rate(lever, axes, h, b, v)
    rotate_velocity(v, q, water, -0.5 * h, -h)
    for i in range(3):
        q[i] += 0.5 * h * v[i]
    rotate_attitude(q, v, 0.5 * h)
    advance_actuators(vehicle, rotors, state, commands, h)


@njit_borrowed
def advance_actuators(
    vehicle: FreeVehicle, rotors: Floats, state: Floats, commands: Floats, h: float
) -> None:
    """Advance the rotors and fins of a vehicle alone by a step; see `step_one`."""
    actuators, limits = vehicle.actuators, vehicle.limits
    for i in range(len(actuators)):
        table, k = actuators[i], ACTUATORS + i
        if table[c.ROLE] == c.PROPELLER:
            command = min(max(commands[i], limits[i, 0]), limits[i, 1])
            state[k] += rotors[i, STEP_SHARE] * (command - state[k])
        else:
            state[k] += h * servo_speed(table, state[k], commands[i], h, False)


@njit_borrowed
def write_axes(q: Floats, axes: Floats) -> None:
    """Write the rotation (9,) of the attitude of a row."""
    w, x, y, z = q[3], q[4], q[5], q[6]
    axes[0], axes[4], axes[8] = (
        w * w + x * x - y * y - z * z,
        w * w - x * x + y * y - z * z,
        w * w - x * x - y * y + z * z,
    )
    axes[1], axes[2] = 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)
    axes[3], axes[5] = 2.0 * (x * y + w * z), 2.0 * (y * z - w * x)
    axes[6], axes[7] = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x)


@njit_borrowed
def _place_body(
    rigid_body: Floats, q: Floats, v: Floats, axes: Floats, com: Floats, twist: Floats
) -> Three:
    """Compute the centre of mass, the spatial velocity about it, the inertia, and the lever."""
    x, y, z = to_world(axes, rigid_body[1], rigid_body[2], rigid_body[3])
    com[0], com[1], com[2] = q[0] + x, q[1] + y, q[2] + z
    wx, wy, wz = to_world(axes, v[3], v[4], v[5])
    twist[0], twist[1], twist[2] = wx, wy, wz
    twist[3] = v[0] + wy * z - wz * y
    twist[4] = v[1] + wz * x - wx * z
    twist[5] = v[2] + wx * y - wy * x
    return (-x, -y, -z)


@njit_borrowed
def _place_part(pose: Floats, q: Floats, axes: Floats, work: Floats) -> None:
    """Compute the position and the axes of a link or a site in the world."""
    x, y, z = to_world(axes, pose[0], pose[1], pose[2])
    k = _PART_POSITION
    work[k], work[k + 1], work[k + 2] = q[0] + x, q[1] + y, q[2] + z
    for i in range(3):
        for j in range(3):
            work[_PART_AXES + 3 * i + j] = (
                axes[3 * i] * pose[3 + j]
                + axes[3 * i + 1] * pose[6 + j]
                + axes[3 * i + 2] * pose[9 + j]
            )


@njit_borrowed
def _rotate_rigid(rigid_body: Floats, axes: Floats, crb: Floats) -> None:
    """Write the row of the rigid body in world axes about its centre of mass."""
    xx, yy, zz, xy, xz, yz = read_six(rigid_body, 4)
    for i in range(3):
        crb[6 + i] = 0.0
    crb[9] = rigid_body[0]
    for k, i, j in ((0, 0, 0), (1, 1, 1), (2, 2, 2), (3, 0, 1), (4, 0, 2), (5, 1, 2)):
        a, b, d = axes[3 * i], axes[3 * i + 1], axes[3 * i + 2]
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        crb[k] = (
            a * (xx * x + xy * y + xz * z)
            + b * (xy * x + yy * y + yz * z)
            + d * (xz * x + yz * y + zz * z)
        )


@njit_borrowed
def _add_part(
    table: Floats, gravity: Floats, bias: Six, water: Floats, h: float, work: Floats
) -> None:
    """Add the wrench, the momentum and the inertia of the water at a link, as `kernel` does."""
    axes, com = work[_PART_AXES:_PART_POSITION], work[_COM:_ORIGIN]
    position, twist = work[_PART_POSITION:_COM], work[_TWIST:_CRB]
    _, lever = reference_point(table, position, axes, com)
    nu = relative_twist(axes, lever, twist, water)
    step = h * table[c.DRAG_IMPLICITNESS]
    omega = to_body(axes, twist[0], twist[1], twist[2])
    rate = bias_acceleration(axes, lever, bias, water, omega)
    s = drag_speeds(table, nu)
    slope = drag_slopes(table, nu, s)
    if table[c.KIND] == c.FULL_MATRICES:
        force, momentum = full_force(table, nu, rate, step, work, _SCRATCH)
    else:
        force = diagonal_force(table, nu, rate, s, slope, step)
        momentum = diagonal_momentum(table, nu)
    force = subtract(force, coriolis(nu, omega, momentum))
    wrench = move_wrench(axes, lever, 1.0, force)
    lift = buoyancy(table[c.DISPLACED_MASS], water, gravity, 1.0)
    centre = (table[c.CENTRE], table[c.CENTRE + 1], table[c.CENTRE + 2])
    add_wrench(axes, lever, centre, wrench, lift, work, f.WRENCH)
    impulse = move_wrench(axes, lever, 1.0, momentum)
    for i in range(6):
        work[f.MOMENTUM + i] += impulse[i]
    if table[c.KIND] == c.FULL_MATRICES:
        add_full_inertia(axes, lever, 1.0, work, _SCRATCH, f.FF)
        if subtract_added_mass(table, work, _SCRATCH):
            add_full_inertia(axes, lever, 1.0, work, _SCRATCH, _DRAG)
    else:
        inertia, change = diagonal_inertia(table, slope, 1.0, step)
        add_diagonal_inertia(axes, lever, inertia, work, f.FF)
        if is_significant(inertia, change):
            add_diagonal_inertia(axes, lever, change, work, _DRAG)


@njit_borrowed
def _add_actuators(
    vehicle: FreeVehicle,
    rotors: Floats,
    state: Floats,
    commands: Floats,
    water: Floats,
    h: float,
    work: Floats,
) -> None:
    """Add the forces of thrusters and fins in the middle of the step, as `kernel` does.

    They are summed in base axes about the centre of mass.
    """
    fx, fy, fz, tx, ty, tz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    actuators, sites, limits = vehicle.actuators, vehicle.sites, vehicle.limits
    rigid_body, density = vehicle.rigid_body, vehicle.density
    for i in range(len(actuators)):
        table, pose, actuator_state = actuators[i], sites[i], state[ACTUATORS + i]
        twisting = 0.0
        if table[c.ROLE] == c.PROPELLER:
            command = min(max(commands[i], limits[i, 0]), limits[i, 1])
            rotor = actuator_state + rotors[i, HALF_STEP_SHARE] * (command - actuator_state)
            health = 1.0 - rotors[i, LOSS]
            x = _thrust(table, pose, health * static_thrust(table, rotor), density, water, work)
            y, twisting = 0.0, table[c.TORQUE]
        else:
            speed = servo_speed(table, actuator_state, commands[i], h, False)
            u, v = _site_velocity(pose, water, work)
            x, y = foil_force(table, actuator_state + 0.5 * h * speed, u, v, density)
        ex, ey, ez = (
            pose[3] * x + pose[4] * y,
            pose[6] * x + pose[7] * y,
            pose[9] * x + pose[10] * y,
        )
        rx, ry, rz = pose[0] - rigid_body[1], pose[1] - rigid_body[2], pose[2] - rigid_body[3]
        fx, fy, fz = fx + ex, fy + ey, fz + ez
        tx += ry * ez - rz * ey + twisting * ex
        ty += rz * ex - rx * ez + twisting * ey
        tz += rx * ey - ry * ex + twisting * ez
    axes = work[_AXES:_PART_AXES]
    force, torque = to_world(axes, fx, fy, fz), to_world(axes, tx, ty, tz)
    for i in range(3):
        work[f.WRENCH + i] += torque[i]
        work[f.WRENCH + 3 + i] += force[i]


@njit_borrowed
def _thrust(
    table: Floats, pose: Floats, thrust: float, density: float, water: Floats, work: Floats
) -> float:
    """Return the thrust of a thruster with a static thrust, less what the inflow takes [N]."""
    if table[c.N_ADVANCE] > 0.0:
        speed = _site_velocity(pose, water, work)[0]
        thrust *= 1.0 - inflow_loss(table, thrust, speed, density)
    return thrust


@njit_borrowed
def _site_velocity(pose: Floats, water: Floats, work: Floats) -> tuple[float, float]:
    """Return the velocity of a site through the water along its x and y axes [m/s]."""
    _place_part(pose, work[_ORIGIN:_TWIST], work[_AXES:_PART_AXES], work)
    axes, com = work[_PART_AXES:_PART_POSITION], work[_COM:_ORIGIN]
    lever = (
        work[_PART_POSITION] - com[0],
        work[_PART_POSITION + 1] - com[1],
        work[_PART_POSITION + 2] - com[2],
    )
    flow = relative_twist(axes, lever, work[_TWIST:_CRB], water)
    return flow[0], flow[1]


@njit_borrowed
def _apply_rate(lever: Three, axes: Floats, h: float, b: Floats, v: Floats) -> None:
    """Add the solved rate to the velocity of the base, which is not at the centre of mass."""
    rx, ry, rz = lever
    x, y, z = b[RATE], b[RATE + 1], b[RATE + 2]
    v[0] += h * (b[RATE + 3] + y * rz - z * ry)
    v[1] += h * (b[RATE + 4] + z * rx - x * rz)
    v[2] += h * (b[RATE + 5] + x * ry - y * rx)
    p, q, r = to_body(axes, x, y, z)
    v[3] += h * p
    v[4] += h * q
    v[5] += h * r
