"""The indices of MuJoCo's fields in the kernel's offsets, and the layout of the kernel's own array.

The value of a constant with a field's name is its index in the offsets that `layout.offsets`
returns.
"""

from __future__ import annotations

from .layout import CONTACT_FIELDS, DATA_FIELDS, MODEL_FIELDS

_NAMES = (*MODEL_FIELDS, *DATA_FIELDS)
TIMESTEP = _NAMES.index("opt.timestep")
GRAVITY = _NAMES.index("opt.gravity")
INTEGRATOR = _NAMES.index("opt.integrator")
SOLVER = _NAMES.index("opt.solver")
NOSLIP = _NAMES.index("opt.noslip_iterations")
DISABLE = _NAMES.index("opt.disableflags")
ENABLE = _NAMES.index("opt.enableflags")
NQ = _NAMES.index("nq")
NV = _NAMES.index("nv")
NU = _NAMES.index("nu")
NBODY = _NAMES.index("nbody")
NACTUATOR = _NAMES.index("nactuator")
NUSER_BODY = _NAMES.index("nuser_body")
NUSER_ACTUATOR = _NAMES.index("nuser_actuator")
NUSERDATA = _NAMES.index("nuserdata")
BODY_PARENT = _NAMES.index("body_parentid")
BODY_ROOT = _NAMES.index("body_rootid")
BODY_TREE = _NAMES.index("body_treeid")
NTREE = _NAMES.index("ntree")
TREE_BODY = _NAMES.index("tree_bodyadr")
TREE_BODYNUM = _NAMES.index("tree_bodynum")
TREE_DOFADR = _NAMES.index("tree_dofadr")
TREE_DOFNUM = _NAMES.index("tree_dofnum")
BODY_JNTNUM = _NAMES.index("body_jntnum")
BODY_JNTADR = _NAMES.index("body_jntadr")
GEOM_BODY = _NAMES.index("geom_bodyid")
JNT_QPOSADR = _NAMES.index("jnt_qposadr")
BODY_DOFNUM = _NAMES.index("body_dofnum")
BODY_DOFADR = _NAMES.index("body_dofadr")
BODY_USER = _NAMES.index("body_user")
DOF_BODY = _NAMES.index("dof_bodyid")
ROW_LENGTH = _NAMES.index("M_rownnz")
ROW_START = _NAMES.index("M_rowadr")
COLUMN = _NAMES.index("M_colind")
ACTUATOR_USER = _NAMES.index("actuator_user")
ACTUATOR_TARGET = _NAMES.index("actuator_trnid")
ACTUATOR_ACT = _NAMES.index("actuator_actadr")
ACTUATOR_CTRL = _NAMES.index("actuator_ctrladr")
ACTUATOR_RANGE = _NAMES.index("actuator_ctrlrange")
SITE_BODY = _NAMES.index("site_bodyid")
QPOS = _NAMES.index("qpos")
QVEL = _NAMES.index("qvel")
ACT = _NAMES.index("act")
CTRL = _NAMES.index("ctrl")
USERDATA = _NAMES.index("userdata")
XPOS = _NAMES.index("xpos")
XMAT = _NAMES.index("xmat")
SITE_XPOS = _NAMES.index("site_xpos")
SITE_XMAT = _NAMES.index("site_xmat")
COM = _NAMES.index("subtree_com")
CDOF = _NAMES.index("cdof")
CDOF_DOT = _NAMES.index("cdof_dot")
CVEL = _NAMES.index("cvel")
CACC = _NAMES.index("cacc")
CINERT = _NAMES.index("cinert")
CRB = _NAMES.index("crb")
M = _NAMES.index("M")
SUBTREE_FORCE = _NAMES.index("cfrc_int")
PASSIVE = _NAMES.index("qfrc_passive")
APPLIED = _NAMES.index("qfrc_applied")
BIAS_FORCE = _NAMES.index("qfrc_bias")
SPRING = _NAMES.index("qfrc_spring")
DAMPER = _NAMES.index("qfrc_damper")
ACTUATOR = _NAMES.index("qfrc_actuator")
TREE_AWAKE = _NAMES.index("tree_awake")
QACC = _NAMES.index("qacc")
QACC_SMOOTH = _NAMES.index("qacc_smooth")
N_ROWS = _NAMES.index("nefc")
ITERATIONS = _NAMES.index("solver_niter")
N_CONTACTS = _NAMES.index("ncon")
CONTACTS = _NAMES.index("contact")
CONTACT_POINT, CONTACT_AXES, CONTACT_GEOMS, CONTACT_SIZE = range(
    len(_NAMES), len(_NAMES) + len(CONTACT_FIELDS) + 1
)

# The kernel's own array has a row of the length ROW for each body. Bias acceleration, wrench and
# momentum are spatial vectors with the rotational part first, as in MuJoCo. The inertia of the
# water is in three blocks: FF (force per acceleration, symmetric: xx xy xz yy yz zz), FT (force per
# angular acceleration, (3, 3) by rows) and TT (torque per angular acceleration, symmetric).
BIAS, WRENCH, FF, FT, TT, MOMENTUM, IS_ACTIVE, ROW = 0, 6, 12, 18, 27, 33, 39, 40
SCRATCH = 60
"""The number of elements behind the rows, as scratch memory for full matrices."""
DRAG = 21
"""The number of elements behind these for each tree: the implicit drag of the tree, as FF, FT, TT.
"""
