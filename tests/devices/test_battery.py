"""A battery is drained by what the motors draw, and motor currents are their power per volt."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import make
from uwsim.benchmark.measures import EnergySpec
from uwsim.checks import model_warnings
from uwsim.devices.battery import BatterySpec
from uwsim.devices.motor_currents import MotorCurrentsSpec
from uwsim.messages import BatteryState, Float64MultiArray, JointState, MultiArrayLayout
from uwsim.simulation import Simulation
from uwsim.topics.sensor_topic import BatteryToROSSpec, MotorCurrentsToROSSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec

NAME = "girona500"
BATTERY = BatterySpec(name="battery", capacity=100.0, voltage=50.0)
CURRENTS = MotorCurrentsSpec(name="currents", voltage=50.0)
TOPICS = (
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name=NAME),
    BatteryToROSSpec(name="battery", topic="/battery", rate=10),
    MotorCurrentsToROSSpec(name="currents", topic="/currents", rate=10),
)


def vehicle(
    battery: BatterySpec = BATTERY, currents: MotorCurrentsSpec = CURRENTS, **changes: object
) -> Simulation:
    topics = TOPICS if changes.get("dynamics", "") is not None else TOPICS[1:]
    return make(
        topics,
        change=lambda spec: replace(spec, parts=(battery, currents), **changes),  # type: ignore[arg-type]
    )


def after(simulation: Simulation, seconds: float) -> BatteryState:
    simulation.latest_message("/battery")
    simulation.advance(seconds)
    return simulation.latest_message("/battery")


def test_a_constant_load_drains_it_by_power_times_time() -> None:
    """3600 W for 0.5 s of 100 Wh: 0.5 %."""
    battery = replace(BATTERY, hotel_load=3600.0)
    with vehicle(battery, dynamics=None) as simulation:
        message = after(simulation, 0.5)
    assert message.percentage == pytest.approx(0.995, rel=1e-9)
    assert message.charge == pytest.approx(0.995 * 2.0)
    assert (message.capacity, message.voltage, message.current) == (2.0, 50.0, -72.0)
    assert math.isnan(message.temperature)
    assert (message.present, message.header.frame_id) == (True, "battery")


def test_a_resistance_lowers_the_voltage_and_costs_charge() -> None:
    battery = replace(BATTERY, hotel_load=400.0, resistance=1.0)
    with vehicle(battery, dynamics=None) as simulation:
        message = after(simulation, 0.5)
    assert message.voltage == pytest.approx(40.0)  # 10 A over 1 ohm
    assert message.current == pytest.approx(-10.0)
    assert message.voltage * -message.current == pytest.approx(400.0)
    assert message.charge == pytest.approx(2.0 - 10.0 * 0.5 / 3600.0)


def test_a_load_beyond_what_it_can_feed_draws_the_most() -> None:
    battery = replace(BATTERY, hotel_load=1e4, resistance=1.0)
    with vehicle(battery, dynamics=None) as simulation:
        assert after(simulation, 0.1).current == pytest.approx(-25.0)


def test_an_empty_battery_stays_empty() -> None:
    battery = replace(BATTERY, hotel_load=36000.0, charge=0.001)
    with vehicle(battery, dynamics=None) as simulation:
        assert after(simulation, 0.5).percentage == 0.0


@pytest.mark.parametrize("stops", [False, True])
def test_an_empty_battery_stops_the_thrusters_if_it_is_to(stops: bool) -> None:
    """Empty after 1 s, also in a simulation that goes on from a saved state."""
    battery = replace(BATTERY, hotel_load=3600.0, charge=0.01, stops_thrusters=stops)
    with vehicle(battery) as simulation:
        ahead = Float64MultiArray(data=np.array([0.5, 0.5, 0.0, 0, 0]))
        simulation.publish("/thrusters", ahead)
        actuators = simulation.world.vehicles.actuators(NAME)
        assert actuators is not None
        full = after(simulation, 0.5)
        drawn = actuators.powers()[: len(actuators.thrusters)].sum()
        assert full.power_supply_health == BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN
        simulation.advance(1.0)
        saved = simulation.save()
        simulation.restore(saved)
        simulation.publish("/thrusters", ahead)
        empty = after(simulation, 0.5)
        left = actuators.powers()[: len(actuators.thrusters)].sum()
    assert empty.percentage == 0.0
    assert empty.power_supply_health == BatteryState.POWER_SUPPLY_HEALTH_DEAD
    assert drawn > 10.0
    assert left == pytest.approx(0.0, abs=1e-9) if stops else left > 10.0


def test_a_vehicle_without_dynamics_has_no_thrusters_to_stop() -> None:
    battery = replace(BATTERY, hotel_load=3600.0, charge=0.0, stops_thrusters=True)
    with vehicle(battery, dynamics=None) as simulation:
        assert after(simulation, 0.1).percentage == 0.0


def test_it_loses_the_energy_that_the_measure_counts() -> None:
    battery = replace(BATTERY, hotel_load=50.0)
    with vehicle(battery) as simulation:
        simulation.publish("/thrusters", Float64MultiArray(data=np.array([0.5, 0.3, 0.0, 0, 0.2])))
        energy = EnergySpec(name="e", target=NAME, hotel_load=50.0).bind(
            simulation.world.measure_view
        )
        energy.start()
        simulation.latest_message("/battery")
        for _ in range(1000):
            simulation.advance()
            energy.update()
        drawn = (1.0 - simulation.latest_message("/battery").percentage) * 100.0 * 3600.0
    assert energy.value is not None
    assert drawn == pytest.approx(energy.value, rel=0.01)
    assert drawn > 2.0 * 50.0 * 2.0


def test_currents_are_power_per_volt_of_each_motor() -> None:
    with vehicle() as simulation:
        simulation.latest_message("/currents")
        simulation.publish("/thrusters", Float64MultiArray(data=np.array([0.5, 0, 0, 0, 0.0])))
        simulation.advance(1.0)
        message = simulation.latest_message("/currents")
        actuators = simulation.world.vehicles.actuators(NAME)
        assert actuators is not None
        assert message.name == [*actuators.thrusters, *actuators.joints]
        np.testing.assert_allclose(message.effort, actuators.powers() / 50.0, rtol=1e-12)
        currents = dict(zip(message.name, message.effort.tolist(), strict=True))
    assert currents["surge_port"] > 0.5
    assert currents["surge_starboard"] == pytest.approx(0.0, abs=1e-9)


def test_the_noise_of_currents_has_its_deviation() -> None:
    """1200 numbers: their deviation is within 10 % of the true one with odds of 1e6."""
    with vehicle(currents=replace(CURRENTS, std=0.2)) as simulation:
        inbox = simulation.bus.inbox("/currents", JointState)
        simulation.advance(12.0)
        samples = [message.effort for message in inbox.take()]
    steady = np.array(samples[20:])  # the arm has come to rest
    differences = np.diff(steady, axis=0) / math.sqrt(2.0)
    assert differences.size > 900
    assert float(differences.std()) == pytest.approx(0.2, rel=0.15)


def test_a_vehicle_without_dynamics_has_no_motors() -> None:
    with vehicle(dynamics=None) as simulation:
        simulation.latest_message("/currents")
        simulation.advance(0.1)
        assert list(simulation.latest_message("/currents").name) == []


def full_thrust(simulation: Simulation, command: float = 1.0) -> None:
    simulation.publish(
        "/thrusters", Float64MultiArray(layout=MultiArrayLayout([], 0), data=np.full(5, command))
    )


@pytest.mark.parametrize("resistance", [0.25, 1.0, 4.0])
@pytest.mark.parametrize("hotel_load", [0.0, 60.0])
def test_thrusters_get_no_more_than_the_battery_can_feed(
    resistance: float, hotel_load: float
) -> None:
    battery = replace(BATTERY, resistance=resistance, hotel_load=hotel_load)
    greatest = 50.0**2 / (4.0 * resistance)
    with vehicle(replace(BATTERY, resistance=0.0)) as free:
        full_thrust(free)
        free.advance(1.0)
        wanted = free.world.vehicles.actuators(NAME)
        demand, full = float(wanted.powers().sum()), wanted.thrusts()
        for_thrust = float(wanted.powers()[:5].sum())
    with vehicle(battery) as simulation:
        simulation.latest_message("/battery")
        full_thrust(simulation)
        simulation.advance(1.0)
        actuators = simulation.world.vehicles.actuators(NAME)
        power, thrusts = float(actuators.powers().sum()) + hotel_load, actuators.thrusts()
        share = (float(actuators.powers()[:5].sum()) / for_thrust) ** (2.0 / 3.0)
        message = simulation.latest_message("/battery")
    fed = message.voltage * -message.current
    assert power == pytest.approx(min(demand + hotel_load, greatest), rel=1e-3)
    assert fed == pytest.approx(power, rel=1e-6)
    is_overload = demand + hotel_load > greatest
    failure, unknown = (
        BatteryState.POWER_SUPPLY_HEALTH_UNSPEC_FAILURE,
        BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN,
    )
    assert message.power_supply_health == (failure if is_overload else unknown)
    if is_overload:
        assert thrusts == pytest.approx(share * full, rel=1e-6)


def test_the_charge_is_that_of_the_power_in_an_overload() -> None:
    battery = replace(BATTERY, resistance=1.0)
    with vehicle(battery) as simulation:
        full_thrust(simulation)
        after(simulation, 2.0)
        before = after(simulation, 0.0).charge
        simulation.advance(2.0)
        drawn = before - simulation.latest_message("/battery").charge
    assert drawn == pytest.approx(25.0 * 2.0 / 3600.0, rel=1e-3)


def test_an_overload_ends_with_the_load() -> None:
    with vehicle(replace(BATTERY, resistance=4.0)) as simulation:
        full_thrust(simulation)
        after(simulation, 1.0)
        full_thrust(simulation, 0.05)
        message = after(simulation, 3.0)
        thrusts = simulation.world.vehicles.actuators(NAME).thrusts()
    assert message.power_supply_health == BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN
    with vehicle(BATTERY) as free:
        full_thrust(free, 0.05)
        free.advance(4.0)
        assert thrusts == pytest.approx(free.world.vehicles.actuators(NAME).thrusts(), rel=0.02)


@pytest.mark.parametrize(("resistance", "warns"), [(0.01, False), (4.0, True)])
def test_a_battery_that_cannot_feed_all_thrusters_is_warned_of(
    resistance: float, warns: bool
) -> None:
    with vehicle(replace(BATTERY, resistance=resistance)) as simulation:
        texts = [warning.message for warning in model_warnings(simulation.world.model)]
    found = [text for text in texts if "'battery' supplies 156.2 W at most" in text]
    assert bool(found) is warns
