"""Messages that command an autopilot: arming, modes, manual control, targets and missions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .message import Message

ARM_DISARM = 400
"""The number of MAV_CMD_COMPONENT_ARM_DISARM."""
DO_SET_MODE = 176
"""The number of MAV_CMD_DO_SET_MODE."""
SET_MESSAGE_INTERVAL = 511
"""The number of MAV_CMD_SET_MESSAGE_INTERVAL."""
MISSION_START = 300
"""The number of MAV_CMD_MISSION_START."""
NAV_WAYPOINT = 16
"""The number of MAV_CMD_NAV_WAYPOINT."""
FORCE = 21196.0
"""The second parameter of the arming command that skips the checks before arming."""
CUSTOM_MODE_ENABLED = 1
"""The bit of MAV_MODE_FLAG_CUSTOM_MODE_ENABLED in base modes."""
LOCAL_NED, GLOBAL_RELATIVE_ALT_INT, GLOBAL_INT = 1, 6, 5
"""The numbers of MAV_FRAME_LOCAL_NED, MAV_FRAME_GLOBAL_RELATIVE_ALT_INT, MAV_FRAME_GLOBAL_INT."""
NEUTRAL_THROTTLE = 500
"""The vertical stick of MANUAL_CONTROL of ArduSub at rest, in its range of 0 to 1000."""
HAS_PITCH, HAS_ROLL = 0x01, 0x02
"""The bits of ``enabled_extensions`` of MANUAL_CONTROL for pitch (s) and roll (t)."""
IGNORE_POSITION, IGNORE_VELOCITY, IGNORE_ACCELERATION = 0x007, 0x038, 0x1C0
"""The bits of a target's type mask for positions, velocities and accelerations."""
IGNORE_YAW, IGNORE_YAW_RATE = 0x400, 0x800
"""The bits of a target's type mask for the heading and its rate."""


@dataclass(frozen=True)
class Target:
    """The autopilot to which commands are sent."""

    system: int = 1
    """The number of its system, ``SYSID_THISMAV`` (``MAV_SYSID``) of ArduPilot."""
    component: int = 1
    """The number of its component; 1 is the autopilot."""


@dataclass(frozen=True, kw_only=True)
class Sticks:
    """The positions of a pilot's sticks, each from -1 to 1."""

    surge: float = 0.0
    """The command to move forward."""
    sway: float = 0.0
    """The command to move to starboard."""
    heave: float = 0.0
    """The command to move up."""
    yaw: float = 0.0
    """The command to turn the bow to starboard."""
    pitch: float = 0.0
    """The command to turn the bow up."""
    roll: float = 0.0
    """The command to turn the starboard side down."""
    buttons: int = 0
    """The pressed buttons, one bit each, 16 bits."""


def heartbeat(*, type: int, autopilot: int = 8) -> Message:
    """Return HEARTBEAT of a component that is no autopilot.

    Args:
        type: its MAV_TYPE: 6 for a ground station, 18 for a computer on board.
        autopilot: its MAV_AUTOPILOT: 8, invalid, for what is no autopilot.
    """
    fields = {"type": type, "autopilot": autopilot, "system_status": 4, "mavlink_version": 3}
    return Message("HEARTBEAT", fields)


def command(target: Target, number: int, *parameters: float) -> Message:
    """Return COMMAND_LONG with a number of MAV_CMD and its parameters; missing ones are 0."""
    values = {f"param{k}": float(value) for k, value in enumerate(parameters, start=1)}
    return Message("COMMAND_LONG", {**_address(target), "command": number, **values})


def arm(target: Target, is_armed: bool, *, is_forced: bool = False) -> Message:
    """Return the command to arm or to disarm; forced: without the checks before arming."""
    return command(target, ARM_DISARM, float(is_armed), FORCE if is_forced else 0.0)


def set_mode(target: Target, number: int) -> Message:
    """Return the command to change the flight mode to one of `uwsim.autopilots.mavlink.modes`."""
    return command(target, DO_SET_MODE, CUSTOM_MODE_ENABLED, number)


def set_message_interval(target: Target, message_number: int, interval: float) -> Message:
    """Return the command to send a message every ``interval`` [s]."""
    return command(target, SET_MESSAGE_INTERVAL, message_number, round(1e6 * interval))


def set_origin(target: Target, *, latitude: float, longitude: float, altitude: float) -> Message:
    """Return SET_GPS_GLOBAL_ORIGIN: the geodetic position of the origin of local positions.

    Without it, and without a GPS, ArduPilot navigates in no mode that needs a position.

    Args:
        target: the autopilot.
        latitude: the latitude [rad].
        longitude: the longitude [rad].
        altitude: the height above mean sea level [m].
    """
    fields = {
        "target_system": target.system,
        "latitude": round(1e7 * math.degrees(latitude)),
        "longitude": round(1e7 * math.degrees(longitude)),
        "altitude": round(1e3 * altitude),
    }
    return Message("SET_GPS_GLOBAL_ORIGIN", fields)


def manual_control(target: Target, sticks: Sticks) -> Message:
    """Return MANUAL_CONTROL: x, y and r from -1000 to 1000; z of ArduSub from 0 to 1000, 500 rest.

    Pitch and roll are sent as the extensions s and t. ArduSub adds s to the channel of pitch, whose
    positive sense is the bow up, in [us]; it is therefore scaled to 400 us.
    """
    has_attitude = bool(sticks.pitch or sticks.roll)
    fields = {
        "target": target.system,
        "x": _scale(sticks.surge, 1000),
        "y": _scale(sticks.sway, 1000),
        "z": NEUTRAL_THROTTLE + _scale(sticks.heave, 500),
        "r": _scale(sticks.yaw, 1000),
        "buttons": sticks.buttons & 0xFFFF,
        "enabled_extensions": HAS_PITCH | HAS_ROLL if has_attitude else 0,
        "s": _scale(sticks.pitch, 400),
        "t": _scale(sticks.roll, 400),
    }
    return Message("MANUAL_CONTROL", fields)


def local_target(
    target: Target,
    time: float,
    *,
    position: Sequence[float] | None = None,
    velocity: Sequence[float] | None = None,
    yaw: float | None = None,
) -> Message:
    """Return SET_POSITION_TARGET_LOCAL_NED: a position, a velocity or both, and a heading.

    Args:
        target: the autopilot.
        time: the time [s].
        position: north, east, down from the origin, (3,) [m]; None: the position is free.
        velocity: north, east, down, (3,) [m/s]; None: the velocity is free.
        yaw: the heading from north to east [rad]; None: the heading is free.
    """
    x, y, z = (0.0, 0.0, 0.0) if position is None else map(float, position)
    fields = {
        **_target_fields(target, time, LOCAL_NED, position is not None, velocity, yaw),
        **{"x": x, "y": y, "z": z},
    }
    return Message("SET_POSITION_TARGET_LOCAL_NED", fields)


def global_target(
    target: Target,
    time: float,
    *,
    latitude: float,
    longitude: float,
    altitude: float,
    velocity: Sequence[float] | None = None,
    yaw: float | None = None,
) -> Message:
    """Return SET_POSITION_TARGET_GLOBAL_INT: a geodetic position, perhaps a velocity and a heading.

    Args:
        target: the autopilot.
        time: the time [s].
        latitude: the latitude [rad].
        longitude: the longitude [rad].
        altitude: the height above mean sea level [m].
        velocity: north, east, down, (3,) [m/s]; None: the velocity is free.
        yaw: the heading from north to east [rad]; None: the heading is free.
    """
    fields = {
        **_target_fields(target, time, GLOBAL_INT, True, velocity, yaw),
        "lat_int": round(1e7 * math.degrees(latitude)),
        "lon_int": round(1e7 * math.degrees(longitude)),
        "alt": altitude,
    }
    return Message("SET_POSITION_TARGET_GLOBAL_INT", fields)


def mission_count(target: Target, n_items: int) -> Message:
    """Return MISSION_COUNT, which begins the transfer of a mission to the autopilot."""
    return Message("MISSION_COUNT", {**_address(target), "count": n_items})


def waypoint(
    target: Target, index: int, *, latitude: float, longitude: float, altitude: float
) -> Message:
    """Return MISSION_ITEM_INT with a waypoint; ``altitude`` [m] is relative to home.

    Item 0 of ArduPilot's missions is home, so waypoints begin at 1. Angles are in [rad].
    """
    fields = {
        **_address(target),
        "seq": index,
        "frame": GLOBAL_RELATIVE_ALT_INT,
        "command": NAV_WAYPOINT,
        "autocontinue": 1,
        "x": round(1e7 * math.degrees(latitude)),
        "y": round(1e7 * math.degrees(longitude)),
        "z": altitude,
    }
    return Message("MISSION_ITEM_INT", fields)


def _address(target: Target) -> dict[str, int]:
    return {"target_system": target.system, "target_component": target.component}


def _scale(value: float, full_scale: int) -> int:
    return round(full_scale * min(1.0, max(-1.0, value)))


def _target_fields(
    target: Target,
    time: float,
    frame: int,
    has_position: bool,
    velocity: Sequence[float] | None,
    yaw: float | None,
) -> dict[str, float]:
    vx, vy, vz = (0.0, 0.0, 0.0) if velocity is None else map(float, velocity)
    mask = IGNORE_ACCELERATION | IGNORE_YAW_RATE
    mask |= 0 if has_position else IGNORE_POSITION
    mask |= IGNORE_VELOCITY if velocity is None else 0
    mask |= IGNORE_YAW if yaw is None else 0
    return {
        **_address(target),
        "time_boot_ms": round(1e3 * max(0.0, time)) % 2**32,
        "coordinate_frame": frame,
        "type_mask": mask,
        **{"vx": vx, "vy": vy, "vz": vz, "yaw": 0.0 if yaw is None else yaw},
    }
