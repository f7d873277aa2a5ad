"""From a scene to a MuJoCo model: bodies, joints and, for vehicles with ``u:dynamics``, water.

Every vehicle becomes a free body with its links as a tree of hinges and slides. A vehicle without
``u:dynamics`` is placed, not simulated. The joints of one that is simulated are held by servos.
Objects stand fixed, but for those that have a shape and are loose. Contacts are elliptic with
friction `FRICTION`, soft enough to take a few steps.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import mujoco
import numpy as np

from ..base.geometry import Pose, quaternion_from_rotation, rotation_from_rpy
from ..base.numerics.linear import product
from ..devices.object_picker import ObjectPickerSpec
from ..errors import BadSetting, SceneError, UwsimError
from ..model.body_names import (
    grip_constraint,
    loose_joint,
    object_body,
    vehicle_body,
    vehicle_fin,
    vehicle_joint,
    vehicle_thruster,
)
from ..model.collision.shapes import CollisionShape
from ..model.inertias import MIN_INERTIA, MIN_MASS
from ..model.resolved_scene import SimulatedScene
from ..scene.hydrodynamics import BodyHydrodynamics, FinSpec, ThrusterSpec, VehicleHydrodynamics
from ..scene.object import PhysicsSpec
from ..scene.spec import SceneSpec
from ..scene.urdf.robot import LinkSpec, RobotSpec
from ..world import GRAVITY
from .collision.world_tree import rebuild_world_tree
from .compiled_models import cached_model
from .engine_warnings import hush
from .free_objects import loose_hydrodynamics, loose_link, object_errors
from .hydrodynamics import prepare
from .joints import add_gear, add_joint, add_servo, is_geared
from .restitution import contact_spring

MAX_STEP = 0.02
"""Of what is simulated: held in soaks up to 0.01 s, seen to diverge from 0.03 s on; the autopilot
thinks this often [s]."""
FRICTION = (0.8, 0.005, 0.0001)
"""Sliding [1], spinning [m] and rolling [m], rubber on metal; of two shapes the greater counts."""
SOFTNESS = (0.95, 0.99, 0.001, 0.5, 2.0)
"""MuJoCo's solimp: half the creep of its default in a grasp."""
IMPRATIO = 10.0
"""How much stiffer friction is than the normal force: less creep of what is held."""
NOSLIP = 5
"""Iterations against the creep of friction, where contacts are precise."""
OBJECTS = 1
"""Collision bit of objects; every vehicle has another."""
ALL = 2**31 - 1
SHAPES = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "hull": mujoco.mjtGeom.mjGEOM_MESH,
    "height field": mujoco.mjtGeom.mjGEOM_HFIELD,
}

INTEGRATORS = {
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}


def vehicle_bit(index: int) -> int:
    """Collision bit of the vehicle number ``index``."""
    return 2 << (index % 29)


def compile_engine_model(simulated: SimulatedScene) -> mujoco.MjModel:
    """Build the MuJoCo model of a scene.

    Raises:
        BadHydrodynamics: with every error.
        BadSetting: the step is no time, or longer than the physics bears.
        SceneError: a loose object has next to no mass, or far too much buoyancy.
    """
    scene, dynamics, shapes = simulated.scene, simulated.dynamics, simulated.shapes
    _check_step(simulated.timestep, is_simulated=bool(dynamics) or scene.has_uwsim_physics)
    hush()
    return cached_model(
        (scene, simulated.robots, dynamics, simulated.timestep, shapes),
        sum(map(len, shapes.values())),
        lambda: _compiled(simulated),
    )


def _compiled(simulated: SimulatedScene) -> mujoco.MjModel:
    """Build the model."""
    scene, dynamics, shapes = simulated.scene, simulated.dynamics, simulated.shapes
    spec = _with_options(scene, simulated.timestep, is_simulated=bool(dynamics))
    world_from_localized = scene.world_from_localized
    _add_vehicles(spec, simulated)
    loose: dict[str, PhysicsSpec] = {}
    density = next(iter(dynamics.values())).density if dynamics else None
    for index, thing in enumerate(scene.objects):
        name = object_body(index)
        if name not in shapes:
            continue
        world_from_object = world_from_localized @ thing.localized_from_object
        if thing.solid.is_loose:
            if wrong := object_errors(thing, thing.solid, shapes[name], density):
                raise SceneError(wrong)
            link = loose_link(name, thing.solid, shapes[name])
            body = _add_body(spec.worldbody, name, world_from_object, link)
            body.add_freejoint(name=loose_joint(index))
            loose[name] = thing.solid
        else:  # without a body of their own they cost the engine nothing
            _add_shapes(spec, spec.worldbody, name, shapes[name], world_from_object)
            _give_surface(spec, name, shapes[name], thing.solid)
    for name, parts in shapes.items():
        if name in loose or not name.startswith("object/"):
            _add_shapes(spec, spec.body(name), name, parts, Pose.identity())
            if name in loose:
                _give_surface(spec, name, parts, loose[name])
    if density is not None:
        wet = {
            name: loose_hydrodynamics(name, physics, shapes[name], density)
            for name, physics in loose.items()
        }
        _add_water(spec, scene, dynamics, wet)
        _add_grips(spec, simulated, loose)
    try:
        model = spec.compile()
    except ValueError as error:
        raise UwsimError(
            f"The scene cannot be simulated: {' '.join(str(error).split())}"
        ) from error
    rebuild_world_tree(model)
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_RK4:
        # what never moves is then placed once, and not at every step; nothing is to fall asleep
        model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER)
    return model


def _with_options(scene: SceneSpec, timestep: float, *, is_simulated: bool) -> mujoco.MjSpec:
    """A model without bodies: the step, the integrator, the contacts and gravity of a scene."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = timestep
    spec.option.integrator = INTEGRATORS[scene.sim_params.integrator]
    if scene.sim_params.contacts == "precise":
        spec.option.noslip_iterations = NOSLIP
    spec.option.gravity = [0.0, 0.0, -GRAVITY if is_simulated else 0.0]
    if scene.has_uwsim_physics:
        spec.option.gravity = list(scene.sim_params.original_gravity)
    return spec


def _add_vehicles(spec: mujoco.MjSpec, simulated: SimulatedScene) -> None:
    """Add every vehicle where the scene puts it; without dynamics its links weigh nothing."""
    for index, vehicle in enumerate(simulated.scene.vehicles):
        robot = simulated.robots[index]
        links = {link.name: link for link in robot.links}
        is_dynamic = index in simulated.dynamics
        base = _add_body(
            spec.worldbody,
            vehicle_body(index, robot.root),
            simulated.scene.world_from_localized @ vehicle.localized_from_base,
            links[robot.root] if is_dynamic else None,
        )
        base.add_freejoint(name=vehicle_joint(index, ""))
        _add_children(spec, base, robot, robot.root, index, links if is_dynamic else {})


def _check_step(timestep: float, *, is_simulated: bool) -> None:
    if not (0.0 < timestep < math.inf):
        raise BadSetting(f"The step is {timestep!r}; expected a time > 0 [s].")
    if is_simulated and timestep > MAX_STEP:
        raise BadSetting(
            f"The step is {timestep:g} s; expected {MAX_STEP:g} s at most where a vehicle is "
            "simulated: with longer ones the motion grows beyond all bounds (0.002 is usual)."
        )


def _add_shapes(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    name: str,
    shapes: Sequence[CollisionShape],
    body_from_owner: Pose,
) -> None:
    """Add the collision shapes of ``name`` to a body; those of one vehicle do not collide."""
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = IMPRATIO
    kind, owner = name.split("/")[:2]
    bit = OBJECTS if kind == "object" else vehicle_bit(int(owner))
    for i, shape in enumerate(shapes):
        place = body_from_owner @ shape.body_from_shape
        geom = body.add_geom(
            name=f"{name}/shape/{i}",
            type=SHAPES[shape.kind],
            pos=place.position.tolist(),
            quat=quaternion_from_rotation(place.rotation).tolist(),
            contype=bit,
            conaffinity=ALL if kind == "object" else ALL & ~bit,
            condim=4,
            friction=list(FRICTION),
            solimp=list(SOFTNESS),
        )
        give_form(spec, geom, f"{name}/{i}", shape)


def give_form(spec: mujoco.MjSpec, geom: mujoco.MjsGeom, name: str, shape: CollisionShape) -> None:
    """Set the size of an engine's shape; a hull or a height field is added under ``name``."""
    if shape.corners is not None:
        spec.add_mesh(name=name, uservert=shape.corners.ravel().tolist())
        geom.meshname = name
    elif shape.heights is not None:
        rows, columns = shape.heights.shape
        spec.add_hfield(
            name=name,
            size=list(shape.size),
            nrow=rows,
            ncol=columns,
            userdata=shape.heights.ravel().tolist(),
        )
        geom.hfieldname = name
    else:
        geom.size[: len(shape.size)] = shape.size


def _give_surface(
    spec: mujoco.MjSpec, name: str, shapes: Sequence[CollisionShape], physics: PhysicsSpec
) -> None:
    """Set the friction and restitution of an object's shapes."""
    if physics.friction is None and physics.restitution is None:
        return
    for i in range(len(shapes)):
        geom = spec.geom(f"{name}/shape/{i}")
        geom.priority = 1  # else the greater friction of the two counts
        if physics.friction is not None:
            geom.friction = [physics.friction, *FRICTION[1:]]
        if physics.restitution is not None:  # negative: stiffness and damping; of two the greater
            stiffness, damping = contact_spring(physics.restitution, spec.option.timestep)
            geom.solref = [-stiffness, -damping]


def _add_children(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    robot: RobotSpec,
    link: str,
    index: int,
    links: Mapping[str, LinkSpec],
) -> None:
    """Add the child links of a link's body; ``links`` is empty for a kinematic vehicle."""
    for joint in robot.joints:
        if joint.parent != link:
            continue
        parent_from_child = Pose.from_rpy(joint.position, joint.rpy)
        child = _add_body(
            body, vehicle_body(index, joint.child), parent_from_child, links.get(joint.child)
        )
        if joint.moves:
            name = vehicle_joint(index, joint.name)
            add_joint(child, name, joint, is_driven=bool(links))
            if links:
                add_servo(spec, name, joint)
                if joint.mimic is not None and is_geared(joint, robot):
                    leader = vehicle_joint(index, joint.mimic.joint)
                    add_gear(spec, name, leader, joint, joint.mimic)
        _add_children(spec, child, robot, joint.child, index, links)


def _add_grips(spec: mujoco.MjSpec, simulated: SimulatedScene, loose: Collection[str]) -> None:
    """Add a constraint, not active, between each picker's link and each loose object."""
    for index in simulated.dynamics:
        pickers = simulated.scene.vehicles[index].parts_of(ObjectPickerSpec)
        for link in dict.fromkeys(picker.relative_to for picker in pickers):
            if simulated.robots[index].link(link) is None:
                continue
            for name in loose:
                weld = spec.add_equality(
                    name=grip_constraint(index, link, int(name.split("/")[1])),
                    type=mujoco.mjtEq.mjEQ_WELD,
                    objtype=mujoco.mjtObj.mjOBJ_BODY,
                    name1=vehicle_body(index, link),
                    name2=name,
                )
                weld.active = False
                weld.data[10] = 1.0  # turning counts as much as moving


def _add_water(
    spec: mujoco.MjSpec,
    scene: SceneSpec,
    dynamics: Mapping[int, VehicleHydrodynamics],
    loose: Mapping[str, BodyHydrodynamics],
) -> None:
    bodies: dict[str, BodyHydrodynamics] = dict(loose)
    thrusters: dict[str, tuple[str, ThrusterSpec]] = {}
    fins: dict[str, tuple[str, FinSpec]] = {}
    for index, vehicle in dynamics.items():
        for body in vehicle.bodies:
            bodies[vehicle_body(index, body.link)] = body
        for thruster in vehicle.thrusters:
            link = vehicle_body(index, thruster.link)
            thrusters[vehicle_thruster(index, thruster.name)] = (link, thruster)
        for fin in vehicle.fins:
            fins[vehicle_fin(index, fin.name)] = (vehicle_body(index, fin.link), fin)
    density = next(iter(dynamics.values())).density
    surface, profile = scene.ocean_state.ocean_surface_height, scene.ocean_state.profile
    levels = () if profile is None else profile.levels
    prepare(spec, bodies, thrusters, fins, surface=surface, density=density, levels=levels)


def _add_body(
    parent: mujoco.MjsBody, name: str, parent_from_body: Pose, link: LinkSpec | None
) -> mujoco.MjsBody:
    """Add a body; with a ``link`` its mass is the URDF's, without it stands for a pose alone."""
    mass, inertia = (1.0, 1.0) if link is None else (MIN_MASS, MIN_INERTIA)
    body = parent.add_body(
        name=name,
        pos=parent_from_body.position.tolist(),
        quat=quaternion_from_rotation(parent_from_body.rotation).tolist(),
        mass=mass,
        inertia=[inertia] * 3,
        ipos=[0.0, 0.0, 0.0],  # else MuJoCo takes the body's place for its centre of mass
    )
    body.explicitinertial = True
    if link is None:
        body.gravcomp = 1.0
    elif link.mass > 0.0:
        body.mass = link.mass
        body.ipos = list(link.centre_of_mass)
        xx, yy, zz, xy, xz, yz = link.inertia
        if min(xx, yy, zz) > 0.0:
            own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            turn = rotation_from_rpy(*link.inertia_rpy)
            turned = product(product(turn, own), turn.T)
            body.fullinertia = [*np.diag(turned), turned[0, 1], turned[0, 2], turned[1, 2]]
            body.inertia = [0.0, 0.0, 0.0]
    return body
