"""``uwsim report``: draw the report and the plots of a result again."""

from __future__ import annotations

from typing import Annotated

from ..base.terminal import warn
from .options.help_texts import OUTPUT, option
from .options.options import ResultArgument
from .output.console import Console

Pdf = Annotated[bool, option(OUTPUT, "--pdf", help="Draw every plot as PDF, too, for a paper.")]


def report(result: ResultArgument, pdf: Pdf = False) -> None:
    """Draw report.html and the plots of RESULT again, from its own files alone.

    Its rows are compared with the journals of its trials; missing journals are reported.
    """
    from ..analysis.report import write_report
    from ..results.journal_check import check_rows
    from ..results.result_file import file_of, load

    warning = check_rows(load(result), file_of(result).parent)
    if warning is not None:
        warn(warning)
    page = write_report(result, pdf=pdf)
    Console().print(f"written: {page}", soft_wrap=True, highlight=False, markup=False)
