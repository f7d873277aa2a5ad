"""The base classes of measures: values that are read at the end of a level."""

from __future__ import annotations

import abc
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from ...schema import Spec, element
from ...world import Body, World
from ..triggers import NeverSpec, OnInitSpec, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class MeasureSpec(Spec, abc.ABC):
    """An element of ``<measures>`` in a benchmark file."""

    values: ClassVar[tuple[str, ...]] = ("last",)
    """What ``u:value`` may be."""
    error_flag: ClassVar[int] = 0
    """What a missing value adds to the original's sum of errors (compatibility ``rows``)."""

    name: str
    """Name of its column, and of the value in the function; an identifier."""
    start_on: TriggerSpec = field(default_factory=OnInitSpec)
    """It is on from here ..."""
    stop_on: TriggerSpec = field(default_factory=NeverSpec)
    """... to here."""
    log: float | None = element(default=None, above=0.0)
    """Period of its log [s]; None: no log."""
    value: Literal["last", "mean", "rms", "max"] = element(
        default="last", attribute=True, namespaced=True
    )
    """Which statistic of a signal is its value (``u:value``)."""

    def errors(self) -> Sequence[str]:
        """Errors in the combination of elements that are valid one by one."""
        return ()

    @property
    def start_value(self) -> float | None:
        """The original's value before anything was measured; None: none."""
        return None

    @property
    def once_initialised(self) -> MeasureSpec:
        """The spec to bind once it `has_initialised` an algorithm."""
        return self

    @property
    def original_fields(self) -> Mapping[str, str]:
        """Its fields in ``result.dat``: name there -> column of the result."""
        return {self.name: self.name}

    @abc.abstractmethod
    def bind(self, world: World) -> Measure:
        """Find what it looks at; raises UnknownName if that is not there."""


class Measure(abc.ABC):
    """A quantity that is measured while its triggers are on.

    It is bound afresh for every level. At the first step at which it is on it is started, at
    every later one updated; at the first at which it is off again, or when the level ends, it
    `went_off`.
    """

    unit: ClassVar[str]
    """Unit of its value."""
    detail_units: ClassVar[Mapping[str, str]] = {}
    """Units of those details that have another than its value: column suffix -> unit.

    ``time`` is that of all ``time.<name>`` that have no entry."""
    fed_by_algorithm: ClassVar[bool] = False
    """Whether it scores what the algorithm under test publishes."""

    @abc.abstractmethod
    def start(self) -> None:
        """Begin, at the first step at which it is on."""

    @abc.abstractmethod
    def update(self) -> None:
        """Look at the world after one more step."""

    def went_off(self) -> None:  # noqa: B027 - to most measures it is nothing
        """Stop, at the first step at which it is off again, or at the last of the level."""

    @property
    @abc.abstractmethod
    def value(self) -> float | None:
        """What was measured so far; None when there was nothing to measure."""

    @property
    def why(self) -> str | None:
        """Why the value is None."""
        return None if self.value is not None else "it was never on"

    @property
    def details(self) -> Mapping[str, float | None]:
        """What else goes into the result: column suffix -> value."""
        return {}

    @property
    def reasons(self) -> Mapping[str, str]:
        """Why details are None, where that is not `why`: column suffix -> reason."""
        return {}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns of its log, after the time; a name may include its unit: ``depth [m]``."""
        return ("value",)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """A line of its log, as of now."""
        return (self.value,)

    @property
    def notes(self) -> tuple[str, ...]:
        """What the reader of the result should know, besides the value."""
        return ()

    @property
    def remarks(self) -> tuple[str, ...]:
        """What belongs beside the status of a row although the row has all values."""
        return ()

    @property
    def has_initialised(self) -> bool:
        """Whether it has initialised the algorithm under test with the position of its target."""
        return False

    @property
    def longest_silence(self) -> float:
        """Longest time without an estimate while it was on [s]; 0 without estimates."""
        return 0.0

    @property
    def ends_level(self) -> str | None:
        """Why it ends the level, status ``collision`` unless it has a `task_status`; None: not."""
        return None

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """Status of the level as a task and, unless it is ``ok``, why; None: it is no judge.

        It counts at the end of the level, unless the algorithm failed.
        """
        return None

    @property
    def moment(self) -> str | None:
        """Name of the phase of a task, of which the report is to have an image; None: none."""
        return None

    @property
    def watched(self) -> tuple[Body, Body] | None:
        """The vehicle and the body that such an image shows."""
        return None

    def close(self) -> None:  # noqa: B027 - most measures hold nothing
        """Release its resources (a subscription)."""
