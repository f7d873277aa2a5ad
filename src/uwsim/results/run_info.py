"""``run`` of a result: what was executed, and with what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from .stored.record import StoredRecord


@dataclass(frozen=True, kw_only=True)
class RunInfo(StoredRecord):
    """What was executed, and with what; None where a result does not say."""

    KEY: ClassVar[str] = "run"

    seed: int | None = None
    """Seed of the first repeat."""
    repeats: int | None = None
    """Number of repeats."""
    mode: str | None = None
    """``sequential`` or ``independent``."""
    algorithm: str | None = None
    """Name of the algorithm, or ``module:Class``."""
    clients: tuple[tuple[str, str], ...] | None = None
    """Third-party algorithm and external clients: name, and how each takes part (`docs`)."""
    parameters: Mapping[str, object] | None = None
    """Parameters that the algorithm ran with."""
    settings: tuple[tuple[str, str], ...] | None = None
    """Path and value of each ``--set``."""
    levels: tuple[tuple[str, float], ...] | None = None
    """Name and value of each ``--level``."""
    compatibility: tuple[str, ...] | None = None
    """Quirks of the original that were on."""
    timestep: tuple[float, str] | None = None
    """Length of a physics step, and its unit."""
    version: str | None = None
    """Version of uwsim."""
    physics: str | None = None
    """Version of MuJoCo."""
    renderer: str | None = None
    """What drew the images; ``none`` for a control."""
    numpy: str | None = None
    """Version of numpy."""
    units: tuple[int, int] | None = None
    """How many trials are finished, and of how many."""
    notes: tuple[str, ...] | None = None
    """What a reader of the result should know."""

    @property
    def is_finished(self) -> bool:
        """Whether every trial is finished, as far as the result says."""
        return self.units is None or self.units[0] == self.units[1]

    @property
    def pairs_of_settings(self) -> tuple[str, ...]:
        """``PATH=VALUE`` of each ``--set``."""
        return tuple(f"{path}={_word(value)}" for path, value in self.settings or ())

    @property
    def pairs_of_levels(self) -> tuple[str, ...]:
        """``NAME=VALUE`` of each ``--level``."""
        return tuple(f"{name}={_word(value)}" for name, value in self.levels or ())


def _word(value: object) -> str:
    """A value as a person writes it: ``3`` for 3.0."""
    return f"{value:.10g}" if isinstance(value, float) else str(value)
