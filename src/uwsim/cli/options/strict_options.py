"""The options of the strict clock, for hardware in the loop."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from ...errors import BadSetting, ErrorCollector
from .connections import ConnectionOptions
from .help_texts import CLOCK, option

MAX_DEADLINE_MS = 60_000.0
"""The greatest deadline [ms]."""
MIN_EXPECTED_RATE, MAX_EXPECTED_RATE = 0.01, 1000.0
"""The range of expected rates [Hz]."""


@dataclass(frozen=True, kw_only=True)
class StrictOptions:
    """The options of the strict clock."""

    is_strict: Annotated[
        bool,
        option(
            CLOCK,
            "--strict",
            help="Real time, in which late data is an error, for hardware in the loop: open the "
            "byte streams of the scene, report what was late, and end with status 3 if "
            "anything was.",
        ),
    ] = False
    deadline: Annotated[
        float | None,
        option(
            CLOCK,
            "--deadline",
            metavar="MS",
            help="The time by which steps and messages may be late with --strict [10].",
        ),
    ] = None
    expected_inputs: Annotated[
        list[str] | None,
        option(
            CLOCK,
            "--expect",
            metavar="TOPIC=HZ",
            help="The rate at which messages of a topic are expected with --strict, such as "
            "thruster commands of ROS; repeatable.",
        ),
    ] = None
    latency: Annotated[
        Path | None,
        option(
            CLOCK,
            "--latency",
            metavar="FILE.png",
            help="Plot the delays of a run with --strict: steps, outputs, and commands.",
        ),
    ] = None

    @property
    def deadline_seconds(self) -> float:
        """The deadline [s]."""
        from ...middleware.strict.strict_clock import DEFAULT_DEADLINE

        return DEFAULT_DEADLINE if self.deadline is None else self.deadline / 1000.0

    @property
    def expected_rates(self) -> dict[str, float]:
        """The expected rate of each topic [Hz]; raise BadSetting."""
        rates = {}
        for text in self.expected_inputs or ():
            topic, _, number = text.rpartition("=")
            try:
                rate = float(number)
            except ValueError:
                rate = math.nan
            if not topic or not MIN_EXPECTED_RATE <= rate <= MAX_EXPECTED_RATE:
                raise BadSetting(
                    f"--expect {text}: expected TOPIC=HZ with a rate from {MIN_EXPECTED_RATE:g} "
                    f"to {MAX_EXPECTED_RATE:g} Hz."
                )
            rates[topic] = rate
        return rates

    def apply(
        self, connections: ConnectionOptions, udp_address: str | None
    ) -> tuple[ConnectionOptions, str | None]:
        """Return the options of a run with the strict clock: real time, and open streams."""
        if not self.is_strict:
            return connections, udp_address
        speed = 1.0 if connections.speed is None else connections.speed
        return replace(connections, speed=speed), udp_address or "127.0.0.1"

    def check(
        self, connections: ConnectionOptions, errors: ErrorCollector, *, is_viewed: bool
    ) -> None:
        """Collect the errors of the options."""
        with errors.collect():
            if self.deadline is not None and not self.is_strict:
                raise BadSetting("--deadline needs --strict.")
        with errors.collect():
            if self.latency is not None and not self.is_strict:
                raise BadSetting("--latency needs --strict.")
            if self.latency is not None and self.latency.suffix.lower() != ".png":
                raise BadSetting(f"--latency {self.latency}: expected a name that ends with .png.")
        with errors.collect():
            if self.deadline is not None and not 0.0 < self.deadline <= MAX_DEADLINE_MS:
                raise BadSetting(
                    f"--deadline {self.deadline:g}: expected a time > 0 and at most "
                    f"{MAX_DEADLINE_MS:g} [ms]."
                )
        with errors.collect():
            if self.expected_rates and not self.is_strict:
                raise BadSetting("--expect needs --strict.")
        with errors.collect():
            if self.is_strict and connections.client:
                raise BadSetting("--strict is in real time; --client waits for a program.")
        with errors.collect():
            if self.is_strict and is_viewed:
                raise BadSetting("--strict has a clock of its own; --view has another.")
        with errors.collect():
            if self.is_strict and connections.speed == 0:
                raise BadSetting("--strict needs a run in real time; --speed 0 is not.")
