"""The envelope of a benchmark: the level at which runs break, with confidence limits.

A run *breaks* if a criterion holds for it, for instance a tracking error above a limit; else the
run *holds*. The search raises (or lowers) one swept parameter until runs break.
"""

from __future__ import annotations

from .criterion import Criterion, Judgement, parse_criterion
from .envelope import Envelope, SearchSettings
from .evaluate import Evaluation, Evaluations, plan_for
from .search import Range, Search, Threshold, search, strategy

__all__ = [
    "Criterion",
    "Envelope",
    "Evaluation",
    "Evaluations",
    "Judgement",
    "Range",
    "Search",
    "SearchSettings",
    "Threshold",
    "parse_criterion",
    "plan_for",
    "search",
    "strategy",
]
