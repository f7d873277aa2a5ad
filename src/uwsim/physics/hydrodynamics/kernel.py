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
_M = _NAMES.index("M")
_PASSIVE = _NAMES.index("qfrc_passive")
_AWAKE = _NAMES.index("tree_awake")

_GRAVITY_OFF = 128  # mjDSBL_GRAVITY
_DIAGEXACT = 32  # mjENBL_DIAGEXACT
_RK4, _PGS = 1, 0

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
def add_water(m: int, d: int, at: Ints64) -> None:
    """Add the water to ``d.M`` and ``d.qfrc_passive``; both must be as MuJoCo made them."""
    nv, nbody = word(m + at[_NV]), word(m + at[_NBODY])
    work = np.zeros((nbody, _ROW))
    theta_h = real(m + at[_TIMESTEP])
    if small(m + at[_INTEGRATOR]) == _RK4:
        theta_h = 0.0
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
        row = work[dof_body[k]]
        if row[_TOUCHED] == 0.0:
            continue
        wx, wy, wz = cdof[6 * k], cdof[6 * k + 1], cdof[6 * k + 2]
        vx, vy, vz = cdof[6 * k + 3], cdof[6 * k + 4], cdof[6 * k + 5]
        passive[k] += (
            wx * row[_WRENCH] + wy * row[_WRENCH + 1] + wz * row[_WRENCH + 2]
            + vx * row[_WRENCH + 3] + vy * row[_WRENCH + 4] + vz * row[_WRENCH + 5]
        )  # fmt: skip
        ff, ft, tt = row[_FF:_FT], row[_FT:_TT], row[_TT:_TOUCHED]
        fx = ff[0] * vx + ff[1] * vy + ff[2] * vz + ft[0] * wx + ft[1] * wy + ft[2] * wz
        fy = ff[1] * vx + ff[3] * vy + ff[4] * vz + ft[3] * wx + ft[4] * wy + ft[5] * wz
        fz = ff[2] * vx + ff[4] * vy + ff[5] * vz + ft[6] * wx + ft[7] * wy + ft[8] * wz
        tx = tt[0] * wx + tt[1] * wy + tt[2] * wz + ft[0] * vx + ft[3] * vy + ft[6] * vz
        ty = tt[1] * wx + tt[3] * wy + tt[4] * wz + ft[1] * vx + ft[4] * vy + ft[7] * vz
        tz = tt[2] * wx + tt[4] * wy + tt[5] * wz + ft[2] * vx + ft[5] * vy + ft[8] * vz
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
    work = np.zeros((nbody, _ROW))
    cacc = floats(word(d + at[_CACC]), 6 * nbody)
    for body in range(1, nbody):
        for i in range(6):
            work[body, _BIAS + i] = cacc[6 * body + i]
        if (small(m + at[_DISABLE]) & _GRAVITY_OFF) == 0:
            gravity = floats(m + at[_GRAVITY], 3)
            for i in range(3):
                work[body, _BIAS + 3 + i] += gravity[i]
    _bodies(m, d, at, 0.0, work, False)
    _thrusters(m, d, at, work)
    _sum_up(m, at, work)
    wrenches[:, :] = work[:, _WRENCH : _WRENCH + 6]


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
        for i in range(6):
            work[body, _BIAS + i] = work[parent[body], _BIAS + i]
        for k in range(dof_start[body], dof_start[body] + dof_number[body]):
            for i in range(6):
                work[body, _BIAS + i] += cdof_dot[6 * k + i] * qvel[k]


@njit
def _sum_up(m: int, at: Ints64, work: Floats) -> None:
    """Add every body's wrench and inertia to its parent's."""
    nbody = word(m + at[_NBODY])
    parent = ints(word(m + at[_BODY_PARENT]), nbody)
    for body in range(nbody - 1, 0, -1):
        above = parent[body]
        if work[body, _TOUCHED] != 0.0 and above > 0:
            for i in range(_WRENCH, _TOUCHED):
                work[above, i] += work[body, i]
            work[above, _TOUCHED] = 1.0


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
        row = work[body]
        row[_TOUCHED] = 1.0
        row[_WRENCH] += ry * fz - rz * fy + table[TORQUE] * fx
        row[_WRENCH + 1] += rz * fx - rx * fz + table[TORQUE] * fy
        row[_WRENCH + 2] += rx * fy - ry * fx + table[TORQUE] * fz
        row[_WRENCH + 3] += fx
        row[_WRENCH + 4] += fy
        row[_WRENCH + 5] += fz


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
    nu, rate, momentum, force = np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    up, centre, matrix, turned = np.empty(3), np.empty(3), np.empty((6, 6)), np.empty(9)
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
        row = work[body]
        bx, by, bz = table[REFERENCE], table[REFERENCE + 1], table[REFERENCE + 2]
        height = place[2] + axes[6] * bx + axes[7] * by + axes[8] * bz
        rx = place[0] - com[0] + axes[0] * bx + axes[1] * by + axes[2] * bz
        ry = place[1] - com[1] + axes[3] * bx + axes[4] * by + axes[5] * bz
        rz = height - com[2]

        # the submerged part
        up[0], up[1], up[2] = axes[6], axes[7], axes[8]
        bx, by, bz = table[CENTRE], table[CENTRE + 1], table[CENTRE + 2]
        depth = still + water[6] - height - (up[0] * bx + up[1] * by + up[2] * bz)
        wet = submerged(table[SHAPE], table[SIZE : SIZE + 3], up, depth, centre)
        if wet <= 0.0:
            continue
        row[_TOUCHED] = 1.0

        # relative twist and the part of its rate that is known, body axes, linear part first
        wx, wy, wz = twist[0], twist[1], twist[2]
        _into(axes, twist[3] + wy * rz - wz * ry - water[0], twist[4] + wz * rx - wx * rz
              - water[1], twist[5] + wx * ry - wy * rx - water[2], nu, 0)  # fmt: skip
        _into(axes, wx, wy, wz, nu, 3)
        ax, ay, az = row[_BIAS], row[_BIAS + 1], row[_BIAS + 2]
        lx = row[_BIAS + 3] + ay * rz - az * ry - water[3]
        ly = row[_BIAS + 4] + az * rx - ax * rz - water[4]
        lz = row[_BIAS + 5] + ax * ry - ay * rx - water[5]
        _into(axes, lx, ly, lz, rate, 0)
        _into(axes, ax, ay, az, rate, 3)
        cx = axes[0] * water[0] + axes[3] * water[1] + axes[6] * water[2]
        cy = axes[1] * water[0] + axes[4] * water[1] + axes[7] * water[2]
        cz = axes[2] * water[0] + axes[5] * water[1] + axes[8] * water[2]
        rate[0] += nu[4] * cz - nu[5] * cy
        rate[1] += nu[5] * cx - nu[3] * cz
        rate[2] += nu[3] * cy - nu[4] * cx

        # added mass: -Ma rate - Ca(nu) nu
        for i in range(6):
            momentum[i], force[i] = 0.0, 0.0
            for j in range(6):
                entry = table[ADDED + 6 * i + j]
                momentum[i] += entry * nu[j]
                force[i] -= entry * rate[j]
        px, py, pz = momentum[0], momentum[1], momentum[2]
        force[0] -= nu[4] * pz - nu[5] * py
        force[1] -= nu[5] * px - nu[3] * pz
        force[2] -= nu[3] * py - nu[4] * px
        force[3] -= nu[4] * momentum[5] - nu[5] * momentum[4] + nu[1] * pz - nu[2] * py
        force[4] -= nu[5] * momentum[3] - nu[3] * momentum[5] + nu[2] * px - nu[0] * pz
        force[5] -= nu[3] * momentum[4] - nu[4] * momentum[3] + nu[0] * py - nu[1] * px

        # damping
        step = theta_h * table[THETA]
        if table[KIND] == FULL:
            for i in range(6):
                for j in range(6):
                    linear = table[LINEAR + 6 * i + j]
                    steep = table[QUADRATIC + 6 * i + j] * abs(nu[j])
                    force[i] -= (linear + steep) * nu[j]
                    matrix[i, j] = linear + 2.0 * steep
            for i in range(6):
                for j in range(i, 6):
                    slope = 0.5 * step * (matrix[i, j] + matrix[j, i])
                    matrix[i, j] = wet * (table[ADDED + 6 * i + j] + slope)
        else:
            for i in range(6):
                linear = table[LINEAR + 7 * i]
                steep = table[QUADRATIC + 7 * i] * abs(nu[i])
                force[i] -= (linear + steep) * nu[i]
                for j in range(i, 6):
                    matrix[i, j] = wet * table[ADDED + 6 * i + j]
                matrix[i, i] += wet * step * (linear + 2.0 * steep)

        # into world axes, about the centre of mass of the tree
        fx = wet * (axes[0] * force[0] + axes[1] * force[1] + axes[2] * force[2])
        fy = wet * (axes[3] * force[0] + axes[4] * force[1] + axes[5] * force[2])
        fz = wet * (axes[6] * force[0] + axes[7] * force[1] + axes[8] * force[2])
        row[_WRENCH] += wet * (
            axes[0] * force[3] + axes[1] * force[4] + axes[2] * force[5]
        ) + ry * fz - rz * fy  # fmt: skip
        row[_WRENCH + 1] += wet * (
            axes[3] * force[3] + axes[4] * force[4] + axes[5] * force[5]
        ) + rz * fx - rx * fz  # fmt: skip
        row[_WRENCH + 2] += wet * (
            axes[6] * force[3] + axes[7] * force[4] + axes[8] * force[5]
        ) + rx * fy - ry * fx  # fmt: skip
        row[_WRENCH + 3] += fx
        row[_WRENCH + 4] += fy
        row[_WRENCH + 5] += fz

        if with_mass:
            _inertia(axes, matrix, rx, ry, rz, turned, row)

        # buoyancy, at the centre of the submerged part
        mass = wet * table[DISPLACED]
        bx, by, bz = bx + centre[0], by + centre[1], bz + centre[2]
        rx += axes[0] * bx + axes[1] * by + axes[2] * bz
        ry += axes[3] * bx + axes[4] * by + axes[5] * bz
        rz += axes[6] * bx + axes[7] * by + axes[8] * bz
        fx = mass * (water[3] - weight * gravity[0])
        fy = mass * (water[4] - weight * gravity[1])
        fz = mass * (water[5] - weight * gravity[2])
        row[_WRENCH] += ry * fz - rz * fy
        row[_WRENCH + 1] += rz * fx - rx * fz
        row[_WRENCH + 2] += rx * fy - ry * fx
        row[_WRENCH + 3] += fx
        row[_WRENCH + 4] += fy
        row[_WRENCH + 5] += fz


@njit
def _into(axes: Floats, x: float, y: float, z: float, vector: Floats, first: int) -> None:
    """A world vector into body axes."""
    vector[first] = axes[0] * x + axes[3] * y + axes[6] * z
    vector[first + 1] = axes[1] * x + axes[4] * y + axes[7] * z
    vector[first + 2] = axes[2] * x + axes[5] * y + axes[8] * z


@njit
def _turn(axes: Floats, matrix: Floats, first: int, second: int, turned: Floats) -> None:
    """One 3x3 block of the upper triangle of ``matrix`` into world axes: R B R^T, row by row."""
    for j in range(3):
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        # column j of B R^T
        if first == second:
            a = matrix[first, first] * x + matrix[first, first + 1] * y
            a += matrix[first, first + 2] * z
            b = matrix[first, first + 1] * x + matrix[first + 1, first + 1] * y
            b += matrix[first + 1, first + 2] * z
            c = matrix[first, first + 2] * x + matrix[first + 1, first + 2] * y
            c += matrix[first + 2, first + 2] * z
        else:
            a = matrix[0, 3] * x + matrix[0, 4] * y + matrix[0, 5] * z
            b = matrix[1, 3] * x + matrix[1, 4] * y + matrix[1, 5] * z
            c = matrix[2, 3] * x + matrix[2, 4] * y + matrix[2, 5] * z
        turned[j] = axes[0] * a + axes[1] * b + axes[2] * c
        turned[3 + j] = axes[3] * a + axes[4] * b + axes[5] * c
        turned[6 + j] = axes[6] * a + axes[7] * b + axes[8] * c


@njit
def _inertia(
    axes: Floats, matrix: Floats, rx: float, ry: float, rz: float, turned: Floats, row: Floats
) -> None:
    """Add a body's 6x6 inertia, moved to the centre of mass of the tree, to its row."""
    ff, ft, tt = row[_FF:_FT], row[_FT:_TT], row[_TT:_TOUCHED]
    _turn(axes, matrix, 0, 0, turned)
    xx, xy, xz, yy, yz, zz = turned[0], turned[1], turned[2], turned[4], turned[5], turned[8]
    ff[0], ff[1], ff[2], ff[3], ff[4], ff[5] = xx, xy, xz, yy, yz, zz
    # force by rotation: B12 - B11 S(r)
    _turn(axes, matrix, 0, 3, turned)
    ft[0] = turned[0] - (xy * rz - xz * ry)
    ft[1] = turned[1] - (xz * rx - xx * rz)
    ft[2] = turned[2] - (xx * ry - xy * rx)
    ft[3] = turned[3] - (yy * rz - yz * ry)
    ft[4] = turned[4] - (yz * rx - xy * rz)
    ft[5] = turned[5] - (xy * ry - yy * rx)
    ft[6] = turned[6] - (yz * rz - zz * ry)
    ft[7] = turned[7] - (zz * rx - xz * rz)
    ft[8] = turned[8] - (xz * ry - yz * rx)
    # torque by rotation: B22 + S(r) (force by rotation) - B12^T S(r)
    a, b, c, d = turned[0], turned[1], turned[2], turned[3]
    e, f, g, h = turned[4], turned[5], turned[6], turned[7]
    _turn(axes, matrix, 3, 3, turned)
    tt[0] = turned[0] + ry * ft[6] - rz * ft[3] - (d * rz - g * ry)
    tt[1] = turned[1] + ry * ft[7] - rz * ft[4] - (g * rx - a * rz)
    tt[2] = turned[2] + ry * ft[8] - rz * ft[5] - (a * ry - d * rx)
    tt[3] = turned[4] + rz * ft[1] - rx * ft[7] - (h * rx - b * rz)
    tt[4] = turned[5] + rz * ft[2] - rx * ft[8] - (b * ry - e * rx)
    tt[5] = turned[8] + rx * ft[5] - ry * ft[2] - (c * ry - f * rx)
