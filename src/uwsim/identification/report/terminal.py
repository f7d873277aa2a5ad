"""The tables of an identification for the terminal."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..identify import Identification
from .tables import (
    COEFFICIENT_HEADER,
    HORIZON_HEADER,
    Row,
    list_warnings,
    make_coefficient_rows,
    make_horizon_rows,
)


def print_tables(result: Identification, console: Console) -> None:
    """Print warnings about the model, coefficients, errors of held-out windows and advice."""
    for sentence in result.check.warnings:
        console.print(f"warning: {sentence}", markup=False, highlight=False, soft_wrap=True)
    estimates = result.uncertainty.estimates
    console.print(_make_table(COEFFICIENT_HEADER, make_coefficient_rows(estimates)))
    if result.horizons:
        console.print(_make_table(HORIZON_HEADER, make_horizon_rows(result.horizons)))
    for sentence in (*list_warnings(result), *result.advice, *result.windows.remarks):
        console.print(sentence, markup=False, highlight=False, soft_wrap=True)


def _make_table(header: Row, rows: list[Row]) -> Table:
    table = Table(box=None, pad_edge=False)
    for name in header:
        is_number = name in ("first guess", "identified", "before", "after", "windows")
        table.add_column(name, justify="right" if is_number else "left", no_wrap=True)
    for row in rows:
        table.add_row(*map(Text, row))
    return table
