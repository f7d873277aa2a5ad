"""Energy: the integral of what is drawn, by consumer; and why there is none."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.fakes import FakeActuators, FakeWorld
from uwsim.benchmark.measures.energy import BatterySpec, Energy, EnergySpec
from uwsim.errors import UnknownName

DT = 0.01


def rov() -> FakeActuators:
    return FakeActuators(thrusters=("port", "starboard"), joints=("elbow",))


def bound(actuators: FakeActuators | None, **given: object) -> tuple[Energy, FakeWorld]:
    world = FakeWorld(timestep=DT, vehicles=("rov", "ghost"))
    if actuators is not None:
        world.actuators_by_vehicle["rov"] = actuators
    spec = EnergySpec(name="e", **{"target": "rov", **given})  # type: ignore[arg-type]
    return spec.bind(world), world


def go_on(energy: Energy, world: FakeWorld, steps: int) -> None:
    for _ in range(steps):
        world.advance()
        energy.update()


def test_constant_power_is_power_times_time_for_every_consumer() -> None:
    actuators = rov()
    energy, world = bound(actuators, hotel_load=60.0)
    actuators.electric_powers[:] = 100.0, 50.0, 10.0
    energy.start()
    go_on(energy, world, 1000)
    assert energy.value == pytest.approx(220.0 * 10.0, abs=1e-9)
    assert energy.details == {
        "thrusters": pytest.approx(1500.0, abs=1e-9),
        "joints": pytest.approx(100.0, abs=1e-9),
        "hotel": pytest.approx(600.0, abs=1e-9),
        "mean_power": pytest.approx(220.0),
        "peak_power": 220.0,
        "charge": None,
        "thruster.port": pytest.approx(1000.0, abs=1e-9),
        "thruster.starboard": pytest.approx(500.0, abs=1e-9),
        "joint.elbow": pytest.approx(100.0, abs=1e-9),
    }
    assert energy.reasons == {"charge": "no <battery> is given"}


def test_a_ramp_of_power_is_exact() -> None:
    actuators = rov()
    energy, world = bound(actuators)
    energy.start()
    for k in range(1, 501):
        actuators.electric_powers[0] = 3.0 * k * DT
        go_on(energy, world, 1)
    assert energy.value == pytest.approx(0.5 * 3.0 * 5.0**2, abs=1e-9)
    assert energy.details["peak_power"] == pytest.approx(15.0)
    assert energy.details["mean_power"] == pytest.approx(7.5)


def test_what_was_drawn_while_it_was_off_does_not_count() -> None:
    actuators = rov()
    energy, world = bound(actuators)
    actuators.electric_powers[0] = 100.0
    world.advance(300)
    energy.start()
    go_on(energy, world, 100)
    world.advance(300)
    energy.start()
    go_on(energy, world, 100)
    assert energy.value == pytest.approx(200.0)
    assert energy.details["mean_power"] == pytest.approx(100.0)


def test_parts_add_up_to_the_whole() -> None:
    actuators = rov()
    energy, world = bound(actuators, hotel_load=7.0)
    random = np.random.default_rng(0)
    energy.start()
    for _ in range(200):
        actuators.electric_powers[:] = random.uniform(0.0, 100.0, 3)
        go_on(energy, world, 1)
    details = energy.details
    parts = [details["thrusters"], details["joints"], details["hotel"]]
    each = [details[f"thruster.{name}"] for name in actuators.thrusters]
    assert energy.value == pytest.approx(sum(parts), rel=1e-12)
    assert details["thrusters"] == pytest.approx(sum(each), rel=1e-12)


def test_a_battery_reports_its_charge_and_runs_empty() -> None:
    actuators = rov()
    energy, world = bound(actuators, battery=BatterySpec(capacity=0.5, unit="Wh"))  # 1800 J
    actuators.electric_powers[0] = 100.0
    energy.start()
    go_on(energy, world, 450)
    assert energy.details["charge"] == pytest.approx(0.75)
    assert energy.notes == ()
    assert energy.log_header == ("energy [J]", "power [W]", "charge [1]")
    assert energy.log_values == pytest.approx((450.0, 100.0, 0.75))
    go_on(energy, world, 2000)
    assert energy.details["charge"] == 0.0
    assert energy.notes == ("the battery of 'rov' ran empty; it was drawn on all the same",)


def test_a_capacity_may_be_in_joules_or_watt_hours() -> None:
    assert BatterySpec(capacity=2.0, unit="Wh").joules == 7200.0
    assert BatterySpec(capacity=2.0).joules == 2.0


def test_units_are_reported_for_what_is_no_energy() -> None:
    energy, _ = bound(rov())
    assert energy.unit == "J"
    assert energy.detail_units == {"mean_power": "W", "peak_power": "W", "charge": "1"}


def test_before_it_was_on_there_is_nothing() -> None:
    energy, _ = bound(rov())
    assert (energy.value, energy.missing_reason) == (None, "it was never on")
    assert set(energy.details.values()) == {None}
    assert energy.log_values == (None, None, None)
    energy.start()
    assert energy.value == 0.0
    assert energy.details["mean_power"] is None
    assert energy.reasons["mean_power"] == "it was on for one step only"


def test_a_vehicle_without_forces_has_no_energy_and_a_reason() -> None:
    energy, world = bound(None, target="ghost", hotel_load=60.0)
    energy.start()
    go_on(energy, world, 10)
    assert energy.value is None
    assert energy.missing_reason == "the vehicle 'ghost' has no <u:dynamics>: nothing drives it"


def test_a_misspelt_vehicle_is_an_error_that_names_the_right_one() -> None:
    with pytest.raises(UnknownName, match="Did you mean 'rov'"):
        bound(rov(), target="rof")
