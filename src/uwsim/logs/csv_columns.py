"""The columns of a CSV log: by a mapping file, or by the names that uwsim itself writes.

.. code-block:: text

    time, x, y, z, qw, qx, qy, qz, u, v, w, p, q, r     motion: L and base axes, SI units
    thrusters.NAME  fins.NAME  wrench.NAME  twist.NAME   commands
    KIND.NAME  or  KIND:SENSOR.NAME                      sensors: imu.ax, dvl:front.u, range.range
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import get_args

from .mapping import (
    SENSOR_KINDS,
    Column,
    CommandMapping,
    FrameMapping,
    LogMapping,
    MotionMapping,
    SensorMapping,
)
from .vehicle_log import CommandKind, VehicleLog

POSITION = ("x", "y", "z")
QUATERNION = ("qw", "qx", "qy", "qz")
VELOCITY = ("u", "v", "w")
ANGULAR_VELOCITY = ("p", "q", "r")
COMMAND_UNITS: Mapping[str, str] = {"thrusters": "1", "fins": "rad", "wrench": "", "twist": ""}
"""The unit of commands of each kind; empty: that of each axis."""
SENSOR_UNITS: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("ax", "ay", "az"), "m/s2"),
        **dict.fromkeys(("p", "q", "r"), "rad/s"),
        **dict.fromkeys(("u", "v", "w"), "m/s"),
        **dict.fromkeys(("roll", "pitch", "yaw"), "rad"),
        **dict.fromkeys(("depth", "range", "altitude"), "m"),
        **dict.fromkeys(("latitude", "longitude"), "deg"),
        "pressure": "Pa",
        "voltage": "V",
        "current": "A",
        "remaining": "1",
    }
)
"""The SI unit of the quantities of sensors; those of latitude and longitude are degrees."""
_SENSOR = re.compile(rf"({'|'.join(SENSOR_KINDS)})(?::([\w/-]+))?\.([\w-]+)")


def derive_mapping(header: Sequence[str]) -> LogMapping:
    """Return the mapping of a file with the names that uwsim writes; others are ignored."""
    names = set(header)

    def present(columns: tuple[str, ...]) -> tuple[str, ...]:
        columns_present = tuple(column if column in names else "" for column in columns)
        return columns_present if any(columns_present) else ()

    commands: dict[CommandKind, CommandMapping] = {}
    for kind in get_args(CommandKind):
        columns = tuple(name for name in header if name.startswith(f"{kind}."))
        if columns:
            names_of_axes = tuple(name.split(".", 1)[1] for name in columns)
            commands[kind] = CommandMapping(columns=columns, names=names_of_axes)
    groups: dict[str, list[tuple[str, str, str]]] = {}
    for column in header:
        if match := _SENSOR.fullmatch(column):
            kind, sensor, name = match.groups()
            groups.setdefault(sensor or kind, []).append((kind, column, name))
    sensors = {
        sensor: SensorMapping(
            kind=rows[0][0],
            columns=tuple(row[1] for row in rows),
            names=tuple(row[2] for row in rows),
        )
        for sensor, rows in groups.items()
    }
    return LogMapping(
        frames=FrameMapping(world="local", body="base"),
        motion=MotionMapping(
            position=present(POSITION),
            quaternion=QUATERNION if present(QUATERNION) else (),
            velocity=present(VELOCITY),
            angular_velocity=present(ANGULAR_VELOCITY),
        ),
        commands=MappingProxyType(commands),
        sensors=MappingProxyType(sensors),
    )


def list_columns(mapping: LogMapping) -> list[str]:
    """Return all columns that a mapping names, each once, the time first."""
    motion = mapping.motion
    groups: Iterable[tuple[Column, ...]] = (
        (mapping.time.column,),
        *(motion.position, motion.quaternion, motion.rpy),
        *(motion.velocity, motion.angular_velocity),
        *(command.columns for command in mapping.commands.values()),
        *(sensor.columns for sensor in mapping.sensors.values()),
    )
    names = (column for group in groups for column in group if isinstance(column, str) and column)
    return list(dict.fromkeys(names))


def name_columns(log: VehicleLog) -> list[str]:
    """Return the header of a log as uwsim writes it."""
    header = ["time"]
    if log.motion is not None:
        header += [*POSITION, *QUATERNION]
        header += [] if log.motion.twists is None else [*VELOCITY, *ANGULAR_VELOCITY]
    header += [f"{series.kind}.{name}" for series in log.commands for name in series.names]
    for label, sensor in log.sensors.items():
        prefix = sensor.kind if label == sensor.kind else f"{sensor.kind}:{label}"
        header += [f"{prefix}.{name}" for name in sensor.names]
    return header


def template_text(header: Sequence[str]) -> str:
    """Return a mapping file to edit, for a file with this header."""
    lines = [
        "# The mapping of a CSV log: fill in the names of columns; remove what the log lacks.",
        f"# Columns: {', '.join(header)}",
        "",
        'vehicle = ""',
        "",
        "[time]",
        f'column = "{_guess(header, ("time", "timestamp", "t"))}"',
        'unit = "s"                       # s, ms, us, ns, min',
        "",
        "[frames]",
        'world = "ned"                    # ned, enu, or local: the frame L of the scene',
        'body = "frd"                     # frd, flu, or base: the base of the URDF',
        "",
        "[motion]",
        'position = ["x", "y", "z"]       # "": no such column; a number: a constant',
        'position_unit = "m"',
        'rpy = ["roll", "pitch", "yaw"]   # or quaternion = ["qw", "qx", "qy", "qz"]',
        'angle_unit = "rad"               # rad, deg',
        'velocity = ["u", "v", "w"]       # over ground; omit it to estimate it from poses',
        'velocity_frame = "body"          # body, world',
        'angular_velocity = ["p", "q", "r"]',
        "",
        "[commands.thrusters]",
        'columns = ["t1", "t2"]',
        "names = []                       # of the vehicle's thrusters, in the order of columns",
        'unit = "1"                       # 1: from -1 to 1; %; pwm: 1100 to 1900 us',
        "signs = []                       # 1, or -1 for a reversed propeller",
        "",
        "# [sensors.dvl]",
        '# kind = "dvl"                   # imu, dvl, pressure, gps, range, battery',
        '# columns = ["dvl_x", "dvl_y", "dvl_z"]',
        '# names = ["u", "v", "w"]',
        '# units = ["m/s", "m/s", "m/s"]',
        "",
    ]
    return "\n".join(lines)


def _guess(header: Sequence[str], names: tuple[str, ...]) -> str:
    lower = {column.lower(): column for column in header}
    return next((lower[name] for name in names if name in lower), "time")
