"""The options of ``uwsim suite`` that choose seeds and a part of the trials."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting
from ..options.help_texts import RUN, option

if TYPE_CHECKING:
    from ...suites.entry import Seeds
    from ...suites.suite import Suite

ShardOption = Annotated[
    str | None,
    option(
        RUN,
        "--shard",
        metavar="I/N",
        help="Part I of N of the trials, into an --out that all parts share. The same command "
        "without --shard then completes and writes the results.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class SeedOptions:
    """The options that choose public seeds."""

    split: Annotated[
        str | None,
        option(RUN, "--split", metavar="NAME", help="The seeds of a split. [the suite's first]"),
    ] = None
    seeds: Annotated[
        int | None,
        option(RUN, "--seeds", metavar="K", min=1, help="Only the first K seeds of the split."),
    ] = None
    is_short: Annotated[
        bool,
        option(RUN, "--short", help="One seed and the middle level of each task, as a trial."),
    ] = False

    @property
    def count(self) -> int | None:
        """The number of seeds; None for all of the split."""
        return 1 if self.is_short else self.seeds

    def split_of(self, suite: Suite) -> str:
        """Return the name of the split."""
        return self.split or suite.spec.splits[0].name

    def read(self, suite: Suite) -> Seeds:
        """Return the seeds of a public split; raise BadSetting or UnknownName."""
        from ...suites.seeds import public_seeds

        return public_seeds(suite, self.split_of(suite), self.count)


@dataclass(frozen=True, kw_only=True)
class DrawnSeedOptions:
    """The options that choose public seeds, or those of the split *test*."""

    public_seeds: SeedOptions
    date: Annotated[
        str | None,
        option(RUN, "--date", metavar="YYYY-MM-DD", help="The date of --split test."),
    ] = None
    beacon: Annotated[
        str | None,
        option(RUN, "--beacon", metavar="TEXT", help="The public text of that date."),
    ] = None

    def read(self, suite: Suite) -> Seeds:
        """Return the seeds; raise BadSetting or UnknownName."""
        from ...suites.seeds import draw_test_seeds
        from ...suites.suite import TEST_SPLIT

        split = self.public_seeds.split_of(suite)
        is_test = split == TEST_SPLIT
        for name, value in (("--date", self.date), ("--beacon", self.beacon)):
            if is_test != (value is not None):
                raise BadSetting(
                    f"--split {split}: " + (f"add {name}." if is_test else f"leave out {name}.")
                )
        if is_test:
            count = self.public_seeds.count or suite.spec.splits[0].count
            return draw_test_seeds(suite, self.date or "", self.beacon or "", count)
        return self.public_seeds.read(suite)
