"""The conclusions of a comparison in sentences: the better result, the evidence, repeats needed."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...results.result import Column
from ...statistics import Interval, min_p_value
from ..plots import levels_text, written_unit
from .inputs import Entry
from .matrix import few_repeats_text
from .model import Comparison, LevelStatistics, PairComparison, PairedDifference, SweepStatistics
from .repeats import ALPHA


def sentences(comparison: Comparison, pair: PairComparison) -> tuple[str, ...]:
    """Return the conclusions on one pair of results."""
    parts = [
        _sweep_sentence(comparison, pair),
        _level_sentence(comparison, pair),
        _success_sentence(pair),
        _missing_values_sentence(pair),
        _unpaired_rows_sentence(pair),
        _image_sentence(pair),
    ]
    return tuple(part for part in parts if part)


def short_verdict(pair: PairComparison, d: PairedDifference) -> str:
    """Return a short verdict: ``ic better``, ``not shown``, ``too few (6 of 7)``."""
    if d.verdict in ("first", "second"):
        return f"{_better_and_worse(pair, d)[0].name} better"
    if d.verdict == "too few":
        return f"too few ({d.difference.n} of {d.repeats_to_test})"
    return d.verdict


def needed_text(comparison: Comparison, d: PairedDifference) -> str:
    """Return the number of repeats that would show a difference: ``34``, ``290``, ``>1000``."""
    is_undecided = d.verdict in ("not shown", "too few")
    if d.verdict == "one repeat" or (is_undecided and d.hedges_g is None):
        return f"≥{comparison.min_level_repeats}"
    if not is_undecided or d.repeats_needed is None:
        return "-"
    return _rounded_count(max(d.repeats_needed, d.difference.n + 1)).replace("more than ", ">")


def p_text(p: float | None) -> str:
    """Return ``0.012``, ``<0.001``, or a dash where nothing was tested."""
    if p is None:
        return "-"
    return "<0.001" if p < 0.001 else f"{p:.3f}"


def unit_text(column: Column) -> str:
    """Return the unit with a leading space, for use after a number; empty without a unit."""
    return f" {written_unit(column.unit)}" if column.unit else ""


# ---------------------------------------------------------------------------- the sweep


def _sweep_sentence(comparison: Comparison, pair: PairComparison) -> str:
    sweep, d = pair.sweep, pair.sweep.value
    n = d.difference.n
    levels_phrase = _levels_phrase(sweep)
    if d.verdict == "no pair":
        return (
            "The sweep as a whole is not compared: no level has a value from both in every repeat."
        )
    difference_text = _difference_text(comparison, pair, d)
    if d.verdict == "one repeat":
        return (
            f"One repeat (seed {sweep.seeds[0]}) allows no inference about other seeds. In it, "
            f"{difference_text}, on average {levels_phrase}. It is below at "
            f"{sweep.n_second_smaller} of these levels and above at {sweep.n_first_smaller}. "
            "The levels of one repeat share its noise and its history; they are not repeats. "
            f"Run each algorithm with --repeat {comparison.min_sweep_repeats} or more for the "
            f"sweep as a whole, {comparison.min_level_repeats} or more for single levels."
        )
    if d.verdict == "equal":
        return f"Both are equal in every one of {n} repeats, {levels_phrase}."
    headline, plan = "No difference is shown", f" {_repeats_sentence(comparison, d)}"
    if d.verdict in ("first", "second"):
        winner, loser = _better_and_worse(pair, d)
        headline, plan = f"{winner.name} is better than {loser.name}", ""
    elif d.verdict == "too few":
        headline = few_repeats_text(d)
    return (
        f"{headline}: {difference_text}, over {n} repeats. The value of a repeat is its mean "
        f"{levels_phrase}. {_effect_text(d)}{_test_text(comparison, d)}.{plan}"
    )


def _difference_text(comparison: Comparison, pair: PairComparison, d: PairedDifference) -> str:
    """Return ``'total' of ic is 0.31 px above that of esm (95 % interval 0.22 to 0.41 px)``."""
    mean = d.difference.mean or 0.0
    unit = unit_text(comparison.column)
    size = f"{abs(mean):.3g}{unit} {'above' if mean > 0 else 'below'}" if mean else "equal to"
    return (
        f"'{comparison.column.name}' of {pair.second.name} is {size} that of {pair.first.name}"
        f"{_interval_text(d.difference, mean, unit)}"
    )


def _interval_text(interval: Interval, mean: float, unit: str) -> str:
    """Return the interval of the difference, in the direction of the mean."""
    if interval.low is None or interval.high is None:
        return ""
    ends = (interval.low, interval.high) if mean >= 0 else (-interval.high, -interval.low)
    low, high = distinct_texts(*ends)
    return f" (95 % interval {low} to {high}{unit})"


def distinct_texts(low: float, high: float) -> tuple[str, str]:
    """Return two numbers with three significant digits, or more (up to seven) until they differ."""
    for digits in range(3, 8):
        texts = f"{low:.{digits}g}", f"{high:.{digits}g}"
        if texts[0] != texts[1]:
            return texts
    return f"{low:.3g}", f"{high:.3g}"


def _levels_phrase(sweep: SweepStatistics) -> str:
    if sweep.n_levels == 1:
        return "at the only level"
    n = len(sweep.levels)
    if n == sweep.n_levels:
        return f"over all {n} levels"
    level_count = f"the {n}" if n > 1 else "the only one"
    return (
        f"over {level_count} of {sweep.n_levels} levels at which every repeat of both has a value"
    )


def _effect_text(d: PairedDifference) -> str:
    size = "" if d.hedges_g is None else f"Hedges' g = {d.hedges_g:.2f}, "
    return size if d.superiority is None else f"{size}A = {d.superiority:.2f}, "


def _test_text(comparison: Comparison, d: PairedDifference) -> str:
    """Return ``p = 0.012 (sign-flip test, Holm over 3 pairs of results)``."""
    n = len(comparison.pairs)
    if d.p_holm is None:
        return f"{_p_phrase(d.p)} (sign-flip test)"
    correction = f", Holm over {n} pairs of results" if n > 1 else ""
    return f"{_p_phrase(d.p_holm)} (sign-flip test{correction})"


def _repeats_sentence(comparison: Comparison, d: PairedDifference) -> str:
    n, min_repeats = d.difference.n, comparison.min_sweep_repeats
    if d.verdict == "too few":
        min_p, n_pairs = min_p_value(n), len(comparison.pairs)
        correction = f", {n_pairs * min_p:.3g} after Holm" if n_pairs > 1 else ""
        return (
            f"With {n} repeats p cannot fall below {min_p:.3g}{correction}: "
            f"at least {min_repeats} are needed{_more_repeats_text(d, n, min_repeats)}."
        )
    if d.repeats_needed is None:
        return "The observed difference is too small to plan the repeats."
    n_repeats = _rounded_count(max(d.repeats_needed, n + 1))
    return (
        f"With {n_repeats} repeats, 4 of 5 such experiments would show a difference of the "
        "observed size."
    )


def _more_repeats_text(d: PairedDifference, n: int, min_repeats: int) -> str:
    if d.repeats_needed is None or d.repeats_needed <= max(n, min_repeats):
        return ""
    n_repeats = _rounded_count(d.repeats_needed)
    return f", and about {n_repeats} to show the observed difference in 4 of 5 experiments"


# ---------------------------------------------------------------------------- single levels


def _level_sentence(comparison: Comparison, pair: PairComparison) -> str:
    tested_levels = [stats for stats in pair.levels if stats.value.p is not None]
    if len(pair.levels) < 2 or not tested_levels:
        return ""
    columns = pair.first.result.columns_of_kind("level")
    parts = []
    for entry, verdict in ((pair.first, "first"), (pair.second, "second")):
        levels = [stats for stats in pair.levels if stats.value.verdict == verdict]
        if levels:
            parts.append(f"{entry.name} is better at {_level_ranges(columns, pair, levels)}")
    n_undecided = sum(stats.value.verdict == "not shown" for stats in tested_levels)
    if n_undecided:
        other = "other " if parts else ""
        parts.append(
            f"no difference is shown at {'the ' if other else ''}{n_undecided} {other}level"
            f"{'s' if n_undecided > 1 else ''}"
        )
    small_samples = [stats.value for stats in tested_levels if stats.value.verdict == "too few"]
    if small_samples:
        n_repeats = _range_text([d.difference.n for d in small_samples])
        parts.append(
            f"{len(small_samples)} level{'s have' if len(small_samples) > 1 else ' has'} too few "
            f"repeats to test ({n_repeats} of {comparison.min_level_repeats} needed)"
        )
    n_equal = sum(stats.value.verdict == "equal" for stats in tested_levels)
    if n_equal:
        parts.append(f"both are equal in every repeat at {n_equal}")
    return f"Single levels (Holm over {comparison.n_tests} tests): {'; '.join(parts)}."


def _level_ranges(
    columns: Sequence[Column], pair: PairComparison, level_statistics: Sequence[LevelStatistics]
) -> str:
    """Return ranges of neighbouring levels: ``14 levels (fog 0.3 to 0.95)``."""
    indices = [i for i, stats in enumerate(pair.levels) if stats in level_statistics]
    runs: list[list[int]] = []
    for index in indices:
        if runs and index == runs[-1][-1] + 1:
            runs[-1].append(index)
        else:
            runs.append([index])
    names = [
        levels_text(columns, pair.levels[run[0]].level)
        + (f" to {levels_text(columns, pair.levels[run[-1]].level)}" if len(run) > 1 else "")
        for run in runs
    ]
    n = len(indices)
    return f"{n} level{'s' if n > 1 else ''} ({'; '.join(names)})"


# ---------------------------------------------------------------------------- success


def _success_sentence(pair: PairComparison) -> str:
    d = pair.sweep.success
    if d is None or d.first.mean is None or d.second.mean is None:
        return ""
    shares = [
        f"{100 * share.mean:.3g} %" for share in (d.first, d.second) if share.mean is not None
    ]
    text = f"Levels that ended ok: {pair.first.name} {shares[0]}, {pair.second.name} {shares[1]}"
    if d.difference.mean == 0.0 and d.difference.std in (0.0, None):
        text += ", the same in every repeat."
    elif d.verdict == "one repeat":
        text += " (one repeat)."
    elif d.difference.low is not None and d.difference.high is not None:
        text += (
            f"; difference {100 * (d.difference.mean or 0.0):.3g} percentage points "
            f"({100 * d.difference.low:.3g} to {100 * d.difference.high:.3g}), "
            f"{_p_phrase(d.p if d.p_holm is None else d.p_holm)}: "
        )
        winner = {"first": pair.first, "second": pair.second}.get(d.verdict)
        text += f"{winner.name} more often." if winner else f"{_undecided_text(d)}."
    columns = pair.first.result.columns_of_kind("level")
    different_levels = [
        stats
        for stats in pair.levels
        if stats.success and stats.success.p_holm is not None and stats.success.p_holm <= ALPHA
    ]
    if different_levels and len(pair.levels) > 1:
        ranges = _level_ranges(columns, pair, different_levels)
        text += f" McNemar's test shows a difference at {ranges}."
    return text


def _missing_values_sentence(pair: PairComparison) -> str:
    incomplete_levels = [
        stats
        for stats in pair.levels
        if stats.n_only_first or stats.n_only_second or stats.n_neither
    ]
    if not incomplete_levels:
        return ""
    names = ("n_only_first", "n_only_second", "n_neither")
    counts = [sum(getattr(stats, name) for stats in incomplete_levels) for name in names]
    n = sum(len(stats.seeds) for stats in pair.levels)
    return (
        f"Of {n} pairs, {sum(counts)} have no difference: {counts[1]} where only "
        f"{pair.first.name} has no value, {counts[0]} where only {pair.second.name} has none, "
        f"{counts[2]} where neither has one. They are counted, never estimated. Where values are "
        "missing, the measure describes the remaining runs only, and the levels that ended ok "
        "describe all runs."
    )


def _unpaired_rows_sentence(pair: PairComparison) -> str:
    if not pair.n_only_first and not pair.n_only_second:
        return ""
    return (
        f"Rows without a partner are omitted: {pair.n_only_first} of {pair.first.name}, "
        f"{pair.n_only_second} of {pair.second.name}."
    )


def _image_sentence(pair: PairComparison) -> str:
    if pair.same_images is None:
        return ""
    n, n_identical = pair.same_images
    if n_identical == n:
        return f"Both received the same images, byte for byte ({n} stream{'s' * (n > 1)})."
    return (
        f"Both received the same bytes in {n_identical} of {n} image streams. The actions of an "
        "algorithm, and the time at which it ends, change the images."
    )


# ---------------------------------------------------------------------------- phrases


def _better_and_worse(pair: PairComparison, d: PairedDifference) -> tuple[Entry, Entry]:
    return (pair.first, pair.second) if d.verdict == "first" else (pair.second, pair.first)


def _undecided_text(d: PairedDifference) -> str:
    message = few_repeats_text(d) if d.verdict == "too few" else "no difference is shown"
    return message[0].lower() + message[1:]


def _range_text(numbers: Sequence[int]) -> str:
    low, high = min(numbers), max(numbers)
    return str(low) if low == high else f"{low} to {high}"


def _rounded_count(n: int) -> str:
    """Return a number of repeats, rounded up to two digits: ``34``, ``290``, ``more than 1000``."""
    if n > 1000:
        return "more than 1000"
    return str(n if n < 100 else math.ceil(n / 10) * 10)


def _p_phrase(p: float | None) -> str:
    text = p_text(p)
    return f"p {text.replace('<', '< ')}" if text.startswith("<") else f"p = {text}"
