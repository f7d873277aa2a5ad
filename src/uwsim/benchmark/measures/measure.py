"""The base classes of measures: values that are read at the end of a level."""

from __future__ import annotations

import abc
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from ...base.deprecation import warn_old_name
from ...schema import Spec, element
from ...world import Body, World
from ..triggers import NeverSpec, OnInitSpec, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class MeasureSpec(Spec, abc.ABC):
    """An element of ``<measures>`` in a benchmark file."""

    values: ClassVar[tuple[str, ...]] = ("last",)
    """The allowed statistics of ``u:value``."""
    error_flag: ClassVar[int] = 0
    """The share of a missing value in the original's sum of errors (compatibility ``rows``)."""

    name: str
    """The name of its column, and of the value in the function; an identifier."""
    start_on: TriggerSpec = field(default_factory=OnInitSpec)
    """The trigger that activates the measure."""
    stop_on: TriggerSpec = field(default_factory=NeverSpec)
    """The trigger that deactivates the measure."""
    log: float | None = element(default=None, exclusive_minimum=0.0)
    """The period of its log [s]; None: no log."""
    value: Literal["last", "mean", "rms", "max"] = element(
        default="last", attribute=True, namespaced=True
    )
    """The statistic of a signal that is its value (``u:value``)."""

    def errors(self) -> Sequence[str]:
        """Return errors in the combination of elements that are valid one by one."""
        return ()

    @property
    def start_value(self) -> float | None:
        """The original's value before the first measurement; None: no value."""
        return None

    @property
    def spec_once_initialised(self) -> MeasureSpec:
        """The spec to bind after the measure `has_initialised` an algorithm."""
        return self

    @property
    def original_fields(self) -> Mapping[str, str]:
        """The columns of the result by the names of its fields in ``result.dat``."""
        return {self.name: self.name}

    @abc.abstractmethod
    def bind(self, world: World) -> Measure:
        """Resolve the names of the spec; raises UnknownName if one is unknown."""


class Measure(abc.ABC):
    """A quantity that is measured while its triggers are on.

    It is bound anew for every level. `start` is called at the first step at which it is active,
    `update` at every later one, and `went_off` at the first at which it is inactive again, or when
    the level ends.
    """

    unit: ClassVar[str]
    """The unit of its value."""
    detail_units: ClassVar[Mapping[str, str]] = {}
    """The units of those details that have another than its value: column suffix -> unit.

    ``time`` is that of all ``time.<name>`` that have no entry.
    """
    fed_by_algorithm: ClassVar[bool] = False
    """True if it scores messages that the algorithm under test publishes."""

    @abc.abstractmethod
    def start(self) -> None:
        """Begin, at the first step at which it is active."""

    @abc.abstractmethod
    def update(self) -> None:
        """Evaluate the world after one more step."""

    def went_off(self) -> None:  # noqa: B027 - most measures ignore it
        """Stop, at the first step at which it is inactive again, or at the last of the level."""

    @property
    @abc.abstractmethod
    def value(self) -> float | None:
        """The value so far; None when there was nothing to measure."""

    def __init_subclass__(cls) -> None:
        """Accept the old name ``why`` of `missing_reason` in a plugin."""
        super().__init_subclass__()
        if "why" in vars(cls):
            warn_old_name("why", "missing_reason", stacklevel=4)  # class body, ABCMeta
            cls.missing_reason = vars(cls)["why"]  # type: ignore[method-assign]

    @property
    def missing_reason(self) -> str | None:
        """The reason why the value is None."""
        return None if self.value is not None else "it was never on"

    @property
    def details(self) -> Mapping[str, float | None]:
        """The further values of the result: column suffix -> value."""
        return {}

    @property
    def reasons(self) -> Mapping[str, str]:
        """The reasons of missing details by column suffix, unless `missing_reason` applies."""
        return {}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns of its log, after the time; a name may include its unit: ``depth [m]``."""
        return ("value",)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of a line of its log."""
        return (self.value,)

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes for the reader of the result, besides the value."""
        return ()

    @property
    def remarks(self) -> tuple[str, ...]:
        """The remarks beside the status of a row that has all values."""
        return ()

    @property
    def has_initialised(self) -> bool:
        """True if it has initialised the algorithm under test with the position of its target."""
        return False

    @property
    def longest_silence(self) -> float:
        """The longest time without an estimate while it was active [s]; 0 without estimates."""
        return 0.0

    @property
    def ends_level(self) -> str | None:
        """The reason to end the level, status ``collision`` or its `task_status`; None: no end."""
        return None

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """The status of the level as a task and, unless it is ``ok``, the reason; None: no task.

        It is used at the end of the level, unless the algorithm failed.
        """
        return None

    @property
    def moment(self) -> str | None:
        """The name of the phase of a task of which the report has an image; None: none."""
        return None

    @property
    def viewed_bodies(self) -> tuple[Body, Body] | None:
        """The vehicle and the body that such an image shows."""
        return None

    def close(self) -> None:  # noqa: B027 - most measures hold nothing
        """Release its resources (a subscription)."""
