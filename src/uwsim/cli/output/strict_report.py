"""A run with the strict clock: its streams are observed, and what was late is reported."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from ...base.terminal import warn
from ...devices.streams.actuator_stream import ActuatorStream
from ...devices.streams.instrument_stream import InstrumentStream
from ...errors import RunFailed

if TYPE_CHECKING:
    from ...middleware.strict import StrictClock, StrictReport
    from ...simulation import Simulation
    from ..options.connections import ConnectionOptions
    from ..options.strict_options import StrictOptions


def print_streams(simulation: Simulation) -> None:
    """Print the formats and addresses of the open streams of a scene, to standard error."""
    for device in simulation.world.devices:
        if isinstance(device, InstrumentStream | ActuatorStream) and device.is_open:
            print(device.description, file=sys.stderr)


def make_strict_clock(
    simulation: Simulation, connections: ConnectionOptions, options: StrictOptions
) -> StrictClock | None:
    """Return the strict clock of a run, which observes its streams; None without --strict."""
    if not options.is_strict:
        return None
    from ...middleware.strict import StrictClock

    clock = StrictClock(
        lambda: simulation.time,
        connections.real_time_factor,
        deadline=options.deadline_seconds,
        max_lag=connections.max_lag,
    )
    for device in simulation.world.devices:
        if isinstance(device, InstrumentStream) and device.is_open:
            clock.watch_output(device.name, partial(getattr, device, "has_reader"))
            device.observer = clock
        elif isinstance(device, ActuatorStream) and device.is_open:
            clock.watch_input(device.name, device.rate)
            device.observer = clock
    for topic, rate in options.expected_rates.items():
        clock.watch_input(topic, rate)
        simulation.bus.subscribe(
            topic, object, partial(_note_message, clock, topic), is_counted=False
        )
    return clock


def _note_message(clock: StrictClock, topic: str, _: object) -> None:
    clock.note_command(topic, None)


@contextmanager
def hold_garbage() -> Iterator[None]:
    """Keep the garbage collector from visiting the objects of the scene, which takes long."""
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()


def warn_of_invalid_input(simulation: Simulation) -> None:
    """Warn about messages and bytes of streams that were no commands, or were lost."""
    for device in simulation.world.devices:
        if isinstance(device, ActuatorStream):
            state = device.state
            if state.n_invalid or state.n_skipped:
                warn(
                    f"{device.name} received {state.n_invalid} invalid messages and "
                    f"{state.n_skipped} bytes of no message"
                )
        elif isinstance(device, InstrumentStream) and device.state.line.n_lost:
            warn(
                f"{device.name} lost {device.state.line.n_lost} messages, which did not fit into "
                "the buffer of its line"
            )


def raise_if_late(report: StrictReport) -> None:
    """Raise RunFailed if anything was late or missing; all results are kept."""
    if report.n_errors:
        n_late = sum(stream.n_late for stream in report.streams)
        n_missing = sum(stream.n_missing for stream in report.streams)
        raise RunFailed(
            f"{n_late} late by more than {1000.0 * report.deadline:g} ms and {n_missing} missing; "
            "the table shows which. Results are kept."
        )
