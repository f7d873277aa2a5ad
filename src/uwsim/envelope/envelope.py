"""The result of a search for the breaking point, and its file ``envelope.json``.

``envelope.json`` is a pure function of inputs, seeds and versions: the same search gives the same
bytes, however often it was interrupted, and with every executor.
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
from ..statistics import Median, fewest_for_median, median_interval, rate
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
class Asked:
    """What was searched for."""

    over: str
    """The swept parameter that grew."""
    unit: str
    """Its unit; ``1`` for none."""
    until: str
    """The criterion."""
    fixed: Mapping[str, float]
    """The swept parameters that stayed, and where."""
    where: Range
    """The range."""
    seeds: tuple[int, ...]
    """One a repeat."""
    confidence: float
    """How surely the limits shall hold the breaking point."""


@dataclass(frozen=True, kw_only=True)
class Envelope:
    """What was found."""

    asked: Asked
    """What was searched for."""
    found: Search
    """The breaking point of each seed."""
    evaluations: tuple[Evaluation, ...]
    """Every run, by level and seed."""
    inputs: Inputs
    """Names and hashes of the files read."""
    run: RunInfo
    """The configuration of the runs."""

    @property
    def median(self) -> Median:
        """The breaking point and its limits, along the range from near to far."""
        where = self.asked.where
        sign = 1.0 if where.stop >= where.start else -1.0
        brackets = [
            (
                -math.inf if one.held is None else sign * one.held,
                math.inf if one.broken is None else sign * one.broken,
            )
            for one in self.found.thresholds
        ]
        found = median_interval(brackets, confidence=self.asked.confidence)
        if sign > 0:
            return found
        turned = [None if v is None else -v for v in (found.value, found.high, found.low)]
        return Median(
            n=found.n,
            value=turned[0],
            low=turned[1],
            high=turned[2],
            confidence=found.confidence,
        )

    @property
    def n_unbroken(self) -> int:
        """How many seeds do not break at the far end."""
        return sum(one.broken is None for one in self.found.thresholds)

    @property
    def n_broken_at_once(self) -> int:
        """How many seeds are broken at the near end."""
        return sum(one.held is None for one in self.found.thresholds)

    @property
    def verdict(self) -> str:
        """``breaks``, ``does not break``, ``broken from the start`` or ``undecided``."""
        n = len(self.found.thresholds)
        if self.median.value is not None:
            return "breaks"
        if 2 * self.n_unbroken > n:
            return "does not break"
        return "broken from the start" if 2 * self.n_broken_at_once > n else "undecided"

    @property
    def sentence(self) -> str:
        """The finding in one line: a number with its unit and its bound."""
        asked, median = self.asked, self.median
        unit = "" if asked.unit == "1" else f" {asked.unit}"
        start, stop = (f"{self._number(v)}{unit}" for v in (asked.where.start, self.found.stop))
        n = len(self.found.thresholds)
        if self.n_unbroken == n:
            return f"{asked.over}: does not break up to {stop} ({self._share(0, 'break')} there)"
        if self.n_broken_at_once == n:
            return f"{asked.over}: broken already at {start} ({self._share(n, 'break')} there)"
        if median.value is None:
            summary = f"{n - self.n_unbroken} of {n} seeds break up to {stop}"
            if self.n_broken_at_once:
                summary += f", {self.n_broken_at_once} of them already at {start}"
            return f"{asked.over}: {summary}{self._limits()}"
        return f"{asked.over} {self._number(median.value)}{unit}{self._limits()}"

    @property
    def warnings(self) -> tuple[str, ...]:
        """Caveats of the result."""
        messages = []
        asked, fold = self.asked, self.found.fold
        if fold is not None:
            messages.append(
                f"not monotone: at {asked.over} {self._number(fold.broken)} "
                f"{fold.n_broken} of {fold.n} seeds break, at {self._number(fold.holds)} "
                f"{fold.n_holding} of {fold.n} hold again; the first breaking point was searched"
            )
        counts = reasons(e.judgement for e in self.evaluations)
        if untrue := counts.get("simulation error", 0):
            messages.append(
                f"{untrue} runs ended with a simulation error: no limit of the algorithm"
            )
        if failed := counts.get("algorithm error", 0):
            messages.append(
                f"{failed} runs ended with an algorithm error: a bug rather than a limit?"
            )
        return tuple(messages)

    def plain(self) -> dict[str, object]:
        """Return everything as it is stored."""
        asked, median = self.asked, self.median
        return {
            "format": FORMAT,
            "inputs": self.inputs.as_dict(),
            "run": self.run.as_dict(),
            "over": asked.over,
            "unit": None if asked.unit == "1" else asked.unit,
            "until": asked.until,
            "fixed": dict(asked.fixed),
            "from": asked.where.start,
            "to": asked.where.stop,
            "tolerance": asked.where.tolerance,
            "seeds": list(asked.seeds),
            "method": METHOD,
            "verdict": self.verdict,
            "value": median.value,
            "low": _finite(median.low),
            "high": _finite(median.high),
            "confidence": asked.confidence,
            "confidence_of_limits": median.confidence,
            "sentence": self.sentence,
            "warnings": list(self.warnings),
            "broken_by": dict(reasons(e.judgement for e in self.evaluations)),
            "thresholds": [
                {"seed": one.seed, "held": one.held, "broken": one.broken}
                for one in self.found.thresholds
            ],
            "evaluations": [_evaluation_record(e) for e in self.evaluations],
        }

    def save(self, directory: Path) -> Path:
        """Write ``envelope.json``, whole or not at all."""
        entries = []
        for key, value in self.plain().items():
            if isinstance(value, list) and value and isinstance(value[0], dict):
                lines = ",\n    ".join(_text(entry) for entry in value)
                entries.append(f"{_text(key)}: [\n    {lines}\n  ]")
            else:
                entries.append(f"{_text(key)}: {_text(value)}")
        path = directory / FILE
        write_text(path, "{\n  " + ",\n  ".join(entries) + "\n}\n")
        return path

    def _number(self, value: float) -> str:
        """A level with the digits that the tolerance justifies."""
        return f"{value:.{self._decimals}f}"

    @property
    def _decimals(self) -> int:
        return max(0, math.ceil(-math.log10(self.asked.where.tolerance) - 1e-9))

    def _limits(self) -> str:
        median, asked = self.median, self.asked
        if median.confidence is None or median.low is None or median.high is None:
            fewest = fewest_for_median(asked.confidence)
            n = len(self.found.thresholds)
            seeds = "1 seed" if n == 1 else f"{n} seeds"
            return f" ({seeds}; a bound of {asked.confidence * 100:.3g} % needs {fewest})"
        low, high = self._outward(median.low, math.floor), self._outward(median.high, math.ceil)
        return f" ({asked.confidence * 100:.3g} %: {low} .. {high})"

    def _outward(self, limit: float, turn: Callable[[float], int]) -> str:
        """A confidence limit, rounded outwards."""
        if not math.isfinite(limit):
            return "outside the range"
        scale = 10.0**self._decimals
        return self._number(turn(round(limit * scale, 6)) / scale)

    def _share(self, n_broken: int, what: str) -> str:
        n = len(self.found.thresholds)
        share = rate(n_broken, n, confidence=self.asked.confidence)
        assert share is not None
        limit = f"at most {share.high:.0%}" if n_broken == 0 else f"at least {share.low:.0%}"
        percent = f"{self.asked.confidence * 100:.3g} %"
        return f"{n_broken} of {n} seeds; with {percent} confidence {limit} of all runs {what}"


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def _evaluation_record(evaluation: Evaluation) -> dict[str, object]:
    row = evaluation.row
    return {
        "seed": evaluation.seed,
        "level": evaluation.level,
        "broken": evaluation.judgement.is_broken,
        "why": evaluation.judgement.why,
        "status": row.status,
        "total": row.total,
        "measures": {name: value for name, (value, _) in row.measures.items()},
    }


def _text(value: object) -> str:
    return json.dumps(value, allow_nan=False, ensure_ascii=False, default=dict)
