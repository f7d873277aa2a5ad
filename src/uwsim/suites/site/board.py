"""The content of the page: submissions that are compared, the others, and the results by task."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...analysis.overview.tasks import OverviewTask
from ...results.result import Result
from ..submission import Submission
from ..suite import SuiteSpec


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
    """The verdict of the last verification, if it is of this content."""

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

    suite: SuiteSpec | None
    """The suite, for descriptions; None if its file is not found by the name."""
    candidates: tuple[Candidate, ...]
    """The compared submissions: by rank, then those that are not ranked (`standings`)."""
    exclusions: tuple[Exclusion, ...]
    """The other submissions."""
    tasks: tuple[OverviewTask, ...]
    """The results by task, in the order of the suite."""
