"""The table and the sentence on the times to success of two results, for terminal and page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...results.table import exact_decimals, interval_text, number_text
from ...statistics import SuccessCurve
from .model import Comparison, LevelTimes, PairComparison
from .sentences import distinct_texts, p_text, short_verdict

DECIMALS = 1
"""The number of decimals of a time in the table [s]."""


@dataclass(frozen=True, kw_only=True)
class TimeLine:
    """The times to success of two results at one level, as text."""

    level: tuple[str, ...]
    """The values of the swept parameters, outermost first."""
    first: str
    """The successes and the median time of the first result: ``8 of 10, 41.2 [38.0, 55.1]``."""
    second: str
    """The successes and the median time of the second result."""
    difference: str
    """The mean difference up to the time limit, second minus first, with its interval."""
    p: str
    """The p-value of the sign-flip test after Holm's correction."""
    p_log_rank: str
    """The p-value of the paired log-rank test."""
    verdict: str
    """The verdict in a few words."""
    is_conclusive: bool
    """True if one result is shown to be faster."""


def time_heading(pair: PairComparison) -> str:
    """Return ``time to success [s], at most 240 s: ic minus esm``; empty without times."""
    if pair.times is None:
        return ""
    return (
        f"time to success [s], at most {pair.times.limit:.4g} s: "
        f"{pair.second.name} minus {pair.first.name}; shorter is better"
    )


def time_lines(pair: PairComparison) -> tuple[TimeLine, ...]:
    """Return the table of the times to success of a pair; empty without times."""
    if pair.times is None:
        return ()
    n_parameters = len(pair.first.result.columns_of_kind("level"))
    decimals = [
        exact_decimals([times.level[i] for times in pair.times.levels]) for i in range(n_parameters)
    ]
    return tuple(
        TimeLine(
            level=tuple(
                number_text(value, k) for value, k in zip(times.level, decimals, strict=True)
            ),
            first=_curve_text(times.first),
            second=_curve_text(times.second),
            difference=str(interval_text(times.difference.difference, DECIMALS)),
            p=p_text(times.difference.p_holm),
            p_log_rank=p_text(times.p_log_rank),
            verdict=short_verdict(pair, times.difference),
            is_conclusive=_is_conclusive(times),
        )
        for times in pair.times.levels
    )


def time_sentence(comparison: Comparison, pair: PairComparison) -> str:
    """Return the sentence on the whole sweep; empty without times."""
    times = pair.times
    if times is None or times.sweep.difference.mean is None:
        return ""
    d = times.sweep
    mean = d.difference.mean or 0.0
    text = (
        f"Mean time to success, at most {times.limit:.4g} s: {pair.first.name} "
        f"{d.first.mean:.3g} s, {pair.second.name} {d.second.mean:.3g} s; difference {mean:.3g} s"
    )
    if d.difference.low is not None and d.difference.high is not None:
        low, high = distinct_texts(d.difference.low, d.difference.high)
        n = len(comparison.pairs)
        correction = f", Holm over {n} pairs of results" if n > 1 else ""
        p = d.p if d.p_holm is None else d.p_holm
        text += f" ({low} to {high} s), p {p_text(p)} (sign-flip test{correction})"
    verdict = {"first": f"{pair.first.name} is faster", "second": f"{pair.second.name} is faster"}
    return f"{text}: {verdict.get(d.verdict, short_verdict(pair, d))}."


def _curve_text(curve: SuccessCurve) -> str:
    """Return ``8 of 10, 41.2 [38.0, 55.1]``, with a dash for a median or limit that is unknown."""
    median = curve.median
    value = "-" if median.value is None else number_text(median.value, DECIMALS)
    low, high = (
        "-" if limit is None or math.isinf(limit) else number_text(limit, DECIMALS)
        for limit in (median.low, median.high)
    )
    return f"{curve.n_successes} of {curve.n}, {value} [{low}, {high}]"


def _is_conclusive(times: LevelTimes) -> bool:
    return times.difference.verdict in ("first", "second")
