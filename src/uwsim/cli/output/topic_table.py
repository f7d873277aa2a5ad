"""The topics of a run as a table, or as JSON for programs."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from .console import standard_output

if TYPE_CHECKING:
    from ...middleware.recording import TopicRate
    from ...simulation import Simulation

NUMBER_COLUMNS = ("messages", "rate [Hz]", "min gap [s]", "max gap [s]", "std [s]")


def print_topics(
    scene: str, simulation: Simulation, rates: Sequence[TopicRate], recording: Path | None
) -> None:
    """Print the number and rate of the messages on each topic as a table."""
    console = standard_output()
    console.print(rate_table(rates))
    seconds = f"{simulation.time:g} s of {Path(scene).name or 'the scene'}"
    has_recording = recording is not None and recording.exists()  # not after a full disk
    recording_note = (
        f"; recorded: {recording} ({_format_size(recording)})"
        if recording and has_recording
        else ""
    )
    print(f"{seconds}, {simulation.step} steps{recording_note}")


def print_json(
    scene: str,
    simulation: Simulation,
    rates: Sequence[TopicRate],
    recording: Path | None,
    *,
    strict_report: Mapping[str, object] | None = None,
) -> None:
    """Print the number and rate of the messages on each topic as JSON."""
    document: dict[str, object] = {
        "scene": scene,
        "time": simulation.time,
        "steps": simulation.step,
        "recording": str(recording) if recording and recording.exists() else None,
        "topics": [asdict(rate) for rate in rates],
        "services": list(simulation.bus.services.names),
    }
    if strict_report is not None:
        document["strict"] = strict_report
    print(json.dumps(document, indent=1))


def rate_table(rates: Sequence[TopicRate]) -> Table:
    """Return a table with a row for each topic."""
    is_counted = any(rate.n_messages is not None for rate in rates)
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("topic", no_wrap=True, style="bold")
    table.add_column("type", no_wrap=True)
    for name in NUMBER_COLUMNS if is_counted else ():
        table.add_column(Text(name), justify="right")
    table.add_column("")
    for rate in rates:
        gaps = (rate.min_gap, rate.max_gap, rate.std_gap)
        n_messages = "-" if rate.n_messages is None else str(rate.n_messages)
        numbers = [n_messages, _format_number(rate.rate), *map(_format_number, gaps)]
        role = "" if rate.is_published else "subscribed to; nothing publishes"
        if is_counted and rate.n_messages is None:
            role = "not read"
        table.add_row(rate.topic, rate.message_type, *(numbers if is_counted else ()), role)
    return table


def _format_number(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g}" if abs(value) > 1e-9 else "0"


def _format_size(path: Path) -> str:
    return f"{path.stat().st_size / 1e6:.3g} MB"
