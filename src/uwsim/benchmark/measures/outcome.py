r"""u:outcome: the success of a level and the classes of its failures, from the other measures.

.. code-block:: xml

    <u:outcome>
      <name>outcome</name>
      <success>offset &lt; 0.3</success>
      <failure> <status>collision</status> <condition>impact_max_speed &gt; 0.5</condition>
                <ends>true</ends> </failure>
      <failure> <status>left</status> <condition>offset_max &gt; 2</condition> </failure>
    </u:outcome>

The names in the expressions are those of the measures before the element, for their values, and of
their details: ``offset_max`` is the detail ``offset.max``, ``offset_x_rms`` is ``offset.x.rms``.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import ClassVar, Literal

from ...base.expression import Expression, ScoreError, parse
from ...errors import BadSetting
from ...schema import Spec
from ...world import World
from .measure import Measure, MeasureSpec

MISSED_STATUS = "missed"
"""The status of a level with neither a success nor a declared failure."""
RESERVED_STATUSES = ("ok", MISSED_STATUS, "algorithm error", "simulation error")
"""The statuses that no failure may have."""

Reading = Callable[[], float | None]
"""A function that returns the present value of a measure or of a detail."""

_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
_STATUS = re.compile(r"[a-z]+( [a-z]+)*")


@dataclass(frozen=True, kw_only=True)
class FailureSpec(Spec):
    """A ``<failure>`` element: a class of failures."""

    status: str
    """The status of the row: lower-case words."""
    condition: str
    """The failure: an expression of values and details of measures; other than 0 is a failure."""
    ends: Literal["false", "true"] = "false"
    """The text ``true`` if the failure ends the level as soon as the condition holds."""


@dataclass(frozen=True, kw_only=True)
class OutcomeSpec(MeasureSpec):
    """A ``<u:outcome>`` element of a benchmark file."""

    success: str
    """The success: an expression of values and details of measures; other than 0 is a success."""
    ends: Literal["false", "true"] = "false"
    """The text ``true`` if a success ends the level as soon as the condition holds."""
    failure: tuple[FailureSpec, ...] = ()
    """The classes of failures; the first that holds is the status of the row."""

    @property
    def may_end_level(self) -> bool:
        """True if a success or a failure may end a level before its time."""
        return "true" in (self.ends, *(failure.ends for failure in self.failure))

    @property
    def conditions(self) -> tuple[str, ...]:
        """The condition of the success, and of each failure."""
        return (self.success, *(failure.condition for failure in self.failure))

    def errors(self) -> Sequence[str]:
        """Return the errors of the statuses."""
        messages = []
        for i, failure in enumerate(self.failure):
            status = failure.status[:60]
            if not _STATUS.fullmatch(failure.status) or failure.status in RESERVED_STATUSES:
                messages.append(
                    f"<status> is {status!r}; expected lower-case words other than "
                    f"{', '.join(RESERVED_STATUSES)}"
                )
            elif failure.status in [other.status for other in self.failure[:i]]:
                messages.append(f"<status> {status!r} is given twice; expected one for each class")
        return messages

    def name_errors(self, measures: Sequence[str]) -> list[tuple[int, str]]:
        """Return the errors of the `conditions`: the index of each, and the message.

        Whether a detail exists is known only in the scene (`Outcome.connect`).

        Args:
            measures: the names of the measures before this one.
        """
        errors = []
        for i, text in enumerate(self.conditions):
            details = [
                name
                for name in _NAME.findall(text)
                if any(name.startswith(f"{measure}_") for measure in measures)
            ]
            try:
                parse(text, [*measures, *dict.fromkeys(details)])
            except ScoreError as error:
                tag = "condition" if i else "success"
                errors.append((i, f"<{tag}>: {error.message} (column {error.column + 1})"))
        return errors

    def bind(self, world: World) -> Outcome:
        """Return the measure, whose names are resolved by `Outcome.connect`."""
        return Outcome(self, world)


class Outcome(Measure):
    r"""1 for a success, 0 otherwise; the measure determines the status of the level.

    The status is that of the first ``<failure>`` whose condition holds at the end of the level;
    else ``ok`` if the success holds, else ``missed``. A condition with ``<ends>`` ends the level at
    the first step at which it holds. A condition of a measure without a value does not hold.
    ``time_done`` is the time since which the success has held up to the end. It is not known how
    near to success a level was: use the measures themselves.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = {"time_done": "s"}

    def __init__(self, spec: OutcomeSpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._start_time: float | None = None  # simulation time [s]
        self._success_time: float | None = None  # since which the success has held [s]
        self._ending: str | None = None
        self._conditions: list[_Condition] = []  # of the success, and of each failure

    def connect(self, readings: Mapping[str, Reading]) -> None:
        """Resolve the names in the expressions; see `connect_outcomes`.

        Args:
            readings: the functions that return values and details, by name.

        Raises:
            BadSetting: there is no such value or detail.
        """
        specs = [("success", self._spec.success, self._spec.ends)]
        specs += [(item.status, item.condition, item.ends) for item in self._spec.failure]
        self._conditions = [
            _Condition(self._spec.name, status, text, readings, ends=ends == "true")
            for status, text, ends in specs
        ]

    def start(self) -> None:
        """Evaluate the conditions at the first step."""
        self._start_time = self._world.time
        self.update()

    def update(self) -> None:
        """Evaluate the conditions that may end the level, and the success."""
        if self._ending is not None:
            return
        success, *failures = self._conditions
        if not success.is_true():
            self._success_time = None
        elif self._success_time is None:
            self._success_time = self._world.time
        if ending := next((item for item in failures if item.ends and item.is_true()), None):
            self._ending = f"{ending.status}: {ending.text}"
        elif success.ends and self._success_time is not None:
            self._ending = f"success: {success.text}"

    @property
    def value(self) -> float | None:
        """1 for a success, 0 otherwise; None if the measure was never active."""
        if self._start_time is None:
            return None
        return float(self.task_status[0] == "ok")

    @property
    def details(self) -> dict[str, float | None]:
        """The time of the success [s]."""
        if self._start_time is None or self._success_time is None or self.value != 1.0:
            return {"time_done": None}
        return {"time_done": self._success_time - self._start_time}

    @property
    def reasons(self) -> dict[str, str]:
        """The reason why there is no time of a success."""
        return {} if self.details["time_done"] is not None else {"time_done": "no success"}

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """1 if the condition of the success holds at present, else 0."""
        if self._start_time is None:
            return (None,)
        return (float(self._success_time is not None),)

    @property
    def ends_level(self) -> str | None:
        """The condition that ended the level."""
        return self._ending

    @property
    def task_status(self) -> tuple[str, str | None]:
        """The status of the first failure that holds, else ``ok`` or ``missed``."""
        success, *failures = self._conditions
        failure = next((item for item in failures if item.is_true()), None)
        if failure is not None:
            return failure.status, failure.describe()
        return ("ok", None) if success.is_true() else (MISSED_STATUS, success.describe())

    @property
    def remarks(self) -> tuple[str, ...]:
        """The condition that decided, unless the level succeeded."""
        success, *failures = self._conditions
        failure = next((item for item in failures if item.is_true()), None)
        if failure is not None:
            return (f"{failure.status}, as {failure.text}",)
        return () if success.is_true() else (f"{MISSED_STATUS}, as not {success.text}",)

    @property
    def is_complete(self) -> bool:
        """True if no failure ended the level before its time."""
        return self._ending is None or self.task_status[0] == "ok"


class _Condition:
    """A condition whose names are resolved."""

    def __init__(
        self, name: str, status: str, text: str, readings: Mapping[str, Reading], *, ends: bool
    ) -> None:
        self.status, self.text, self.ends = status, " ".join(text.split()), ends
        try:
            self._expression: Expression = parse(text, [*readings], kind="value or detail")
        except ScoreError as error:
            raise BadSetting(f"<u:outcome> {name!r}, {status}: {error.message}") from None
        self._readings = {item: readings[item] for item in self._expression.names}

    def _values(self) -> dict[str, float | None]:
        return {name: read() for name, read in self._readings.items()}

    def is_true(self) -> bool:
        """Return whether the condition holds at present."""
        value = self._expression.evaluate(self._values())
        return value is not None and value != 0.0

    def describe(self) -> str:
        """Return the condition and the present values of its names."""
        values = [
            f"{name} {'has no value' if value is None else f'= {value:.4g}'}"
            for name, value in self._values().items()
        ]
        return f"{self.text}; {', '.join(values)}" if values else self.text


def find_outcome_spec(measures: Sequence[MeasureSpec]) -> OutcomeSpec | None:
    """Return the outcome among the measures of a benchmark; None if it has none."""
    return next((spec for spec in measures if isinstance(spec, OutcomeSpec)), None)


def connect_outcomes(measures: Sequence[tuple[str, Measure]]) -> None:
    """Connect the outcomes among bound measures with the measures before them.

    Args:
        measures: the name of each measure, and the measure, in the order of the file.

    Raises:
        BadSetting: an expression has a name that is no value or detail of these measures.
    """
    readings: dict[str, Reading] = {}
    for name, measure in measures:
        if isinstance(measure, Outcome):
            measure.connect(readings)
        readings[name] = functools.partial(_read_value, measure)
        for detail in measure.details:
            readings[detail_name(name, detail)] = functools.partial(_read_detail, measure, detail)


def detail_name(measure: str, detail: str) -> str:
    """Return the name of a detail of a measure in an expression."""
    return re.sub(r"\W", "_", f"{measure}.{detail}")


def _read_value(measure: Measure) -> float | None:
    return _number(measure.value)


def _read_detail(measure: Measure, detail: str) -> float | None:
    return _number(measure.details.get(detail))


def _number(value: object) -> float | None:
    """Return a value as a number; None if it is none, as a plugin may give anything."""
    return float(value) if isinstance(value, Real) else None
