"""``uwsim report``: draw the report and the plots of a result again."""

from __future__ import annotations

from typing import Annotated

from rich.console import Console

from .options import ResultArgument
from .taught import OUTPUT, in_group

Pdf = Annotated[bool, in_group(OUTPUT, "--pdf", help="Draw every plot as PDF, too, for a paper.")]


def report(result: ResultArgument, pdf: Pdf = False) -> None:
    """Draw report.html and the plots of RESULT again, from what lies in it alone."""
    from ..benchmark.report import write_report

    written = write_report(result, pdf=pdf)
    Console().print(f"written: {written}", soft_wrap=True, highlight=False, markup=False)
