"""The tables of a calibration for the terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console
from rich.table import Table

from ..calibrate import Calibration
from .tables import GATE_WORDS, make_rows


def print_tables(calibration: Calibration, console: Console) -> None:
    """Print the coefficients of every water, the readings left out, and the quality gates."""
    for table in _make_tables(calibration):
        console.print(table)
    for water in calibration.waters:
        for remark in water.remarks:
            console.print(f"note: {water.name}: not used: {remark}", markup=False)
    n_passed = sum(gate.is_passed is True for gate in calibration.gates)
    n_checked = sum(gate.is_passed is not None for gate in calibration.gates)
    console.print(f"quality gates: {n_passed} of {n_checked} passed", markup=False)
    for gate in calibration.gates:
        if gate.is_passed is not True:
            word = GATE_WORDS[gate.is_passed]
            console.print(f"  {word}: {gate.name}, {gate.subject}: {gate.text}", markup=False)


def _make_tables(calibration: Calibration) -> Iterator[Table]:
    for water in calibration.waters:
        dose = "" if water.dose is None else f", dose {water.dose:g}"
        table = Table(title=f"{water.name}{dose}: value (95 % interval)", title_justify="left")
        table.add_column("quantity", no_wrap=True)
        table.add_column("unit")
        for result in water.channels:
            table.add_column(result.estimate.channel, justify="right", no_wrap=True)
        for name, unit, texts in make_rows(water):
            table.add_row(name, unit, *texts)
        yield table
