"""``uwsim report``: draw the report and the plots of a result again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

Result = Annotated[
    Path, typer.Argument(metavar="RESULT", help="A result directory or its result.json.")
]
Pdf = Annotated[bool, typer.Option("--pdf", help="Draw every plot as PDF, too, for a paper.")]


def report(result: Result, pdf: Pdf = False) -> None:
    """Draw report.html and the plots of RESULT again, from what lies in it alone."""
    from ..benchmark.report import write_report

    written = write_report(result, pdf=pdf)
    Console().print(f"written: {written}", soft_wrap=True, highlight=False, markup=False)
