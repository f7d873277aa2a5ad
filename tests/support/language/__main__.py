"""The command ``python -m tests.support.language``."""

from __future__ import annotations

import sys
from collections import Counter

from .scan import Report, package_of, scan

KINDS_OF_TEXT = ("docstring", "article", "message", "sentence", "page")
COLUMNS = (*("function", "class", "constant", "variable"), *KINDS_OF_TEXT)
"""The kinds that the table shows."""
USAGE = """usage: python -m tests.support.language [FOLDER... | --figures]

FOLDER...   list the violations in these folders or files
--figures   print how far the code is from the figures to reach
            without arguments: a table of counts for each package, and the figures
"""


def print_figures(report: Report) -> None:
    """Print how far the code is from the figures to reach."""
    tests = scan(("tests",))
    print(f"language: {name_figures(report)}")
    print(f"language, tests: {name_figures(tests)}")
    print(
        f"language: {len(report.select('docstring'))} docstrings begin with a fragment, "
        f"{len(report.select('article'))} without an article"
    )
    share = report.total("long sentence") / max(1, report.total("sentence"))
    n_messages = len(report.select("message"))
    print(
        f"language: {share:.1%} of the sentences in docs are long (goal: 3 %), "
        f"{len(report.select('sentence'))} very long; {n_messages} long messages"
    )


def name_figures(report: Report) -> str:
    """Return the numbers of functions and variables that violate the rules."""
    n_functions, n_variables = len(report.select("function")), len(report.select("variable"))
    share = n_variables / max(1, report.total("variable"))
    return (
        f"{n_functions} of {report.total('function')} functions without a verb or noun (goal: 0), "
        f"{n_variables} variables without a noun, {share:.1%} (goal: 2 %)"
    )


def print_table(report: Report) -> None:
    """Print the numbers of violations for each package."""
    numbers = Counter((package_of(item.path), item.kind) for item in report.violations)
    rows = sorted({package for package, _ in report.counts})
    print(f"{'package':18}" + "".join(f"{column:>10}" for column in COLUMNS))
    for row in rows:
        print(f"{row:18}" + "".join(f"{numbers[row, column]:10}" for column in COLUMNS))
    totals = (len(report.select(column)) for column in COLUMNS)
    print(f"{'total':18}" + "".join(f"{total:10}" for total in totals))


def main(arguments: list[str]) -> None:
    """Run the command."""
    if arguments == ["--figures"]:
        print_figures(scan())
    elif any(argument.startswith("-") for argument in arguments):
        raise SystemExit(USAGE)
    elif arguments:
        for violation in scan(arguments).violations:
            print(violation)
    else:
        report = scan()
        print_table(report)
        print_figures(report)


main(sys.argv[1:])
