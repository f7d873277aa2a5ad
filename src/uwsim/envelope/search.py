"""The search for the breaking point: bisection of each seed, and a scan of the whole range.

*Model.* A run at level x with one seed holds or breaks; over seeds it breaks with a probability
P(x) that grows along the range. The breaking point is where half of the runs break. A seed's own is
where bisection finds it: between a level at which its run held and one at which it broke, not
farther apart than the tolerance. Seeds are independent, so their breaking points are, and the exact
interval of the median holds for them (`uwsim.statistics.median_interval`).

*Why the first cut is by chance.* Runs near the breaking point go either way. If all seeds cut the
range at the same places, the first cut that falls there would decide for all that come after it,
and the median would lean to one side. So each seed makes its first cut at a place of its own, from
a quarter to three quarters of the range. Then the interval holds the true point as often as
promised, for curves from sharp to as wide as a quarter of the range, also when one run in twenty
goes wrong at any level: ``docs/statistics.md`` has the table.

*Ends are looked at when they matter*: a seed that has never broken is run at the far end, one
that has never held at the near one. What lies beyond an end counts as there.

*Monotony* cannot be seen in bisections: they never go back. So the first seed also runs a grid
over the range. Where it holds behind a level that broke it, all seeds are asked at both; if most
of them agree the criterion is not monotone, and the first breaking point is searched.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ..base.rng import stream

GRID = 8
"""Intervals of the first seed's grid."""
FIRST_CUT = (0.25, 0.75)
"""Where a seed may cut the range first."""
FINER = 8
"""Levels are rounded to a decimal place that divides the tolerance at least so often."""

Ask = Callable[[Sequence[tuple[int, float]]], list[bool]]
"""Runs pairs (seed, level); returns of each whether it is broken."""
T = TypeVar("T")
Questions = Generator[float, bool, T]
"""Yields levels to run with one seed, receives whether they broke; returns the breaking point."""


@dataclass(frozen=True)
class SeedSearch(Generic[T]):
    """A pending search of one seed."""

    seed: int
    """The seed."""
    questions: Questions[T]
    """One after the other; those of several tasks may be answered side by side."""


Strategy = Generator[list[SeedSearch[Any]], list[Any], "Search"]
"""Yields tasks, takes in what each found; returns what the search found."""


@dataclass(frozen=True, kw_only=True)
class Range:
    """The searched range."""

    start: float
    """The near end: runs are expected to hold here."""
    stop: float
    """The far end, above or below: runs are expected to break here."""
    tolerance: float
    """How near to each other the last level that held and the first that broke shall be."""

    @property
    def decimals(self) -> int:
        """Decimal places of the levels."""
        return max(0, math.ceil(-math.log10(self.tolerance / FINER) - 1e-9))

    def at(self, held: float, broken: float, fraction: float) -> float:
        """Return the level so far on the way from one to another, rounded."""
        return round(held + fraction * (broken - held), self.decimals)

    def most_cuts(self) -> int:
        """Return how many cuts a seed needs at most."""
        width = abs(self.stop - self.start) * max(FIRST_CUT) / self.tolerance
        return 1 + max(0, math.ceil(math.log2(max(width, 1.0)) + 0.5))


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """The breaking point of one seed."""

    seed: int
    """The seed."""
    held: float | None
    """The last level at which it held; None: it is broken at the near end."""
    broken: float | None
    """The first at which it broke; None: it holds at the far end."""


@dataclass(frozen=True, kw_only=True)
class Fold:
    """A non-monotonic criterion: broken at one level, not broken at a farther one."""

    broken: float
    """Runs break here ..."""
    holds: float
    """... and hold here."""
    n: int
    """Seeds that were asked."""
    n_broken: int
    """Of them broken at the first."""
    n_holding: int
    """Of them holding at the second."""


@dataclass(frozen=True, kw_only=True)
class Search:
    """What was found."""

    thresholds: tuple[Threshold, ...]
    """One a seed."""
    fold: Fold | None
    """Where the criterion is not monotone, if anywhere."""
    stop: float
    """The far end in the end: nearer where there is a fold."""


def strategy(seeds: Sequence[int], where: Range) -> Strategy:
    """Find the breaking point of every seed: yields the levels to run next.

    Args:
        seeds: at least one.
        where: the range.
    """
    grid = [where.at(where.start, where.stop, i / GRID) for i in range(GRID + 1)]
    seen: list[bool] = yield [SeedSearch(seeds[0], _once(level)) for level in grid]
    if not any(seen):  # most likely nothing breaks: one run of each seed decides
        broken: list[bool] = yield [SeedSearch(seed, _once(where.stop)) for seed in seeds]
        holding = [s for s, breaks in zip(seeds, broken, strict=True) if not breaks]
        known = {s: Threshold(seed=s, held=where.stop, broken=None) for s in holding}
        return (yield from _others(seeds, known, where, where.stop, None))
    fold = yield from _fold(seeds, grid, seen)
    stop = where.stop if fold is None else fold.broken
    known = {}
    if all(seen) or stop == where.start:
        broken = yield [SeedSearch(seed, _once(where.start)) for seed in seeds]
        for seed, breaks in zip(seeds, broken, strict=True):
            if breaks:
                known[seed] = Threshold(seed=seed, held=None, broken=where.start)
            elif stop == where.start:
                known[seed] = Threshold(seed=seed, held=stop, broken=None)
    return (yield from _others(seeds, known, where, stop, fold))


def _once(level: float) -> Questions[bool]:
    """Request one level."""
    return (yield level)


def _others(
    seeds: Sequence[int],
    known: dict[int, Threshold],
    where: Range,
    stop: float,
    fold: Fold | None,
) -> Strategy:
    """Bisect the seeds that are not known yet."""
    others = [seed for seed in seeds if seed not in known]
    found: list[Threshold] = yield [SeedSearch(s, bisection(s, where, stop)) for s in others]
    thresholds = known | {one.seed: one for one in found}
    return Search(thresholds=tuple(thresholds[seed] for seed in seeds), fold=fold, stop=stop)


def search(seeds: Sequence[int], where: Range, ask: Ask) -> Search:
    """Find the breaking point of every seed, one level at a time.

    Args:
        seeds: at least one.
        where: the range.
        ask: executes runs; the same run always has the same result.
    """
    steps = strategy(seeds, where)
    tasks = next(steps)
    while True:
        found: dict[int, Any] = {}
        wanted = {i: next(task.questions) for i, task in enumerate(tasks)}
        while wanted:
            answers = ask([(tasks[i].seed, level) for i, level in wanted.items()])
            for i, breaks in zip(list(wanted), answers, strict=True):
                try:
                    wanted[i] = tasks[i].questions.send(breaks)
                except StopIteration as end:
                    found[i] = end.value
                    del wanted[i]
        try:
            tasks = steps.send([found[i] for i in range(len(tasks))])
        except StopIteration as end:
            result: Search = end.value
            return result


def bisection(seed: int, where: Range, stop: float) -> Questions[Threshold]:
    """Yield levels to run, receive whether they broke, and return the breaking point."""
    held, broken = where.start, stop
    has_held = has_broken = False
    low, high = FIRST_CUT
    fraction = float(stream(seed, "envelope").uniform(low, high))
    while abs(broken - held) > where.tolerance * (1 + 1e-9):
        level = where.at(held, broken, fraction)
        fraction = 0.5
        if level in (held, broken):
            break
        if (yield level):
            broken, has_broken = level, True
        else:
            held, has_held = level, True
    if not has_broken and not (yield broken):
        return Threshold(seed=seed, held=broken, broken=None)
    if not has_held and (yield held):
        return Threshold(seed=seed, held=None, broken=held)
    return Threshold(seed=seed, held=held, broken=broken)


def _fold(
    seeds: Sequence[int], grid: Sequence[float], seen: Sequence[bool]
) -> Generator[list[SeedSearch[bool]], list[bool], Fold | None]:
    """Search a level that does not break beyond one that does, and run both with every seed."""
    first = seen.index(True)
    behind = [i for i in range(first + 1, len(grid)) if not seen[i]]
    if not behind:
        return None
    here, there = grid[first], grid[behind[-1]]
    answers = yield [SeedSearch(seed, _once(level)) for level in (here, there) for seed in seeds]
    n = len(seeds)
    n_broken, n_holding = sum(answers[:n]), n - sum(answers[n:])
    if 2 * n_broken <= n or 2 * n_holding <= n:
        return None  # chance, for most seeds do not agree
    return Fold(broken=here, holds=there, n=n, n_broken=n_broken, n_holding=n_holding)
