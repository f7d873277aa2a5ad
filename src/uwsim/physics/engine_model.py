"""The compilation of a scene to a MuJoCo model: bodies, joints, shapes and hydrodynamics.

Every vehicle becomes a free body with its links as a tree of hinge and slide joints. A vehicle with
``u:dynamics`` has servos at its joints, thrusters and hydrodynamics. Without ``u:dynamics`` it is
kinematic: its links have no weight, and its pose is set. Objects are fixed unless they have a shape
and are loose. Contacts have elliptic friction cones with the friction `FRICTION`, and are soft
enough to last a few steps.
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
    fixture_joint,
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
from ..model.segment_names import segment_names
from ..scene.hydrodynamics import BodyHydrodynamics, FinSpec, ThrusterSpec, VehicleHydrodynamics
from ..scene.object import PhysicsSpec
from ..scene.spec import SceneSpec
from ..scene.urdf.robot import LinkSpec, RobotSpec
from ..world import GRAVITY
from .collision.world_tree import rebuild_world_tree
from .compiled_models import cached_model
from .engine_warnings import suppress_warnings
from .free_objects import loose_hydrodynamics, loose_link, object_errors
from .hydrodynamics import prepare
from .joints import add_fixture_joint, add_gear, add_joint, add_servo, is_geared
from .restitution import contact_spring

MAX_STEP = 0.02
"""The longest step of a scene with dynamics [s]. In long tests, steps up to 0.01 s were stable, and
steps from 0.03 s on unstable."""
FRICTION = (0.8, 0.005, 0.0001)
"""The sliding [1], torsional [m] and rolling [m] friction coefficients, as of rubber on metal."""
SOFTNESS = (0.95, 0.99, 0.001, 0.5, 2.0)
"""The ``solimp`` of contacts; with MuJoCo's default, a grasped object creeps twice as fast."""
IMPRATIO = 10.0
"""The ``impratio``: the ratio of frictional to normal impedance; reduces creep in a grasp."""
NOSLIP = 5
"""The number of no-slip iterations, which reduce creep, in scenes with precise contacts."""
OBJECT_BIT = 1
"""The collision bit of objects; vehicles have other bits (`vehicle_bit`)."""
ALL_BITS = 2**31 - 1
"""All collision bits."""
GEOM_TYPES = {
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
    """Return the collision bit of the vehicle ``index``; vehicles of the same bit do not collide.

    The bits repeat every 29 vehicles: for example, the vehicles 0 and 29 do not collide.
    """
    return 2 << (index % 29)


def compile_engine_model(inputs: SimulatedScene) -> mujoco.MjModel:
    """Build the MuJoCo model of a scene.

    Raises:
        BadHydrodynamics: the hydrodynamics are invalid; with every error.
        BadSetting: the timestep is not positive, or too long for stable dynamics.
        SceneError: the mass or inertia of a loose object is too small, or its buoyancy too great.
        UwsimError: MuJoCo rejects the model.
    """
    scene, dynamics, shapes = inputs.scene, inputs.dynamics, inputs.shapes
    _check_step(inputs.timestep, has_dynamics=bool(dynamics) or scene.has_original_physics)
    suppress_warnings()
    return cached_model(
        (scene, inputs.robots, dynamics, inputs.timestep, shapes),
        sum(map(len, shapes.values())),
        lambda: _compile(inputs),
    )


def _compile(inputs: SimulatedScene) -> mujoco.MjModel:
    scene, dynamics, shapes = inputs.scene, inputs.dynamics, inputs.shapes
    spec = _make_spec(scene, inputs.timestep, has_dynamics=bool(dynamics))
    world_from_localized = scene.world_from_localized
    _add_vehicles(spec, inputs)
    loose_physics: dict[str, PhysicsSpec] = {}
    density = next(iter(dynamics.values())).density if dynamics else None
    for index, object_spec in enumerate(scene.objects):
        name = object_body(index)
        if name not in shapes:
            continue
        world_from_object = world_from_localized @ object_spec.localized_from_object
        if object_spec.solid.is_loose:
            if errors := object_errors(object_spec, object_spec.solid, shapes[name], density):
                raise SceneError(errors)
            link = loose_link(name, object_spec.solid, shapes[name])
            body = _add_body(spec.worldbody, name, world_from_object, link)
            if object_spec.joint is None:
                body.add_freejoint(name=loose_joint(index))
            else:
                add_fixture_joint(body, fixture_joint(index), object_spec.joint)
                # a handle touches the panel that it is mounted on
                spec.add_exclude(bodyname1="world", bodyname2=name)
            loose_physics[name] = object_spec.solid
        else:  # shapes of the world's body take the engine no time in a step
            _add_shapes(spec, spec.worldbody, name, shapes[name], world_from_object)
            _set_surface(spec, name, shapes[name], object_spec.solid)
    for name, parts in shapes.items():
        if name in loose_physics or not name.startswith("object/"):
            _add_shapes(spec, spec.body(name), name, parts, Pose.identity())
            if name in loose_physics:
                _set_surface(spec, name, parts, loose_physics[name])
    _add_segments(spec, scene)
    if density is not None:
        hydrodynamics = {
            name: loose_hydrodynamics(name, physics, shapes[name], density)
            for name, physics in loose_physics.items()
        }
        _add_water(spec, scene, dynamics, hydrodynamics)
        _add_grips(spec, inputs, loose_physics)
    try:
        model = spec.compile()
    except ValueError as error:
        raise UwsimError(
            f"The scene cannot be simulated: {' '.join(str(error).split())}"
        ) from error
    rebuild_world_tree(model)
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_RK4:
        # with sleeping enabled, fixed shapes are placed once, not in every step; no body may sleep
        model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER)
    return model


def _make_spec(scene: SceneSpec, timestep: float, *, has_dynamics: bool) -> mujoco.MjSpec:
    """Return a spec without bodies, with the timestep, integrator and gravity of a scene."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = timestep
    spec.option.integrator = INTEGRATORS[scene.sim_params.integrator]
    if scene.sim_params.contacts == "precise":
        spec.option.noslip_iterations = NOSLIP
    spec.option.gravity = [0.0, 0.0, -GRAVITY if has_dynamics else 0.0]
    if scene.has_original_physics:
        spec.option.gravity = list(scene.sim_params.original_gravity)
    return spec


def _add_vehicles(spec: mujoco.MjSpec, inputs: SimulatedScene) -> None:
    """Add every vehicle at its pose in the scene; links of kinematic vehicles have no weight."""
    for index, vehicle in enumerate(inputs.scene.vehicles):
        robot = inputs.robots[index]
        links = {link.name: link for link in robot.links}
        is_dynamic = index in inputs.dynamics
        base = _add_body(
            spec.worldbody,
            vehicle_body(index, robot.root),
            inputs.scene.world_from_localized @ vehicle.localized_from_base,
            links[robot.root] if is_dynamic else None,
        )
        base.add_freejoint(name=vehicle_joint(index, ""))
        _add_children(spec, base, robot, robot.root, index, links if is_dynamic else {})


def _check_step(timestep: float, *, has_dynamics: bool) -> None:
    if not (0.0 < timestep < math.inf):
        raise BadSetting(f"The step is {timestep!r}; expected a time > 0 [s].")
    if has_dynamics and timestep > MAX_STEP:
        raise BadSetting(
            f"The step is {timestep:g} s; expected {MAX_STEP:g} s at most where a vehicle is "
            "simulated. Longer steps make the motion unstable (0.002 s is usual)."
        )


def _add_shapes(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    name: str,
    shapes: Sequence[CollisionShape],
    body_from_owner: Pose,
) -> None:
    """Add collision shapes to a body; shapes of the same vehicle do not collide with each other.

    Args:
        spec: the spec of the scene.
        body: the body that receives the shapes.
        name: the name of the vehicle's link or the object that owns the shapes.
        shapes: the collision shapes, in the frame of their owner.
        body_from_owner: the pose of the owner in the frame of the body.
    """
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = IMPRATIO
    kind, owner = name.split("/")[:2]
    bit = OBJECT_BIT if kind == "object" else vehicle_bit(int(owner))
    for i, shape in enumerate(shapes):
        pose = body_from_owner @ shape.body_from_shape
        geom = body.add_geom(
            name=f"{name}/shape/{i}",
            type=GEOM_TYPES[shape.kind],
            pos=pose.position.tolist(),
            quat=quaternion_from_rotation(pose.rotation).tolist(),
            contype=bit,
            conaffinity=ALL_BITS if kind == "object" else ALL_BITS & ~bit,
            condim=4,
            friction=list(FRICTION),
            solimp=list(SOFTNESS),
        )
        if shape.friction is not None:
            geom.friction = [shape.friction, *FRICTION[1:]]
            geom.priority = 1  # else a contact has the greater friction of its two shapes
        set_size(spec, geom, f"{name}/{i}", shape)


def set_size(spec: mujoco.MjSpec, geom: mujoco.MjsGeom, name: str, shape: CollisionShape) -> None:
    """Set the size of a geom, and add the mesh or height field that it may need under ``name``."""
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


def _set_surface(
    spec: mujoco.MjSpec, name: str, shapes: Sequence[CollisionShape], physics: PhysicsSpec
) -> None:
    """Set the friction and restitution of an object's shapes."""
    if physics.friction is None and physics.restitution is None:
        return
    for i in range(len(shapes)):
        geom = spec.geom(f"{name}/shape/{i}")
        geom.priority = 1  # else a contact has the greater friction of its two shapes
        if physics.friction is not None:
            geom.friction = [physics.friction, *FRICTION[1:]]
        if physics.restitution is not None:  # negative numbers: stiffness and damping
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
    """Add the child links of a link recursively.

    Args:
        spec: the spec of the scene.
        body: the body of the link.
        robot: the links and joints of the vehicle.
        link: the name of the link.
        index: the index of the vehicle.
        links: the links by name; empty for a kinematic vehicle.
    """
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


def _add_segments(spec: mujoco.MjSpec, scene: SceneSpec) -> None:
    """Add a body without weight and shape for each segment that a force places."""
    for body, _ in segment_names(scene):
        spec.worldbody.add_body(name=body, mocap=True)


def _add_grips(spec: mujoco.MjSpec, inputs: SimulatedScene, objects: Collection[str]) -> None:
    """Add an inactive weld constraint between each object picker's link and each loose object."""
    for index in inputs.dynamics:
        pickers = inputs.scene.vehicles[index].parts_of(ObjectPickerSpec)
        for link in dict.fromkeys(picker.relative_to for picker in pickers):
            if inputs.robots[index].link(link) is None:
                continue
            for name in objects:
                if inputs.scene.objects[int(name.split("/")[1])].joint is not None:
                    continue
                weld = spec.add_equality(
                    name=grip_constraint(index, link, int(name.split("/")[1])),
                    type=mujoco.mjtEq.mjEQ_WELD,
                    objtype=mujoco.mjtObj.mjOBJ_BODY,
                    name1=vehicle_body(index, link),
                    name2=name,
                )
                weld.active = False
                weld.data[10] = 1.0  # the ratio of rotational to translational stiffness


def _add_water(
    spec: mujoco.MjSpec,
    scene: SceneSpec,
    dynamics: Mapping[int, VehicleHydrodynamics],
    object_hydrodynamics: Mapping[str, BodyHydrodynamics],
) -> None:
    bodies: dict[str, BodyHydrodynamics] = dict(object_hydrodynamics)
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
    """Add a body with the mass of a ``link``, or without weight if ``link`` is None."""
    mass, inertia = (1.0, 1.0) if link is None else (MIN_MASS, MIN_INERTIA)
    body = parent.add_body(
        name=name,
        pos=parent_from_body.position.tolist(),
        quat=quaternion_from_rotation(parent_from_body.rotation).tolist(),
        mass=mass,
        inertia=[inertia] * 3,
        ipos=[0.0, 0.0, 0.0],  # else MuJoCo takes the body's position as its centre of mass
    )
    body.explicitinertial = True
    if link is None:
        body.gravcomp = 1.0
    elif link.mass > 0.0:
        body.mass = link.mass
        body.ipos = list(link.centre_of_mass)
        xx, yy, zz, xy, xz, yz = link.inertia
        if min(xx, yy, zz) > 0.0:
            tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            rotation = rotation_from_rpy(*link.inertia_rpy)
            tensor = product(product(rotation, tensor), rotation.T)
            body.fullinertia = [*np.diag(tensor), tensor[0, 1], tensor[0, 2], tensor[1, 2]]
            body.inertia = [0.0, 0.0, 0.0]
    return body
