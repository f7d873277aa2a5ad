"""A program outside that is the algorithm of a simulation: how it comes, and what is waited for."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from ...errors import BadSetting, did_you_mean
from ..connection import ConnectionSpec

Sync = Literal["ack", "step", "output", "none"]
"""What simulation time waits for: an acknowledgement of each tick; a call of ``step_simulation``;
the outputs of a node that knows nothing of lock-step; nothing, it is real time."""
SETTLE = 0.005
"""Default of how long a node of ROS may take to have what was sent to it [s of wall time]."""
ORDERED = ("web",)
"""Transports that keep the order of all that they carry."""
LOCK_STEP, FREE = "lock-step", "free-running"
"""How a program outside takes part, as a result says it."""
GRADES = {"ack": "(a)", "step": "(b)", "output": "(c)"}
"""What its answers are paired with what it is given by (docs/lock-step.md)."""
RATE = re.compile(r"([0-9.eE+-]+) ?Hz", re.ASCII)


@dataclass(frozen=True, kw_only=True)
class OutputSpec:
    """A topic that a node publishes, and when a message of it is due."""

    topic: str
    """Without a leading slash."""
    rate: float | None = None
    """That of the node's timer, on the clock of the simulation [Hz]."""
    follows: str | None = None
    """Topic for each message of which the node publishes one; without a leading slash."""


@dataclass(frozen=True, kw_only=True)
class ClientSpec:
    """A program outside that is the algorithm."""

    name: str
    """Under which it joins, or is known in the result."""
    connection: ConnectionSpec
    """The one by which it comes."""
    limit: float = 60.0
    """How long it may take to join, and to answer [s of wall time]."""
    sync: Sync = "ack"
    """What simulation time waits for."""
    outputs: tuple[OutputSpec, ...] = ()
    """Of ``output``: those that are waited for."""
    settle: float = SETTLE
    """Of ``step`` and ``output``, over ROS: how long what was sent may be on its way [s of wall
    time]."""
    speed: float = 1.0
    """Of ``none``: simulation time per real time."""
    secret: str | None = field(default=None, repr=False)
    """Of ``ack``: what the join has to have, so that no other program joins under the name."""

    @property
    def transport(self) -> str:
        """Name of that by which it comes: ros1, ros2, web."""
        return self.connection.names[0]

    @property
    def keeps_order(self) -> bool:
        """Whether what is sent arrives in the order in which it was sent, on all topics."""
        return self.transport in ORDERED

    @property
    def settling(self) -> float:
        """How long to wait for what is on its way [s of wall time]."""
        return 0.0 if self.keeps_order else self.settle

    @property
    def participation(self) -> str:
        """How it takes part, as a result says it: ``lock-step, ros1, grade (a)``."""
        if self.sync == "none":
            return f"{FREE}, {self.transport}, not repeatable"
        said = f"{LOCK_STEP}, {self.transport}, grade {GRADES[self.sync]}"
        is_certain = self.sync == "ack" or self.keeps_order
        return said if is_certain else f"{said}, not guaranteed"


def sync_named(text: str) -> Sync:
    """Return what ``--sync`` names; raises BadSetting."""
    for known in get_args(Sync):
        if text == known:
            found: Sync = known
            return found
    raise BadSetting(
        f"--sync {text}: expected {', '.join(get_args(Sync))}.{did_you_mean(text, get_args(Sync))}"
    )


def outputs_of(texts: Sequence[str]) -> tuple[OutputSpec, ...]:
    """Read every ``--output``; raises BadSetting."""
    found: dict[str, OutputSpec] = {}
    for text in texts:
        output = output_of(text)
        if output.topic in found:
            raise BadSetting(f"--output {text}: /{output.topic} is given twice.")
        found[output.topic] = output
    return tuple(found.values())


def output_of(text: str) -> OutputSpec:
    """Read ``TOPIC=10Hz`` or ``TOPIC=INPUT``; raises BadSetting."""
    topic, _, due = (part.strip() for part in text.partition("="))
    name, follows = topic.lstrip("/"), due.lstrip("/")
    if not name or not follows:
        raise BadSetting(
            f"--output {text}: expected TOPIC=RATE or TOPIC=INPUT, as /cmd_vel=10Hz or "
            "/corners=/camera/image."
        )
    if name == follows:
        raise BadSetting(f"--output {text}: a topic does not follow itself.")
    if due[0] not in "+-.0123456789" and not due.lower().endswith("hz"):
        return OutputSpec(topic=name, follows=follows)
    found = RATE.fullmatch(due)
    try:
        rate = float(found[1]) if found else float("nan")
    except ValueError:
        rate = float("nan")
    if not 0.0 < rate <= 1e4:
        raise BadSetting(
            f"--output {text}: expected a rate above 0, of 10 000 Hz at most, as {topic}=10Hz."
        )
    return OutputSpec(topic=name, rate=rate)
