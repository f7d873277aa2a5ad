"""The sentences of a comparison: which is better, how certainly, and the repeats needed."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...results.result import Column
from ...statistics import Interval, min_p_value
from ..plots import level_text, written_unit
from .inputs import Entry
from .matrix import too_few
from .model import AtLevel, Comparison, Overall, PairedDifference, Versus
from .pairs import Level
from .repeats import ALPHA


def sentences(comparison: Comparison, versus: Versus) -> tuple[str, ...]:
    """Return what follows, and what does not, from one pair of results."""
    parts = [
        _sweep(comparison, versus),
        _single_levels(comparison, versus),
        _success(versus),
        _missing(versus),
        _unpaired(versus),
        _images(versus),
    ]
    return tuple(part for part in parts if part)


def short_verdict(versus: Versus, d: PairedDifference) -> str:
    """Return a verdict of a few words: ``ic better``, ``not shown``, ``too few (6 of 7)``."""
    if d.verdict in ("first", "second"):
        return f"{_winner(versus, d).name} better"
    if d.verdict == "too few":
        return f"too few ({d.difference.n} of {d.fewest})"
    return d.verdict


def needed_text(comparison: Comparison, d: PairedDifference) -> str:
    """Return how many repeats would show what was not shown: ``34``, ``290``, ``>1000``, ``≥6``."""
    is_open = d.verdict in ("not shown", "too few")
    if d.verdict == "one repeat" or (is_open and d.hedges_g is None):
        return f"≥{comparison.fewest}"
    if not is_open or d.needed is None:
        return "-"
    return _about(max(d.needed, d.difference.n + 1)).replace("more than ", ">")


def p_text(p: float | None) -> str:
    """Return ``0.012``, ``<0.001``, or a dash where nothing was tested."""
    if p is None:
        return "-"
    return "<0.001" if p < 0.001 else f"{p:.3f}"


def levels_text(columns: Sequence[Column], level: Level) -> str:
    """Return ``fog 0.3 m⁻¹, current 0.1 m/s``."""
    parts = [
        level_text(column, value)
        for column, value in zip(columns, level, strict=True)
        if column.name != "none"
    ]
    return ", ".join(parts) or "the only level"


def unit_text(column: Column) -> str:
    """Return the unit with a leading space, for use after a number; empty without a unit."""
    return f" {written_unit(column.unit)}" if column.unit else ""


# ---------------------------------------------------------------------------- the sweep


def _sweep(comparison: Comparison, versus: Versus) -> str:
    overall, d = versus.overall, versus.overall.value
    n = d.difference.n
    where = _where(overall)
    if d.verdict == "no pair":
        return (
            "The sweep as a whole is not compared: at no level does every repeat of both have a "
            "value."
        )
    found = _found(comparison, versus, d)
    if d.verdict == "one repeat":
        return (
            f"One repeat (seed {overall.seeds[0]}): nothing follows for other seeds. In this one, "
            f"{found}, on average {where}: below it at {overall.n_second_smaller} of these levels "
            f"and above it at {overall.n_first_smaller}. The levels of one repeat share its noise "
            "and its history and are no repeats. Run each with --repeat "
            f"{comparison.fewest_for_sweep} or more for the sweep as a whole, "
            f"{comparison.fewest} or more for single levels."
        )
    if d.verdict == "equal":
        return f"Both are equal in every one of {n} repeats, {where}."
    over = f"over {n} repeats, each its mean {where}"
    tested = f"{_effect(d)}{_tested(comparison, d)}"
    if d.verdict in ("first", "second"):
        return (
            f"{_winner(versus, d).name} is better than {_loser(versus, d).name}: {found}, {over}; "
            f"{tested}."
        )
    if d.verdict == "too few":
        return f"{too_few(d)}: {found}, {over}; {tested}. {_needed(comparison, d)}"
    return f"No difference is shown: {found}, {over}; {tested}. {_needed(comparison, d)}"


def _found(comparison: Comparison, versus: Versus, d: PairedDifference) -> str:
    """``in 'total' ic lies 0.31 px above esm (95 % interval 0.22 to 0.41 px)``."""
    mean = d.difference.mean or 0.0
    unit = unit_text(comparison.column)
    size = f"{abs(mean):.3g}{unit} {'above' if mean > 0 else 'below'}" if mean else "on"
    return (
        f"in '{comparison.column.name}' {versus.second.name} lies {size} {versus.first.name}"
        f"{_limits(d.difference, mean, unit)}"
    )


def _limits(interval: Interval, mean: float, unit: str) -> str:
    """The interval of the difference, in the direction of the mean."""
    if interval.low is None or interval.high is None:
        return ""
    ends = (interval.low, interval.high) if mean >= 0 else (-interval.high, -interval.low)
    low, high = told_apart(*ends)
    return f" (95 % interval {low} to {high}{unit})"


def told_apart(low: float, high: float) -> tuple[str, str]:
    """Return two numbers with the digits that show them apart: three, and at most seven."""
    for digits in range(3, 8):
        texts = f"{low:.{digits}g}", f"{high:.{digits}g}"
        if texts[0] != texts[1]:
            return texts
    return f"{low:.3g}", f"{high:.3g}"


def _where(overall: Overall) -> str:
    if overall.n_levels == 1:
        return "at the only level"
    n = len(overall.levels)
    if n == overall.n_levels:
        return f"over all {n} levels"
    shared = f"the {n}" if n > 1 else "the only one"
    return f"over {shared} of {overall.n_levels} levels at which every repeat of both has a value"


def _effect(d: PairedDifference) -> str:
    size = "" if d.hedges_g is None else f"Hedges' g = {d.hedges_g:.2f}, "
    return size if d.superiority is None else f"{size}A = {d.superiority:.2f}, "


def _tested(comparison: Comparison, d: PairedDifference) -> str:
    """``p = 0.012 (sign flips, Holm over 3 pairs of results)``."""
    n = len(comparison.versus)
    if d.p_holm is None:
        return f"{_p_said(d.p)} (sign flips)"
    corrected = f", Holm over {n} pairs of results" if n > 1 else ""
    return f"{_p_said(d.p_holm)} (sign flips{corrected})"


def _needed(comparison: Comparison, d: PairedDifference) -> str:
    """How many more repeats are needed, or why that cannot be planned."""
    n, fewest = d.difference.n, comparison.fewest_for_sweep
    if d.verdict == "too few":
        least, of = min_p_value(n), len(comparison.versus)
        corrected = f", {_round(of * least)} after Holm" if of > 1 else ""
        return (
            f"With {n} repeats p cannot fall below {_round(least)}{corrected}: "
            f"at least {fewest} are needed{_more(d, n, fewest)}."
        )
    if d.needed is None:
        return "The observed difference is too small to plan by."
    return (
        f"With {_about(max(d.needed, n + 1))} repeats 4 of 5 such experiments would show a "
        "difference of the observed size."
    )


def _more(d: PairedDifference, n: int, fewest: int) -> str:
    if d.needed is None or d.needed <= max(n, fewest):
        return ""
    return f", and about {_about(d.needed)} to show the observed difference in 4 of 5 experiments"


# ---------------------------------------------------------------------------- single levels


def _single_levels(comparison: Comparison, versus: Versus) -> str:
    tested = [at for at in versus.levels if at.value.p is not None]
    if len(versus.levels) < 2 or not tested:
        return ""
    columns = versus.first.result.columns_of_kind("level")
    parts = []
    for entry, verdict in ((versus.first, "first"), (versus.second, "second")):
        levels = [at for at in versus.levels if at.value.verdict == verdict]
        if levels:
            parts.append(f"{entry.name} is better at {_levels(columns, versus, levels)}")
    rest = sum(at.value.verdict == "not shown" for at in tested)
    if rest:
        other = "other " if parts else ""
        parts.append(
            f"no difference is shown at {'the ' if other else ''}{rest} {other}level"
            f"{'s' if rest > 1 else ''}"
        )
    few = [at.value for at in tested if at.value.verdict == "too few"]
    if few:
        parts.append(
            f"{len(few)} level{'s have' if len(few) > 1 else ' has'} too few repeats to test "
            f"({_span([d.difference.n for d in few])} of {comparison.fewest} needed)"
        )
    equal = sum(at.value.verdict == "equal" for at in tested)
    if equal:
        parts.append(f"equal in every repeat at {equal}")
    return f"Level by level (Holm over {comparison.n_tests}): {'; '.join(parts)}."


def _levels(columns: Sequence[Column], versus: Versus, chosen: Sequence[AtLevel]) -> str:
    """Runs of neighbouring levels: ``14 levels (fog 0.3 to 0.95)``."""
    places = [i for i, at in enumerate(versus.levels) if at in chosen]
    runs: list[list[int]] = []
    for place in places:
        if runs and place == runs[-1][-1] + 1:
            runs[-1].append(place)
        else:
            runs.append([place])
    names = [
        levels_text(columns, versus.levels[run[0]].level)
        + (f" to {levels_text(columns, versus.levels[run[-1]].level)}" if len(run) > 1 else "")
        for run in runs
    ]
    n = len(places)
    return f"{n} level{'s' if n > 1 else ''} ({'; '.join(names)})"


# ---------------------------------------------------------------------------- success


def _success(versus: Versus) -> str:
    d = versus.overall.success
    if d is None or d.first.mean is None or d.second.mean is None:
        return ""
    shares = (
        f"{versus.first.name} {_percent(d.first.mean)}, "
        f"{versus.second.name} {_percent(d.second.mean)}"
    )
    text = f"Levels that ended ok: {shares}"
    if d.difference.mean == 0.0 and d.difference.std in (0.0, None):
        text += ", the same in every repeat."
    elif d.verdict == "one repeat":
        text += " (one repeat)."
    elif d.difference.low is not None and d.difference.high is not None:
        text += (
            f"; difference {100 * (d.difference.mean or 0.0):.3g} points "
            f"({100 * d.difference.low:.3g} to {100 * d.difference.high:.3g}), "
            f"{_p_said(d.p if d.p_holm is None else d.p_holm)}: "
        )
        winner = {"first": versus.first, "second": versus.second}.get(d.verdict)
        text += f"{winner.name} more often." if winner else f"{_open(d)}."
    columns = versus.first.result.columns_of_kind("level")
    shown = [
        at
        for at in versus.levels
        if at.success and at.success.p_holm is not None and at.success.p_holm <= ALPHA
    ]
    if shown and len(versus.levels) > 1:
        text += f" McNemar's test finds a difference at {_levels(columns, versus, shown)}."
    return text


def _missing(versus: Versus) -> str:
    partly = [at for at in versus.levels if at.n_only_first or at.n_only_second or at.n_neither]
    if not partly:
        return ""
    lost = [sum(getattr(at, name) for at in partly) for name in _MISSING]
    n = sum(len(at.seeds) for at in versus.levels)
    return (
        f"Of {n} pairs {lost[0] + lost[1] + lost[2]} have no difference: {lost[1]} where only "
        f"{versus.first.name} has no value, {lost[0]} where only {versus.second.name} has none, "
        f"{lost[2]} where neither has one. They are left out, not guessed: where values are "
        "missing the measure describes the remaining runs only, and the levels that ended ok of "
        "the "
        "rest."
    )


_MISSING = ("n_only_first", "n_only_second", "n_neither")


def _unpaired(versus: Versus) -> str:
    if not versus.n_only_first and not versus.n_only_second:
        return ""
    return (
        f"Rows without a partner are left out: {versus.n_only_first} of {versus.first.name}, "
        f"{versus.n_only_second} of {versus.second.name}."
    )


def _images(versus: Versus) -> str:
    if versus.same_images is None:
        return ""
    n, same = versus.same_images
    if same == n:
        return f"Both were handed the same images, byte for byte ({n} stream{'s' * (n > 1)})."
    return (
        f"{same} of {n} image streams were the same bytes for both: what an algorithm does, or "
        "when it stops, changes what it sees."
    )


# ---------------------------------------------------------------------------- small words


def _winner(versus: Versus, d: PairedDifference) -> Entry:
    return versus.first if d.verdict == "first" else versus.second


def _loser(versus: Versus, d: PairedDifference) -> Entry:
    return versus.second if d.verdict == "first" else versus.first


def _open(d: PairedDifference) -> str:
    """Return why no result is named as better."""
    message = too_few(d) if d.verdict == "too few" else "no difference is shown"
    return message[0].lower() + message[1:]


def _span(numbers: Sequence[int]) -> str:
    """``4``, ``2 to 4``."""
    low, high = min(numbers), max(numbers)
    return str(low) if low == high else f"{low} to {high}"


def _about(n: int) -> str:
    """``34``, ``290``: a plan has two digits; ``more than 1000`` is enough to know."""
    if n > 1000:
        return "more than 1000"
    return str(n if n < 100 else math.ceil(n / 10) * 10)


def _p_said(p: float | None) -> str:
    text = p_text(p)
    return f"p {text.replace('<', '< ')}" if text.startswith("<") else f"p = {text}"


def _percent(share: float) -> str:
    return f"{100 * share:.3g} %"


def _round(p: float) -> str:
    return f"{p:.3g}"
