"""The result of a search for the breaking point, and its file ``envelope.json``.

The bytes of ``envelope.json`` depend only on inputs, seeds and versions: interruptions of the
search and the executor have no effect on them.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..results.atomic_file import write_text
from ..results.inputs import Inputs
from ..results.run_info import RunInfo
from ..statistics import Median, median_interval, min_values_for_median, rate
from .criterion import reasons
from .evaluate import Evaluation
from .search import Range, Search

FORMAT = "uwsim-envelope/1"
FILE = "envelope.json"
METHOD = (
    "median over seeds of the level at which bisection finds the run broken; "
    "limits: order statistics, exact"
)


@dataclass(frozen=True, kw_only=True)
class SearchSettings:
    """The settings of a search, as the envelope stores them."""

    parameter: str
    """The name of the swept parameter that the search varies."""
    unit: str
    """The unit of the parameter; ``1`` for none."""
    criterion: str
    """The text of the criterion of a broken run."""
    fixed: Mapping[str, float]
    """The values of the other swept parameters, which the search does not vary."""
    bounds: Range
    """The searched range of the parameter, with its tolerance."""
    seeds: tuple[int, ...]
    """The seeds, one for each repeat."""
    confidence: float
    """The confidence level of the limits, from 0 to 1."""


@dataclass(frozen=True, kw_only=True)
class Envelope:
    """The result of a search for the breaking point."""

    settings: SearchSettings
    """The settings of the search."""
    search: Search
    """The breaking point of each seed."""
    evaluations: tuple[Evaluation, ...]
    """The evaluations of all runs, ordered by level, then by seed."""
    inputs: Inputs
    """The names and hashes of the files read."""
    run: RunInfo
    """The configuration of the runs."""

    @property
    def median(self) -> Median:
        """The median breaking point over the seeds, with its confidence limits."""
        bounds = self.settings.bounds
        sign = 1.0 if bounds.stop >= bounds.start else -1.0
        brackets = [
            (
                -math.inf if threshold.hold_level is None else sign * threshold.hold_level,
                math.inf if threshold.break_level is None else sign * threshold.break_level,
            )
            for threshold in self.search.thresholds
        ]
        median = median_interval(brackets, confidence=self.settings.confidence)
        if sign > 0:
            return median
        values = [None if v is None else -v for v in (median.value, median.high, median.low)]
        return Median(
            n=median.n,
            value=values[0],
            low=values[1],
            high=values[2],
            confidence=median.confidence,
        )

    @property
    def n_unbroken(self) -> int:
        """The number of seeds whose run at the far end of the range holds."""
        return sum(threshold.break_level is None for threshold in self.search.thresholds)

    @property
    def n_broken_at_once(self) -> int:
        """The number of seeds whose run at the near end of the range is broken."""
        return sum(threshold.hold_level is None for threshold in self.search.thresholds)

    @property
    def verdict(self) -> str:
        """The verdict: ``breaks``, ``does not break``, ``broken from the start``, ``undecided``."""
        n = len(self.search.thresholds)
        if self.median.value is not None:
            return "breaks"
        if 2 * self.n_unbroken > n:
            return "does not break"
        return "broken from the start" if 2 * self.n_broken_at_once > n else "undecided"

    @property
    def sentence(self) -> str:
        """The result in one line: the breaking point with its unit and confidence limits."""
        settings, median = self.settings, self.median
        name, unit = settings.parameter, "" if settings.unit == "1" else f" {settings.unit}"
        start, stop = (
            f"{self._number(v)}{unit}" for v in (settings.bounds.start, self.search.stop)
        )
        n = len(self.search.thresholds)
        if self.n_unbroken == n:
            return f"{name}: does not break up to {stop} ({self._share(0, 'break')} there)"
        if self.n_broken_at_once == n:
            return f"{name}: broken already at {start} ({self._share(n, 'break')} there)"
        if median.value is None:
            summary = f"{n - self.n_unbroken} of {n} seeds break up to {stop}"
            if self.n_broken_at_once:
                summary += f", {self.n_broken_at_once} of them already at {start}"
            return f"{name}: {summary}{self._limits()}"
        return f"{name} {self._number(median.value)}{unit}{self._limits()}"

    @property
    def warnings(self) -> tuple[str, ...]:
        """The caveats of the result, as messages."""
        messages = []
        settings, reversal = self.settings, self.search.reversal
        if reversal is not None:
            n, hold_level = reversal.n, self._number(reversal.hold_level)
            messages.append(
                f"not monotone: at {settings.parameter} {self._number(reversal.break_level)} "
                f"{reversal.n_broken} of {n} seeds break, at {hold_level} "
                f"{reversal.n_held} of {n} hold again; the first breaking point was searched"
            )
        counts = reasons(e.judgement for e in self.evaluations)
        if n_failures := counts.get("simulation error", 0):
            messages.append(
                f"{n_failures} runs ended with a simulation error: no limit of the algorithm"
            )
        if n_errors := counts.get("algorithm error", 0):
            messages.append(
                f"{n_errors} runs ended with an algorithm error: a bug rather than a limit?"
            )
        return tuple(messages)

    def as_dict(self) -> dict[str, object]:
        """Return the content of ``envelope.json``."""
        settings, median = self.settings, self.median
        return {
            "format": FORMAT,
            "inputs": self.inputs.as_dict(),
            "run": self.run.as_dict(),
            "over": settings.parameter,
            "unit": None if settings.unit == "1" else settings.unit,
            "until": settings.criterion,
            "fixed": dict(settings.fixed),
            "from": settings.bounds.start,
            "to": settings.bounds.stop,
            "tolerance": settings.bounds.tolerance,
            "seeds": list(settings.seeds),
            "method": METHOD,
            "verdict": self.verdict,
            "value": median.value,
            "low": _finite_or_none(median.low),
            "high": _finite_or_none(median.high),
            "confidence": settings.confidence,
            "confidence_of_limits": median.confidence,
            "sentence": self.sentence,
            "warnings": list(self.warnings),
            "broken_by": dict(reasons(e.judgement for e in self.evaluations)),
            "thresholds": [
                {"seed": point.seed, "held": point.hold_level, "broken": point.break_level}
                for point in self.search.thresholds
            ],
            "evaluations": [_evaluation_record(e) for e in self.evaluations],
        }

    def save(self, directory: Path) -> Path:
        """Write ``envelope.json`` atomically."""
        entries = []
        for key, value in self.as_dict().items():
            if isinstance(value, list) and value and isinstance(value[0], dict):
                lines = ",\n    ".join(_text(entry) for entry in value)
                entries.append(f"{_text(key)}: [\n    {lines}\n  ]")
            else:
                entries.append(f"{_text(key)}: {_text(value)}")
        path = directory / FILE
        write_text(path, "{\n  " + ",\n  ".join(entries) + "\n}\n")
        return path

    def _number(self, value: float) -> str:
        """Return a level as text with the decimals that the tolerance justifies."""
        return f"{value:.{self._decimals}f}"

    @property
    def _decimals(self) -> int:
        return max(0, math.ceil(-math.log10(self.settings.bounds.tolerance) - 1e-9))

    def _limits(self) -> str:
        median, settings = self.median, self.settings
        if median.confidence is None or median.low is None or median.high is None:
            n_needed = min_values_for_median(settings.confidence)
            n = len(self.search.thresholds)
            seeds = "1 seed" if n == 1 else f"{n} seeds"
            return f" ({seeds}; a bound of {settings.confidence * 100:.3g} % needs {n_needed})"
        low, high = (self._widen(median.low, math.floor), self._widen(median.high, math.ceil))
        return f" ({settings.confidence * 100:.3g} %: {low} .. {high})"

    def _widen(self, limit: float, rounding: Callable[[float], int]) -> str:
        """Return a confidence limit as text; ``rounding`` must round away from the median."""
        if not math.isfinite(limit):
            return "outside the range"
        scale = 10.0**self._decimals
        return self._number(rounding(round(limit * scale, 6)) / scale)

    def _share(self, n_broken: int, verb: str) -> str:
        n = len(self.search.thresholds)
        share = rate(n_broken, n, confidence=self.settings.confidence)
        assert share is not None
        limit = f"at most {share.high:.0%}" if n_broken == 0 else f"at least {share.low:.0%}"
        percent = f"{self.settings.confidence * 100:.3g} %"
        return f"{n_broken} of {n} seeds; with {percent} confidence {limit} of all runs {verb}"


def _finite_or_none(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def _evaluation_record(evaluation: Evaluation) -> dict[str, object]:
    row = evaluation.row
    return {
        "seed": evaluation.seed,
        "level": evaluation.level,
        "broken": evaluation.judgement.is_broken,
        "why": evaluation.judgement.reason,
        "status": row.status,
        "total": row.total,
        "measures": {name: value for name, (value, _) in row.measures.items()},
    }


def _text(value: object) -> str:
    return json.dumps(value, allow_nan=False, ensure_ascii=False, default=dict)
