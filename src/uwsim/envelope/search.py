"""The search for the breaking point: a bisection for each seed, and a grid over the whole range.

*Model.* The run of a seed at level x holds or breaks. The probability P(x) that a run breaks grows
along the range. The breaking point is the level at which half of the runs break. Bisection brackets
the breaking point of a seed between a level at which its run held and a level at which its run
broke, no farther apart than the tolerance. The breaking points of different seeds are independent,
so the exact interval of the median holds for them (`uwsim.statistics.median_interval`).

*Random first cut.* Runs near the breaking point may hold or break. If all seeds cut the range at
the same levels, the first cut near that point would decide for all later cuts, and the median would
be biased. Each seed therefore draws the level of its first cut between a quarter and three quarters
of the range. The interval then has its nominal coverage if P(x) is a step or rises over at most a
quarter of the range, also when one run in twenty fails at any level (``docs/statistics.md``).

*Ends of the range.* A seed whose runs all held is run at the far end; a seed whose runs all broke
is run at the near end. A breaking point beyond an end counts as at that end.

*Monotonicity.* Bisection cannot detect that runs hold again beyond a level that breaks. The first
seed therefore also runs a grid over the range. If it holds beyond a level that broke it, all seeds
are run at both levels. If most of them agree, the criterion is not monotone, and the first breaking
point is searched.
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
"""The fractions of the range between which the first cut of a seed is drawn."""
MIN_DIVISOR = 8
"""The minimum ratio of the tolerance to the step to which levels are rounded."""

ExecuteRuns = Callable[[Sequence[tuple[int, float]]], list[bool]]
"""A function that executes runs, given as pairs (seed, level), and returns whether each is broken.
"""
T = TypeVar("T")
LevelRequests = Generator[float, bool, T]
"""A generator of levels: it receives whether the run at each level broke, and returns a result."""


@dataclass(frozen=True)
class SeedSearch(Generic[T]):
    """A task: a search with one seed."""

    seed: int
    """The seed of the runs."""
    requests: LevelRequests[T]
    """The levels to run in sequence; the runs of several tasks may be executed in parallel."""


Strategy = Generator[list[SeedSearch[Any]], list[Any], "Search"]
"""A generator of lists of tasks: it receives their results, and returns the result of the search.
"""


@dataclass(frozen=True, kw_only=True)
class Range:
    """The searched range of the swept parameter, in its unit."""

    start: float
    """The near end: runs are expected to hold here."""
    stop: float
    """The far end, above or below `start`: runs are expected to break here."""
    tolerance: float
    """The greatest difference between the last level that held and the first level that broke."""

    @property
    def decimals(self) -> int:
        """The number of decimal places to which levels are rounded."""
        return max(0, math.ceil(-math.log10(self.tolerance / MIN_DIVISOR) - 1e-9))

    def interpolate(self, start: float, stop: float, fraction: float) -> float:
        """Return the rounded level at a fraction (0 to 1) of the way between two levels."""
        return round(start + fraction * (stop - start), self.decimals)

    def max_cuts(self) -> int:
        """Return the greatest number of bisection cuts of a seed."""
        width = abs(self.stop - self.start) * max(FIRST_CUT) / self.tolerance
        return 1 + max(0, math.ceil(math.log2(max(width, 1.0)) + 0.5))


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """The breaking point of one seed."""

    seed: int
    """The seed of the runs."""
    hold_level: float | None
    """The last level at which the run held; None if the run at the near end is broken."""
    break_level: float | None
    """The first level at which the run broke; None if the run at the far end holds."""


@dataclass(frozen=True, kw_only=True)
class Reversal:
    """The evidence that a criterion is not monotone: runs break, but hold at a farther level."""

    break_level: float
    """The level at which most runs break."""
    hold_level: float
    """The farther level at which most runs hold."""
    n: int
    """The number of seeds that were run at both levels."""
    n_broken: int
    """The number of seeds whose run at `break_level` is broken."""
    n_held: int
    """The number of seeds whose run at `hold_level` holds."""


@dataclass(frozen=True, kw_only=True)
class Search:
    """The result of a search."""

    thresholds: tuple[Threshold, ...]
    """The breaking points, one for each seed."""
    reversal: Reversal | None
    """The evidence that the criterion is not monotone; None without any."""
    stop: float
    """The far end of the bisections: the level that broke if there is a reversal, else the end of
    the range."""


def strategy(seeds: Sequence[int], bounds: Range) -> Strategy:
    """Find the breaking point of every seed, as a generator that yields tasks to carry out.

    Args:
        seeds: the seeds, at least one.
        bounds: the searched range.
    """
    grid = [bounds.interpolate(bounds.start, bounds.stop, i / GRID) for i in range(GRID + 1)]
    grid_breaks: list[bool] = yield [SeedSearch(seeds[0], _request(level)) for level in grid]
    if not any(grid_breaks):  # probably no run breaks: one run of each seed at the far end decides
        end_breaks: list[bool] = yield [SeedSearch(seed, _request(bounds.stop)) for seed in seeds]
        held_seeds = [s for s, breaks in zip(seeds, end_breaks, strict=True) if not breaks]
        thresholds = {
            s: Threshold(seed=s, hold_level=bounds.stop, break_level=None) for s in held_seeds
        }
        return (yield from _bisect_seeds(seeds, thresholds, bounds, bounds.stop, None))
    reversal = yield from _find_reversal(seeds, grid, grid_breaks)
    stop = bounds.stop if reversal is None else reversal.break_level
    thresholds = {}
    if all(grid_breaks) or stop == bounds.start:
        end_breaks = yield [SeedSearch(seed, _request(bounds.start)) for seed in seeds]
        for seed, breaks in zip(seeds, end_breaks, strict=True):
            if breaks:
                thresholds[seed] = Threshold(seed=seed, hold_level=None, break_level=bounds.start)
            elif stop == bounds.start:
                thresholds[seed] = Threshold(seed=seed, hold_level=stop, break_level=None)
    return (yield from _bisect_seeds(seeds, thresholds, bounds, stop, reversal))


def _request(level: float) -> LevelRequests[bool]:
    return (yield level)


def _bisect_seeds(
    seeds: Sequence[int],
    thresholds: dict[int, Threshold],
    bounds: Range,
    stop: float,
    reversal: Reversal | None,
) -> Strategy:
    """Find the breaking points of the seeds without a threshold by bisection."""
    open_seeds = [seed for seed in seeds if seed not in thresholds]
    results: list[Threshold] = yield [SeedSearch(s, bisection(s, bounds, stop)) for s in open_seeds]
    thresholds = thresholds | {threshold.seed: threshold for threshold in results}
    all_thresholds = tuple(thresholds[seed] for seed in seeds)
    return Search(thresholds=all_thresholds, reversal=reversal, stop=stop)


def search(seeds: Sequence[int], bounds: Range, execute: ExecuteRuns) -> Search:
    """Find the breaking point of every seed with a function that executes runs.

    Args:
        seeds: the seeds, at least one.
        bounds: the searched range.
        execute: the function that executes runs; a run must always have the same result.
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
    """Yield the levels to run, receive whether each run broke, and return the breaking point.

    Args:
        seed: the seed.
        bounds: the searched range.
        stop: the far end of the bisection, which may be nearer than that of ``bounds``.
    """
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


def _find_reversal(
    seeds: Sequence[int], grid: Sequence[float], grid_breaks: Sequence[bool]
) -> Generator[list[SeedSearch[bool]], list[bool], Reversal | None]:
    """Find a level that holds beyond a level that breaks, and run every seed at both levels."""
    first_index = grid_breaks.index(True)
    later_indices = [i for i in range(first_index + 1, len(grid)) if not grid_breaks[i]]
    if not later_indices:
        return None
    near, far = grid[first_index], grid[later_indices[-1]]
    answers = yield [SeedSearch(seed, _request(level)) for level in (near, far) for seed in seeds]
    n = len(seeds)
    n_broken, n_held = sum(answers[:n]), n - sum(answers[n:])
    if 2 * n_broken <= n or 2 * n_held <= n:
        return None  # chance: most seeds do not agree with the first
    return Reversal(break_level=near, hold_level=far, n=n, n_broken=n_broken, n_held=n_held)
