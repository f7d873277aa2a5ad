"""The ``run`` of a result: the executed algorithm, its settings and versions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePath
from typing import ClassVar

from ..base.deprecation import deprecated_name
from .stored.record import StoredRecord


@dataclass(frozen=True, kw_only=True)
class RunInfo(StoredRecord):
    """The executed algorithm, its settings and versions; None for values that a result lacks."""

    KEY: ClassVar[str] = "run"
    STORED_KEYS: ClassVar[Mapping[str, str]] = {"trial_counts": "units"}

    seed: int | None = None
    """The seed of the first repeat."""
    repeats: int | None = None
    """The number of repeats."""
    mode: str | None = None
    """``sequential`` or ``independent``."""
    algorithm: str | None = None
    """The name of the algorithm, or ``module:Class``."""
    clients: tuple[tuple[str, str], ...] | None = None
    """The name of each third-party algorithm or external client, and how it takes part."""
    parameters: Mapping[str, object] | None = None
    """The parameters of the algorithm, including defaults."""
    settings: tuple[tuple[str, str], ...] | None = None
    """The path and value of each ``--set``."""
    levels: tuple[tuple[str, float], ...] | None = None
    """The name and value of each ``--level``."""
    track: tuple[str, tuple[str, ...]] | None = None
    """The name of the track and the kinds of sensors whose topics the algorithm could receive; None
    if it could receive all topics."""
    compatibility: tuple[str, ...] | None = None
    """The names of the compatibility quirks that were on."""
    timestep: tuple[float, str] | None = None
    """The length of a physics step, and its unit."""
    version: str | None = None
    """The version of uwsim."""
    physics: str | None = None
    """The version of MuJoCo."""
    renderer: str | None = None
    """The renderer of the images; ``none`` for a control run, which has no images."""
    numpy: str | None = None
    """The version of numpy."""
    trial_counts: tuple[int, int] | None = None
    """The number of finished trials, and the number of all trials; ``units`` in the file."""
    notes: tuple[str, ...] | None = None
    """Notes for a reader of the result."""

    @property
    def algorithm_label(self) -> str:
        """The name of the algorithm without the folders of its file: ``policy.py:Policy``.

        It is empty without an algorithm.
        """
        name = self.algorithm or ""
        file, _, class_name = name.rpartition(":")
        return f"{PurePath(file).name}:{class_name}" if file.endswith(".py") else name

    @property
    def is_finished(self) -> bool:
        """True if every trial is finished, as far as the result states it."""
        return self.trial_counts is None or self.trial_counts[0] == self.trial_counts[1]

    @property
    @deprecated_name("trial_counts")
    def units(self) -> tuple[int, int] | None:
        """The old name of `trial_counts`."""
        return self.trial_counts

    @property
    def pairs_of_settings(self) -> tuple[str, ...]:
        """``PATH=VALUE`` of each ``--set``."""
        return tuple(f"{path}={_word(value)}" for path, value in self.settings or ())

    @property
    def pairs_of_levels(self) -> tuple[str, ...]:
        """``NAME=VALUE`` of each ``--level``."""
        return tuple(f"{name}={_word(value)}" for name, value in self.levels or ())


def _word(value: object) -> str:
    """Return a value as a user writes it: ``3`` for 3.0."""
    return f"{value:.10g}" if isinstance(value, float) else str(value)
