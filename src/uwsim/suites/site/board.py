"""The content of the page: submissions that are compared, the others, and the results by task."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...analysis.overview.tasks import OverviewTask
from ...results.result import Result
from ..entry import Seeds
from ..submission import Submission
from ..suite_spec import SuiteSpec
from ..verification import VERIFIED_VERDICT


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A submission with its results."""

    name: str
    """The name in tables, which is unique on the page."""
    directory: Path
    """The folder of the submission."""
    submission: Submission
    """The content of ``submission.json``."""
    results: Mapping[str, Result]
    """The results by task."""
    verdict: str
    """The verdict of the last verification, or that the entry was changed after it."""

    @property
    def is_verified(self) -> bool:
        """A flag for a submission that was verified, and not changed since."""
        return self.verdict == VERIFIED_VERDICT

    @property
    def is_reference(self) -> bool:
        """A flag for a baseline, an expert or a control condition of the suite."""
        return self.submission.kind != "entry"


@dataclass(frozen=True, kw_only=True)
class Exclusion:
    """A submission that is not compared."""

    name: str
    """The name of its folder."""
    reasons: tuple[str, ...]
    """The reasons, each in one line."""


@dataclass(frozen=True, kw_only=True)
class Leaderboard:
    """The content of the page."""

    suite: SuiteSpec
    """The suite."""
    seeds: Seeds
    """The seeds of all submissions."""
    is_short: bool = False
    """A flag for the middle level of each task alone."""
    candidates: tuple[Candidate, ...]
    """The compared submissions: by rank, then those that are not ranked (`standings`)."""
    exclusions: tuple[Exclusion, ...]
    """The other submissions."""
    tasks: tuple[OverviewTask, ...]
    """The results by task, in the order of the suite."""
