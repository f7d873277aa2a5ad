"""The flight modes of ArduSub and ArduRover, as ArduPilot numbers them (custom modes)."""

from __future__ import annotations

from collections.abc import Mapping

from ...errors import BadSetting, did_you_mean

SUB_MODES = {
    "STABILIZE": 0,
    "ACRO": 1,
    "ALT_HOLD": 2,
    "AUTO": 3,
    "GUIDED": 4,
    "CIRCLE": 7,
    "SURFACE": 9,
    "POSHOLD": 16,
    "MANUAL": 19,
    "MOTOR_DETECT": 20,
    "SURFTRAK": 21,
}
"""The modes of ArduSub (``ArduSub/mode.h``); SURFTRAK since 4.5."""
ROVER_MODES = {
    "MANUAL": 0,
    "ACRO": 1,
    "STEERING": 3,
    "HOLD": 4,
    "LOITER": 5,
    "FOLLOW": 6,
    "SIMPLE": 7,
    "DOCK": 8,
    "CIRCLE": 9,
    "AUTO": 10,
    "RTL": 11,
    "SMART_RTL": 12,
    "GUIDED": 15,
    "INITIALISING": 16,
}
"""The modes of ArduRover (``Rover/mode.h``)."""
SUBMARINE, SURFACE_BOAT, GROUND_ROVER = 12, 11, 10
"""The numbers of MAV_TYPE_SUBMARINE, MAV_TYPE_SURFACE_BOAT, MAV_TYPE_GROUND_ROVER."""


def modes_of(vehicle_type: int) -> Mapping[str, int]:
    """Return the modes of a vehicle by its MAV_TYPE: those of ArduRover, else of ArduSub."""
    return ROVER_MODES if vehicle_type in (SURFACE_BOAT, GROUND_ROVER) else SUB_MODES


def mode_number(name: str, vehicle_type: int = SUBMARINE) -> int:
    """Return the number of a mode; raise BadSetting, which lists the modes, if there is none."""
    modes = modes_of(vehicle_type)
    number = modes.get(name.strip().upper())
    if number is None:
        raise BadSetting(
            f"{name[:40]!r} is not a flight mode.{did_you_mean(name.upper(), modes)} "
            f"Modes: {', '.join(modes)}."
        )
    return number


def mode_name(number: int, vehicle_type: int = SUBMARINE) -> str:
    """Return the name of a mode; ``MODE 42`` if the number has none."""
    names = {value: name for name, value in modes_of(vehicle_type).items()}
    return names.get(number, f"MODE {number}")
