"""The base classes of measures, which compute one value for each level of a benchmark."""

from __future__ import annotations

import abc
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from ...base.deprecation import accept_old_members
from ...schema import Spec, element
from ...world import Body, World
from ..triggers import NeverSpec, OnInitSpec, TriggerSpec

OLD_NAMES = {"why": "missing_reason", "went_off": "stop", "moment": "current_phase"}
"""The new name of each deprecated member of a measure."""


@dataclass(frozen=True, kw_only=True)
class MeasureSpec(Spec, abc.ABC):
    """An element of ``<measures>`` in a benchmark file."""

    values: ClassVar[tuple[str, ...]] = ("last",)
    """The allowed statistics in ``u:value``."""
    error_flag: ClassVar[int] = 0
    """The number that a missing value adds to the sum of error flags of a row (compatibility
    ``rows``: as in the original UWSim, result.dat has only rows whose sum is 0)."""

    statuses: ClassVar[tuple[str, ...]] = ()
    """The statuses of failures that the measure itself may give a level."""
    columns: ClassVar[tuple[str, ...]] = ()
    """The names of further numbers of the log that a reward can use, as ``NAME_COLUMN``."""

    name: str
    """The name of the column and of the variable in the score function; an identifier."""
    start_on: TriggerSpec = field(default_factory=OnInitSpec)
    """The trigger that activates the measure."""
    stop_on: TriggerSpec = field(default_factory=NeverSpec)
    """The trigger that deactivates the measure."""
    log: float | None = element(default=None, exclusive_minimum=0.0)
    """The period at which the log is written [s]; None: no log."""
    value: Literal["last", "mean", "rms", "max"] = element(
        default="last", attribute=True, namespaced=True
    )
    """The statistic over the level that is the value of the measure (``u:value``)."""

    def errors(self) -> Sequence[str]:
        """Return errors of elements that are valid one by one, but not together."""
        return ()

    @property
    def start_value(self) -> float | None:
        """The value that the original UWSim reports before its first sample; None: no value."""
        return None

    @property
    def spec_once_initialised(self) -> MeasureSpec:
        """The spec to bind in later levels, once the measure `has_initialised` an algorithm."""
        return self

    @property
    def original_fields(self) -> Mapping[str, str]:
        """The measure's fields in ``result.dat``: field name -> column name of the result."""
        return {self.name: self.name}

    @abc.abstractmethod
    def bind(self, world: World) -> Measure:
        """Resolve the names in the spec; raises UnknownName if one is unknown."""


class Measure(abc.ABC):
    """A quantity that is measured while it is active: between its start and its stop trigger.

    A measure is bound anew for every level. `start` is called at the first step at which it is
    active, `update` at every later step, and `stop` at the first step at which it is inactive
    again, or when the level ends.
    """

    unit: ClassVar[str]
    """The unit of the value."""
    detail_units: ClassVar[Mapping[str, str]] = {}
    """The units of the details whose unit is not that of the value: column suffix -> unit.

    The entry ``time`` applies to all details ``time.<name>`` without an entry.
    """
    fed_by_algorithm: ClassVar[bool] = False
    """True if the measure scores messages that the algorithm under test publishes."""

    @abc.abstractmethod
    def start(self) -> None:
        """Begin to measure, at the first step at which the measure is active."""

    @abc.abstractmethod
    def update(self) -> None:
        """Evaluate the world after one more step."""

    def stop(self) -> None:  # noqa: B027 - most measures ignore it
        """Stop, at the first step at which the measure is inactive, or the last of the level."""

    @property
    @abc.abstractmethod
    def value(self) -> float | None:
        """The value so far; None when there was nothing to measure."""

    def __init_subclass__(cls) -> None:
        """Accept old names of members in a plugin."""
        super().__init_subclass__()
        accept_old_members(cls, OLD_NAMES, stacklevel=5)  # class body, ABCMeta

    @property
    def missing_reason(self) -> str | None:
        """The reason why the value is None."""
        return None if self.value is not None else "it was never on"

    @property
    def details(self) -> Mapping[str, float | None]:
        """The further values in the result: column suffix -> value."""
        return {}

    @property
    def reasons(self) -> Mapping[str, str]:
        """The reasons why details are None, unless `missing_reason` applies: suffix -> reason."""
        return {}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns of the log, after the time; a name may include a unit: ``depth [m]``."""
        return ("value",)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of the columns of the log."""
        return (self.value,)

    @property
    def newest_sample(self) -> float | None:
        """The newest sample of the measured quantity, for rewards: the first number of the log."""
        values = self.log_values
        return values[0] if values else self.value

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes about this measure for the reader of the result."""
        return ()

    @property
    def remarks(self) -> tuple[str, ...]:
        """The remarks that the result shows next to the status of a row with all values."""
        return ()

    @property
    def has_initialised(self) -> bool:
        """True if the measure has sent the position of its target to the algorithm under test."""
        return False

    @property
    def longest_silence(self) -> float:
        """The longest time without an estimate while the measure was active [s].

        It is 0 for a measure that scores no estimates.
        """
        return 0.0

    @property
    def ends_level(self) -> str | None:
        """The reason to end the level now; None: it continues.

        The level then has the status `task_status`, or ``collision`` without a task.
        """
        return None

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """The status of the task and, unless it is ``ok``, the reason; None: there is no task.

        It becomes the status of the level when the level ends, unless the algorithm failed.
        """
        return None

    @property
    def current_phase(self) -> str | None:
        """The name of the present phase, of which the report shows an image; None: no image."""
        return None

    @property
    def viewed_bodies(self) -> tuple[Body, Body] | None:
        """The vehicle and the body that are shown in the image of a phase."""
        return None

    def close(self) -> None:  # noqa: B027 - most measures have no subscription
        """End the measure's subscriptions."""


accept_old_members(Measure, OLD_NAMES)
