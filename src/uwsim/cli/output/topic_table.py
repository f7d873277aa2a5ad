"""The topics of a run as a table, or as JSON for programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from .console import standard_output

if TYPE_CHECKING:
    from ...middleware.recording import TopicRate
    from ...simulation import Simulation

NUMBERS = ("messages", "rate [Hz]", "min gap [s]", "max gap [s]", "std [s]")


def print_topics(
    scene: str, simulation: Simulation, rates: Sequence[TopicRate], recording: Path | None
) -> None:
    """Print what came on each topic."""
    console = standard_output()
    console.print(table_of(rates))
    seconds = f"{simulation.time:g} s of {Path(scene).name or 'the scene'}"
    is_kept = recording is not None and recording.exists()  # not after a full disk
    written = f"; recorded: {recording} ({_size(recording)})" if recording and is_kept else ""
    print(f"{seconds}, {simulation.step} steps{written}")


def print_json(
    scene: str, simulation: Simulation, rates: Sequence[TopicRate], recording: Path | None
) -> None:
    """Print the same for a program."""
    document = {
        "scene": scene,
        "time": simulation.time,
        "steps": simulation.step,
        "recording": str(recording) if recording and recording.exists() else None,
        "topics": [asdict(each) for each in rates],
        "services": list(simulation.bus.services.names),
    }
    print(json.dumps(document, indent=1))


def table_of(rates: Sequence[TopicRate]) -> Table:
    """Return a row for each topic."""
    is_counted = any(each.n_messages is not None for each in rates)
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("topic", no_wrap=True, style="bold")
    table.add_column("type", no_wrap=True)
    for name in NUMBERS if is_counted else ():
        table.add_column(Text(name), justify="right")
    table.add_column("")
    for each in rates:
        gaps = (each.min_gap, each.max_gap, each.std_gap)
        n_messages = "-" if each.n_messages is None else str(each.n_messages)
        numbers = [n_messages, _number(each.rate), *map(_number, gaps)]
        role = "" if each.is_published else "subscribed to; nothing publishes"
        if is_counted and each.n_messages is None:
            role = "not read"
        table.add_row(each.topic, each.message_type, *(numbers if is_counted else ()), role)
    return table


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g}" if abs(value) > 1e-9 else "0"


def _size(path: Path) -> str:
    return f"{path.stat().st_size / 1e6:.3g} MB"
