"""The topics by which a pilot steers a vehicle, as parameters of the algorithm `pilot`."""

from __future__ import annotations

from ...devices.lamp import LampSpec
from ...devices.mavlink import MavlinkDevice
from ...devices.topic_link import TopicLinkSpec
from ...simulation import Simulation
from ...topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from ...topics.ros_odom_to_pat import ROSOdomToPATSpec
from ...topics.ros_twist_to_pat import ROSTwistToPATSpec
from ...topics.thruster_commands import ROSThrustersToPATSpec

STEERING_SPECS = (ROSTwistToPATSpec, ROSOdomToPATSpec, ROSThrustersToPATSpec)
"""The elements by whose topics a vehicle is steered."""
JAW_WORDS = ("jaw", "grip", "hand", "finger")
"""Words in the name of a joint that opens a gripper."""


def pilot_topics(simulation: Simulation) -> dict[str, float | str]:
    """Return the parameters of `uwsim.algorithms.pilot.Pilot` that the scene determines.

    The parameters are for the first vehicle that can be steered, or, if no vehicle can be steered,
    for the first vehicle. The result is empty if the scene has no vehicle.
    """
    world = simulation.world
    if not world.vehicles:
        return {}
    index = _steered_index(simulation)
    name = world.vehicles.names[index]
    parameters: dict[str, float | str] = {}
    autopilots = {device.vehicle_name: device.name for device in _open_autopilots(simulation)}
    if name in autopilots:
        parameters["autopilot"] = autopilots[name]
    vehicle = world.model.scene.vehicles[index]
    links = vehicle.parts_of(TopicLinkSpec)
    routes = {route.target: route.from_ for link in links for route in link.command}

    def operator_topic(topic: str) -> str:
        return routes.get(topic.strip("/"), topic)

    for spec in world.model.scene.ros_interfaces:
        if getattr(spec, "vehicle_name", name) != name:
            continue
        if name in autopilots and isinstance(spec, STEERING_SPECS):
            continue
        if isinstance(spec, ROSTwistToPATSpec):
            parameters.setdefault("twist_topic", operator_topic(spec.topic))
        elif isinstance(spec, ROSOdomToPATSpec):
            parameters.setdefault("odom_topic", operator_topic(spec.topic))
        elif isinstance(spec, ROSJointStateToArmSpec):
            parameters.setdefault("joints_topic", operator_topic(spec.topic))
        elif isinstance(spec, ROSThrustersToPATSpec) and world.vehicles.find(name).thrusters:
            parameters.setdefault("thrusters_topic", operator_topic(spec.topic))
            parameters["n_thrusters"] = float(len(world.vehicles.find(name).thrusters))
    lamps = (operator_topic(lamp.brightness_topic) for lamp in vehicle.parts_of(LampSpec))
    if topics := " ".join(dict.fromkeys(topic for topic in lamps if " " not in topic)):
        parameters["lamp_topics"] = topics
    joints = list(world.vehicles.find(name).joint_names)
    jaw = ""
    if joints and any(word in joints[-1].lower() for word in JAW_WORDS):
        jaw = joints.pop()
    down = -float(simulation.pose(name, "W").rotation[2, 2])
    return {**parameters, "joints": " ".join(joints), "jaw": jaw, "z_is_down": float(down > 0.0)}


def _open_autopilots(simulation: Simulation) -> list[MavlinkDevice]:
    """Return the connections to autopilots by MAVLink, if the simulation has connections."""
    devices = simulation.world.devices
    return [d for d in devices if isinstance(d, MavlinkDevice) and d.is_open]


def _steered_index(simulation: Simulation) -> int:
    """Return the index of the vehicle that a pilot steers, or 0.

    It is the first with an autopilot that is connected, or else with topics for twists, odometry or
    thrusters.
    """
    world = simulation.world
    names = {device.vehicle_name for device in _open_autopilots(simulation)} or {
        spec.vehicle_name
        for spec in world.model.scene.ros_interfaces
        if isinstance(spec, STEERING_SPECS)
    }
    return next((i for i, name in enumerate(world.vehicles.names) if name in names), 0)
