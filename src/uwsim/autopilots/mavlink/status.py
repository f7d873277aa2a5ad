"""The status of an autopilot, from its messages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...base.record import Record
from .message import Message
from .modes import SUBMARINE, mode_name

AUTOPILOT_COMPONENT = 1
"""The number of the component that is the autopilot."""
ARMED_FLAG = 0x80
"""The bit of MAV_MODE_FLAG_SAFETY_ARMED in base modes."""
INVALID_AUTOPILOT = 8
"""The MAV_AUTOPILOT of components that are no autopilot."""
SEVERITIES = (
    *("emergency", "alert", "critical", "error"),
    *("warning", "notice", "info", "debug"),
)
"""The severities of texts by number, MAV_SEVERITY."""
MAX_TEXT_LENGTH = 500
"""The greatest length of a text that is sent in pieces."""
N_SERVOS = 16
"""The number of servo outputs in a SERVO_OUTPUT_RAW."""
ACK_RESULTS = ("accepted", "temporarily rejected", "denied", "unsupported", "failed", "in progress")
"""The results of commands by number, MAV_RESULT."""

COMMAND_NAMES: Mapping[int, str] = {176: "mode", 400: "arming", 511: "rate of a message"}
"""The commands that uwsim sends, by number, MAV_CMD."""


@dataclass(slots=True)
class AutopilotStatus(Record):
    """The state of an autopilot, as its messages report it."""

    system: int = 0
    """The number of the autopilot's system; 0 before its first heartbeat."""
    vehicle_type: int = SUBMARINE
    """The MAV_TYPE of the vehicle."""
    is_armed: bool = False
    """True if it is armed."""
    mode: int = 0
    """The number of the flight mode."""
    heartbeat_time: float = -1.0
    """The simulation time of its last heartbeat [s]; -1 before the first."""
    text_id: int = 0
    """The number of the text of which pieces have arrived."""
    text: str = ""
    """The pieces of a text so far."""

    @property
    def mode_name(self) -> str:
        """The name of the flight mode; empty before the first heartbeat."""
        return mode_name(self.mode, self.vehicle_type) if self.system else ""


def is_autopilot_heartbeat(message: Message) -> bool:
    """Return True for a heartbeat of an autopilot, not of a ground station or another component."""
    return (
        message.name == "HEARTBEAT"
        and message.component == AUTOPILOT_COMPONENT
        and message.system > 0
        and message.integer("autopilot") != INVALID_AUTOPILOT
    )


def apply_heartbeat(status: AutopilotStatus, message: Message, time: float) -> bool:
    """Update the status from a heartbeat; return True if mode, arming or system have changed."""
    old_values = (status.system, status.mode, status.is_armed)
    status.system = message.system
    status.vehicle_type = message.integer("type")
    status.mode = message.integer("custom_mode")
    status.is_armed = bool(message.integer("base_mode") & ARMED_FLAG)
    status.heartbeat_time = time
    return old_values != (status.system, status.mode, status.is_armed)


def read_text(status: AutopilotStatus, message: Message) -> str | None:
    """Return the text of a STATUSTEXT after its severity; None while pieces of it are missing.

    A text of more than 50 characters has a number that is not 0, and arrives in pieces; a piece
    with fewer than 50 characters is the last. A new number discards the pieces before it.
    """
    piece, number = str(message.fields.get("text", "")), message.integer("id")
    severity = SEVERITIES[min(max(message.integer("severity"), 0), 7)]
    if number == 0:
        return f"{severity}: {piece}"
    is_same_text = number == status.text_id and message.integer("chunk_seq") > 0
    status.text = (status.text if is_same_text else "") + piece
    status.text_id = number
    if len(piece) >= 50 and len(status.text) < MAX_TEXT_LENGTH:
        return None
    text, status.text, status.text_id = status.text, "", 0
    return f"{severity}: {text}"


def servo_outputs(message: Message) -> tuple[int, ...]:
    """Return the pulse widths of a SERVO_OUTPUT_RAW [us], (16,); 0 if a channel is not used."""
    return tuple(message.integer(f"servo{k}_raw") for k in range(1, N_SERVOS + 1))


def describe_command(message: Message) -> str:
    """Return the command of a COMMAND_ACK in words."""
    number = message.integer("command")
    name = COMMAND_NAMES.get(number)
    return f"command {number}" + ("" if name is None else f" ({name})")


def describe_result(message: Message) -> str:
    """Return the result of a COMMAND_ACK as a word."""
    number = message.integer("result")
    return ACK_RESULTS[number] if 0 <= number < len(ACK_RESULTS) else f"result {number}"
