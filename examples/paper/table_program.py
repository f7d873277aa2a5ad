"""The common parts of the programs that print a table of docs/reproductions.md."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from uwsim.statistics import mean_interval


def make_parser(description: str | None) -> argparse.ArgumentParser:
    """Return the parser of the options that all tables have."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--seeds", type=int, default=10, help="the number of seeds")
    parser.add_argument("--experiments", action="store_true", help="run the experiments")
    return parser


def mean_text(values: Sequence[float], digits: int) -> str:
    """Return a mean with its 95 % interval, ``0.36 [0.31, 0.41]``; without it for one value."""
    interval = mean_interval(values)
    if interval.low is None:
        return f"{interval.mean:.{digits}f}"
    return f"{interval.mean:.{digits}f} [{interval.low:.{digits}f}, {interval.high:.{digits}f}]"
