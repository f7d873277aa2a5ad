"""A floating vehicle and its arm: what one does to the other, and where energy can come from."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib import resources
from pathlib import Path

import mujoco
import numpy as np

from tests.simulation.girona500 import SCENE, position, run
from tests.support.opened import open_scene
from uwsim.messages import Float64MultiArray, JointState, MultiArrayLayout, header
from uwsim.physics.hydrodynamics import columns as c
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec

VEHICLES = Path(str(resources.files("uwsim"))) / "data" / "vehicles"
INTERFACES = (
    ROSJointStateToArmSpec(topic="/arm", vehicle_name="girona500"),
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name="girona500"),
)
JOINTS = ["Slew", "Shoulder", "Elbow", "JawRotate", "JawOpening"]


def adrift(tmp_path: Path, *, has_drag: bool) -> Simulation:
    """A vehicle without thrust, deep in still water, with a drag or without any."""
    folder = tmp_path
    (folder / "parts").mkdir(parents=True)
    for name in ("g500_physical.xml", "parts/arm5e.xml"):
        text = (VEHICLES / name).read_text()
        if not has_drag:
            text = re.sub(r"<(linear|quadratic)Damping>.*?</\1Damping>", "", text)
        (folder / name.replace("g500_physical", "adrift")).write_text(text)
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], parts=(), dynamics="adrift")
    simulation = open_scene(
        replace(
            scene,
            vehicles=(vehicle,),
            objects=(),
            ros_interfaces=INTERFACES,
            path=str(folder / "scene.xml"),
        )
    )
    simulation.advance(0.0)
    still = Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.zeros(5))
    simulation.bus.publisher("/thrusters", Float64MultiArray)(still)
    return simulation


def command(simulation: Simulation, **given: list[float]) -> None:
    arrays = {name: np.array(given.get(name, [])) for name in ("position", "velocity", "effort")}
    message = JointState(header=header(0.0), name=JOINTS, **arrays)
    simulation.bus.publisher("/arm", JointState)(message)


def momentum(simulation: Simulation) -> np.ndarray:
    """Linear momentum of vehicle, arm and the water that they set in motion, in W (3,) [N s].

    The first three coordinates move everything along the axes of W: what belongs to them in
    M qvel, where M has the added mass, is the momentum of the whole.
    """
    model, data = simulation.world.engine._model, simulation.world.engine._data
    now = mujoco.MjData(model)
    mujoco.mj_copyData(now, model, data)
    mujoco.mj_forward(model, now)
    found = np.zeros(model.nv)
    mujoco.mj_mulM(model, now, found, now.qvel.copy())
    return found[:3]


def energy(simulation: Simulation) -> float:
    """Kinetic energy, the water's included, and potential energy of weight and buoyancy [J]."""
    model, data = simulation.world.engine._model, simulation.world.engine._data
    now = mujoco.MjData(model)
    mujoco.mj_copyData(now, model, data)
    mujoco.mj_forward(model, now)
    moved = np.zeros(model.nv)
    mujoco.mj_mulM(model, now, moved, now.qvel.copy())
    total = 0.5 * float(now.qvel @ moved)
    g = -float(model.opt.gravity[2])
    for body in range(1, model.nbody):
        total += float(model.body_mass[body]) * g * float(now.xipos[body, 2])
        row = model.body_user[body]
        if row[c.DISPLACED_MASS] > 0.0:
            centre = row[c.REFERENCE : c.REFERENCE + 3] + row[c.CENTRE : c.CENTRE + 3]
            at = now.xpos[body] + now.xmat[body].reshape(3, 3) @ centre
            total -= float(row[c.DISPLACED_MASS]) * g * float(at[2])
    return total


def test_an_arm_that_moves_moves_the_vehicle_and_the_momentum_of_the_whole_is_kept(
    tmp_path: Path,
) -> None:
    simulation = adrift(tmp_path, has_drag=False)
    run(simulation, 0.1)
    before, start = momentum(simulation), position(simulation)
    sizes, moved = [], []
    command(simulation, position=[-0.8, 1.2, 0.6, 0.0, 0.8])
    for _ in range(30):
        run(simulation, 0.1)
        sizes.append(momentum(simulation) - before)
        moved.append(np.linalg.norm(position(simulation)[:2] - start[:2]))
    arm = 28.0 * 0.3  # kg of links and water, at the speed of a joint of 1 rad/s and a lever
    assert max(moved) > 0.02
    assert np.abs(np.array(sizes)[:, :2]).max() < 0.01 * arm  # in z weight and buoyancy differ


def test_a_limp_arm_in_still_water_gains_no_energy(tmp_path: Path) -> None:
    simulation = adrift(tmp_path, has_drag=True)
    command(simulation, effort=[0.0] * 5)
    run(simulation, 0.01)
    found, joints = [energy(simulation)], simulation.world.engine.joints(0)
    for _ in range(40):
        run(simulation, 0.05)
        found.append(energy(simulation))
    assert np.abs(simulation.world.engine.joints(0) - joints).max() > 0.5
    assert found[0] - found[-1] > 10.0  # J; it has fallen through the water
    assert np.diff(found).max() < 1e-3
