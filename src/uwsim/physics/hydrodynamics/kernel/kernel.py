r"""The forces of the water on every body, added to MuJoCo's mass matrix and passive forces.

For a body with the added mass :math:`M_A` and the damping :math:`D` (in body axes, about the
reference point), which moves with the twist :math:`\nu` in water that moves with :math:`v_c`,
Fossen's equations are

.. math:: f = -M_A\dot\nu_r - C_A(\nu_r)\nu_r - D(\nu_r)\nu_r + B,
          \qquad \nu_r = \nu - [R^T v_c;\, 0]

with the rotation R from body to world axes, and :math:`\dot\nu = J\ddot q + \dot J\dot q`. The
factor of :math:`\ddot q` is added to the mass matrix M, the rest to the passive forces
:math:`\tau`:

.. math:: M \mathrel{+}= J^T (M_A + \theta h D') J, \qquad
          \tau \mathrel{+}= J^T\bigl(-M_A(\dot J\dot q - \tfrac{d}{dt}R^T v_c)
          - C_A(\nu_r)\nu_r - D(\nu_r)\nu_r + B\bigr)

:math:`D'` is the derivative of the drag: with :math:`\theta > 0`, drag is linearly implicit over a
step of length h. :math:`B = \rho V (a_c - g)` is the buoyancy, with the pressure gradient of
accelerating water. At the surface, :math:`M_A`, :math:`D` and :math:`B` are proportional to the
submerged fraction. While the fraction grows, :math:`\dot M_A\nu_r`, the momentum rate of the newly
accelerated water, is subtracted from the force. While it decreases, the water that leaves the body
keeps its momentum. Inertias and wrenches are summed from the leaves of a tree of bodies to its
root, as in the composite-rigid-body algorithm, in MuJoCo's spatial frame: in world axes, about the
centre of mass of the tree.

After Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), chapters 6 and 8.
`equations` has the equations of one body; this module reads and writes MuJoCo's memory.

Not modelled: memory effects of waves, ground effect, flow interaction of bodies.
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
from .. import columns as c
from . import fields as f
from .equations import read_six
from .fins import add_fin
from .free_bodies import conserve_energy
from .links import LinkMotion, StepNumbers, add_link
from .thrusters import add_thrust

_WATER_MARK = 1e-300
"""The value of the first element of ``crb`` that marks M as containing the water.

The element belongs to the world's body, is not used, and is cleared whenever MuJoCo computes M.
"""
_GRAVITY_OFF = 128  # mjDSBL_GRAVITY
_DIAGEXACT = 32  # mjENBL_DIAGEXACT
_RK4, _PGS = 1, 0


@njit
def has_tables(m: int, o: Ints64) -> bool:
    """Return whether a model has the tables of `columns`."""
    if read_int64(m + o[f.NUSER_BODY]) != c.BODY_COLUMNS:
        return False
    return read_double(read_int64(m + o[f.BODY_USER]) + 8 * c.MAGIC) == c.MAGIC_NUMBER


@njit
def needs_projection(m: int, o: Ints64) -> bool:
    """Return whether the constraint solver uses products with the inverse of M, now outdated."""
    return (
        read_int32(m + o[f.SOLVER]) == _PGS
        or read_int32(m + o[f.NOSLIP]) > 0
        or (read_int32(m + o[f.ENABLE]) & _DIAGEXACT) != 0
    )


@njit
def has_water(d: int, o: Ints64) -> bool:
    """Return whether ``d.M`` contains the water already; it must then be computed again first."""
    return read_double(read_int64(d + o[f.CRB])) == _WATER_MARK


@njit
def add_water(m: int, d: int, o: Ints64) -> None:
    """Add the water to ``d.M`` and ``d.qfrc_passive``, which must be as MuJoCo computes them."""
    nv, nbody = read_int64(m + o[f.NV]), read_int64(m + o[f.NBODY])
    work = np.zeros(f.ROW * nbody + f.SCRATCH + f.DRAG * read_int64(m + o[f.NTREE]))
    step = read_double(m + o[f.TIMESTEP])
    if read_int32(m + o[f.INTEGRATOR]) == _RK4:
        step = 0.0
    view_doubles(read_int64(d + o[f.CRB]), 1)[0] = _WATER_MARK
    _compute_bias(m, d, o, work)
    _add_bodies(m, d, o, step, work, True)
    _add_actuators(m, d, o, work, 0.5 * step)
    _sum_up(m, o, work)
    cdof = view_doubles(read_int64(d + o[f.CDOF]), 6 * nv)
    dof_body = view_int32s(read_int64(m + o[f.DOF_BODY]), nv)
    length = view_int32s(read_int64(m + o[f.ROW_LENGTH]), nv)
    start = view_int32s(read_int64(m + o[f.ROW_START]), nv)
    passive = view_doubles(read_int64(d + o[f.PASSIVE]), nv)
    n_entries = start[nv - 1] + length[nv - 1] if nv > 0 else 0
    column = view_int32s(read_int64(m + o[f.COLUMN]), n_entries)
    mass = view_doubles(read_int64(d + o[f.M]), n_entries)
    for k in range(nv):
        base = f.ROW * dof_body[k]
        if work[base + f.IS_ACTIVE] == 0.0:
            continue
        wx, wy, wz = cdof[6 * k], cdof[6 * k + 1], cdof[6 * k + 2]
        vx, vy, vz = cdof[6 * k + 3], cdof[6 * k + 4], cdof[6 * k + 5]
        w = base + f.WRENCH
        passive[k] += (
            wx * work[w] + wy * work[w + 1] + wz * work[w + 2]
            + vx * work[w + 3] + vy * work[w + 4] + vz * work[w + 5]
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
        for index in range(start[k], start[k] + length[k]):
            j = 6 * column[index]
            mass[index] += (
                cdof[j] * tx + cdof[j + 1] * ty + cdof[j + 2] * tz
                + cdof[j + 3] * fx + cdof[j + 4] * fy + cdof[j + 5] * fz
            )  # fmt: skip
    if read_int32(m + o[f.INTEGRATOR]) != _RK4:
        conserve_energy(m, d, o, work)


@njit
def water_wrenches(m: int, d: int, o: Ints64, wrenches: Floats) -> None:
    """Compute the wrench of the water, thrusters and fins on the subtree of every body.

    ``cacc`` must be up to date, as a step with force sensors or ``mj_rnePostConstraint`` leaves it.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        wrenches: receives torque [N m] and force [N] of each subtree in world axes, about the
            centre of mass of its tree, (nbody, 6).
    """
    nbody = read_int64(m + o[f.NBODY])
    work = np.zeros(f.ROW * nbody + f.SCRATCH + f.DRAG * read_int64(m + o[f.NTREE]))
    cacc = view_doubles(read_int64(d + o[f.CACC]), 6 * nbody)
    gravity = view_doubles(m + o[f.GRAVITY], 3)
    for body in range(1, nbody):
        for i in range(6):
            work[f.ROW * body + f.BIAS + i] = cacc[6 * body + i]
        if (read_int32(m + o[f.DISABLE]) & _GRAVITY_OFF) == 0:
            for i in range(3):
                work[f.ROW * body + f.BIAS + 3 + i] += gravity[i]
    _add_bodies(m, d, o, 0.0, work, False)
    _add_actuators(m, d, o, work, 0.5 * read_double(m + o[f.TIMESTEP]))
    _sum_up(m, o, work)
    for body in range(nbody):
        for i in range(6):
            wrenches[body, i] = work[f.ROW * body + f.WRENCH + i]


@njit
def _compute_bias(m: int, d: int, o: Ints64, work: Floats) -> None:
    """Compute the spatial acceleration of every body without joint accelerations, Jdot qvel."""
    nv, nbody = read_int64(m + o[f.NV]), read_int64(m + o[f.NBODY])
    parent = view_int32s(read_int64(m + o[f.BODY_PARENT]), nbody)
    dof_number = view_int32s(read_int64(m + o[f.BODY_DOFNUM]), nbody)
    dof_start = view_int32s(read_int64(m + o[f.BODY_DOFADR]), nbody)
    cdof_dot = view_doubles(read_int64(d + o[f.CDOF_DOT]), 6 * nv)
    qvel = view_doubles(read_int64(d + o[f.QVEL]), nv)
    for body in range(1, nbody):
        base, parent_base = f.ROW * body + f.BIAS, f.ROW * parent[body] + f.BIAS
        for i in range(6):
            work[base + i] = work[parent_base + i]
        for k in range(dof_start[body], dof_start[body] + dof_number[body]):
            for i in range(6):
                work[base + i] += cdof_dot[6 * k + i] * qvel[k]


@njit
def _sum_up(m: int, o: Ints64, work: Floats) -> None:
    """Add the wrench, inertia and momentum of every body to those of its parent."""
    nbody = read_int64(m + o[f.NBODY])
    parent = view_int32s(read_int64(m + o[f.BODY_PARENT]), nbody)
    for body in range(nbody - 1, 0, -1):
        base, parent_base = f.ROW * body, f.ROW * parent[body]
        if work[base + f.IS_ACTIVE] != 0.0 and parent_base > 0:
            for i in range(f.WRENCH, f.IS_ACTIVE):
                work[parent_base + i] += work[base + i]
            work[parent_base + f.IS_ACTIVE] = 1.0


@njit
def _add_actuators(m: int, d: int, o: Ints64, work: Floats, dt: float) -> None:
    """Add the forces of all thrusters and fins with their states after a time ``dt`` [s]."""
    if read_int64(m + o[f.NUSER_ACTUATOR]) != c.ACTUATOR_COLUMNS:
        return
    tables = read_int64(m + o[f.ACTUATOR_USER])
    for i in range(read_int64(m + o[f.NACTUATOR])):
        table = view_doubles(tables + 8 * c.ACTUATOR_COLUMNS * i, c.ACTUATOR_COLUMNS)
        if table[c.ROLE] == c.PROPELLER:
            add_thrust(m, d, o, i, table, dt, work)
        elif table[c.ROLE] == c.FIN:
            add_fin(m, d, o, i, table, dt, work)


@njit
def _add_bodies(m: int, d: int, o: Ints64, theta_h: float, work: Floats, with_mass: bool) -> None:
    """Compute the wrench of the water on every body.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        theta_h: the step over which drag is implicit, for bodies with an implicitness of 1 [s].
        work: the rows of the bodies, with their bias accelerations.
        with_mass: true to compute the inertia and the momentum of the water, too.
    """
    nbody = read_int64(m + o[f.NBODY])
    tree = view_int32s(read_int64(m + o[f.BODY_TREE]), nbody)
    root = view_int32s(read_int64(m + o[f.BODY_ROOT]), nbody)
    timestep = read_double(m + o[f.TIMESTEP])
    world = view_doubles(read_int64(m + o[f.BODY_USER]), c.BODY_COLUMNS)
    gravity = view_doubles(m + o[f.GRAVITY], 3)
    gravity_scale = 0.0 if (read_int32(m + o[f.DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    numbers = StepNumbers(world, gravity, gravity_scale, timestep, theta_h, with_mass)
    scratch = f.ROW * nbody
    for body in range(1, nbody):
        table = view_doubles(
            read_int64(m + o[f.BODY_USER]) + 8 * c.BODY_COLUMNS * body, c.BODY_COLUMNS
        )
        if table[c.KIND] == c.DRY_BODY or tree[body] < 0:
            continue
        if read_int32(read_int64(d + o[f.TREE_AWAKE]) + 4 * tree[body]) == 0:
            continue
        link = LinkMotion(
            table,
            view_doubles(read_int64(d + o[f.XPOS]) + 24 * body, 3),
            view_doubles(read_int64(d + o[f.XMAT]) + 72 * body, 9),
            view_doubles(read_int64(d + o[f.COM]) + 24 * root[body], 3),
            view_doubles(read_int64(d + o[f.CVEL]) + 48 * body, 6),
            view_doubles(
                read_int64(d + o[f.USERDATA]) + 8 * c.WATER_COLUMNS * body, c.WATER_COLUMNS
            ),
        )
        base, drag = f.ROW * body, scratch + f.SCRATCH + f.DRAG * tree[body]
        bias = read_six(work, base + f.BIAS)
        is_submerged, impulse = add_link(link, numbers, bias, work, base, scratch, drag)
        if not is_submerged:
            continue
        work[base + f.IS_ACTIVE] = 1.0
        if with_mass:
            for i in range(6):
                work[base + f.MOMENTUM + i] = impulse[i]
