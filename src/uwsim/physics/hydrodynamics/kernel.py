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
One file, although long: numba's cache on disk watches only the file of the function it compiled.
After a change in `columns`, `layout`, `memory` or `submersion`, save this file anew too.

Not modelled: the momentum of water shed when the submerged fraction changes, memory of waves,
ground effect, flow of one body over another, thrust lost to inflow.
"""

from __future__ import annotations

import numpy as np

from ...jit import njit
from .columns import (
    ADDED,
    BACKWARD,
    BODY_COLUMNS,
    CENTRE,
    CURVE_TERMS,
    DEAD_ZONE,
    DISPLACED,
    DRY,
    FORWARD,
    FULL,
    IS_THRUSTER,
    KIND,
    LEAST,
    LINEAR,
    MAGIC,
    MAGIC_NUMBER,
    MOST,
    QUADRATIC,
    RADIUS,
    REACH,
    REFERENCE,
    SHAPE,
    SIZE,
    SURFACE,
    THETA,
    THRUSTER_COLUMNS,
    TORQUE,
    WATER_COLUMNS,
)  # fmt: skip
from .layout import DATA_FIELDS, MODEL_FIELDS
from .memory import Floats, Ints64, floats, ints, real, small, word
from .submersion import submerged

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
        r00, r01, r02 = axes[0], axes[1], axes[2]
        r10, r11, r12 = axes[3], axes[4], axes[5]
        r20, r21, r22 = axes[6], axes[7], axes[8]
        bx, by, bz = table[REFERENCE], table[REFERENCE + 1], table[REFERENCE + 2]
        height = place[2] + r20 * bx + r21 * by + r22 * bz
        rx = place[0] - com[0] + r00 * bx + r01 * by + r02 * bz
        ry = place[1] - com[1] + r10 * bx + r11 * by + r12 * bz
        rz = height - com[2]

        # the submerged part
        bx, by, bz = table[CENTRE], table[CENTRE + 1], table[CENTRE + 2]
        depth = still + water[6] - height - (r20 * bx + r21 * by + r22 * bz)
        wet = 1.0
        if depth < table[REACH]:
            wet, cx, cy, cz = submerged(
                table[SHAPE], table[SIZE], table[SIZE + 1], table[SIZE + 2], r20, r21, r22, depth
            )
            bx, by, bz = bx + cx, by + cy, bz + cz
            if wet <= 0.0:
                continue
        base = _ROW * body
        work[base + _TOUCHED] = 1.0

        # twist relative to the water, body axes
        wx, wy, wz = twist[0], twist[1], twist[2]
        x = twist[3] + wy * rz - wz * ry - water[0]
        y = twist[4] + wz * rx - wx * rz - water[1]
        z = twist[5] + wx * ry - wy * rx - water[2]
        u = r00 * x + r10 * y + r20 * z
        v = r01 * x + r11 * y + r21 * z
        w = r02 * x + r12 * y + r22 * z
        p = r00 * wx + r10 * wy + r20 * wz
        q = r01 * wx + r11 * wy + r21 * wz
        r = r02 * wx + r12 * wy + r22 * wz
        # the part of its rate that is known: R^T (a - a_water) + omega x R^T v_water
        ax, ay, az = work[base], work[base + 1], work[base + 2]
        x = work[base + 3] + ay * rz - az * ry - water[3]
        y = work[base + 4] + az * rx - ax * rz - water[4]
        z = work[base + 5] + ax * ry - ay * rx - water[5]
        cx = r00 * water[0] + r10 * water[1] + r20 * water[2]
        cy = r01 * water[0] + r11 * water[1] + r21 * water[2]
        cz = r02 * water[0] + r12 * water[1] + r22 * water[2]
        du = r00 * x + r10 * y + r20 * z + q * cz - r * cy
        dv = r01 * x + r11 * y + r21 * z + r * cx - p * cz
        dw = r02 * x + r12 * y + r22 * z + p * cy - q * cx
        dp = r00 * ax + r10 * ay + r20 * az
        dq = r01 * ax + r11 * ay + r21 * az
        dr = r02 * ax + r12 * ay + r22 * az

        # -Ma rate - D(nu) nu, and the momentum Ma nu
        step = theta_h * table[THETA]
        scratch = _ROW * nbody
        if table[KIND] == FULL:
            _full(table, step, work, scratch, u, v, w, p, q, r, du, dv, dw, dp, dq, dr)
            fx, fy, fz = work[scratch], work[scratch + 1], work[scratch + 2]
            tx, ty, tz = work[scratch + 3], work[scratch + 4], work[scratch + 5]
            px, py, pz = work[scratch + 6], work[scratch + 7], work[scratch + 8]
            hx, hy, hz = work[scratch + 9], work[scratch + 10], work[scratch + 11]
        else:
            px, py, pz = table[ADDED] * u, table[ADDED + 7] * v, table[ADDED + 14] * w
            hx, hy, hz = table[ADDED + 21] * p, table[ADDED + 28] * q, table[ADDED + 35] * r
            fx = -table[ADDED] * du - (table[LINEAR] + table[QUADRATIC] * abs(u)) * u
            fy = -table[ADDED + 7] * dv - (table[LINEAR + 7] + table[QUADRATIC + 7] * abs(v)) * v
            fz = -table[ADDED + 14] * dw - (table[LINEAR + 14] + table[QUADRATIC + 14] * abs(w)) * w
            tx = -table[ADDED + 21] * dp - (table[LINEAR + 21] + table[QUADRATIC + 21] * abs(p)) * p
            ty = -table[ADDED + 28] * dq - (table[LINEAR + 28] + table[QUADRATIC + 28] * abs(q)) * q
            tz = -table[ADDED + 35] * dr - (table[LINEAR + 35] + table[QUADRATIC + 35] * abs(r)) * r

        # -Ca(nu) nu
        tx -= q * hz - r * hy + v * pz - w * py
        ty -= r * hx - p * hz + w * px - u * pz
        tz -= p * hy - q * hx + u * py - v * px
        fx -= q * pz - r * py
        fy -= r * px - p * pz
        fz -= p * py - q * px

        # into world axes, about the centre of mass of the tree
        x = wet * (r00 * fx + r01 * fy + r02 * fz)
        y = wet * (r10 * fx + r11 * fy + r12 * fz)
        z = wet * (r20 * fx + r21 * fy + r22 * fz)
        ax = wet * (r00 * tx + r01 * ty + r02 * tz) + ry * z - rz * y
        ay = wet * (r10 * tx + r11 * ty + r12 * tz) + rz * x - rx * z
        az = wet * (r20 * tx + r21 * ty + r22 * tz) + rx * y - ry * x

        # buoyancy, at the centre of the submerged part
        mass = wet * table[DISPLACED]
        cx = rx + r00 * bx + r01 * by + r02 * bz
        cy = ry + r10 * bx + r11 * by + r12 * bz
        cz = rz + r20 * bx + r21 * by + r22 * bz
        fx = mass * (water[3] - weight * gravity[0])
        fy = mass * (water[4] - weight * gravity[1])
        fz = mass * (water[5] - weight * gravity[2])
        work[base + _WRENCH] += ax + cy * fz - cz * fy
        work[base + _WRENCH + 1] += ay + cz * fx - cx * fz
        work[base + _WRENCH + 2] += az + cx * fy - cy * fx
        work[base + _WRENCH + 3] += x + fx
        work[base + _WRENCH + 4] += y + fy
        work[base + _WRENCH + 5] += z + fz
        if not with_mass:
            continue
        if table[KIND] == FULL:
            _full_inertia(axes, wet, rx, ry, rz, work, base, scratch + 12)
        else:
            h = wet * step
            a = wet * table[ADDED] + h * (table[LINEAR] + 2.0 * table[QUADRATIC] * abs(u))
            b = wet * table[ADDED + 7]
            b += h * (table[LINEAR + 7] + 2.0 * table[QUADRATIC + 7] * abs(v))
            c = wet * table[ADDED + 14]
            c += h * (table[LINEAR + 14] + 2.0 * table[QUADRATIC + 14] * abs(w))
            xx = a * r00 * r00 + b * r01 * r01 + c * r02 * r02
            xy = a * r00 * r10 + b * r01 * r11 + c * r02 * r12
            xz = a * r00 * r20 + b * r01 * r21 + c * r02 * r22
            yy = a * r10 * r10 + b * r11 * r11 + c * r12 * r12
            yz = a * r10 * r20 + b * r11 * r21 + c * r12 * r22
            zz = a * r20 * r20 + b * r21 * r21 + c * r22 * r22
            a = wet * table[ADDED + 21]
            a += h * (table[LINEAR + 21] + 2.0 * table[QUADRATIC + 21] * abs(p))
            b = wet * table[ADDED + 28]
            b += h * (table[LINEAR + 28] + 2.0 * table[QUADRATIC + 28] * abs(q))
            c = wet * table[ADDED + 35]
            c += h * (table[LINEAR + 35] + 2.0 * table[QUADRATIC + 35] * abs(r))
            ff, ft, tt = base + _FF, base + _FT, base + _TT
            work[ff], work[ff + 1], work[ff + 2] = xx, xy, xz
            work[ff + 3], work[ff + 4], work[ff + 5] = yy, yz, zz
            # force by rotation: -B11 S(r)
            f0, f1, f2 = xz * ry - xy * rz, xx * rz - xz * rx, xy * rx - xx * ry
            f3, f4, f5 = yz * ry - yy * rz, xy * rz - yz * rx, yy * rx - xy * ry
            f6, f7, f8 = zz * ry - yz * rz, xz * rz - zz * rx, yz * rx - xz * ry
            work[ft], work[ft + 1], work[ft + 2] = f0, f1, f2
            work[ft + 3], work[ft + 4], work[ft + 5] = f3, f4, f5
            work[ft + 6], work[ft + 7], work[ft + 8] = f6, f7, f8
            # torque by rotation: B22 + S(r) (force by rotation)
            work[tt] = a * r00 * r00 + b * r01 * r01 + c * r02 * r02 + ry * f6 - rz * f3
            work[tt + 1] = a * r00 * r10 + b * r01 * r11 + c * r02 * r12 + ry * f7 - rz * f4
            work[tt + 2] = a * r00 * r20 + b * r01 * r21 + c * r02 * r22 + ry * f8 - rz * f5
            work[tt + 3] = a * r10 * r10 + b * r11 * r11 + c * r12 * r12 + rz * f1 - rx * f7
            work[tt + 4] = a * r10 * r20 + b * r11 * r21 + c * r12 * r22 + rz * f2 - rx * f8
            work[tt + 5] = a * r20 * r20 + b * r21 * r21 + c * r22 * r22 + rx * f5 - ry * f2


@njit
def _full(
    table: Floats, step: float, work: Floats, at: int,
    u: float, v: float, w: float, p: float, q: float, r: float,
    du: float, dv: float, dw: float, dp: float, dq: float, dr: float,
) -> None:  # fmt: skip
    """Full 6x6 matrices: -Ma rate - D(nu) nu, Ma nu, and Ma + step D' (symmetric part).

    Left in ``work`` from ``at`` on: 6 forces, 6 momenta, 36 entries.
    """
    nu = (u, v, w, p, q, r)
    rate = (du, dv, dw, dp, dq, dr)
    for i in range(6):
        force, momentum = 0.0, 0.0
        for j in range(6):
            added = table[ADDED + 6 * i + j]
            linear = table[LINEAR + 6 * i + j]
            steep = table[QUADRATIC + 6 * i + j] * abs(nu[j])
            momentum += added * nu[j]
            force -= added * rate[j] + (linear + steep) * nu[j]
            mirrored = table[LINEAR + 6 * j + i] + 2.0 * table[QUADRATIC + 6 * j + i] * abs(nu[i])
            slope = 0.5 * (linear + 2.0 * steep + mirrored)
            work[at + 12 + 6 * i + j] = added + step * slope
        work[at + i], work[at + 6 + i] = force, momentum


@njit
def _turn(axes: Floats, work: Floats, block: int, to: int) -> None:
    """One 3x3 block, at ``block`` in rows of 6, into world axes: R B R^T, in rows of 3."""
    for j in range(3):
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        a = work[block] * x + work[block + 1] * y + work[block + 2] * z
        b = work[block + 6] * x + work[block + 7] * y + work[block + 8] * z
        c = work[block + 12] * x + work[block + 13] * y + work[block + 14] * z
        work[to + j] = axes[0] * a + axes[1] * b + axes[2] * c
        work[to + 3 + j] = axes[3] * a + axes[4] * b + axes[5] * c
        work[to + 6 + j] = axes[6] * a + axes[7] * b + axes[8] * c


@njit
def _full_inertia(
    axes: Floats, wet: float, rx: float, ry: float, rz: float, work: Floats, base: int, full: int
) -> None:
    """Move a full 6x6 inertia, at ``full``, to the centre of mass of the tree."""
    to = full + 36
    ff, ft, tt = base + _FF, base + _FT, base + _TT
    _turn(axes, work, full, to)
    xx, xy, xz = wet * work[to], wet * work[to + 1], wet * work[to + 2]
    yy, yz, zz = wet * work[to + 4], wet * work[to + 5], wet * work[to + 8]
    work[ff], work[ff + 1], work[ff + 2] = xx, xy, xz
    work[ff + 3], work[ff + 4], work[ff + 5] = yy, yz, zz
    # force by rotation: B12 - B11 S(r)
    _turn(axes, work, full + 3, to)
    a, b, c = wet * work[to], wet * work[to + 1], wet * work[to + 2]
    d, e, f = wet * work[to + 3], wet * work[to + 4], wet * work[to + 5]
    g, h, i = wet * work[to + 6], wet * work[to + 7], wet * work[to + 8]
    f0, f1, f2 = a - xy * rz + xz * ry, b - xz * rx + xx * rz, c - xx * ry + xy * rx
    f3, f4, f5 = d - yy * rz + yz * ry, e - yz * rx + xy * rz, f - xy * ry + yy * rx
    f6, f7, f8 = g - yz * rz + zz * ry, h - zz * rx + xz * rz, i - xz * ry + yz * rx
    work[ft], work[ft + 1], work[ft + 2] = f0, f1, f2
    work[ft + 3], work[ft + 4], work[ft + 5] = f3, f4, f5
    work[ft + 6], work[ft + 7], work[ft + 8] = f6, f7, f8
    # torque by rotation: B22 + S(r) (force by rotation) - B12^T S(r)
    _turn(axes, work, full + 21, to)
    work[tt] = wet * work[to] + ry * f6 - rz * f3 - (d * rz - g * ry)
    work[tt + 1] = wet * work[to + 1] + ry * f7 - rz * f4 - (g * rx - a * rz)
    work[tt + 2] = wet * work[to + 2] + ry * f8 - rz * f5 - (a * ry - d * rx)
    work[tt + 3] = wet * work[to + 4] + rz * f1 - rx * f7 - (h * rx - b * rz)
    work[tt + 4] = wet * work[to + 5] + rz * f2 - rx * f8 - (b * ry - e * rx)
    work[tt + 5] = wet * work[to + 8] + rx * f5 - ry * f2 - (c * ry - f * rx)
