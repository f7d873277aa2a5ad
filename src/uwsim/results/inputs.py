"""The ``inputs`` of a result: every input file by role and name, with its hash.

``benchmark``, ``scene`` and ``plugins`` are name and hash; ``assets`` are what the scene and the
benchmark name: robots, vehicles' parts, models with their materials, buffers and images, data of
currents, the user's own functions, recordings; ``algorithm`` is the source of one's own
``module:Class`` and of what it imports.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from .stored.record import StoredRecord

ASSETS = "assets"
"""The role of what scene and benchmark name."""
ALGORITHM = "algorithm"
"""The role of an algorithm's sources."""
NO_HASH = "sha256:"
"""What earlier versions stored for boxes, cylinders and spheres."""
SHORT = 12
"""Digits of a hash that are shown to people."""
NAMED = 6
"""Greatest number of differences listed."""


@dataclass(frozen=True, kw_only=True)
class Inputs(StoredRecord):
    """Names and hashes of the files read; None where a result does not say."""

    KEY: ClassVar[str] = "inputs"

    benchmark: tuple[str, str] | None = None
    """Name and hash of the benchmark."""
    scene: tuple[str, str] | None = None
    """Name and hash of the scene."""
    assets: Mapping[str, str] | None = None
    """Name -> hash of what scene and benchmark name."""
    plugins: tuple[tuple[str, str], ...] | None = None
    """Name and hash of each plugin."""
    algorithm: Mapping[str, str] | None = None
    """Name -> hash of an algorithm's sources."""

    @property
    def title(self) -> str:
        """Name of the benchmark without its ending; ``benchmark`` where there is none."""
        return "benchmark" if self.benchmark is None else self.benchmark[0].removesuffix(".xml")

    def files(self) -> Iterator[tuple[str, str, str]]:
        """Yield role, name and hash of every input.

        Shapes without a hash, which results of earlier versions list, are left out.
        """
        for role in ("benchmark", "scene"):
            if (file := getattr(self, role)) is not None:
                yield (role, *file)
        assets = (self.assets or {}).items()
        yield from ((ASSETS, name, digest) for name, digest in assets if digest != NO_HASH)
        yield from (("plugins", *file) for file in self.plugins or ())
        yield from ((ALGORITHM, *file) for file in (self.algorithm or {}).items())

    def without_algorithm(self) -> Inputs:
        """Return the inputs without those of the algorithm."""
        return replace(self, algorithm=None)


def differing(before: Inputs, now: Inputs) -> list[str]:
    """Return the differing inputs, a line each."""
    then, today = ({(r, n): d for r, n, d in each.files()} for each in (before, now))
    messages = []
    for role, name in dict.fromkeys([*then, *today]):
        old, new = then.get((role, name)), today.get((role, name))
        file = name if role == ASSETS else f"{role} {name}"
        if old is None:
            messages.append(f"{file} was not used then")
        elif new is None:
            messages.append(f"{file} is not used any more")
        elif old != new:
            messages.append(
                f"{file} is another file now ({short_hash(old)} then, {short_hash(new)} now)"
            )
    return (
        messages if len(messages) <= NAMED else [*messages[:NAMED], f"{len(messages) - NAMED} more"]
    )


def short_hash(digest: object) -> str:
    """Return the first digits of a hash."""
    return str(digest).removeprefix("sha256:")[:SHORT]
