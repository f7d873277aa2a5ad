"""The search for the breaking point: bisection of each seed, and a scan of the whole range.

*Model.* A run at level x with one seed holds or breaks; over seeds it breaks with a probability
P(x) that grows along the range. The breaking point is the level at which half of the runs break.
Bisection brackets that of a seed: between a level at which its run held and one at which it broke,
not farther apart than the tolerance. Seeds are independent, so their breaking points are, and the
exact interval of the median holds for them (`uwsim.statistics.median_interval`).

*The first cut is random.* Runs near the breaking point may hold or break. If all seeds cut the
range at the same levels, the first cut near that point would decide for all later ones, and the
median would be biased. So each seed draws the level of its first cut, from a quarter to three
quarters of the range. The interval then has its nominal coverage, for curves from a step to a width
of a quarter of the range, also when one run in twenty fails at any level (``docs/statistics.md``).

*The ends are run when they decide*: a seed that has never broken is run at the far end, one that
has never held at the near one. A breaking point beyond an end counts as at that end.

*Monotony* is not tested by bisections, which never go back. So the first seed also runs a grid
over the range. Where it holds beyond a level that broke it, all seeds are run at both; if most of
them agree, the criterion is not monotone, and the first breaking point is searched.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ..base.rng import stream

GRID = 8
"""The number of intervals of the first seed's grid."""
FIRST_CUT = (0.25, 0.75)
"""The part of the range from which the first cut of a seed is drawn."""
MIN_DIVISOR = 8
"""The least divisor of the tolerance for the decimal place to which levels are rounded."""

ExecuteRuns = Callable[[Sequence[tuple[int, float]]], list[bool]]
"""The execution of pairs (seed, level), which returns whether each is broken."""
T = TypeVar("T")
LevelRequests = Generator[float, bool, T]
"""A generator of levels: it receives whether a run broke there, and returns a result."""


@dataclass(frozen=True)
class SeedSearch(Generic[T]):
    """A pending search of one seed."""

    seed: int
    """The seed."""
    requests: LevelRequests[T]
    """The levels in sequence; those of several tasks may run at the same time."""


Strategy = Generator[list[SeedSearch[Any]], list[Any], "Search"]
"""A generator of tasks: it receives the result of each and returns the search's result."""


@dataclass(frozen=True, kw_only=True)
class Range:
    """The searched range."""

    start: float
    """The near end: runs are expected to hold here."""
    stop: float
    """The far end, above or below: runs are expected to break here."""
    tolerance: float
    """The greatest distance of the last level that held and the first that broke."""

    @property
    def decimals(self) -> int:
        """The decimal places of the levels."""
        return max(0, math.ceil(-math.log10(self.tolerance / MIN_DIVISOR) - 1e-9))

    def interpolate(self, start: float, stop: float, fraction: float) -> float:
        """Return the level at a fraction of the way between two levels, rounded."""
        return round(start + fraction * (stop - start), self.decimals)

    def max_cuts(self) -> int:
        """Return the greatest number of cuts of a seed."""
        width = abs(self.stop - self.start) * max(FIRST_CUT) / self.tolerance
        return 1 + max(0, math.ceil(math.log2(max(width, 1.0)) + 0.5))


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """The breaking point of one seed."""

    seed: int
    """The seed."""
    hold_level: float | None
    """The last level at which it held; None if it is broken at the near end."""
    break_level: float | None
    """The first level at which it broke; None if it holds at the far end."""


@dataclass(frozen=True, kw_only=True)
class Fold:
    """A non-monotonic criterion: broken at one level, not broken at a farther one."""

    break_level: float
    """The level at which runs break."""
    hold_level: float
    """The farther level at which runs hold."""
    n: int
    """The number of seeds that were run."""
    n_broken: int
    """The number of seeds broken at the first level."""
    n_held: int
    """The number of seeds that hold at the second level."""


@dataclass(frozen=True, kw_only=True)
class Search:
    """The result of a search."""

    thresholds: tuple[Threshold, ...]
    """The breaking points, one a seed."""
    fold: Fold | None
    """The evidence that the criterion is not monotone, if there is any."""
    stop: float
    """The far end of the search, which is nearer where there is a fold."""


def strategy(seeds: Sequence[int], bounds: Range) -> Strategy:
    """Find the breaking point of every seed; yield the levels to run next.

    Args:
        seeds: the seeds, at least one.
        bounds: the range.
    """
    grid = [bounds.interpolate(bounds.start, bounds.stop, i / GRID) for i in range(GRID + 1)]
    grid_breaks: list[bool] = yield [SeedSearch(seeds[0], _request(level)) for level in grid]
    if not any(grid_breaks):  # most likely nothing breaks: one run of each seed decides
        end_breaks: list[bool] = yield [SeedSearch(seed, _request(bounds.stop)) for seed in seeds]
        held_seeds = [s for s, breaks in zip(seeds, end_breaks, strict=True) if not breaks]
        thresholds = {
            s: Threshold(seed=s, hold_level=bounds.stop, break_level=None) for s in held_seeds
        }
        return (yield from _bisect_seeds(seeds, thresholds, bounds, bounds.stop, None))
    fold = yield from _fold(seeds, grid, grid_breaks)
    stop = bounds.stop if fold is None else fold.break_level
    thresholds = {}
    if all(grid_breaks) or stop == bounds.start:
        end_breaks = yield [SeedSearch(seed, _request(bounds.start)) for seed in seeds]
        for seed, breaks in zip(seeds, end_breaks, strict=True):
            if breaks:
                thresholds[seed] = Threshold(seed=seed, hold_level=None, break_level=bounds.start)
            elif stop == bounds.start:
                thresholds[seed] = Threshold(seed=seed, hold_level=stop, break_level=None)
    return (yield from _bisect_seeds(seeds, thresholds, bounds, stop, fold))


def _request(level: float) -> LevelRequests[bool]:
    return (yield level)


def _bisect_seeds(
    seeds: Sequence[int],
    thresholds: dict[int, Threshold],
    bounds: Range,
    stop: float,
    fold: Fold | None,
) -> Strategy:
    """Bisect the seeds without a known threshold."""
    open_seeds = [seed for seed in seeds if seed not in thresholds]
    results: list[Threshold] = yield [SeedSearch(s, bisection(s, bounds, stop)) for s in open_seeds]
    thresholds = thresholds | {threshold.seed: threshold for threshold in results}
    return Search(thresholds=tuple(thresholds[seed] for seed in seeds), fold=fold, stop=stop)


def search(seeds: Sequence[int], bounds: Range, execute: ExecuteRuns) -> Search:
    """Find the breaking point of every seed, one level at a time.

    Args:
        seeds: the seeds, at least one.
        bounds: the range.
        execute: executes runs; the same run always has the same result.
    """
    steps = strategy(seeds, bounds)
    tasks = next(steps)
    while True:
        results: dict[int, Any] = {}
        levels = {i: next(task.requests) for i, task in enumerate(tasks)}
        while levels:
            answers = execute([(tasks[i].seed, level) for i, level in levels.items()])
            for i, breaks in zip(list(levels), answers, strict=True):
                try:
                    levels[i] = tasks[i].requests.send(breaks)
                except StopIteration as end:
                    results[i] = end.value
                    del levels[i]
        try:
            tasks = steps.send([results[i] for i in range(len(tasks))])
        except StopIteration as end:
            result: Search = end.value
            return result


def bisection(seed: int, bounds: Range, stop: float) -> LevelRequests[Threshold]:
    """Yield levels to run, receive whether they broke, and return the breaking point."""
    near, far = bounds.start, stop
    has_held = has_broken = False
    low, high = FIRST_CUT
    fraction = float(stream(seed, "envelope").uniform(low, high))
    while abs(far - near) > bounds.tolerance * (1 + 1e-9):
        level = bounds.interpolate(near, far, fraction)
        fraction = 0.5
        if level in (near, far):
            break
        if (yield level):
            far, has_broken = level, True
        else:
            near, has_held = level, True
    if not has_broken and not (yield far):
        return Threshold(seed=seed, hold_level=far, break_level=None)
    if not has_held and (yield near):
        return Threshold(seed=seed, hold_level=None, break_level=near)
    return Threshold(seed=seed, hold_level=near, break_level=far)


def _fold(
    seeds: Sequence[int], grid: Sequence[float], grid_breaks: Sequence[bool]
) -> Generator[list[SeedSearch[bool]], list[bool], Fold | None]:
    """Search a level that holds beyond one that breaks, and run both with every seed."""
    first_index = grid_breaks.index(True)
    later_indices = [i for i in range(first_index + 1, len(grid)) if not grid_breaks[i]]
    if not later_indices:
        return None
    near, far = grid[first_index], grid[later_indices[-1]]
    answers = yield [SeedSearch(seed, _request(level)) for level in (near, far) for seed in seeds]
    n = len(seeds)
    n_broken, n_held = sum(answers[:n]), n - sum(answers[n:])
    if 2 * n_broken <= n or 2 * n_held <= n:
        return None  # random, as most seeds do not agree
    return Fold(break_level=near, hold_level=far, n=n, n_broken=n_broken, n_held=n_held)
