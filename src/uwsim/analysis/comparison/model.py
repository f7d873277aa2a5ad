"""The results of a comparison, as `compare` returns them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ...base.deprecation import deprecated_name
from ...results.result import Column
from ...statistics import Interval, Rate, SuccessCurve, holm, min_p_value, min_pairs
from .inputs import Entry
from .pairs import Level
from .repeats import ALPHA

CONFIDENCE = 0.95
POWER = 0.8
"""The probability with which the repeats needed would show an effect of the observed size."""

Verdict = Literal["first", "second", "not shown", "too few", "equal", "one repeat", "no pair"]
"""The better result, or the reason why there is none. ``too few`` means that no values could show a
difference with this number of repeats (`min_corrected_p`), so nothing was tested."""


@dataclass(frozen=True, kw_only=True)
class PairedDifference:
    """The paired differences of two results, second minus first.

    A repeat that both results have is a paired repeat. Only those with a value in both count.
    """

    first: Interval
    """The mean of the first result over these repeats, with its confidence interval."""
    second: Interval
    """The mean of the second result over these repeats, with its confidence interval."""
    difference: Interval
    """The mean of the paired differences, with its confidence interval."""
    cohens_d: float | None
    """Cohen's d: the mean difference divided by the standard deviation of the differences."""
    hedges_g: float | None
    """The unbiased estimate of `cohens_d` for few repeats."""
    rank_biserial: float | None
    """The rank-biserial correlation of the signed ranks, -1 to 1."""
    superiority: float | None
    """Vargha and Delaney's A, the probability that a value of the second result is better than a
    value of the first; None for fewer than two repeats."""
    p: float | None
    """The p-value of the sign-flip test; None for fewer than two repeats."""
    p_signed_rank: float | None
    """The p-value of Wilcoxon's signed-rank test."""
    p_holm: float | None = None
    """The p-value `p` after Holm's correction; None if the repeats are too few to reach `ALPHA`."""
    repeats_needed: int | None = None
    """The number of repeats that would show the observed effect; None without an effect."""
    repeats_to_test: int | None = None
    """The number of repeats below which no test of the family can show a difference."""
    verdict: Verdict = "no pair"
    """The verdict on the two results."""

    @property
    def is_tested(self) -> bool:
        """True if there are enough repeats for p to reach `ALPHA`."""
        return self.difference.n >= min_pairs(ALPHA)

    @property
    @deprecated_name("repeats_needed")
    def needed(self) -> int | None:
        """The old name of `repeats_needed`."""
        return self.repeats_needed

    @property
    @deprecated_name("repeats_to_test")
    def fewest(self) -> int | None:
        """The old name of `repeats_to_test`."""
        return self.repeats_to_test


@dataclass(frozen=True, kw_only=True)
class Success:
    """The success rates (of ``ok``) of two results at one level, and their comparison."""

    first: Rate
    """The success rate of the first result."""
    second: Rate
    """The success rate of the second result."""
    first_only: int
    """The number of paired repeats of which only the first result ended ``ok``."""
    second_only: int
    """The number of paired repeats of which only the second result ended ``ok``."""
    p: float | None
    """The p-value of McNemar's exact test; None for fewer than two repeats."""
    p_holm: float | None = None
    """The p-value `p` after Holm's correction; None for too few discordant pairs."""

    @property
    def is_tested(self) -> bool:
        """True if there are enough discordant pairs (one ``ok``, one not) to reach `ALPHA`."""
        return self.first_only + self.second_only >= min_pairs(ALPHA)


@dataclass(frozen=True, kw_only=True)
class LevelStatistics:
    """The comparison of two results at one level, over the seeds."""

    level: Level
    """The values of the swept parameters, outermost first."""
    seeds: tuple[int, ...]
    """The seeds of the paired repeats."""
    n_only_first: int
    """The number of paired repeats with a value in the first result alone."""
    n_only_second: int
    """The number of paired repeats with a value in the second result alone."""
    n_neither: int
    """The number of paired repeats without a value in either result."""
    value: PairedDifference
    """The differences of the compared column, over the repeats with a value in both results."""
    success: Success | None
    """The success rates over all paired repeats; None if a result has no status."""


@dataclass(frozen=True, kw_only=True)
class SweepStatistics:
    """The comparison of two results over the whole sweep, with one value for each seed."""

    seeds: tuple[int, ...]
    """The seeds that both results have at every shared level."""
    n_levels: int
    """The number of shared levels."""
    levels: tuple[Level, ...]
    """The levels at which all these seeds have a value in both results."""
    value: PairedDifference
    """The differences of the means over `levels`, a mean for each seed."""
    success: PairedDifference | None
    """The differences of the fraction of levels that ended ``ok`` [1], a fraction for each seed;
    a higher fraction is better. None if a result has no status."""
    n_first_smaller: int
    """The number of levels at which the mean of the first result is smaller; this is no test."""
    n_second_smaller: int
    """The number of levels at which the mean of the second result is smaller."""


@dataclass(frozen=True, kw_only=True)
class LevelTimes:
    """The times to success of two results of a task at one level, over all paired repeats."""

    level: Level
    """The values of the swept parameters, outermost first."""
    first: SuccessCurve
    """The times to success of the first result [s]."""
    second: SuccessCurve
    """The times to success of the second result [s]."""
    difference: PairedDifference
    """The differences of the times to success, at most the time limit [s]; shorter is better."""
    p_log_rank: float | None
    """The p-value of the paired log-rank test, not corrected; None for fewer than two repeats."""


@dataclass(frozen=True, kw_only=True)
class PairTimes:
    """The comparison of the times to success of two results of a task."""

    limit: float
    """The time limit [s]: the latest end of a trial of any level that is not known to have failed.
    A trial without success up to it counts with it."""
    levels: tuple[LevelTimes, ...]
    """The comparison at every shared level."""
    sweep: PairedDifference
    """The differences of the mean over the levels [s], a mean for each seed that has them all."""


@dataclass(frozen=True, kw_only=True)
class PairComparison:
    """The comparison of two results."""

    first: Entry
    """The baseline, or the earlier argument."""
    second: Entry
    """The other result."""
    levels: tuple[LevelStatistics, ...]
    """The comparison at every shared level."""
    sweep: SweepStatistics
    """The comparison over the whole sweep."""
    n_only_first: int
    """The number of rows that only the first result has."""
    n_only_second: int
    """The number of rows that only the second result has."""
    same_images: tuple[int, int] | None
    """The number of image streams that both results have, and how many of them are identical; None
    if they have none in common."""
    times: PairTimes | None = None
    """The times to success; None if a result is not of a task, or no trial ever succeeded."""

    @property
    @deprecated_name("sweep")
    def overall(self) -> SweepStatistics:
        """The old name of `sweep`."""
        return self.sweep


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """The comparison of results, pair by pair."""

    entries: tuple[Entry, ...]
    """The results, the baseline first if there is one."""
    baseline: Entry | None
    """The baseline; None if each result is compared with each."""
    column: Column
    """The column that is compared."""
    higher_is_better: bool
    """True if a higher value is better."""
    experiment_differences: tuple[str, ...]
    """The differences between the experiments, which ``--force`` accepted."""
    remarks: tuple[str, ...]
    """The remarks on versions, unfinished results and unchecked rows."""
    pairs: tuple[PairComparison, ...]
    """The comparison of every pair of results."""

    def __str__(self) -> str:
        """Return a line for each pair: the mean difference over the sweep, and the verdict.

        For example ``total [m]: p minus pi: 0.187 [0.164, 0.199], 6 repeats, p = 0.031: pi is
        better``. `p` is the p-value after Holm's correction.
        """
        return "\n".join(f"{self.column.label}: {_describe(pair)}" for pair in self.pairs)

    def __repr__(self) -> str:
        return f"<Comparison {self.column.name}: {', '.join(entry.name for entry in self.entries)}>"

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels that at least two of the results share."""
        return tuple(dict.fromkeys(stats.level for pair in self.pairs for stats in pair.levels))

    @property
    def n_tests(self) -> int:
        """The number of levels, over all pairs of results, that Holm's correction counts."""
        return family_size([stats.value for pair in self.pairs for stats in pair.levels])

    @property
    def min_level_repeats(self) -> int:
        """The number of repeats below which no level can differ after Holm's correction."""
        return min_family_repeats([stats.value for pair in self.pairs for stats in pair.levels])

    @property
    def min_sweep_repeats(self) -> int:
        """The number of repeats below which no sweep can differ after Holm's correction."""
        return min_family_repeats([pair.sweep.value for pair in self.pairs])

    @property
    @deprecated_name("pairs")
    def versus(self) -> tuple[PairComparison, ...]:
        """The old name of `pairs`."""
        return self.pairs

    @property
    @deprecated_name("experiment_differences")
    def forced(self) -> tuple[str, ...]:
        """The old name of `experiment_differences`."""
        return self.experiment_differences

    @property
    @deprecated_name("min_level_repeats")
    def fewest(self) -> int:
        """The old name of `min_level_repeats`."""
        return self.min_level_repeats

    @property
    @deprecated_name("min_sweep_repeats")
    def fewest_for_sweep(self) -> int:
        """The old name of `min_sweep_repeats`."""
        return self.min_sweep_repeats


def family_size(family: Sequence[PairedDifference]) -> int:
    """Return the number of tests in Holm's correction: the tested ones, else all with data."""
    n_tested = sum(d.is_tested for d in family)
    return n_tested or sum(d.difference.n > 0 for d in family) or 1


def min_family_repeats(family: Sequence[PairedDifference]) -> int:
    """Return the minimum number of repeats at which a test of this family can show a difference.

    With m tests of n repeats each, the smallest corrected p is m times :math:`2/2^n`. All tests
    with data are counted, because with more repeats all of them will be tested.
    """
    return min_pairs(ALPHA / max(1, sum(d.difference.n > 0 for d in family)))


def min_corrected_p(family: Sequence[PairedDifference]) -> tuple[float | None, ...]:
    """Return the smallest possible p of each test after Holm's correction; None if not tested.

    A corrected p never falls when the p of another test rises. So a corrected p is smallest when
    all tests have their smallest p (`min_p_value`), which depends on n alone.
    """
    return holm([min_p_value(d.difference.n) if d.is_tested else None for d in family])


def _describe(pair: PairComparison) -> str:
    """Return the difference of two results over the sweep, and the verdict."""
    value = pair.sweep.value
    difference = value.difference
    text = f"{pair.second.name} minus {pair.first.name}: "
    text += "no value" if difference.mean is None else f"{difference.mean:.3g}"
    if difference.low is not None:
        text += f" [{difference.low:.3g}, {difference.high:.3g}]"
    text += f", {difference.n} repeats"
    if value.p_holm is not None:
        text += f", p = {value.p_holm:.2g}"
    winner = {"first": pair.first, "second": pair.second}.get(value.verdict)
    return f"{text}: {value.verdict if winner is None else f'{winner.name} is better'}"
