"""Run any scene, and check type, rate and values of the messages on its topics."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tests.support.opened import open_scene
from uwsim.cli.output.inventory import inventory
from uwsim.messages import seconds
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

TYPES = {
    "PATToROSOdom": ("nav_msgs/msg/Odometry",),
    "WorldToROSTF": ("tf2_msgs/msg/TFMessage",),
    "ArmToROSJointState": ("sensor_msgs/msg/JointState",),
    "VirtualCameraToROSImage": ("sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"),
    "RangeSensorToROSRange": ("sensor_msgs/msg/Range",),
    "ImuToROSImu": ("sensor_msgs/msg/Imu",),
    "PressureSensorToROS": ("underwater_sensor_msgs/msg/Pressure", "sensor_msgs/msg/FluidPressure"),
    "GPSSensorToROS": ("sensor_msgs/msg/NavSatFix",),
    "DVLSensorToROS": ("underwater_sensor_msgs/msg/DVL", "marine_acoustic_msgs/msg/Dvl"),
    "RangeImageSensorToROSImage": ("sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"),
    "multibeamSensorToLaserScan": ("sensor_msgs/msg/LaserScan",),
    "ProfilingSonarROS": ("sensor_msgs/msg/LaserScan",),
    "contactSensorToROS": ("std_msgs/msg/Bool",),
    "echoROS": ("std_msgs/msg/String",),
    "ForceSensorROS": ("geometry_msgs/msg/WrenchStamped",),
    "RangeCameraToPCL": ("sensor_msgs/msg/PointCloud2",),
    "CustomCommsDeviceROS": ("geometry_msgs/msg/Pose",),
    "AcousticCommsDeviceROS": ("geometry_msgs/msg/Pose",),
    "batteryToROS": ("sensor_msgs/msg/BatteryState",),
    "motorCurrentsToROS": ("sensor_msgs/msg/JointState",),
    "segmentationToROS": ("sensor_msgs/msg/Image", "std_msgs/msg/String"),
    "sonarToROS": ("marine_acoustic_msgs/msg/ProjectedSonarImage", "sensor_msgs/msg/Image"),
}
"""The message types that each element may publish."""

LIMITS = {
    "position": 1e4,
    "translation": 1e4,
    "velocity": 20.0,
    "linear": 20.0,
    "angular": 20.0,
    "angular_velocity": 20.0,
    "linear_acceleration": 200.0,
    "force": 1e5,
    "torque": 1e5,
}
"""The largest plausible absolute value of fields of each name, in the message's unit."""


@dataclass
class ReceivedMessages:
    """The messages of one topic, as their times and faults."""

    times: list[float] = field(default_factory=list)
    """The times at which they arrived [s]."""
    faults: set[str] = field(default_factory=set)
    """The implausible values in them."""


@dataclass
class SceneRun:
    """The faults of the topics of a scene, and the topics that are not simulated."""

    faults: list[str]
    """The topics and their faults, sorted."""
    not_simulated: list[str]
    """The declared topics whose sensor or device is parsed only."""
    n_messages: dict[str, int]
    """The number of messages on each published topic."""


def run_scene(path: Path, duration: float, *, data_path: tuple[Path, ...] = ()) -> SceneRun:
    """Run a scene headless, and read all its declared topics."""
    spec = read_scene(path)
    with open_scene(spec, seed=1, data_path=data_path) as simulation:
        declared_topics = [
            topic_entry
            for topic_entry in inventory(spec, simulation, [])["topics"]
            if topic_entry["direction"] == "publishes"
        ]
        messages_by_topic: dict[str, ReceivedMessages] = {
            topic_entry["topic"]: ReceivedMessages() for topic_entry in declared_topics
        }
        messages_by_topic |= {f"/{name}": ReceivedMessages() for name in simulation.bus.topics}
        for topic, messages in messages_by_topic.items():
            simulation.bus.subscribe(topic, object, _make_receiver(simulation, messages))
        simulation.advance(duration)
        simulated_topics = [
            topic_entry for topic_entry in declared_topics if not topic_entry["limit"]
        ]
        faults = [fault for topic_entry in simulated_topics for fault in type_faults(topic_entry)]
        faults += rate_faults(simulated_topics, messages_by_topic, duration)
    faults += [
        f"{topic}: {fault}"
        for topic, messages in messages_by_topic.items()
        for fault in messages.faults
    ]
    return SceneRun(
        faults=sorted(set(faults)),
        not_simulated=sorted(
            {topic_entry["topic"] for topic_entry in declared_topics if topic_entry["limit"]}
        ),
        n_messages={
            topic: len(messages.times)
            for topic, messages in messages_by_topic.items()
            if messages.times
        },
    )


def _make_receiver(simulation: Simulation, messages: ReceivedMessages) -> Any:
    def read(message: Any) -> None:
        messages.times.append(simulation.time)
        messages.faults.update(message_faults(message, simulation.time))

    return read


def type_faults(topic_entry: dict[str, Any]) -> list[str]:
    """Describe a message type that the element does not publish."""
    expected = TYPES.get(topic_entry["interface"])
    if expected is None or topic_entry["type"] in expected:
        return []
    return [f"{topic_entry['topic']}: {topic_entry['type']}, expected {' or '.join(expected)}"]


def rate_faults(
    topic_entries: list[dict[str, Any]],
    messages_by_topic: dict[str, ReceivedMessages],
    duration: float,
) -> list[str]:
    """Describe topics with more or fewer messages than their publishers send; on /tf fewer.

    A USBL loses replies.
    """
    expected: dict[str, int] = {}
    for topic_entry in topic_entries:
        if topic_entry["rate_hz"]:
            number = math.floor(duration * topic_entry["rate_hz"] + 1e-9) + 1
            expected[topic_entry["topic"]] = expected.get(topic_entry["topic"], 0) + number
    return [
        f"{topic}: {len(messages_by_topic[topic].times)} messages in {duration:g} s, "
        f"expected {number}"
        for topic, number in expected.items()
        if not (0 if topic.endswith("/usbl") else number)
        <= len(messages_by_topic[topic].times)
        <= (math.inf if topic == "/tf" else number)
    ]


def message_faults(message: Any, now: float) -> Iterator[str]:
    """Yield implausible values of a message."""
    kind = type(message).__name__
    header = getattr(message, "header", None)
    if header is not None and not now - 1.0 <= seconds(header.stamp) <= now + 1e-9:
        yield f"stamp {seconds(header.stamp)} at {now}"
    if kind == "Image":
        yield from image_faults(message)
    elif kind == "PointCloud2":
        if len(message.data) != message.row_step * message.height:
            yield "number of bytes"
    elif kind == "LaserScan":
        yield from scan_faults(message)
    elif kind == "Range":
        if not message.min_range <= message.range <= message.max_range:
            yield f"range {message.range}"
    elif kind == "JointState" and len(message.name) != len(message.position):
        yield "numbers of joints and positions differ"
    has_fix = kind != "NavSatFix" or message.status.status >= 0
    if kind == "DVL":
        yield from dvl_faults(message)
    elif kind not in ("Image", "PointCloud2") and has_fix:
        yield from number_faults(message, kind)


def dvl_faults(message: Any) -> Iterator[str]:
    """Yield velocities that are not finite despite a valid status."""
    for group in ("bi", "bs", "be", "wi", "ws", "we"):
        for name, value in vars(message).items():
            is_known = getattr(message, f"{group}_status") == "A"
            if is_known and name.startswith(f"{group}_") and isinstance(value, float):
                yield from number_faults(value, name)


def image_faults(message: Any) -> Iterator[str]:
    """Yield invalid sizes, an unknown encoding, and images without content."""
    n_bytes = {"rgb8": 3, "mono8": 1, "16UC1": 2, "32FC1": 4}.get(message.encoding)
    if n_bytes is None:
        yield f"encoding {message.encoding}"
        return
    if (
        message.step != n_bytes * message.width
        or len(message.data) != message.step * message.height
    ):
        yield "number of bytes"
        return
    data = np.asarray(message.data)
    if message.encoding == "32FC1":
        depth = data.view(np.float32)
        if np.isnan(depth).any() or (np.isfinite(depth) & (depth <= 0.0)).any():
            yield "depths that are not positive"
    elif int(data.max()) == int(data.min()):
        yield "an image of one grey level"


def scan_faults(message: Any) -> Iterator[str]:
    """Yield ranges beyond the limits, or a number of ranges that is not that of the angles."""
    ranges = np.asarray(message.ranges)
    n_angles = round((message.angle_max - message.angle_min) / message.angle_increment) + 1
    if len(ranges) != n_angles:
        yield f"{len(ranges)} ranges at {n_angles} angles"
    tolerance = 1e-6 * message.range_max
    is_outside = (ranges < message.range_min) | (ranges > message.range_max + tolerance)
    if (is_outside & np.isfinite(ranges)).any():
        yield "ranges beyond the limits"
    if not (ranges < message.range_max - tolerance).any():
        yield "no beam that meets anything"


def number_faults(value: Any, name: str) -> Iterator[str]:
    """Yield numbers that are not finite or too large, and quaternions that are not unit."""
    if dataclasses.is_dataclass(value):
        if type(value).__name__ == "Quaternion":
            norm = value.x**2 + value.y**2 + value.z**2 + value.w**2
            if not math.isclose(norm, 1.0, abs_tol=1e-6):
                yield f"{name}: quaternion of norm {math.sqrt(norm):g}"
        limit = LIMITS.get(name, math.inf)
        for field_of_value in dataclasses.fields(value):
            number = getattr(value, field_of_value.name)
            if isinstance(number, float) and abs(number) > limit:
                yield f"{name}.{field_of_value.name} is {number:g}"
            yield from number_faults(number, field_of_value.name)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from number_faults(item, name)
    elif name == "temperature" and math.isnan(value):
        return  # of a battery: ROS has NaN where it is not measured
    elif isinstance(value, float | np.ndarray) and not is_finite(value):
        yield f"{name} is not finite"


def is_finite(value: Any) -> bool:
    """Return True if no number is infinite or NaN."""
    array = np.asarray(value)
    return array.dtype.kind != "f" or bool(np.isfinite(array).all())
