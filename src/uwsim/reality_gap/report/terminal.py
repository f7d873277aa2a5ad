"""The tables of a gap for the terminal."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..gap import Gap
from .tables import axis_rows, cause_row, horizon_row, rest_row, sensor_row


def print_gap(gap: Gap, console: Console) -> None:
    """Print the errors, the causes, the residuals of sensors, remarks and the verdict."""
    table = _make_table(
        "error of the simulated position (95 % interval)",
        ("after", "windows", "RMS", "distance travelled", "ratio"),
    )
    for error in gap.horizons:
        table.add_row(*map(Text, horizon_row(error)))
    console.print(table)
    for error in gap.horizons:
        table = _make_table(
            f"after {error.horizon:g} s", ("axis", "RMS", "bias", "simulated / measured")
        )
        for row in axis_rows(gap, error):
            table.add_row(*map(Text, row))
        console.print(table)
    if gap.attribution is not None and gap.attribution.causes:
        table = _make_table(
            "coefficients that explain the error", ("coefficient", "factor", "share", "confidence")
        )
        for cause in gap.attribution.causes:
            table.add_row(*map(Text, cause_row(cause)[:4]))
        table.add_row(*map(Text, rest_row(gap.attribution)[:4]))
        console.print(table)
    if gap.sensors:
        table = _make_table(
            "sensors: simulated minus measured",
            ("sensor", "quantity", "RMS", "bias", "deviation of readings"),
        )
        for residual in gap.sensors:
            table.add_row(*map(Text, sensor_row(residual)))
        console.print(table)
    for remark in gap.remarks:
        console.print(f"note: {remark}", markup=False, highlight=False)
    console.print(gap.verdict, markup=False, highlight=False)


def _make_table(title: str, columns: tuple[str, ...]) -> Table:
    table = Table(title=title, title_justify="left")
    for index, column in enumerate(columns):
        table.add_column(column, justify="left" if index == 0 else "right", no_wrap=True)
    return table
