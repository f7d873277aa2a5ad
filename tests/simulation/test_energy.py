"""The power of a vehicle with dynamics, against closed forms of its rotors, arm and faults."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.simulation.girona500 import make, run
from uwsim.benchmark.measures import Energy, EnergySpec
from uwsim.devices.fault import FaultSpec
from uwsim.errors import UnknownName
from uwsim.messages import Float64MultiArray, JointState, MultiArrayLayout, header
from uwsim.physics.actuation.power import power_table
from uwsim.physics.actuation.power_kernel import joint_power, thruster_power
from uwsim.physics.joints import servo_gains
from uwsim.scene.hydrodynamics import VehicleHydrodynamics
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec

NAME = "girona500"
INTERFACES = (
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name=NAME),
    ROSJointStateToArmSpec(topic="/arm", vehicle_name=NAME),
    ArmToROSJointStateSpec(topic="/joints", vehicle_name=NAME, rate=500),
)
LAG = 0.2  # of every rotor [s]


@pytest.fixture(scope="module")
def vehicle() -> VehicleHydrodynamics:
    return read_vehicle(vehicle_sets()["g500_physical"])


def thrust(simulation: Simulation, *values: float) -> None:
    simulation.bus.publisher("/thrusters", Float64MultiArray)(
        Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.array(values))
    )


def bend(simulation: Simulation, **given: list[float]) -> None:
    arrays = {kind: np.array(given.get(kind, [])) for kind in ("position", "velocity", "effort")}
    simulation.bus.publisher("/arm", JointState)(
        JointState(header=header(0.0), name=["Slew"], **arrays)
    )


def start(simulation: Simulation, **given: float) -> Energy:
    energy = EnergySpec(name="e", target=NAME, **given).bind(simulation.world.measure_view)  # type: ignore[arg-type]
    energy.start()
    return energy


def go_on(simulation: Simulation, energy: Energy, seconds: float) -> None:
    for _ in range(round(seconds / simulation.timestep)):
        simulation.advance()
        energy.update()


def cubed(seconds: float) -> float:
    """Integral of the cube of a rotor's state that rises to 1 with its lag [s]."""
    e = [math.exp(-n * seconds / LAG) for n in range(4)]
    return seconds - 3 * LAG * (1 - e[1]) + 1.5 * LAG * (1 - e[2]) - LAG / 3 * (1 - e[3])


def test_rotors_that_run_up_draw_the_closed_form(vehicle: VehicleHydrodynamics) -> None:
    simulation = make(INTERFACES)
    thrust(simulation, 0.5, -0.25, 0.0, 0.0, 0.0)
    energy = start(simulation)
    go_on(simulation, energy, 2.0)
    turned = 2.0 - simulation.timestep  # delivered in the first step, acts in the second
    power = partial(thruster_power, power_table(vehicle.thrusters[0], vehicle.density))
    for name, command in (("surge_port", 0.5), ("surge_starboard", 0.25)):
        spent = energy.details[f"thruster.{name}"]
        assert spent == pytest.approx(power(140.0 * command**2) * cubed(turned), rel=1e-4)
    assert energy.details["thruster.sway"] == pytest.approx(0.0, abs=1e-9)


def test_a_constant_thrust_draws_its_power_times_time(vehicle: VehicleHydrodynamics) -> None:
    simulation = make(INTERFACES)
    thrust(simulation, 0.4, 0.4, 0.0, 0.0, 0.0)
    run(simulation, 5.0)
    energy = start(simulation, hotel_load=50.0)
    go_on(simulation, energy, 1.0)
    power = partial(thruster_power, power_table(vehicle.thrusters[0], vehicle.density))(
        140.0 * 0.16
    )
    assert energy.details["thrusters"] == pytest.approx(2.0 * power, rel=1e-9)
    assert energy.details["hotel"] == pytest.approx(50.0)
    assert energy.value == pytest.approx(2.0 * power + 50.0 + energy.details["joints"])


def test_energy_is_the_integral_of_the_published_thrusts_and_efforts(
    vehicle: VehicleHydrodynamics,
) -> None:
    simulation = make(INTERFACES)
    thrust(simulation, 0.5, 0.3, 0.2, 0.1, -0.4)
    bend(simulation, velocity=[-0.3])
    told = simulation.bus.inbox("/joints", JointState)
    run(simulation, 0.5)
    before = told.take()[-1].velocity
    energy = start(simulation)
    actuators = simulation.world.vehicles.actuators(NAME)
    assert actuators is not None
    laws = [partial(thruster_power, power_table(one, vehicle.density)) for one in vehicle.thrusters]
    drawn = [[law(t) for law, t in zip(laws, actuators.thrusts(), strict=True)]]  # [W]
    works = np.zeros(5)  # [J]
    dampings = np.array(
        [servo_gains(one)[1] for one in simulation.world.model.robots[0].movable_joints]
    )
    for _ in range(1500):
        simulation.advance()
        energy.update()
        drawn.append([law(t) for law, t in zip(laws, actuators.thrusts(), strict=True)])
        (state,) = told.take()
        # a servo's damping acts on the speed at the end of a step, what is told on that before it
        efforts = state.effort - dampings * (state.velocity - before)
        before = state.velocity
        own = dict(zip(actuators.joints, actuators.efforts(), strict=True))
        assert [own[name] for name in state.name] == pytest.approx(efforts, abs=1e-9)
        for i, name in enumerate(state.name):
            drive = vehicle.drive(name)
            power = joint_power(drive.efficiency, drive.copper_loss, efforts[i], state.velocity[i])
            works[i] += power * simulation.timestep
    thrusters = np.trapezoid(np.array(drawn), dx=simulation.timestep, axis=0)
    for name, expected in zip(actuators.thrusters, thrusters, strict=True):
        assert energy.details[f"thruster.{name}"] == pytest.approx(expected, rel=1e-12)
    for name, expected in zip(state.name, works, strict=True):
        assert energy.details[f"joint.{name}"] == pytest.approx(expected, rel=0.01, abs=1e-3)
    assert energy.details["joint.Slew"] > 0.05


def test_a_dead_thruster_draws_nothing_and_half_a_thruster_a_third(
    vehicle: VehicleHydrodynamics,
) -> None:
    def broken(spec: VehicleSpec) -> VehicleSpec:
        dead = FaultSpec(thruster="surge_port")
        half = FaultSpec(thruster="surge_starboard", loss=0.5)
        return replace(spec, parts=(dead, half))

    simulation = make(INTERFACES, change=broken)
    thrust(simulation, 0.4, 0.4, 0.0, 0.0, 0.0)
    run(simulation, 5.0)
    energy = start(simulation)
    go_on(simulation, energy, 1.0)
    power = partial(thruster_power, power_table(vehicle.thrusters[0], vehicle.density))(
        140.0 * 0.16
    )
    assert energy.details["thruster.surge_port"] == 0.0
    assert energy.details["thruster.surge_starboard"] == pytest.approx(power * 0.5**1.5, rel=1e-9)


def test_a_joint_held_against_gravity_draws_its_copper_loss_alone(
    vehicle: VehicleHydrodynamics,
) -> None:
    simulation = make(INTERFACES)
    run(simulation, 15.0)  # hangs still, the autopilot holds the vehicle
    energy = start(simulation)
    go_on(simulation, energy, 1.0)
    actuators = simulation.world.vehicles.actuators(NAME)
    assert actuators is not None
    effort = dict(zip(actuators.joints, actuators.efforts(), strict=True))["Shoulder"]
    assert abs(effort) > 10.0
    loss = vehicle.drive("Shoulder").copper_loss * effort**2
    assert energy.details["joint.Shoulder"] == pytest.approx(loss, rel=0.01)


def test_a_joint_that_is_pushed_draws_for_the_commanded_effort(
    vehicle: VehicleHydrodynamics,
) -> None:
    simulation = make(INTERFACES)
    told = simulation.bus.inbox("/joints", JointState)
    bend(simulation, effort=[-3.0])
    run(simulation, 0.1)
    actuators = simulation.world.vehicles.actuators(NAME)
    assert actuators is not None
    slew = actuators.joints.index("Slew")
    assert actuators.efforts()[slew] == pytest.approx(-3.0)
    state = told.take()[-1]
    speed = state.velocity[state.name.index("Slew")]
    assert speed < 0.0
    drawn = actuators.powers()[len(actuators.thrusters) + slew]
    assert drawn == pytest.approx(3.0 * -speed / 0.5 + 0.01 * 9.0)


def test_a_thruster_half_out_of_the_water_draws_for_the_thrust_it_has_left() -> None:
    powers, thrusts = [], []
    for depth in (-0.363, 1.5):  # of the vehicle: its surge thrusters are 0.363 m deeper
        simulation = make(
            INTERFACES, change=lambda spec, z=depth: replace(spec, position=(3.0, 1.5, z))
        )
        thrust(simulation, 1.0, 1.0, 0.0, 0.0, 0.0)
        run(simulation, 0.04)
        actuators = simulation.world.vehicles.actuators(NAME)
        assert actuators is not None
        powers.append(actuators.powers()[0])
        thrusts.append(actuators.thrusts()[0])
    assert thrusts[0] / thrusts[1] == pytest.approx(0.5, abs=0.05)
    assert powers[0] / powers[1] == pytest.approx((thrusts[0] / thrusts[1]) ** 1.5)


def test_reading_what_is_drawn_changes_nothing() -> None:
    still, watched = make(INTERFACES), make(INTERFACES)
    energy = start(watched)
    for simulation in (still, watched):
        thrust(simulation, 0.5, 0.3, 0.2, 0.1, -0.4)
    run(still, 1.0)
    go_on(watched, energy, 1.0)
    poses = [s.world.bodies.find(NAME).world_from_body.position.tolist() for s in (still, watched)]
    assert poses[0] == poses[1]


def test_a_vehicle_that_is_not_simulated_has_no_actuators_and_an_unknown_one_is_named() -> None:
    simulation = make(change=lambda spec: replace(spec, dynamics=None))
    assert simulation.world.vehicles.actuators(NAME) is None
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        simulation.world.vehicles.actuators("girona50")
