r"""A step of one free vehicle in water, on plain arrays: no engine, no contacts.

A vehicle is one free body whose links do not move relative to each other, with any number of links
in the water, thrusters and fins. A step is that of the engine with `kernel` and `free_bodies`: the
same functions of `links`, `flow`, `thrusters`, `fins` and `midpoint` in the same order, for
one row of numbers in place of MuJoCo's memory. It takes well below a microsecond on one core, for
fits and batches that need millions of steps. Nothing is allocated in a step.

The equations are in `kernel`, and the rule of the step in `midpoint`: the body moves by half a step
with its velocity, forces and the implicit midpoint rule for Coriolis terms give the new velocity,
and the body moves by the other half.

Not modelled: contacts, moving joints.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats, Ints64
from .. import columns as c
from . import fields as f
from .equations import Three, read_six, to_body, to_world
from .fins import foil_force, servo_speed
from .flow import SiteFlow, flow_velocity, submerged_share
from .free_motion import (
    add_rigid_body,
    convert_rate,
    fill_inertia,
    fill_motion,
    rotate_attitude,
    rotate_velocity,
)
from .links import LinkMotion, StepNumbers, add_link
from .midpoint import NUMBERS, RATE, solve_rate
from .stratification import density_at_height
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
_SITE = _CRB + 10
_B = _SITE + 12
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
    world: Floats
    """The row of the world: the surface, and layers of stratified water (`columns`), (160,)."""
    actuator_links: Ints64
    """The index of the link that each actuator is on; -1: a link that is not in the water, (k,)."""
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
        water: the water in W in the middle of the step at each link, then at the base (`columns`),
            (n + 1, 12).
        h: the length of the step [s].
        work: scratch memory, (`WORK`,).
    """
    q, v = state[:7], state[VELOCITY:ACTUATORS]
    b, root_water = work[_B:], water[len(vehicle.bodies)]
    for i in range(3):
        q[i] += 0.5 * h * v[i]
    rotate_velocity(v, q, root_water, 0.5 * h, 0.5 * h)
    rotate_attitude(q, v, 0.5 * h)
    for i in range(_AXES):
        work[i] = 0.0
    axes, com, twist = work[_AXES:_PART_AXES], work[_COM:_ORIGIN], work[_TWIST:_CRB]
    write_axes(q, axes)
    for i in range(3):
        work[_ORIGIN + i] = q[i]
    lever = _place_body(vehicle.rigid_body, q, v, axes, com, twist)
    crb = work[_CRB:_SITE]
    _rotate_rigid(vehicle.rigid_body, axes, crb)
    # the spatial acceleration of the free joint without accelerations, as MuJoCo's cdof_dot qvel
    bias_x = v[1] * twist[2] - v[2] * twist[1]
    bias_y = v[2] * twist[0] - v[0] * twist[2]
    bias_z = v[0] * twist[1] - v[1] * twist[0]
    bias = (0.0, 0.0, 0.0, bias_x, bias_y, bias_z)
    numbers = StepNumbers(vehicle.world, vehicle.gravity, 1.0, h, h, True)
    for part in range(len(vehicle.bodies)):
        _place_part(vehicle.poses[part], q, axes, work)
        link = LinkMotion(
            vehicle.bodies[part],
            work[_PART_POSITION:_COM],
            work[_PART_AXES:_PART_POSITION],
            com,
            twist,
            water[part],
        )
        _, impulse = add_link(link, numbers, bias, work, 0, _SCRATCH, _DRAG)
        for i in range(6):
            work[f.MOMENTUM + i] += impulse[i]
    _add_actuators(vehicle, rotors, state, commands, water, h, work)
    fill_inertia(crb, work, f.FF, _DRAG, b)
    fill_motion(twist, root_water, lever, work, 0, b)
    known_rate = (b[RATE + 3], b[RATE + 4], b[RATE + 5])  # the rate without accelerations
    gravity = (vehicle.gravity[0], vehicle.gravity[1], vehicle.gravity[2])
    speed = (root_water[0], root_water[1], root_water[2])
    turn = (twist[0], twist[1], twist[2], twist[3], twist[4], twist[5])
    add_rigid_body(crb, turn, bias, gravity, speed, b)
    solve_rate(b, h)
    convert_rate(lever, h, b)
    for i in range(3):
        b[RATE + 3 + i] -= known_rate[i]
    _apply_rate(lever, axes, h, b, v)
    rotate_velocity(v, q, root_water, -0.5 * h, -h)
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
    limits, rigid_body, surface = vehicle.limits, vehicle.rigid_body, vehicle.world[c.SURFACE]
    for i in range(len(vehicle.actuators)):
        table, pose, link = vehicle.actuators[i], vehicle.sites[i], vehicle.actuator_links[i]
        row = link if link >= 0 else len(vehicle.bodies)
        height, level = _site_height(pose, work), surface + water[row, c.ELEVATION]
        x, y, twisting = 0.0, 0.0, 0.0
        if table[c.ROLE] == c.PROPELLER:
            command = min(max(commands[i], limits[i, 0]), limits[i, 1])
            rotor = state[ACTUATORS + i]
            rotor += rotors[i, HALF_STEP_SHARE] * (command - rotor)
            x, twisting = (1.0 - rotors[i, LOSS]) * static_thrust(table, rotor), table[c.TORQUE]
            if table[c.N_ADVANCE] > 0.0:
                inflow = _site_velocity(vehicle, i, water, work)[0]
                x *= 1.0 - inflow_loss(table, x, inflow, vehicle.density)
            x *= submerged_share(level, height, table[c.RADIUS])
        else:
            fraction = submerged_share(level, height, 0.5 * math.sqrt(table[c.AREA]))
            if fraction > 0.0:
                speed = servo_speed(table, state[ACTUATORS + i], commands[i], h, False)
                angle = state[ACTUATORS + i] + 0.5 * h * speed
                u, v, _ = _site_velocity(vehicle, i, water, work)
                density = vehicle.density * density_at_height(vehicle.world, height)
                x, y = foil_force(table, angle, u, v, fraction * density)
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
def _site_height(pose: Floats, work: Floats) -> float:
    """Return the height of a site in W [m]."""
    k = _AXES + 6
    rise = work[k] * pose[0] + work[k + 1] * pose[1] + work[k + 2] * pose[2]
    height: float = work[_ORIGIN + 2] + rise
    return height


@njit_borrowed
def _site_velocity(vehicle: FreeVehicle, i: int, water: Floats, work: Floats) -> Three:
    """Return the velocity of a site through the water in site axes [m/s]."""
    link, row = vehicle.actuator_links[i], len(vehicle.bodies)
    origin, body_axes = work[_ORIGIN:_TWIST], work[_AXES:_PART_AXES]
    table = vehicle.world
    if link >= 0:
        row, table = link, vehicle.bodies[link]
        _place_part(vehicle.poses[link], origin, body_axes, work)
        for k in range(12):
            work[_SITE + k] = work[_PART_AXES + k]
        body_axes, origin = work[_SITE : _SITE + 9], work[_SITE + 9 : _SITE + 12]
    _place_part(vehicle.sites[i], work[_ORIGIN:_TWIST], work[_AXES:_PART_AXES], work)
    flow = SiteFlow(
        work[_PART_POSITION:_COM],
        work[_PART_AXES:_PART_POSITION],
        work[_COM:_ORIGIN],
        work[_TWIST:_CRB],
        water[row],
        table,
        origin,
        body_axes,
    )
    return flow_velocity(flow)


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
