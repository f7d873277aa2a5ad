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
of the water :math:`M_A`, :math:`D` and :math:`B` shrink with the submerged fraction. Inertias and
wrenches are summed up the tree, as in the composite-rigid-body algorithm, in MuJoCo's own frame: at
the centre of mass of the tree, world axes.

After Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), chapters 6 and 8.
The equations of one body are in `equations`; here is where the numbers lie. numba's cache on disk
watches only the file of the function that it compiled, so that this file must change with those
that it compiles in: `COMPILED_IN` is their digest, and a test says what it should be.

Not modelled: the momentum of water shed when the submerged fraction changes, memory of waves,
ground effect, flow of one body over another, thrust lost to inflow.
"""

from __future__ import annotations

import numpy as np

from ...jit import njit
from .columns import (
    BACKWARD,
    BODY_COLUMNS,
    CURVE_TERMS,
    DEAD_ZONE,
    DISPLACED,
    DRY,
    FORWARD,
    FULL,
    IS_THRUSTER,
    KIND,
    LEAST,
    MAGIC,
    MAGIC_NUMBER,
    MOST,
    RADIUS,
    SURFACE,
    THETA,
    THRUSTER_COLUMNS,
    TORQUE,
    WATER_COLUMNS,
)  # fmt: skip
from .equations import (
    add_lift,
    buoyancy,
    coriolis,
    diagonal_force,
    diagonal_inertia,
    diagonal_momentum,
    full_force,
    known_rate,
    move_diagonal_inertia,
    move_full_inertia,
    move_wrench,
    reference_point,
    relative_twist,
    six,
    subtract,
    wet_part,
)
from .layout import DATA_FIELDS, MODEL_FIELDS
from .memory import Floats, Ints64, floats, ints, real, small, word

COMPILED_IN = "56c9aecefb89bbd9"
"""Digest of `columns`, `equations`, `layout`, `memory` and `submersion`."""

_NAMES = (*MODEL_FIELDS, *DATA_FIELDS)
_TIMESTEP = _NAMES.index("opt.timestep")
_GRAVITY = _NAMES.index("opt.gravity")
_INTEGRATOR = _NAMES.index("opt.integrator")
_SOLVER = _NAMES.index("opt.solver")
_NOSLIP = _NAMES.index("opt.noslip_iterations")
_DISABLE = _NAMES.index("opt.disableflags")
_ENABLE = _NAMES.index("opt.enableflags")
_NV = _NAMES.index("nv")
_NBODY = _NAMES.index("nbody")
_NACTUATOR = _NAMES.index("nactuator")
_NUSER_BODY = _NAMES.index("nuser_body")
_NUSER_ACTUATOR = _NAMES.index("nuser_actuator")
_NUSERDATA = _NAMES.index("nuserdata")
_BODY_PARENT = _NAMES.index("body_parentid")
_BODY_ROOT = _NAMES.index("body_rootid")
_BODY_TREE = _NAMES.index("body_treeid")
_BODY_DOFNUM = _NAMES.index("body_dofnum")
_BODY_DOFADR = _NAMES.index("body_dofadr")
_BODY_USER = _NAMES.index("body_user")
_DOF_BODY = _NAMES.index("dof_bodyid")
_ROW_LENGTH = _NAMES.index("M_rownnz")
_ROW_START = _NAMES.index("M_rowadr")
_COLUMN = _NAMES.index("M_colind")
_ACTUATOR_USER = _NAMES.index("actuator_user")
_ACTUATOR_TARGET = _NAMES.index("actuator_trnid")
_ACTUATOR_ACT = _NAMES.index("actuator_actadr")
_ACTUATOR_CTRL = _NAMES.index("actuator_ctrladr")
_ACTUATOR_RANGE = _NAMES.index("actuator_ctrlrange")
_SITE_BODY = _NAMES.index("site_bodyid")
_QVEL = _NAMES.index("qvel")
_ACT = _NAMES.index("act")
_CTRL = _NAMES.index("ctrl")
_USERDATA = _NAMES.index("userdata")
_XPOS = _NAMES.index("xpos")
_XMAT = _NAMES.index("xmat")
_SITE_XPOS = _NAMES.index("site_xpos")
_SITE_XMAT = _NAMES.index("site_xmat")
_COM = _NAMES.index("subtree_com")
_CDOF = _NAMES.index("cdof")
_CDOF_DOT = _NAMES.index("cdof_dot")
_CVEL = _NAMES.index("cvel")
_CACC = _NAMES.index("cacc")
_CRB = _NAMES.index("crb")
_M = _NAMES.index("M")
_PASSIVE = _NAMES.index("qfrc_passive")
_AWAKE = _NAMES.index("tree_awake")

_WET = 1e-300
"""Stands in the world's composite inertia, which nobody reads and MuJoCo clears with every M."""
_GRAVITY_OFF = 128  # mjDSBL_GRAVITY
_DIAGEXACT = 32  # mjENBL_DIAGEXACT
_RK4, _PGS = 1, 0

_SCRATCH = 60  # doubles behind the rows, for full matrices

# a row of the scratch array, one a body
_BIAS, _WRENCH, _FF, _FT, _TT, _TOUCHED, _ROW = 0, 6, 12, 18, 27, 33, 34
# _FF: force by velocity, symmetric (xx xy xz yy yz zz); _FT: force by rotation (3, 3), row by row;
# _TT: torque by rotation, symmetric. Wrenches and twists: rotational part first, as in MuJoCo.


@njit
def has_tables(m: int, at: Ints64) -> bool:
    """Whether a model carries our tables."""
    if word(m + at[_NUSER_BODY]) != BODY_COLUMNS:
        return False
    return real(word(m + at[_BODY_USER]) + 8 * MAGIC) == MAGIC_NUMBER


@njit
def needs_projection(m: int, at: Ints64) -> bool:
    """Whether the constraint solver keeps products with the inverse of M that are now stale."""
    return (
        small(m + at[_SOLVER]) == _PGS
        or small(m + at[_NOSLIP]) > 0
        or (small(m + at[_ENABLE]) & _DIAGEXACT) != 0
    )


@njit
def has_water(d: int, at: Ints64) -> bool:
    """Whether ``d.M`` has had its water since MuJoCo made it; if so it must be made anew."""
    return real(word(d + at[_CRB])) == _WET


@njit
def add_water(m: int, d: int, at: Ints64) -> None:
    """Add the water to ``d.M`` and ``d.qfrc_passive``; both must be as MuJoCo made them."""
    nv, nbody = word(m + at[_NV]), word(m + at[_NBODY])
    work = np.zeros(_ROW * nbody + _SCRATCH)
    theta_h = real(m + at[_TIMESTEP])
    if small(m + at[_INTEGRATOR]) == _RK4:
        theta_h = 0.0
    floats(word(d + at[_CRB]), 1)[0] = _WET
    _bias(m, d, at, work)
    _bodies(m, d, at, theta_h, work, True)
    _thrusters(m, d, at, work)
    _sum_up(m, at, work)
    cdof = floats(word(d + at[_CDOF]), 6 * nv)
    dof_body = ints(word(m + at[_DOF_BODY]), nv)
    length = ints(word(m + at[_ROW_LENGTH]), nv)
    start = ints(word(m + at[_ROW_START]), nv)
    passive = floats(word(d + at[_PASSIVE]), nv)
    n_entries = start[nv - 1] + length[nv - 1] if nv > 0 else 0
    column = ints(word(m + at[_COLUMN]), n_entries)
    mass = floats(word(d + at[_M]), n_entries)
    for k in range(nv):
        base = _ROW * dof_body[k]
        if work[base + _TOUCHED] == 0.0:
            continue
        wx, wy, wz = cdof[6 * k], cdof[6 * k + 1], cdof[6 * k + 2]
        vx, vy, vz = cdof[6 * k + 3], cdof[6 * k + 4], cdof[6 * k + 5]
        to = base + _WRENCH
        passive[k] += (
            wx * work[to] + wy * work[to + 1] + wz * work[to + 2]
            + vx * work[to + 3] + vy * work[to + 4] + vz * work[to + 5]
        )  # fmt: skip
        ff, ft, tt = base + _FF, base + _FT, base + _TT
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


@njit
def water_wrenches(m: int, d: int, at: Ints64, wrenches: Floats) -> None:
    """What the water and the thrusters do to every body and all that hangs on it.

    Needs ``cacc``, as a step with force sensors (or ``mj_rnePostConstraint``) leaves it.

    Args:
        m: address of the model.
        d: address of the data.
        at: offsets of the fields.
        wrenches: (nbody, 6), receives torque [N m] and force [N] of each subtree in world axes,
            about the centre of mass of its tree.
    """
    nbody = word(m + at[_NBODY])
    work = np.zeros(_ROW * nbody + _SCRATCH)
    cacc = floats(word(d + at[_CACC]), 6 * nbody)
    gravity = floats(m + at[_GRAVITY], 3)
    for body in range(1, nbody):
        for i in range(6):
            work[_ROW * body + _BIAS + i] = cacc[6 * body + i]
        if (small(m + at[_DISABLE]) & _GRAVITY_OFF) == 0:
            for i in range(3):
                work[_ROW * body + _BIAS + 3 + i] += gravity[i]
    _bodies(m, d, at, 0.0, work, False)
    _thrusters(m, d, at, work)
    _sum_up(m, at, work)
    for body in range(nbody):
        for i in range(6):
            wrenches[body, i] = work[_ROW * body + _WRENCH + i]


@njit
def _bias(m: int, d: int, at: Ints64, work: Floats) -> None:
    """Spatial acceleration of every body when no joint accelerates: Jdot qvel."""
    nv, nbody = word(m + at[_NV]), word(m + at[_NBODY])
    parent = ints(word(m + at[_BODY_PARENT]), nbody)
    dof_number = ints(word(m + at[_BODY_DOFNUM]), nbody)
    dof_start = ints(word(m + at[_BODY_DOFADR]), nbody)
    cdof_dot = floats(word(d + at[_CDOF_DOT]), 6 * nv)
    qvel = floats(word(d + at[_QVEL]), nv)
    for body in range(1, nbody):
        base, above = _ROW * body + _BIAS, _ROW * parent[body] + _BIAS
        for i in range(6):
            work[base + i] = work[above + i]
        for k in range(dof_start[body], dof_start[body] + dof_number[body]):
            for i in range(6):
                work[base + i] += cdof_dot[6 * k + i] * qvel[k]


@njit
def _sum_up(m: int, at: Ints64, work: Floats) -> None:
    """Add every body's wrench and inertia to its parent's."""
    nbody = word(m + at[_NBODY])
    parent = ints(word(m + at[_BODY_PARENT]), nbody)
    for body in range(nbody - 1, 0, -1):
        base, above = _ROW * body, _ROW * parent[body]
        if work[base + _TOUCHED] != 0.0 and above > 0:
            for i in range(_WRENCH, _TOUCHED):
                work[above + i] += work[base + i]
            work[above + _TOUCHED] = 1.0


@njit
def _thrusters(m: int, d: int, at: Ints64, work: Floats) -> None:
    """Add the thrust of every thruster that is in the water."""
    if word(m + at[_NUSER_ACTUATOR]) != THRUSTER_COLUMNS:
        return
    n, nbody = word(m + at[_NACTUATOR]), word(m + at[_NBODY])
    for i in range(n):
        table = floats(word(m + at[_ACTUATOR_USER]) + 8 * THRUSTER_COLUMNS * i, THRUSTER_COLUMNS)
        if table[IS_THRUSTER] == 0.0:
            continue
        state = small(word(m + at[_ACTUATOR_ACT]) + 4 * i)
        control = small(word(m + at[_ACTUATOR_CTRL]) + 4 * i)
        command = real(word(d + at[_CTRL]) + 8 * control)
        if state >= 0:
            command = real(word(d + at[_ACT]) + 8 * state)
        limits = floats(word(m + at[_ACTUATOR_RANGE]) + 16 * control, 2)
        loss = real(word(d + at[_USERDATA]) + 8 * (WATER_COLUMNS * nbody + i))
        thrust = (1.0 - loss) * curve(table, min(max(command, limits[0]), limits[1]))
        site = small(word(m + at[_ACTUATOR_TARGET]) + 8 * i)
        body = small(word(m + at[_SITE_BODY]) + 4 * site)
        place = floats(word(d + at[_SITE_XPOS]) + 24 * site, 3)
        axes = floats(word(d + at[_SITE_XMAT]) + 72 * site, 9)
        surface = real(word(m + at[_BODY_USER]) + 8 * SURFACE)
        surface += real(word(d + at[_USERDATA]) + 8 * (WATER_COLUMNS * body + 6))
        wet = 0.5 + 0.5 * (surface - place[2]) / table[RADIUS]
        thrust *= min(max(wet, 0.0), 1.0)
        root = small(word(m + at[_BODY_ROOT]) + 4 * body)
        com = floats(word(d + at[_COM]) + 24 * root, 3)
        fx, fy, fz = thrust * axes[0], thrust * axes[3], thrust * axes[6]
        rx, ry, rz = place[0] - com[0], place[1] - com[1], place[2] - com[2]
        base = _ROW * body
        to = base + _WRENCH
        work[base + _TOUCHED] = 1.0
        work[to] += ry * fz - rz * fy + table[TORQUE] * fx
        work[to + 1] += rz * fx - rx * fz + table[TORQUE] * fy
        work[to + 2] += rx * fy - ry * fx + table[TORQUE] * fz
        work[to + 3] += fx
        work[to + 4] += fy
        work[to + 5] += fz


@njit
def curve(table: Floats, command: float) -> float:
    """Thrust [N] of a command: dead zone, polynomial of its sign, saturation."""
    x = abs(command) - table[DEAD_ZONE]
    if x <= 0.0:
        return 0.0
    first = FORWARD if command > 0.0 else BACKWARD
    thrust = 0.0
    for i in range(CURVE_TERMS - 1, -1, -1):
        thrust = (thrust + table[first + i]) * x
    if command < 0.0:
        thrust = -thrust
    limited: float = min(max(thrust, table[LEAST]), table[MOST])
    return limited


@njit
def _bodies(m: int, d: int, at: Ints64, theta_h: float, work: Floats, with_mass: bool) -> None:
    """Wrench of the water on every body, and its inertia when ``with_mass``."""
    nbody = word(m + at[_NBODY])
    tree = ints(word(m + at[_BODY_TREE]), nbody)
    root = ints(word(m + at[_BODY_ROOT]), nbody)
    still = real(word(m + at[_BODY_USER]) + 8 * SURFACE)
    gravity = floats(m + at[_GRAVITY], 3)
    weight = 0.0 if (small(m + at[_DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    scratch = _ROW * nbody
    for body in range(1, nbody):
        table = floats(word(m + at[_BODY_USER]) + 8 * BODY_COLUMNS * body, BODY_COLUMNS)
        if table[KIND] == DRY or tree[body] < 0:
            continue
        if small(word(d + at[_AWAKE]) + 4 * tree[body]) == 0:
            continue
        water = floats(word(d + at[_USERDATA]) + 8 * WATER_COLUMNS * body, WATER_COLUMNS)
        place = floats(word(d + at[_XPOS]) + 24 * body, 3)
        axes = floats(word(d + at[_XMAT]) + 72 * body, 9)
        com = floats(word(d + at[_COM]) + 24 * root[body], 3)
        twist = floats(word(d + at[_CVEL]) + 48 * body, 6)
        height, lever = reference_point(table, place, axes, com)
        wet, centre = wet_part(table, axes, still + water[6] - height)
        if wet <= 0.0:
            continue
        base = _ROW * body
        work[base + _TOUCHED] = 1.0
        step = theta_h * table[THETA]
        nu = relative_twist(axes, lever, twist, water)
        bias = six(work, base + _BIAS)
        rate = known_rate(axes, lever, bias, water, nu)
        if table[KIND] == FULL:
            force, momentum = full_force(table, nu, rate, step, work, scratch)
        else:
            force, momentum = diagonal_force(table, nu, rate), diagonal_momentum(table, nu)
        force = subtract(force, coriolis(nu, momentum))
        wrench = move_wrench(axes, lever, wet, force)
        lift = buoyancy(wet * table[DISPLACED], water, gravity, weight)
        to = base + _WRENCH
        add_lift(axes, lever, centre, wrench, lift, work, to)
        if not with_mass:
            continue
        ff, ft, tt = base + _FF, base + _FT, base + _TT
        if table[KIND] == FULL:
            move_full_inertia(axes, lever, wet, work, scratch, ff, ft, tt)
        else:
            inertia = diagonal_inertia(table, nu, wet, step)
            move_diagonal_inertia(axes, lever, inertia, work, ff, ft, tt)
