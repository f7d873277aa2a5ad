"""Small models in water for the tests of this room."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import mujoco
import numpy as np

from uwsim.base.geometry import Pose, rotation_about
from uwsim.physics.hydrodynamics import prepare
from uwsim.scene.hydrodynamics import BodyHydrodynamics, FinSpec, ThrusterSpec, VehicleHydrodynamics
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.urdf.reader import read_urdf

FAR_BELOW = 1000.0  # a surface that nothing reaches [m]


def free_body(
    water: BodyHydrodynamics,
    *,
    mass: float,
    inertia: tuple[float, ...] = (1.0, 1.0, 1.0),
    centre_of_mass: tuple[float, float, float] = (0.0, 0.0, 0.0),
    thrusters: Mapping[str, ThrusterSpec] | None = None,
    fins: Mapping[str, FinSpec] | None = None,
    surface: float = FAR_BELOW,
    density: float = 1000.0,
    timestep: float = 0.002,
    integrator: str = "implicitfast",
    gravity: float = 9.81,
) -> mujoco.MjModel:
    """Compile one free body called "body"."""
    spec = mujoco.MjSpec()
    set_options(spec, timestep=timestep, integrator=integrator, gravity=gravity)
    body = spec.worldbody.add_body(name="body", mass=mass, ipos=list(centre_of_mass))
    if len(inertia) == 3:
        body.inertia = list(inertia)
    else:
        body.fullinertia = list(inertia)
    body.explicitinertial = True
    body.add_freejoint()
    propellers = {name: ("body", one) for name, one in (thrusters or {}).items()}
    foils = {name: ("body", one) for name, one in (fins or {}).items()}
    prepare(spec, {"body": water}, propellers, foils, surface=surface, density=density)
    return spec.compile()


def set_options(
    spec: mujoco.MjSpec,
    *,
    timestep: float = 0.002,
    integrator: str = "implicitfast",
    gravity: float = 9.81,
) -> None:
    spec.option.timestep = timestep
    spec.option.integrator = {
        "RK4": mujoco.mjtIntegrator.mjINT_RK4,
        "Euler": mujoco.mjtIntegrator.mjINT_EULER,
        "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
        "discrete": mujoco.mjtIntegrator.mjINT_DISCRETE,
    }[integrator]
    spec.option.gravity = [0.0, 0.0, -gravity]


def random_added_mass(rng: np.random.Generator, scale: float = 1.0) -> tuple[float, ...]:
    """Symmetric positive definite, full, 36 numbers."""
    root = rng.normal(size=(6, 6))
    full = scale * (root @ root.T / 6 + 0.5 * np.eye(6))
    return tuple(float(value) for value in full.ravel())


DATA = Path(__file__).parents[2] / "src" / "uwsim" / "data"
ROBOTS = {
    "bluerov2_heavy": DATA / "vehicles" / "bluerov2_heavy.urdf",
    "g500_physical": DATA / "scenes" / "g500ARM5.urdf",
    "remus100": DATA / "vehicles" / "remus100.urdf",
    "rexrov": DATA / "vehicles" / "rexrov.urdf",
    "uwsim_compat": DATA / "scenes" / "g500ARM5.urdf",
}


def bundled(
    name: str,
    *,
    only_base: bool = False,
    z_down: bool = True,
    rail: tuple[float, ...] | None = None,
    held: tuple[float, ...] = (0.0, 0.0, 2.15, 0.0, 0.0, 0.0),
    timestep: float = 0.002,
    gravity: float = 9.81,
) -> tuple[mujoco.MjModel, VehicleHydrodynamics]:
    """Compile a bundled set with its robot, the arm's joints held fast at ``held``.

    With ``z_down`` the vehicle begins turned by half a turn about x: its z points down in W. On a
    ``rail`` it may only move along that direction of its own.
    """
    robot = read_urdf(ROBOTS[name])
    vehicle = read_vehicle(vehicle_sets()[name], [link.name for link in robot.links])
    spec = mujoco.MjSpec()
    set_options(spec, timestep=timestep, gravity=gravity)
    quat = [0.0, 1.0, 0.0, 0.0] if z_down else [1.0, 0.0, 0.0, 0.0]
    nodes = {robot.root: spec.worldbody.add_body(name=robot.root, quat=quat)}
    if rail is None:
        nodes[robot.root].add_freejoint()
    else:
        nodes[robot.root].add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=list(rail))
    angles = iter(held)
    for joint in () if only_base else robot.joints:
        pose = Pose.from_rpy(joint.position, joint.rpy)
        angle = next(angles) if joint.moves else 0.0
        turn = Pose(np.zeros(3), rotation_about(np.array(joint.axis), angle))
        placed = pose @ turn
        nodes[joint.child] = nodes[joint.parent].add_body(
            name=joint.child, pos=placed.position.tolist(), quat=placed.quaternion.tolist()
        )
    prepare(
        spec,
        {body.link: body for body in vehicle.bodies if body.link in nodes},
        {one.name: (one.link, one) for one in vehicle.thrusters},
        {one.name: (one.link, one) for one in vehicle.fins},
        surface=FAR_BELOW,
        density=vehicle.density,
    )
    return spec.compile(), vehicle
