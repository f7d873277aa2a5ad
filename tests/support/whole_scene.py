"""Run any scene for a time and check what its topics carry: type, rate, and values."""

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
"""Element -> the message types that it may publish."""

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
"""Largest plausible absolute value of fields of that name, in the message's unit."""


@dataclass
class Heard:
    """The messages of one topic."""

    times: list[float] = field(default_factory=list)
    faults: set[str] = field(default_factory=set)


@dataclass
class SceneRun:
    """What is wrong with the topics of a scene, and what it does not simulate."""

    faults: list[str]
    """Topic and fault, sorted."""
    not_simulated: list[str]
    """Declared topics whose sensor or device is only parsed."""
    n_messages: dict[str, int]
    """Messages on each topic that is published."""


def run_scene(path: Path, duration: float, *, data_path: tuple[Path, ...] = ()) -> SceneRun:
    """Run a scene headless and read every topic that it declares."""
    spec = read_scene(path)
    with open_scene(spec, seed=1, data_path=data_path) as simulation:
        declared = [
            each
            for each in inventory(spec, simulation, [])["topics"]
            if each["direction"] == "publishes"
        ]
        heard: dict[str, Heard] = {each["topic"]: Heard() for each in declared}
        heard |= {f"/{name}": Heard() for name in simulation.bus.topics}
        for topic, there in heard.items():
            simulation.bus.subscribe(topic, object, _reader(simulation, there))
        simulation.advance(duration)
        simulated = [each for each in declared if not each["limit"]]
        faults = [fault for each in simulated for fault in type_faults(each)]
        faults += rate_faults(simulated, heard, duration)
    faults += [f"{topic}: {fault}" for topic, there in heard.items() for fault in there.faults]
    return SceneRun(
        faults=sorted(set(faults)),
        not_simulated=sorted({each["topic"] for each in declared if each["limit"]}),
        n_messages={topic: len(there.times) for topic, there in heard.items() if there.times},
    )


def _reader(simulation: Simulation, there: Heard) -> Any:
    def read(message: Any) -> None:
        there.times.append(simulation.time)
        there.faults.update(message_faults(message, simulation.time))

    return read


def type_faults(declared: dict[str, Any]) -> list[str]:
    """A message type other than the one that the element publishes."""
    expected = TYPES.get(declared["interface"])
    if expected is None or declared["type"] in expected:
        return []
    return [f"{declared['topic']}: {declared['type']}, expected {' or '.join(expected)}"]


def rate_faults(
    declared: list[dict[str, Any]], heard: dict[str, Heard], duration: float
) -> list[str]:
    """Topics on which more or fewer messages came than all publishers send; on /tf too few."""
    expected: dict[str, int] = {}
    for each in declared:
        if each["rate_hz"]:
            number = math.floor(duration * each["rate_hz"] + 1e-9) + 1
            expected[each["topic"]] = expected.get(each["topic"], 0) + number
    return [
        f"{topic}: {len(heard[topic].times)} messages in {duration:g} s, expected {number}"
        for topic, number in expected.items()
        if not 0 <= len(heard[topic].times) - number <= (math.inf if topic == "/tf" else 0)
    ]


def message_faults(message: Any, now: float) -> Iterator[str]:
    """What no real device would send."""
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
    """Velocities that are not finite while their status says that they are known."""
    for group in ("bi", "bs", "be", "wi", "ws", "we"):
        for name, value in vars(message).items():
            is_known = getattr(message, f"{group}_status") == "A"
            if is_known and name.startswith(f"{group}_") and isinstance(value, float):
                yield from number_faults(value, name)


def image_faults(message: Any) -> Iterator[str]:
    """Sizes that do not fit, an unknown encoding, and images that show nothing."""
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
    """Ranges beyond the limits, or another number of them than there are angles."""
    ranges = np.asarray(message.ranges)
    n_angles = round((message.angle_max - message.angle_min) / message.angle_increment) + 1
    if len(ranges) != n_angles:
        yield f"{len(ranges)} ranges at {n_angles} angles"
    tolerance = 1e-6 * message.range_max
    outside = (ranges < message.range_min) | (ranges > message.range_max + tolerance)
    if (outside & np.isfinite(ranges)).any():
        yield "ranges beyond the limits"
    if not (ranges < message.range_max - tolerance).any():
        yield "no beam that meets anything"


def number_faults(value: Any, name: str) -> Iterator[str]:
    """Numbers that are not finite or too large, and quaternions that are no rotation."""
    if dataclasses.is_dataclass(value):
        if type(value).__name__ == "Quaternion":
            norm = value.x**2 + value.y**2 + value.z**2 + value.w**2
            if not math.isclose(norm, 1.0, abs_tol=1e-6):
                yield f"{name}: quaternion of norm {math.sqrt(norm):g}"
        limit = LIMITS.get(name, math.inf)
        for each in dataclasses.fields(value):
            number = getattr(value, each.name)
            if isinstance(number, float) and abs(number) > limit:
                yield f"{name}.{each.name} is {number:g}"
            yield from number_faults(number, each.name)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from number_faults(item, name)
    elif isinstance(value, float | np.ndarray) and not finite(value):
        yield f"{name} is not finite"


def finite(value: Any) -> bool:
    """Whether no number of it is infinite or NaN; integers never are."""
    array = np.asarray(value)
    return array.dtype.kind != "f" or bool(np.isfinite(array).all())
