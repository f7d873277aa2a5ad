"""Rigid bodies in water: DESIGN 9's steps per second, its cost over the dry engine, and a soak.

Run ``python benchmarks/physics.py``. Scenes: a free vehicle with five joints and jaws that holds a
box between its pads in mid-water (eight contacts), the same without a box, and with the box lying
on the floor; the fourth is the bundled Girona 500 with its ARM5E over a box that lies on the mesh
of the CIRS tank. Water on every body, 2 ms, one core. A dry engine step is the same model with the
callback removed. Targets: at least 60 000 steps/s in all; with water at most 1.35 times the dry
step.

The public `Simulation` in scenes that grow: see `steps.py`.

Accuracy: the fall of a thin tag against DOP853, and the gain of energy of a tumbling box.

The soak (``--soak``, minutes): 64 simulations of 30 s with random thrust, joint targets, jaws and
currents above a floor with a loose box at 2, 5 and 10 ms: no NaN, no warning of the engine, and a
median path of the vehicles above 2 m.
"""

from __future__ import annotations

import copy
import sys
import time
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from statistics import median

import mujoco
import numpy as np
import steps
from measure import main
from mujoco import batch

from uwsim.physics.compile_scene import compile_scene
from uwsim.physics.hydrodynamics import callback, prepare
from uwsim.physics.hydrodynamics.columns import WATER_COLUMNS
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, ThrusterSpec
from uwsim.scene.object import PhysicsSpec
from uwsim.scene.reader import read_scene

STEPS_PER_SECOND, RATIO = 60_000, 1.35
BATCHES, STEPS = 15, 4000
TAG_FALL = 1.6089  # by scipy's DOP853 [m]
N_SOAK, SOAK_SECONDS, MIN_PATH = 64, 30.0, 2.0  # [1], [s], [m]
BOX = (0.15, 0.10, 0.075)  # half-edges [m]
ARM = (("slew", (0, 0, 1), 0.05), ("shoulder", (0, 1, 0), 0.35), ("elbow", (0, 1, 0), 0.30),
       ("wrist", (0, 1, 0), 0.12), ("roll", (0, 0, 1), 0.10))  # fmt: skip
NEUTRAL_FACTORS = {"added": 1.0, "drag": 1.0}


def cylinder_water(link: str, radius: float, length: float, mass: float) -> BodyHydrodynamics:
    """Return the hydrodynamics of a cylinder along z by strip theory."""
    transverse_mass = 1000.0 * np.pi * radius**2 * length
    rotational_inertia = transverse_mass * length**2 / 12
    drag = 0.5 * 1000.0 * 1.1 * 2 * radius * length
    return BodyHydrodynamics(
        link=link,
        reference=(0.0, 0.0, length / 2),
        added_mass=(
            transverse_mass,
            transverse_mass,
            0.1 * transverse_mass,
            rotational_inertia,
            rotational_inertia,
            0.001,
        ),
        quadratic_damping=(drag, drag, 0.2 * drag, 0.1 * drag, 0.1 * drag, 0.01),
        volume=0.5 * mass / 1000.0,
        centre_of_buoyancy=(0.0, 0.0, length / 2),
        implicitness=1.0,
    )


def compile_model(
    box: str, *, timestep: float = 0.002, neutral_arm: bool = False
) -> mujoco.MjModel:
    """Compile a vehicle with arm and, on the ``floor`` or in the ``grasp``, a box; or ``none``."""
    spec = mujoco.MjSpec()
    spec.option.timestep = timestep
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 10.0
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[50, 50, 0.1], pos=[0, 0, -3])
    base = spec.worldbody.add_body(name="base", mass=150, ipos=[0, 0, -0.05], inertia=[24, 28, 19])
    base.explicitinertial = True
    base.add_freejoint()
    base.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.7, 0.45, 0.4], contype=2, conaffinity=1)
    waters = {
        "base": BodyHydrodynamics(
            link="base",
            added_mass=(25.0, 230, 230, 20, 32, 32),
            linear_damping=(30.0, 60, 60, 20, 20, 20),
            quadratic_damping=(230.0, 450, 500, 60, 80, 80),
            volume=0.159,
            centre_of_buoyancy=(0.0, 0.0, 0.2),
            shape="box",
            size=(1.4, 0.9, 0.8),
        )
    }
    node, place = base, [0.4, 0.0, -0.45]
    quaternion = [0.0, 1.0, 0.0, 0.0]  # z of the arm points down
    for name, axis, length in ARM:
        node = node.add_body(
            name=name, pos=place, quat=quaternion, mass=3.0, ipos=[0, 0, length / 2]
        )
        node.inertia = [0.03, 0.03, 0.01]
        node.explicitinertial = True
        node.add_joint(name=name, axis=list(axis), armature=0.05)
        joint = node.joints[0]
        joint.range, joint.limited = [-1.5, 1.5], mujoco.mjtLimited.mjLIMITED_TRUE
        servo = spec.add_actuator(name=name, target=name)
        servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
        servo.set_to_position(kp=400.0, kv=60.0)
        waters[name] = cylinder_water(name, 0.045, length, 3.0)
        place, quaternion = [0.0, 0.0, length], [1.0, 0.0, 0.0, 0.0]
    for name, side in (("left", 1.0), ("right", -1.0)):
        jaw = node.add_body(name=name, pos=[0.0, side * (BOX[1] + 0.02), 0.2], mass=0.5,
                            ipos=[0, 0, 0], inertia=[0.001] * 3)  # fmt: skip
        jaw.explicitinertial = True
        jaw.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, -side, 0],
                      range=[-0.1, 0.15], limited=mujoco.mjtLimited.mjLIMITED_TRUE)  # fmt: skip
        jaw.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.04, 0.01, 0.04], condim=4,
                     friction=[0.8, 0.01, 0.001], solimp=[0.95, 0.99, 0.001, 0.5, 2])  # fmt: skip
        clamp = spec.add_actuator(name=name, target=name)
        clamp.trntype = mujoco.mjtTrn.mjTRN_JOINT
        clamp.set_to_motor()
        clamp.ctrlrange, clamp.ctrllimited = [-80, 80], mujoco.mjtLimited.mjLIMITED_TRUE
        waters[name] = BodyHydrodynamics(
            link=name, added_mass=(0.1, 0.3, 0.1, 0.001, 0.001, 0.001), volume=0.0002,
            quadratic_damping=(2.0, 5.0, 2.0, 0.002, 0.002, 0.002), implicitness=1.0,
        )  # fmt: skip
    if box != "none":
        grasp_position = (0.4, 0.0, -0.45 - sum(length for *_, length in ARM) - 0.2)
        body = spec.worldbody.add_body(
            name="box", pos=grasp_position if box == "grasp" else (1.5, 0.3, -2.925), mass=14.2,
            ipos=[0, 0, 0], inertia=[0.08, 0.15, 0.19],
        )  # fmt: skip
        body.explicitinertial = True
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=list(BOX), condim=4,
                       friction=[0.8, 0.01, 0.001])  # fmt: skip
        waters["box"] = BodyHydrodynamics(
            link="box", added_mass=(4.0, 6, 9, 0.05, 0.08, 0.05), volume=0.009,
            quadratic_damping=(15.0, 25, 35, 0.3, 0.5, 0.4), shape="box",
            size=(0.3, 0.2, 0.15), implicitness=1.0,
        )  # fmt: skip
    places = (((-0.4, 0.3, 0), (1, 0, 0)), ((-0.4, -0.3, 0), (1, 0, 0)), ((0.5, 0, 0), (0, 0, 1)),
              ((-0.5, 0, 0), (0, 0, 1)), ((0, 0, 0), (0, 1, 0)))  # fmt: skip
    thrusters = {
        f"thruster{i}": ("base", ThrusterSpec(
            name=f"thruster{i}", link="base", position=position, direction=direction,
            forward=(0.0, 140.0), time_constant=0.2))
        for i, (position, direction) in enumerate(places)
    }  # fmt: skip
    prepare(spec, waters, thrusters, surface=5.0)
    return spec.compile()


def settle_model(box: str) -> tuple[mujoco.MjModel, Hydrodynamics, mujoco.MjData]:
    model = compile_model(box)
    water, data = install(model), mujoco.MjData(model)
    for jaw in ("left", "right"):
        data.ctrl[model.actuator(jaw).id] = 80.0 if box == "grasp" else 0.0
    water.set_thrusters(data, [0.3, 0.3, 0.1, 0.1, 0.1])
    water.set_current(data, (0.1, 0.2, 0.0))
    water.step(data, 300)
    return model, water, data


def settle_tank_model() -> tuple[mujoco.MjModel, Hydrodynamics, mujoco.MjData]:
    path = Path(str(files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"
    scene = read_scene(path).nominal_scene
    tank, box = scene.objects
    box = replace(box, is_solid=None)
    tank = replace(tank, physics=PhysicsSpec(mass=0.0, collision_shape_type="trimesh"))
    box = replace(box, orientation=(0.0, 0.0, 0.0), physics=PhysicsSpec(mass=10.0))
    scene = replace(scene, objects=(tank, box))
    model = copy.copy(compile_scene(scene).engine_model)
    water, data = install(model), mujoco.MjData(model)
    water.set_current(data, (0.1, 0.2, 0.0))
    water.step(data, 300)
    return model, water, data


def measure_step_us(model: mujoco.MjModel, data: mujoco.MjData) -> list[float]:
    """Measure CPU microseconds of a step by batch, always from the same state."""
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    costs = []
    for _ in range(BATCHES):
        cpu_time = 0.0
        for _ in range(STEPS // 200):
            mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
            start_time = time.process_time()
            mujoco.mj_step(model, data, 200)
            cpu_time += time.process_time() - start_time
        costs.append(cpu_time * 1e6 / STEPS)
    return costs


def measure_speeds() -> dict[str, object]:
    figures: dict[str, object] = {}
    for box in ("none", "floor", "grasp", "tank"):
        model, _, data = settle_tank_model() if box == "tank" else settle_model(box)
        contacts = int(data.ncon)
        water_costs = measure_step_us(model, data)
        callback.remove()
        dry_costs = measure_step_us(model, data)
        callback.install()
        figures[f"box: {box}"] = {
            "dof": int(model.nv),
            "contacts": contacts,
            "with_water_us": round(median(water_costs), 2),
            "with_water_us_best": round(min(water_costs), 2),
            "dry_us": round(median(dry_costs), 2),
            "dry_us_best": round(min(dry_costs), 2),
            "ratio": round(median(water_costs) / median(dry_costs), 3),
            "ratio_best": round(min(water_costs) / min(dry_costs), 3),
            "target_ratio": RATIO,
            "steps_per_s": round(1e6 / median(water_costs)),
            "steps_per_s_best": round(1e6 / min(water_costs)),
            "target_steps_per_s": STEPS_PER_SECOND,
        }
    return figures


def run_soak() -> dict[str, object]:
    figures: dict[str, object] = {}
    for timestep in (0.002, 0.005, 0.010):
        model = compile_model("floor", timestep=timestep)
        install(model)
        pool = batch.Batch(model, N_SOAK, 2)
        rng = np.random.Generator(np.random.Philox(7))
        hold = round(1.0 / timestep)
        path_lengths = np.zeros(N_SOAK)
        last_positions = pool.qpos[:, :3].copy()
        max_speed = 0.0
        n_servos = len(ARM)
        for _ in range(round(SOAK_SECONDS)):
            pool.ctrl[:, :n_servos] = rng.uniform(-1.2, 1.2, (N_SOAK, n_servos))
            pool.ctrl[:, n_servos : n_servos + 2] = rng.uniform(-80, 80, (N_SOAK, 2))
            pool.ctrl[:, n_servos + 2 :] = rng.uniform(-1.0, 1.0, (N_SOAK, 5))
            water = pool.userdata[:, : WATER_COLUMNS * model.nbody]
            water = water.reshape(N_SOAK, model.nbody, WATER_COLUMNS)
            water[:, :, 0:3] = rng.uniform(-0.5, 0.5, (N_SOAK, 1, 3))
            for _ in range(10):
                pool.step(nstep=hold // 10)
                path_lengths += np.linalg.norm(pool.qpos[:, :3] - last_positions, axis=1)
                last_positions = pool.qpos[:, :3].copy()
                max_speed = max(max_speed, float(np.abs(pool.qvel).max()))
        figures[f"{timestep * 1e3:g} ms"] = {
            "simulations": N_SOAK,
            "seconds": SOAK_SECONDS,
            "not_finite": int((~np.isfinite(pool.state).all(axis=1)).sum()),
            "warnings": int(np.asarray(pool.warning).sum()),
            "fastest_m_or_rad_per_s": round(max_speed, 2),
            "median_path_m": round(float(np.median(path_lengths)), 2),
            "least_path_m": round(float(path_lengths.min()), 2),
            "target_median_path_m": MIN_PATH,
        }
    return figures


def compile_single_body(
    water: BodyHydrodynamics, mass: float, inertia: tuple[float, float, float], timestep: float
) -> tuple[Hydrodynamics, mujoco.MjData]:
    spec = mujoco.MjSpec()
    spec.option.timestep = timestep
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    body = spec.worldbody.add_body(name="body", mass=mass, ipos=[0, 0, 0], inertia=list(inertia))
    body.explicitinertial = True
    body.add_freejoint()
    prepare(spec, {"body": water}, surface=1000.0)
    model = spec.compile()
    return install(model), mujoco.MjData(model)


def drop_tag(timestep: float) -> dict[str, float]:
    """Return the fall in 3 s of a steel tag, 10 x 10 x 0.2 cm, dropped at a tilt of 30 degrees."""
    water = BodyHydrodynamics(
        link="body", added_mass=(3e-4, 3e-4, 0.6329, 3.249e-4, 3.249e-4, 0.0), volume=2e-5,
        quadratic_damping=(0.105, 0.105, 5.25, 1.64e-4, 1.64e-4, 6.56e-6), implicitness=1.0,
    )  # fmt: skip
    inertia = (0.157 / 12 * 0.010004, 0.157 / 12 * 0.010004, 0.157 / 12 * 0.02)
    hydrodynamics, data = compile_single_body(water, 0.157, inertia, timestep)
    data.qpos[3:] = np.cos(np.pi / 12), 0.0, np.sin(np.pi / 12), 0.0
    hydrodynamics.step(data, round(3.0 / timestep))
    return {"fall_m": round(-float(data.qpos[2]), 4), "dop853_m": TAG_FALL}


def tumble_box(timestep: float) -> dict[str, float]:
    """Return the gain of energy in 10 s of a neutral box without drag at 3.2 rad/s."""
    added_mass, inertia = np.array([4.0, 20, 30, 0.3, 0.02, 0.1]), (0.08, 0.15, 0.19)
    water = BodyHydrodynamics(link="body", added_mass=tuple(added_mass.tolist()), volume=0.0142)
    hydrodynamics, data = compile_single_body(water, 14.2, inertia, timestep)
    total_mass = added_mass + np.array([14.2] * 3 + list(inertia))
    data.qvel[:] = start_twist = np.array([0.3, -0.2, 0.4, 2.0, 2.2, 1.1])
    hydrodynamics.step(data, round(10.0 / timestep))
    mujoco.mj_kinematics(hydrodynamics.model, data)
    twist = data.qvel.copy()
    twist[:3] = data.xmat[1].reshape(3, 3).T @ twist[:3]
    gain = float((twist * twist) @ total_mass / ((start_twist * start_twist) @ total_mass)) - 1.0
    return {"energy_gain_percent": 100.0 * gain, "target_percent": 0.5}


def measure_accuracy() -> dict[str, object]:
    return {
        f"{name} {timestep * 1e3:g} ms": case(timestep)
        for name, case in (("tag", drop_tag), ("tumbling box", tumble_box))
        for timestep in (0.002, 0.005, 0.010)
    }


def measure() -> dict[str, object]:
    figures_by_part: dict[str, object] = {
        "speed": measure_speeds(),
        "simulation": steps.measure_scenes(),
        "accuracy": measure_accuracy(),
    }
    return figures_by_part | {"soak": run_soak()} if SOAK else figures_by_part


if __name__ == "__main__":
    SOAK = "--soak" in sys.argv
    if SOAK:
        sys.argv.remove("--soak")
    main(measure)
