"""The outcome of rows of episodes: the statuses that ``<u:outcome>`` gives their measures.

Of details, rows have the statistics of the vehicle's distances: ``mean``, ``rms`` and ``max``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
import numpy.typing as npt

from ...base.expression import ScoreError, parse
from ...base.geometry import Array
from ...benchmark.environment.program import compile_program, run_rows
from ...benchmark.measures import EnergySpec, MeasureSpec, OutcomeSpec
from ...benchmark.measures.outcome import MISSED_STATUS, detail_name

DETAILS = ("mean", "rms", "max")
"""The details of a distance."""


class RowOutcome:
    """The outcome of a benchmark for rows.

    Args:
        spec: the outcome.
        measures: the measures that rows compute.
    """

    def __init__(self, spec: OutcomeSpec, measures: Sequence[MeasureSpec]) -> None:
        self.name = spec.name
        """The name of the measure."""
        names = outcome_names(measures)
        self._names = list(names)
        self._sources = list(names.values())
        programs = [compile_program(parse(text, names), self._names) for text in spec.conditions]
        self._success, self._failures = programs[0], programs[1:]
        self._statuses = [failure.status for failure in spec.failure]

    def judge(self, statistics: Mapping[str, Array]) -> npt.NDArray[np.object_]:
        """Return the status of each row, (k,).

        Args:
            statistics: the value (``value``) and `DETAILS` of each measure of each row, (k, m).
        """
        columns = [statistics[kind][:, i] for i, kind in self._sources]
        values = np.stack(columns, axis=1) if columns else np.zeros((len(statistics["value"]), 0))
        statuses = np.where(
            _find_true(run_rows(self._success, values)), "ok", MISSED_STATUS
        ).astype(object)
        for status, program in reversed(list(zip(self._statuses, self._failures, strict=True))):
            statuses[_find_true(run_rows(program, values))] = status
        return statuses


def outcome_names(measures: Sequence[MeasureSpec]) -> dict[str, tuple[int, str]]:
    """Return the names in an outcome that rows know: the index of the measure, and the kind."""
    names = {spec.name: (i, "value") for i, spec in enumerate(measures)}
    distances = [(i, s) for i, s in enumerate(measures) if not isinstance(s, EnergySpec)]
    for (i, spec), detail in product(distances, DETAILS):
        names[detail_name(spec.name, detail)] = (i, detail)
    return names


def outcome_reasons(spec: OutcomeSpec | None, measures: Sequence[MeasureSpec]) -> list[str]:
    """Return the reasons why rows cannot judge an outcome."""
    if spec is None:
        return []
    reasons = []
    if spec.may_end_level:
        reasons.append(f"its outcome {spec.name} may end a level")
    for text in spec.conditions:
        try:
            parse(text, outcome_names(measures))
        except ScoreError as error:
            reasons.append(f"its outcome {spec.name}: {error.message}")
    return reasons


def _find_true(values: Array) -> npt.NDArray[np.bool_]:
    is_true: npt.NDArray[np.bool_] = np.isfinite(values) & (values != 0.0)
    return is_true
