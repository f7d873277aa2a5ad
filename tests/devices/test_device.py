"""Devices are bound to their vehicle and act in the step; those on one thing act together."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.devices import DEVICES
from uwsim.devices.device import DeviceSpec
from uwsim.devices.fault import FaultSpec, ThrusterFault
from uwsim.devices.fault_times import FaultTimes
from uwsim.scene.mounts import MountFrames
from uwsim.scene.unsupported import describe_limitation
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation.vehicles import SceneVehicle


class FakeState:
    """Remembers what is done to it."""

    def __init__(self) -> None:
        self.losses: list[tuple[int, float]] = []
        self.placed: list[Pose] = []
        self.actuation = {
            0: SimpleNamespace(
                thrusters=("port", "starboard"),
                set_loss=lambda thruster, loss: self.losses.append((thruster, loss)),
            )
        }

    def place_vehicle(self, index: int, pose: Pose) -> None:
        self.placed.append(pose)


def vehicle_on(state: FakeState) -> SceneVehicle:
    spec = VehicleSpec(name="v", file="v.urdf", position=(1.0, 2.0, 3.0))
    robot = SimpleNamespace(movable_joints=())
    frames = MountFrames(spec, robot, Pose.identity())  # type: ignore[arg-type]
    return SceneVehicle(0, frames, state, lambda: 0)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", DEVICES)
def test_a_device_without_bind_is_reported_as_read_only(name: str) -> None:
    spec = DEVICES[name]
    assert bool(describe_limitation("vehicle", name)) is not hasattr(spec, "bind")
    assert issubclass(spec, DeviceSpec) is hasattr(spec, "bind")


def test_of_two_losses_of_one_thruster_the_greater_counts() -> None:
    state = FakeState()
    vehicle = vehicle_on(state)
    first, second = vehicle.loss_setter("starboard"), vehicle.loss_setter("starboard")
    first(0.7)
    second(0.2)
    first(0.0)
    assert state.losses == [(1, 0.7), (1, 0.7), (1, 0.2)]


def test_a_fault_begins_and_ends_in_time() -> None:
    losses: list[float] = []
    spec = FaultSpec(thruster="t", loss=0.5, start=1.0, end=2.0)
    fault = ThrusterFault(spec, losses.append, FaultTimes(spec, np.random.default_rng(0)))
    for time in (0.998, 1.0, 1.998, 2.0):
        fault.step(time)
    assert losses == [0.0, 0.5, 0.5, 0.0]


def test_displacements_add_up_and_the_last_one_moves_the_vehicle() -> None:
    state = FakeState()
    vehicle = vehicle_on(state)
    along, again, up = vehicle.displacer(0), vehicle.displacer(0), vehicle.displacer(2)
    along(0.5)
    again(0.25)
    assert state.placed == []
    up(-1.0)
    assert state.placed[0].position.tolist() == [1.75, 2.0, 2.0]
