"""``uwsim suite seeds``: the seeds of the split test."""

from __future__ import annotations

from typing import Annotated

from ..options.help_texts import INPUT, option
from .list import SuiteArgument


def print_seeds(
    suite: SuiteArgument,
    date: Annotated[str, option(INPUT, "--date", metavar="YYYY-MM-DD", help="The announced date.")],
    beacon: Annotated[
        str,
        option(
            INPUT,
            "--beacon",
            metavar="TEXT",
            help="A public text of that date, which nobody can choose.",
        ),
    ],
    count: Annotated[
        int, option(INPUT, "--seeds", metavar="K", min=1, help="The number of seeds.")
    ] = 10,
) -> None:
    """Print the seeds of the split test.

    They follow from the hash of the suite, the date and the text by SHA-256, so nobody knows them
    before the text exists. `uwsim suite run --split test` with the same date and text uses them.
    """
    from ...suites.seeds import draw_test_seeds
    from ...suites.suite import find_suite, read_suite

    seeds = draw_test_seeds(read_suite(find_suite(suite)), date, beacon, count)
    print(" ".join(str(seeds.first + i) for i in range(count)))
