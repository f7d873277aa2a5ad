"""The specification of an external program that is the algorithm of a simulation."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from ...errors import BadSetting, did_you_mean
from ..connection import ConnectionSpec

Sync = Literal["ack", "step", "output", "none"]
"""The synchronization: simulation time waits for an acknowledgement of each tick, for a call of
``step_simulation``, for the outputs of a node without lock-step, or for nothing (real time)."""
DEFAULT_SETTLE_TIME = 0.005
"""The default time for a node of ROS to receive the messages sent to it [s of wall time]."""
ORDERED_TRANSPORTS = ("web",)
"""The transports that keep the order of messages on all topics."""
LOCK_STEP, FREE_RUNNING = "lock-step", "free-running"
"""The two kinds of participation, as they are named in a result."""
GRADES = {"ack": "(a)", "step": "(b)", "output": "(c)"}
"""The grade of each synchronization: how it pairs answers with inputs (docs/lock-step.md)."""
RATE = re.compile(r"([0-9.eE+-]+) ?Hz", re.ASCII)
"""The pattern of a rate in ``--output``."""


@dataclass(frozen=True, kw_only=True)
class OutputSpec:
    """A topic that a node publishes, and the schedule of its messages."""

    topic: str
    """The topic, without a leading slash."""
    rate: float | None = None
    """The rate at which a timer of the node publishes, in simulation time [Hz]; None: no timer."""
    input_topic: str | None = None
    """The input topic, without a leading slash, for each message of which the node publishes one
    output; None: a timer publishes."""


@dataclass(frozen=True, kw_only=True)
class ClientSpec:
    """An external program that is the algorithm."""

    name: str
    """The name under which the program joins, and in the result."""
    connection: ConnectionSpec
    """The connection that the program uses."""
    limit: float = 60.0
    """The time limit for joining, and for each answer [s of wall time]."""
    sync: Sync = "ack"
    """The synchronization of simulation time."""
    outputs: tuple[OutputSpec, ...] = ()
    """The outputs for which simulation time waits (``output`` only)."""
    settle: float = DEFAULT_SETTLE_TIME
    """The time for messages to arrive over ROS (``step`` and ``output`` only) [s of wall time]."""
    speed: float = 1.0
    """The real-time factor: simulation time per real time (``none`` only) [1]."""
    secret: str | None = field(default=None, repr=False)
    """The secret that the join must have, so that no other program joins (``ack`` only)."""

    @property
    def transport(self) -> str:
        """The name of the transport: ros1, ros2, web."""
        return self.connection.names[0]

    @property
    def keeps_order(self) -> bool:
        """True if messages arrive in the order in which they were sent, on all topics."""
        return self.transport in ORDERED_TRANSPORTS

    @property
    def settle_time(self) -> float:
        """The time to wait for messages to arrive, 0 over WebSocket [s of wall time]."""
        return 0.0 if self.keeps_order else self.settle

    @property
    def participation(self) -> str:
        """The kind of participation in a result: ``lock-step, ros1, grade (a)``."""
        if self.sync == "none":
            return f"{FREE_RUNNING}, {self.transport}, not repeatable"
        text = f"{LOCK_STEP}, {self.transport}, grade {GRADES[self.sync]}"
        is_certain = self.sync == "ack" or self.keeps_order
        return text if is_certain else f"{text}, not guaranteed"


def read_sync(text: str) -> Sync:
    """Read ``--sync``; raise BadSetting if it is invalid."""
    for name in get_args(Sync):
        if text == name:
            sync: Sync = name
            return sync
    raise BadSetting(
        f"--sync {text}: expected {', '.join(get_args(Sync))}.{did_you_mean(text, get_args(Sync))}"
    )


def read_outputs(texts: Sequence[str]) -> tuple[OutputSpec, ...]:
    """Read every ``--output``; raise BadSetting if one is invalid, or occurs twice."""
    outputs: dict[str, OutputSpec] = {}
    for text in texts:
        output = read_output(text)
        if output.topic in outputs:
            raise BadSetting(f"--output {text}: /{output.topic} occurs twice.")
        outputs[output.topic] = output
    return tuple(outputs.values())


def read_output(text: str) -> OutputSpec:
    """Read ``TOPIC=10Hz`` or ``TOPIC=INPUT``; raise BadSetting if it is invalid."""
    topic, _, schedule = (part.strip() for part in text.partition("="))
    name, input_topic = topic.lstrip("/"), schedule.lstrip("/")
    if not name or not input_topic:
        raise BadSetting(
            f"--output {text}: expected TOPIC=RATE or TOPIC=INPUT, as /cmd_vel=10Hz or "
            "/corners=/camera/image."
        )
    if name == input_topic:
        raise BadSetting(
            f"--output {text}: the input is the output itself; expected another topic."
        )
    if schedule[0] not in "+-.0123456789" and not schedule.lower().endswith("hz"):
        return OutputSpec(topic=name, input_topic=input_topic)
    match = RATE.fullmatch(schedule)
    try:
        rate = float(match[1]) if match else float("nan")
    except ValueError:
        rate = float("nan")
    if not 0.0 < rate <= 1e4:
        raise BadSetting(
            f"--output {text}: expected a rate above 0, of 10 000 Hz at most, as {topic}=10Hz."
        )
    return OutputSpec(topic=name, rate=rate)
