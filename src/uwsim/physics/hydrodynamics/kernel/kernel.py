r"""The forces of the water on every body, written into MuJoCo's own matrices.

For a body with added mass :math:`M_A` and damping :math:`D` (body axes, about a point fixed to it),
moving with the twist :math:`\nu` in water that moves with :math:`v_c`, Fossen's equations say

.. math:: f = -M_A\dot\nu_r - C_A(\nu_r)\nu_r - D(\nu_r)\nu_r + B,
          \qquad \nu_r = \nu - [R^T v_c;\, 0]

with :math:`\dot\nu = J\ddot q + \dot J\dot q`. What multiplies :math:`\ddot q` goes into the mass
matrix, the rest into the passive forces:

.. math:: M \mathrel{+}= J^T (M_A + \theta h D') J, \qquad
          \tau \mathrel{+}= J^T\bigl(-M_A(\dot J\dot q - \tfrac{d}{dt}R^T v_c)
          - C_A(\nu_r)\nu_r - D(\nu_r)\nu_r + B\bigr)

:math:`D'` is the derivative of the drag: with :math:`\theta > 0` drag is linearly implicit over a
step. :math:`B = \rho V (a_c - g)` is buoyancy with the pressure gradient of accelerating water. Out
of the water :math:`M_A`, :math:`D` and :math:`B` shrink with the submerged fraction. Where that
grows, the force is less by :math:`\dot M_A\nu_r`, the momentum of the water that is set in motion;
where it shrinks, the water that is shed keeps its own. Inertias and wrenches are summed up the
tree, as in the composite-rigid-body algorithm, in MuJoCo's own frame: at the centre of mass of the
tree, world axes.

After Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), chapters 6 and 8.
The equations of one body are in `equations`; here is where the numbers lie.

Not modelled: memory of waves, ground effect, flow of one body over another.
"""

from __future__ import annotations

import numpy as np

from ....base.numerics.jit import njit
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
    view_int32s,
)
from ..columns import (
    ACTUATOR_COLUMNS,
    BODY_COLUMNS,
    DISPLACED,
    DRY,
    FIN,
    FULL,
    KIND,
    MAGIC,
    MAGIC_NUMBER,
    N_LEVELS,
    PROPELLER,
    REACH,
    ROLE,
    SURFACE,
    THETA,
    WATER_COLUMNS,
)
from . import fields as f
from .equations import (
    add_lift,
    buoyancy,
    coriolis,
    diagonal_force,
    diagonal_momentum,
    entered,
    full_force,
    known_rate,
    move_wrench,
    paces,
    reference_point,
    relative_twist,
    six,
    slopes,
    subtract,
    take_along,
    to_body,
    wet_part,
)
from .fins import add_fin
from .free_bodies import keep_energy
from .inertias import (
    add_diagonal_inertia,
    add_full_inertia,
    diagonal_inertia,
    is_drag_left,
    is_felt,
)
from .stratification import density_ratio
from .thrusters import add_thrust

_WET = 1e-300
"""Marker in the world's composite inertia, which is unused and which MuJoCo clears with every M."""
_GRAVITY_OFF = 128  # mjDSBL_GRAVITY
_DIAGEXACT = 32  # mjENBL_DIAGEXACT
_RK4, _PGS = 1, 0


@njit
def has_tables(m: int, at: Ints64) -> bool:
    """Whether a model carries our tables."""
    if read_int64(m + at[f.NUSER_BODY]) != BODY_COLUMNS:
        return False
    return read_double(read_int64(m + at[f.BODY_USER]) + 8 * MAGIC) == MAGIC_NUMBER


@njit
def needs_projection(m: int, at: Ints64) -> bool:
    """Whether the constraint solver keeps products with the inverse of M that are now stale."""
    return (
        read_int32(m + at[f.SOLVER]) == _PGS
        or read_int32(m + at[f.NOSLIP]) > 0
        or (read_int32(m + at[f.ENABLE]) & _DIAGEXACT) != 0
    )


@njit
def has_water(d: int, at: Ints64) -> bool:
    """Whether ``d.M`` has had its water since MuJoCo made it; if so it must be made anew."""
    return read_double(read_int64(d + at[f.CRB])) == _WET


@njit
def add_water(m: int, d: int, at: Ints64) -> None:
    """Add the water to ``d.M`` and ``d.qfrc_passive``; both must be as MuJoCo made them."""
    nv, nbody = read_int64(m + at[f.NV]), read_int64(m + at[f.NBODY])
    work = np.zeros(f.ROW * nbody + f.SCRATCH + f.DRAG * read_int64(m + at[f.NTREE]))
    step = read_double(m + at[f.TIMESTEP])
    if read_int32(m + at[f.INTEGRATOR]) == _RK4:
        step = 0.0
    view_doubles(read_int64(d + at[f.CRB]), 1)[0] = _WET
    _bias(m, d, at, work)
    _bodies(m, d, at, step, work, True)
    _actuators(m, d, at, work, 0.5 * step)
    _sum_up(m, at, work)
    cdof = view_doubles(read_int64(d + at[f.CDOF]), 6 * nv)
    dof_body = view_int32s(read_int64(m + at[f.DOF_BODY]), nv)
    length = view_int32s(read_int64(m + at[f.ROW_LENGTH]), nv)
    start = view_int32s(read_int64(m + at[f.ROW_START]), nv)
    passive = view_doubles(read_int64(d + at[f.PASSIVE]), nv)
    n_entries = start[nv - 1] + length[nv - 1] if nv > 0 else 0
    column = view_int32s(read_int64(m + at[f.COLUMN]), n_entries)
    mass = view_doubles(read_int64(d + at[f.M]), n_entries)
    for k in range(nv):
        base = f.ROW * dof_body[k]
        if work[base + f.TOUCHED] == 0.0:
            continue
        wx, wy, wz = cdof[6 * k], cdof[6 * k + 1], cdof[6 * k + 2]
        vx, vy, vz = cdof[6 * k + 3], cdof[6 * k + 4], cdof[6 * k + 5]
        to = base + f.WRENCH
        passive[k] += (
            wx * work[to] + wy * work[to + 1] + wz * work[to + 2]
            + vx * work[to + 3] + vy * work[to + 4] + vz * work[to + 5]
        )  # fmt: skip
        ff, ft, tt = base + f.FF, base + f.FT, base + f.TT
        fx = work[ff] * vx + work[ff + 1] * vy + work[ff + 2] * vz
        fy = work[ff + 1] * vx + work[ff + 3] * vy + work[ff + 4] * vz
        fz = work[ff + 2] * vx + work[ff + 4] * vy + work[ff + 5] * vz
        fx += work[ft] * wx + work[ft + 1] * wy + work[ft + 2] * wz
        fy += work[ft + 3] * wx + work[ft + 4] * wy + work[ft + 5] * wz
        fz += work[ft + 6] * wx + work[ft + 7] * wy + work[ft + 8] * wz
        tx = work[tt] * wx + work[tt + 1] * wy + work[tt + 2] * wz
        ty = work[tt + 1] * wx + work[tt + 3] * wy + work[tt + 4] * wz
        tz = work[tt + 2] * wx + work[tt + 4] * wy + work[tt + 5] * wz
        tx += work[ft] * vx + work[ft + 3] * vy + work[ft + 6] * vz
        ty += work[ft + 1] * vx + work[ft + 4] * vy + work[ft + 7] * vz
        tz += work[ft + 2] * vx + work[ft + 5] * vy + work[ft + 8] * vz
        for entry in range(start[k], start[k] + length[k]):
            j = 6 * column[entry]
            mass[entry] += (
                cdof[j] * tx + cdof[j + 1] * ty + cdof[j + 2] * tz
                + cdof[j + 3] * fx + cdof[j + 4] * fy + cdof[j + 5] * fz
            )  # fmt: skip
    if read_int32(m + at[f.INTEGRATOR]) != _RK4:
        keep_energy(m, d, at, work)


@njit
def water_wrenches(m: int, d: int, at: Ints64, wrenches: Floats) -> None:
    """Wrench of the water and the thrusters on the subtree of every body.

    Needs ``cacc``, as a step with force sensors (or ``mj_rnePostConstraint``) leaves it.

    Args:
        m: address of the model.
        d: address of the data.
        at: offsets of the fields.
        wrenches: (nbody, 6), receives torque [N m] and force [N] of each subtree in world axes,
            about the centre of mass of its tree.
    """
    nbody = read_int64(m + at[f.NBODY])
    work = np.zeros(f.ROW * nbody + f.SCRATCH + f.DRAG * read_int64(m + at[f.NTREE]))
    cacc = view_doubles(read_int64(d + at[f.CACC]), 6 * nbody)
    gravity = view_doubles(m + at[f.GRAVITY], 3)
    for body in range(1, nbody):
        for i in range(6):
            work[f.ROW * body + f.BIAS + i] = cacc[6 * body + i]
        if (read_int32(m + at[f.DISABLE]) & _GRAVITY_OFF) == 0:
            for i in range(3):
                work[f.ROW * body + f.BIAS + 3 + i] += gravity[i]
    _bodies(m, d, at, 0.0, work, False)
    _actuators(m, d, at, work, 0.5 * read_double(m + at[f.TIMESTEP]))
    _sum_up(m, at, work)
    for body in range(nbody):
        for i in range(6):
            wrenches[body, i] = work[f.ROW * body + f.WRENCH + i]


@njit
def _bias(m: int, d: int, at: Ints64, work: Floats) -> None:
    """Spatial acceleration of every body when no joint accelerates: Jdot qvel."""
    nv, nbody = read_int64(m + at[f.NV]), read_int64(m + at[f.NBODY])
    parent = view_int32s(read_int64(m + at[f.BODY_PARENT]), nbody)
    dof_number = view_int32s(read_int64(m + at[f.BODY_DOFNUM]), nbody)
    dof_start = view_int32s(read_int64(m + at[f.BODY_DOFADR]), nbody)
    cdof_dot = view_doubles(read_int64(d + at[f.CDOF_DOT]), 6 * nv)
    qvel = view_doubles(read_int64(d + at[f.QVEL]), nv)
    for body in range(1, nbody):
        base, above = f.ROW * body + f.BIAS, f.ROW * parent[body] + f.BIAS
        for i in range(6):
            work[base + i] = work[above + i]
        for k in range(dof_start[body], dof_start[body] + dof_number[body]):
            for i in range(6):
                work[base + i] += cdof_dot[6 * k + i] * qvel[k]


@njit
def _sum_up(m: int, at: Ints64, work: Floats) -> None:
    """Add every body's wrench and inertia to its parent's."""
    nbody = read_int64(m + at[f.NBODY])
    parent = view_int32s(read_int64(m + at[f.BODY_PARENT]), nbody)
    for body in range(nbody - 1, 0, -1):
        base, above = f.ROW * body, f.ROW * parent[body]
        if work[base + f.TOUCHED] != 0.0 and above > 0:
            for i in range(f.WRENCH, f.TOUCHED):
                work[above + i] += work[base + i]
            work[above + f.TOUCHED] = 1.0


@njit
def _actuators(m: int, d: int, at: Ints64, work: Floats, ahead: float) -> None:
    """Add the forces of all thrusters and fins, by their state some time ahead."""
    if read_int64(m + at[f.NUSER_ACTUATOR]) != ACTUATOR_COLUMNS:
        return
    tables = read_int64(m + at[f.ACTUATOR_USER])
    for i in range(read_int64(m + at[f.NACTUATOR])):
        table = view_doubles(tables + 8 * ACTUATOR_COLUMNS * i, ACTUATOR_COLUMNS)
        if table[ROLE] == PROPELLER:
            add_thrust(m, d, at, i, table, ahead, work)
        elif table[ROLE] == FIN:
            add_fin(m, d, at, i, table, ahead, work)


@njit
def _bodies(m: int, d: int, at: Ints64, theta_h: float, work: Floats, with_mass: bool) -> None:
    """Wrench of the water on every body, and its inertia when ``with_mass``."""
    nbody = read_int64(m + at[f.NBODY])
    tree = view_int32s(read_int64(m + at[f.BODY_TREE]), nbody)
    root = view_int32s(read_int64(m + at[f.BODY_ROOT]), nbody)
    still = read_double(read_int64(m + at[f.BODY_USER]) + 8 * SURFACE)
    gravity = view_doubles(m + at[f.GRAVITY], 3)
    weight = 0.0 if (read_int32(m + at[f.DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    is_stratified = read_double(read_int64(m + at[f.BODY_USER]) + 8 * N_LEVELS) > 0.0
    scratch = f.ROW * nbody
    for body in range(1, nbody):
        table = view_doubles(
            read_int64(m + at[f.BODY_USER]) + 8 * BODY_COLUMNS * body, BODY_COLUMNS
        )
        if table[KIND] == DRY or tree[body] < 0:
            continue
        if read_int32(read_int64(d + at[f.AWAKE]) + 4 * tree[body]) == 0:
            continue
        water = view_doubles(
            read_int64(d + at[f.USERDATA]) + 8 * WATER_COLUMNS * body, WATER_COLUMNS
        )
        place = view_doubles(read_int64(d + at[f.XPOS]) + 24 * body, 3)
        axes = view_doubles(read_int64(d + at[f.XMAT]) + 72 * body, 9)
        com = view_doubles(read_int64(d + at[f.COM]) + 24 * root[body], 3)
        twist = view_doubles(read_int64(d + at[f.CVEL]) + 48 * body, 6)
        height, lever = reference_point(table, place, axes, com)
        up, depth = (axes[6], axes[7], axes[8]), still + water[6] - height
        wet, centre = wet_part(table, up, depth)
        if wet <= 0.0:
            continue
        nu = relative_twist(axes, lever, twist, water)
        growth = 0.0
        x, y, z = centre
        if depth - (up[0] * x + up[1] * y + up[2] * z) < 2.0 * table[REACH]:
            timestep = read_double(m + at[f.TIMESTEP])
            growth = entered(table, up, depth, wet, nu, timestep) / timestep
        if is_stratified:
            centre_height = height + axes[6] * x + axes[7] * y + axes[8] * z
            wet *= density_ratio(m, at, centre_height)
        base = f.ROW * body
        work[base + f.TOUCHED] = 1.0
        step = theta_h * table[THETA]
        bias = six(work, base + f.BIAS)
        omega = to_body(axes, twist[0], twist[1], twist[2])
        rate = known_rate(axes, lever, bias, water, omega)
        pace = paces(table, nu)
        slope = slopes(table, nu, pace)
        if table[KIND] == FULL:
            force, momentum = full_force(table, nu, rate, step, work, scratch)
        else:
            force = diagonal_force(table, nu, rate, pace, slope, step)
            momentum = diagonal_momentum(table, nu)
        force = subtract(force, coriolis(nu, omega, momentum))
        if growth > 0.0:
            force = take_along(force, momentum, growth)
        wrench = move_wrench(axes, lever, wet, force)
        lift = buoyancy(wet * table[DISPLACED], water, gravity, weight)
        to = base + f.WRENCH
        add_lift(axes, lever, centre, wrench, lift, work, to)
        if not with_mass:
            continue
        impulse = move_wrench(axes, lever, wet, momentum)
        for i in range(6):
            work[base + f.MOMENTUM + i] = impulse[i]
        to, drag = base + f.FF, scratch + f.SCRATCH + f.DRAG * tree[body]
        if table[KIND] == FULL:
            add_full_inertia(axes, lever, wet, work, scratch, to)
            if is_drag_left(table, work, scratch):
                add_full_inertia(axes, lever, wet, work, scratch, drag)
        else:
            inertia, change = diagonal_inertia(table, slope, wet, step)
            add_diagonal_inertia(axes, lever, inertia, work, to)
            if is_felt(inertia, change):
                add_diagonal_inertia(axes, lever, change, work, drag)
