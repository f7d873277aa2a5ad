"""Logs as recordings: MCAP files, bags of ROS 1, rosbag2 folders and ``.db3`` files.

Topics are chosen by the types of their messages. ``[topics]`` of a mapping file chooses among
several of one type.

==========================================  =================================================
``nav_msgs/Odometry``                       motion
``geometry_msgs/PoseStamped``               motion, if there is no odometry
``std_msgs/Float64MultiArray``              commands of thrusters; of fins if its name has "fin";
                                            preferred: those that an autopilot has applied,
                                            ``VEHICLE/autopilot/thrusters``; never its sticks
``geometry_msgs/WrenchStamped``             commands of a wrench, if a mapping names the topic
``geometry_msgs/TwistStamped``, ``Twist``   commands of a twist
``sensor_msgs/Imu``, DVL, Pressure,         sensors, by the last part of the topic
``FluidPressure``, ``Range``,
``NavSatFix``, ``BatteryState``
==========================================  =================================================

A sample has the time of its stamp; a message without a stamp has that of its record. Commands
have the time of the record, at which they were delivered.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, get_args

from ..base.files.input_files import compute_hash
from ..errors import AssetError, BadSetting, choices
from ..messages.build import NANOSECONDS
from ..middleware.recording import BagReader
from .assemble import check_content, make_motion
from .limits import MAX_BYTES
from .mapping import LogMapping
from .message_readings import COMMAND_READERS, MOTION_READERS, SENSOR_READERS, SensorReader
from .samples import Samples
from .vehicle_log import CommandKind, CommandSeries, MotionSeries, SensorSeries, VehicleLog

COMMAND_TYPES: Mapping[CommandKind, tuple[str, ...]] = {
    "thrusters": ("std_msgs/msg/Float64MultiArray",),
    "fins": ("std_msgs/msg/Float64MultiArray",),
    "wrench": ("geometry_msgs/msg/WrenchStamped",),
    "twist": ("geometry_msgs/msg/TwistStamped", "geometry_msgs/msg/Twist"),
}
"""The types of messages that carry each kind of commands."""
APPLIED = "/autopilot/thrusters"
"""The end of the topic of the commands that an autopilot has applied (`devices.ardupilot`)."""
PILOT_NAMES = ("sticks", "joy", "joystick", "manual_control", "rc", "axes")
"""The names of topics with the inputs of a pilot."""
COMMAND_NAMES: Mapping[str, tuple[str, ...]] = {
    "wrench": ("fx", "fy", "fz", "mx", "my", "mz"),
    "twist": ("u", "v", "w", "p", "q", "r"),
}


def read_recording_log(
    path: Path, mapping: LogMapping | None = None, vehicle: str = ""
) -> VehicleLog:
    """Read the log of one vehicle from a recording.

    Args:
        path: the file or folder of the recording.
        mapping: the topics, frames, and names of commands; None: chosen by types, frames L and
            base, as uwsim records them.
        vehicle: the name of the vehicle, the first part of its topics; empty: that of the mapping,
            or the only one.

    Raises:
        AssetError: the recording cannot be read, is too large, or has no motion and no commands.
        BadSetting: several topics fit, or a topic of the mapping does not exist.
    """
    mapping = mapping or LogMapping()
    vehicle = vehicle or mapping.vehicle
    _check_size(path)
    with BagReader(path) as reader:
        types = {topic: kind.__msgtype__ for topic, kind in reader.topics.items()}  # type: ignore[attr-defined]
        roles = _choose_topics(types, mapping, vehicle)
        collectors = {topic: _Collector(role, topic) for topic, role in roles.items()}
        for time, topic, message in reader.messages(collectors):
            collectors[topic].add(time, message)
        start = reader.start
    return _assemble(path, mapping, vehicle, list(collectors.values()), start)


def _check_size(path: Path) -> None:
    files = [file for file in path.rglob("*") if file.is_file()] if path.is_dir() else [path]
    size = sum(file.stat().st_size for file in files if file.exists())
    if size > MAX_BYTES:
        raise AssetError(f"{path.name} is larger than {MAX_BYTES / 2**30:g} GiB.")


@dataclass(frozen=True)
class _Role:
    """The role of a topic: a motion, a kind of commands, or a sensor."""

    kind: str
    read: Callable[[Any], tuple[float, ...]]
    sensor: SensorReader | None = None


def _choose_topics(types: Mapping[str, str], mapping: LogMapping, vehicle: str) -> dict[str, _Role]:
    """Return the role of each topic that is read."""
    unknown_topics = [topic for topic in mapping.topics.values() if topic not in types]
    if unknown_topics:
        raise BadSetting(
            "\n".join(
                f"{mapping.path}: the recording has no topic {topic!r}.{choices(topic, types)}"
                for topic in unknown_topics
            )
        )
    own_topics = [topic for topic in types if vehicle and vehicle in topic.split("/")]
    candidates = own_topics or list(types)
    roles: dict[str, _Role] = {}
    motion = _choose_one("odometry", candidates, types, mapping, MOTION_READERS)
    if motion is not None:
        roles[motion] = _Role("motion", MOTION_READERS[types[motion]])
    for kind in get_args(CommandKind):
        topic = _choose_commands(kind, candidates, types, mapping)
        if topic is not None:
            roles[topic] = _Role(kind, COMMAND_READERS[types[topic]])
    topics_by_role = dict(mapping.topics)
    for topic in candidates:
        sensor = SENSOR_READERS.get(types[topic])
        if sensor is not None and topics_by_role.get(sensor.kind, topic) == topic:
            roles.setdefault(topic, _Role("sensor", sensor.read, sensor))
    return roles


def _choose_one(
    role: str,
    candidates: list[str],
    types: Mapping[str, str],
    mapping: LogMapping,
    readers: Mapping[str, object],
) -> str | None:
    mapped_topic = mapping.topics.get(role) or mapping.topics.get("pose")
    if mapped_topic is not None:
        if types[mapped_topic] not in readers:
            raise BadSetting(
                f"{mapped_topic} carries {types[mapped_topic]}; expected "
                f"{' or '.join(readers)} as {role}."
            )
        return mapped_topic
    for message_type in readers:
        topics = [topic for topic in candidates if types[topic] == message_type]
        if len(topics) > 1:
            raise BadSetting(
                f"{len(topics)} topics carry {message_type}: {', '.join(topics)}. Choose by "
                f"--vehicle, or name {role} in [topics] of a mapping file."
            )
        if topics:
            return topics[0]
    return None


def _choose_commands(
    kind: CommandKind, candidates: list[str], types: Mapping[str, str], mapping: LogMapping
) -> str | None:
    mapped_topic = mapping.topics.get(kind)
    if mapped_topic is not None:
        if types[mapped_topic] not in COMMAND_TYPES[kind]:
            expected = " or ".join(COMMAND_TYPES[kind])
            raise BadSetting(
                f"{mapped_topic} carries {types[mapped_topic]}; expected {expected} as {kind}."
            )
        return mapped_topic
    topics = [topic for topic in candidates if types[topic] in COMMAND_TYPES[kind]]
    if kind == "wrench":  # a force sensor has the same type
        return None
    if kind in ("thrusters", "fins"):
        topics = [topic for topic in topics if ("fin" in topic.lower()) is (kind == "fins")]
        applied_topics = [topic for topic in topics if topic.endswith(APPLIED)]
        named_topics = [topic for topic in topics if "thruster" in topic.lower()]
        topics = applied_topics or named_topics or [t for t in topics if not _is_of_pilot(t)]
    if len(topics) > 1:
        raise BadSetting(
            f"{len(topics)} topics may carry commands of {kind}: {', '.join(topics)}. Name "
            f"{kind} in [topics] of a mapping file, or choose by --vehicle."
        )
    return topics[0] if topics else None


def _is_of_pilot(topic: str) -> bool:
    """Return whether a topic has the sticks of a pilot, or is another input of an autopilot."""
    parts = topic.lower().strip("/").split("/")
    return "autopilot" in parts[:-1] or parts[-1] in PILOT_NAMES


class _Collector:
    """The samples of one topic."""

    def __init__(self, role: _Role, topic: str) -> None:
        self.role, self.topic = role, topic
        self.samples: Samples | None = None
        self._has_stamps = False

    def add(self, time: float, message: Any) -> None:
        """Add a message with the time of its record [s]."""
        values = self.role.read(message)
        if self.samples is None:
            self.samples = Samples(len(values) + 1, self.topic)
        if len(values) + 1 != self.samples.width:
            raise AssetError(
                f"{self.topic}: a message has {len(values)} values; the first has "
                f"{self.samples.width - 1}."
            )
        header = getattr(message, "header", None)
        stamp = 0.0
        if header is not None and self.role.kind in ("motion", "sensor"):
            stamp = header.stamp.sec + header.stamp.nanosec / NANOSECONDS
            self._has_stamps |= stamp > 0.0
        self.samples.append(time, (stamp, *values))

    def finish(self, remarks: list[str]) -> tuple[Any, Any]:
        """Return the times and the values."""
        assert self.samples is not None
        samples = self.samples
        if self._has_stamps:
            samples = samples.retime()
        times, values = samples.finish(remarks, is_motion=self.role.kind == "motion")
        return times, values[:, 1:]


def _assemble(
    path: Path, mapping: LogMapping, vehicle: str, collectors: list[_Collector], start: float
) -> VehicleLog:
    remarks: list[str] = []
    motion: MotionSeries | None = None
    commands: list[CommandSeries] = []
    sensors: dict[str, SensorSeries] = {}
    frames = mapping.frames
    for collector in collectors:
        if collector.samples is None:
            continue
        times, values = collector.finish(remarks)
        role = collector.role
        if role.kind == "motion":
            motion = make_motion(
                times,
                values[:, :3],
                values[:, 3:7],
                values[:, 7:] if values.shape[1] > 7 and values[:, 7:].any() else None,
                world=frames.world or "local",
                body=frames.body or "base",
                remarks=remarks,
                origin=frames.origin,
            )
        elif role.sensor is not None:
            name = _name_sensor(collector.topic, role.sensor.kind, sensors)
            sensors[name] = SensorSeries(
                kind=role.sensor.kind,
                names=role.sensor.names,
                units=role.sensor.units,
                times=times,
                values=role.sensor.convert(values, frames.body or "base"),
            )
        else:
            commands.append(_make_commands(collector, times, values, mapping))
    check_content(motion, len(commands), path.name)
    return VehicleLog(
        path=str(path),
        format=path.suffix.lstrip(".") if path.is_file() else "bag",
        sha256=compute_hash(path),
        vehicle=vehicle or _find_vehicle(collectors),
        motion=motion,
        commands=tuple(commands),
        sensors=MappingProxyType(sensors),
        start=start,
        remarks=tuple(remarks),
    )


def _make_commands(
    collector: _Collector, times: Any, values: Any, mapping: LogMapping
) -> CommandSeries:
    kind: Any = collector.role.kind
    command_kind: CommandKind = kind
    spec = mapping.commands.get(command_kind)
    names = COMMAND_NAMES.get(kind) or tuple(str(i) for i in range(values.shape[1]))
    if spec is not None:
        if len(spec.columns) != values.shape[1]:
            raise BadSetting(
                f"{mapping.path}: [commands.{kind}] has {len(spec.columns)} columns; the recording "
                f"has {values.shape[1]}."
            )
        names = spec.names or spec.columns
        values = values * (spec.signs or 1.0)
        times = times + spec.delay + spec.clock_offset
    return CommandSeries(
        kind=command_kind, names=names, times=times, values=values, source=collector.topic
    )


def _name_sensor(topic: str, kind: str, names_in_use: Mapping[str, object]) -> str:
    name = topic.rsplit("/", 1)[1] or kind
    number, candidate = 1, name
    while candidate in names_in_use:
        number += 1
        candidate = f"{name}_{number}"
    return candidate


def _find_vehicle(collectors: list[_Collector]) -> str:
    for collector in collectors:
        if collector.role.kind == "motion":
            parts = collector.topic.strip("/").split("/")
            return parts[0] if len(parts) > 1 else ""
    return ""
