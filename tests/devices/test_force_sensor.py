"""A force sensor measures the contacts on its link, in its own frame, in every kind of physics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import joint, scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.base.geometry import rotation_from_rpy
from uwsim.devices.force_sensor import ForceSensorSpec
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.topics.sensor_topic import ForceSensorROSSpec

TOPIC = ForceSensorROSSpec(name="force", topic="/force", rate=50)


def sensor(
    offsetp: tuple[float, float, float] = (0.0, 0.0, 0.0),
    offsetr: tuple[float, float, float] = (0.0, 0.0, 0.0),
    target: str = "base_link",
) -> ForceSensorSpec:
    return ForceSensorSpec(name="force", target=target, offsetp=offsetp, offsetr=offsetr)


def box(z: float, physics: PhysicsSpec) -> ObjectSpec:
    """A box of 0.1 m, its middle at x = 0.02 m."""
    return ObjectSpec(
        name="box", file="objects/box.obj", scale_factor=(0.1, 0.1, 0.1), position=(0.02, 0.0, z),
        physics=physics,
    )  # fmt: skip


def in_water(mass: float) -> SceneSpec:
    """A vehicle with dynamics with a box of 1 l above it."""
    rov = VehicleSpec(
        name="rov", file="bluerov2_heavy.urdf", dynamics="bluerov2_heavy",
        position=(0.0, 0.0, -5.0), parts=(sensor(),),
    )  # fmt: skip
    load = replace(box(-4.82, PhysicsSpec(mass=mass, volume=0.001)), position=(0.0, 0.0, -4.82))
    return scene_of(rov, objects=(load,), ros_interfaces=(TOPIC,))


def on_a_placed_vehicle(folder: Path, part: ForceSensorSpec, z: float = 0.15) -> SceneSpec:
    """UWSim's physics, 1 m/s2: a vehicle of 0.2 m that floats in the air, a box of 2 kg on it."""
    inside = f'{shape()}{shape("collision")}<inertial><mass value="1"/></inertial>'
    robot = write_robot(folder, f'<link name="base_link">{inside}</link>')
    vehicle = VehicleSpec(name="rov", file=str(robot), parts=(part,))
    return scene_of(
        vehicle,
        objects=(box(z, PhysicsSpec(mass=2.0)),),
        ros_interfaces=(TOPIC,),
        sim_params=SimParamsSpec(enable_physics=True),
    )


def measured(scene: SceneSpec, seconds: float) -> np.ndarray:
    """Force and torque at the end, (6,)."""
    with open_scene(scene, is_blind=True) as simulation:
        simulation.latest_message("/force")
        simulation.advance(seconds)
        message = simulation.latest_message("/force")
        assert message.header.frame_id == "force"
        force, torque = message.wrench.force, message.wrench.torque
        return np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])


def test_a_box_that_rests_on_a_simulated_vehicle_weighs_what_it_weighs_in_water() -> None:
    wrench = measured(in_water(2.0), 2.5)
    assert wrench[2] == pytest.approx(-9.81 * (2.0 - 0.001 * 1000.0), rel=0.02)
    assert wrench[[0, 1, 3, 4, 5]] == pytest.approx(np.zeros(5), abs=0.01)


def test_without_a_contact_all_is_zero(tmp_path: Path) -> None:
    assert not measured(in_water(0.9), 0.1).any()  # it rises
    apart = on_a_placed_vehicle(tmp_path, sensor(), z=2.0)
    assert not measured(apart, 0.1).any()


def test_without_physics_all_is_zero(tmp_path: Path) -> None:
    scene = on_a_placed_vehicle(tmp_path, sensor(), z=0.12)
    assert not measured(replace(scene, sim_params=SimParamsSpec()), 0.1).any()


def test_on_a_placed_vehicle_it_measures_the_weight_and_where_it_lies(tmp_path: Path) -> None:
    wrench = measured(on_a_placed_vehicle(tmp_path, sensor()), 2.0)
    assert wrench[:3] == pytest.approx([0.0, 0.0, -2.0], abs=0.02)
    assert wrench[3:] == pytest.approx([0.0, 0.02 * 2.0, 0.0], abs=2e-3)


def test_its_place_moves_the_torque_and_its_axes_turn_both(tmp_path: Path) -> None:
    place, rpy = (0.3, -0.2, 0.1), (0.4, -0.7, 1.1)
    centred = measured(on_a_placed_vehicle(tmp_path, sensor()), 1.0)
    moved = measured(on_a_placed_vehicle(tmp_path, sensor(place, rpy)), 1.0)
    back = rotation_from_rpy(*rpy).T
    force, torque = centred[:3], centred[3:]
    assert moved[:3] == pytest.approx(back @ force)
    assert moved[3:] == pytest.approx(back @ (torque - np.cross(place, force)))


def test_two_runs_are_the_same_to_the_last_bit() -> None:
    scene = in_water(2.0)
    first, second = measured(scene, 0.5), measured(scene, 0.5)
    assert first.any()
    assert first.tobytes() == second.tobytes()


BODY = (
    '<body link="{}"><volume>{}</volume><addedMass>{} {} {} 0.1 0.1 0.1</addedMass>'
    "<quadraticDamping>{} {} {} 1 1 1</quadraticDamping></body>"
)


def with_a_wrist(
    folder: Path,
    *,
    mass: float,
    volume: float,
    added: float = 0.0,
    drag: float = 0.0,
    tool: tuple[float, float, float] = (5.0, 0.001, 0.0),
) -> SceneSpec:
    """A base of ``mass`` and ``volume`` with a tool 0.5 m ahead of it, on a fixed wrist.

    ``added`` and ``drag`` are those of the base; the ``tool`` has mass [kg], volume [m3] and added
    mass [kg], its middle 0.1 m ahead of the wrist.
    """
    tool_mass, tool_volume, tool_added = tool
    bodies = (
        BODY.format("base_link", volume, added, added, added, drag, drag, drag),
        BODY.format("tool", tool_volume, tool_added, tool_added, tool_added, 0, 0, 0).replace(
            "</body>",
            "<centreOfBuoyancy> <x>0.1</x> <y>0</y> <z>0</z> </centreOfBuoyancy>"
            "<reference> <x>0.1</x> <y>0</y> <z>0</z> </reference></body>",
        ),
    )
    (folder / "mine.xml").write_text(
        f'<hydrodynamics name="mine"><source>A test.</source>{"".join(bodies)}</hydrodynamics>'
    )
    inertial = '<inertial><origin xyz="{} 0 0"/><mass value="{}"/><inertia ixx="{}" iyy="{}" izz="{}"/></inertial>'  # fmt: skip  # noqa: E501
    heavy = inertial.format(0.0, mass, mass, mass, mass)
    light = inertial.format(0.1, tool_mass, 0.01, 0.01, 0.01)
    robot = write_robot(
        folder,
        f'<link name="base_link">{heavy}</link><link name="tool">{light}</link>'
        + joint("wrist", "base_link tool", xyz="0.5 0 0"),
    )
    wrist = ForceSensorSpec(name="force", target="tool", measures="joint")
    vehicle = VehicleSpec(
        name="rov", file=str(robot), dynamics="mine", position=(0.0, 0.0, -20.0), parts=(wrist,)
    )
    scene = scene_of(vehicle, ros_interfaces=(TOPIC,))
    return replace(scene, path=str(folder / "scene.xml"))


@pytest.mark.parametrize(("mass", "volume"), [(5.0, 0.001), (2.0, 0.003)])
def test_a_wrist_weighs_what_hangs_on_it_in_water(
    tmp_path: Path, mass: float, volume: float
) -> None:
    scene = with_a_wrist(tmp_path, mass=50000.0, volume=50.0, tool=(mass, volume, 0.0))
    force = -9.81 * (mass - 1000.0 * volume)
    wrench = measured(scene, 0.2)
    assert wrench[2] == pytest.approx(force, rel=0.02)
    assert wrench[4] == pytest.approx(-0.1 * force, rel=0.02)  # about y: ahead of it, it pulls down
    assert wrench[[0, 1, 3, 5]] == pytest.approx(np.zeros(4), abs=0.01)


def test_a_wrist_feels_inertia_and_added_mass(tmp_path: Path) -> None:
    """As the vehicle begins to sink, the tool's added mass holds it back."""
    mass, volume, added = 1000.0, 0.9, 20.0
    scene = with_a_wrist(tmp_path, mass=mass, volume=volume, tool=(5.0, 0.005, added))
    wrench = measured(scene, 0.02)
    sinks = 9.81 * (mass - 1000.0 * volume) / (mass + 5.0 + added)
    assert wrench[2] == pytest.approx((5.0 + added) * sinks, rel=0.02)


def test_what_a_wrist_measures_does_not_depend_on_who_else_asks(tmp_path: Path) -> None:
    scene = with_a_wrist(tmp_path, mass=1000.0, volume=0.9)
    alone = measured(scene, 0.1)
    with open_scene(scene, is_blind=True) as simulation:
        simulation.latest_message("/force")
        for _ in range(50):
            simulation.advance()
            simulation.world.bodies.find("rov/tool").world_from_body  # noqa: B018
        simulation.advance()
        force = simulation.latest_message("/force").wrench.force
    assert [force.x, force.y, force.z] == alone[:3].tolist()


def test_a_vehicle_that_is_not_simulated_has_no_forces_at_its_wrist(tmp_path: Path) -> None:
    scene = with_a_wrist(tmp_path, mass=1000.0, volume=1.0)
    vehicle = replace(scene.vehicles[0], dynamics=None)
    assert not measured(replace(scene, vehicles=(vehicle,)), 0.1).any()
