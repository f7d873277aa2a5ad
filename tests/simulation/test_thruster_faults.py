"""Thrusters that fail on schedule."""

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import command, heading_deg, make, position, run
from uwsim.devices.fault import FaultSpec
from uwsim.errors import SceneError
from uwsim.simulation import Simulation


def faulty(*faults: FaultSpec) -> Simulation:
    return make(change=lambda vehicle: replace(vehicle, parts=faults))


def test_a_dead_thruster_turns_the_vehicle_until_it_works_again() -> None:
    simulation = faulty(FaultSpec(thruster="surge_port", start=4.0, end=8.0))
    command(simulation, 0.4, 0.0)
    run(simulation, 4.0)
    assert heading_deg(simulation) == pytest.approx(90.0, abs=0.2)
    run(simulation, 4.0)
    assert heading_deg(simulation) < 80.0  # pushed on starboard alone it turns to port
    run(simulation, 12.0)
    assert heading_deg(simulation) == pytest.approx(90.0, abs=3.0)


def test_a_thruster_without_strength_left_moves_nothing() -> None:
    simulation = faulty(FaultSpec(thruster="sway"))
    command(simulation, 0.0, 0.3)
    run(simulation, 5.0)
    assert position(simulation)[0] == pytest.approx(3.0, abs=0.02)


def test_a_loss_of_thrust_costs_speed_as_the_square_root() -> None:
    speeds = []
    for loss in (0.0, 0.75):
        faults = [FaultSpec(thruster=name, loss=loss) for name in ("surge_port", "surge_starboard")]
        simulation = faulty(*faults)
        command(simulation, 5.0, 0.0)  # full ahead
        run(simulation, 8.0)
        before = position(simulation)
        run(simulation, 0.5)
        speeds.append(float(np.linalg.norm(position(simulation) - before)) / 0.5)
    # 280 and 70 N against 30 u + 230 u^2
    whole, quarter = [(-30 + np.sqrt(30**2 + 4 * 230 * force)) / 460 for force in (280.0, 70.0)]
    assert speeds[1] / speeds[0] == pytest.approx(quarter / whole, rel=0.02)
    assert (
        0.9 * whole < speeds[0] < whole
    )  # the arm drags aside; to keep the course takes its share


def test_of_two_faults_the_greater_loss_counts() -> None:
    simulation = faulty(FaultSpec(thruster="sway", loss=1.0), FaultSpec(thruster="sway", loss=0.1))
    command(simulation, 0.0, 0.3)
    run(simulation, 3.0)
    assert position(simulation)[0] == pytest.approx(3.0, abs=0.02)


def test_a_fault_of_an_unknown_thruster_lists_the_known_ones() -> None:
    with pytest.raises(SceneError, match="surge_port"):
        faulty(FaultSpec(thruster="surge"))
