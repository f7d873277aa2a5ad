"""The data of a comparison, made by `compare`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ...results.result import Column
from ...statistics import Interval, Rate, holm, min_p_value, min_pairs
from .inputs import Entry
from .pairs import Level
from .repeats import ALPHA

CONFIDENCE = 0.95
POWER = 0.8
"""Chance of showing the observed effect with the repeats that are called needed."""

Outcome = Literal["first", "second", "not shown", "too few", "equal", "one repeat", "no pair"]
"""Which is better, or why not decided. ``too few``: with so many repeats no data at all could
have shown a difference (see `least_corrected`), so nothing was tested."""


@dataclass(frozen=True, kw_only=True)
class PairedDifference:
    """Second less first, over pairs in which both have a value."""

    first: Interval
    """Of the first, over these pairs."""
    second: Interval
    """Of the second, over these pairs."""
    difference: Interval
    """Of the paired differences."""
    cohens_d: float | None
    """Mean difference over the deviation of the differences."""
    hedges_g: float | None
    """The same, right on average for few repeats."""
    rank_biserial: float | None
    """-1 to 1, from the signed ranks."""
    superiority: float | None
    """Vargha and Delaney's A: chance that one of the second is better than one of the first;
    None below two repeats."""
    p: float | None
    """Sign-flip test; None below two repeats."""
    p_signed_rank: float | None
    """Wilcoxon's signed-rank test."""
    p_holm: float | None = None
    """`p`, corrected over its family; None where so few repeats could not reach `ALPHA`."""
    needed: int | None = None
    """Repeats that would show the observed effect; None where there is none to plan by."""
    fewest: int | None = None
    """Repeats below which no test of its family can show anything."""
    verdict: Outcome = "no pair"
    """Which is better."""

    @property
    def is_tested(self) -> bool:
        """Whether there are repeats enough for p to reach `ALPHA`."""
        return self.difference.n >= min_pairs(ALPHA)


@dataclass(frozen=True, kw_only=True)
class Success:
    """How often both, one or neither ended ``ok``."""

    first: Rate
    """Of the first."""
    second: Rate
    """Of the second."""
    first_only: int
    """Pairs in which only the first ended ``ok``."""
    second_only: int
    """Pairs in which only the second did."""
    p: float | None
    """McNemar's exact test; None below two repeats."""
    p_holm: float | None = None
    """`p`, corrected over its family; None where so few unlike pairs could not reach `ALPHA`."""

    @property
    def is_tested(self) -> bool:
        """Whether there are unlike pairs enough for p to reach `ALPHA`."""
        return self.first_only + self.second_only >= min_pairs(ALPHA)


@dataclass(frozen=True, kw_only=True)
class AtLevel:
    """Both at one level, over the seeds."""

    level: Level
    """The swept parameters, outermost first."""
    seeds: tuple[int, ...]
    """Of the pairs."""
    n_only_first: int
    """Pairs in which only the first has a value."""
    n_only_second: int
    """Pairs in which only the second has one."""
    n_neither: int
    """Pairs in which neither has one."""
    value: PairedDifference
    """Of the measure, over the pairs in which both have a value."""
    success: Success | None
    """Over all pairs; None where a result has no status."""


@dataclass(frozen=True, kw_only=True)
class Overall:
    """Both over the whole sweep: one number a seed."""

    seeds: tuple[int, ...]
    """Seeds that both ran at every shared level."""
    n_levels: int
    """Number of shared levels."""
    levels: tuple[Level, ...]
    """Those at which every one of these seeds has a value from both: `value` is over them."""
    value: PairedDifference
    """Of the seeds' means over `levels`."""
    success: PairedDifference | None
    """Of the seeds' shares of levels that ended ``ok``, 0 to 1; more is better."""
    n_first_smaller: int
    """Levels at which the first's mean is the smaller one; a description, not a test."""
    n_second_smaller: int
    """Levels at which the second's is."""


@dataclass(frozen=True, kw_only=True)
class Versus:
    """The comparison of two results."""

    first: Entry
    """The baseline, or the one given first."""
    second: Entry
    """The other."""
    levels: tuple[AtLevel, ...]
    """Every shared level."""
    overall: Overall
    """The whole sweep."""
    n_only_first: int
    """Rows that only the first has."""
    n_only_second: int
    """Rows that only the second has."""
    same_images: tuple[int, int] | None
    """Image streams that both have, and how many of them are identical."""


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """Everything that was compared."""

    entries: tuple[Entry, ...]
    """The results, the baseline first if there is one."""
    baseline: Entry | None
    """The baseline; None: each result is compared with each."""
    column: Column
    """What was compared."""
    higher_is_better: bool
    """Whether more of it is better."""
    forced: tuple[str, ...]
    """What differs between the experiments, compared all the same."""
    remarks: tuple[str, ...]
    """What else is worth knowing."""
    versus: tuple[Versus, ...]
    """Every pair of results."""

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels that were compared: those that two of the results share."""
        return tuple(dict.fromkeys(at.level for versus in self.versus for at in versus.levels))

    @property
    def n_tests(self) -> int:
        """Number of levels, over all pairs of results, that Holm's correction counts."""
        return family_size([at.value for versus in self.versus for at in versus.levels])

    @property
    def fewest(self) -> int:
        """Repeats below which no level can differ after Holm's correction."""
        return fewest_of([at.value for versus in self.versus for at in versus.levels])

    @property
    def fewest_for_sweep(self) -> int:
        """Repeats below which no sweep as a whole can differ after Holm's correction."""
        return fewest_of([versus.overall.value for versus in self.versus])


def family_size(family: Sequence[PairedDifference]) -> int:
    """Return how many tests Holm counts; where no test is possible, how many there would be."""
    tested = sum(d.is_tested for d in family)
    return tested or sum(d.difference.n > 0 for d in family) or 1


def fewest_of(family: Sequence[PairedDifference]) -> int:
    """Return how many repeats it takes until a test of this family can show a difference.

    With m tests of n repeats each the smallest corrected p there is is m times :math:`2/2^n`; m
    are all that have a pair, for with more repeats all of them will be tested.
    """
    return min_pairs(ALPHA / max(1, sum(d.difference.n > 0 for d in family)))


def least_corrected(family: Sequence[PairedDifference]) -> tuple[float | None, ...]:
    """Return the smallest p that each test could have after Holm's correction; None: not tested.

    Holm's correction of no test falls when the p of another rises, so the least there is is that of
    all tests at their smallest (`min_p_value`), which depends on their numbers of pairs alone.
    """
    return holm([min_p_value(d.difference.n) if d.is_tested else None for d in family])
