"""The ``inputs`` of a result: every input file by role and name, with its hash.

``assets`` are the files that the scene and the benchmark name: robots, parts of vehicles, models
with their materials, buffers and images, data of currents, the user's own functions, recordings.
``algorithm`` has the source files of a user's own ``module:Class`` and of the modules that it
imports.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from .stored.record import StoredRecord

ASSETS = "assets"
"""The role of the files that scene and benchmark name."""
ALGORITHM = "algorithm"
"""The role of an algorithm's sources."""
NO_HASH = "sha256:"
"""The hash that earlier versions stored for boxes, cylinders and spheres."""
HASH_DIGITS = 12
"""The number of digits of a hash that texts show."""
MAX_LINES = 6
"""The greatest number of differences that are listed."""


@dataclass(frozen=True, kw_only=True)
class Inputs(StoredRecord):
    """The names and hashes of the files read; None for a role that a result does not state."""

    KEY: ClassVar[str] = "inputs"

    benchmark: tuple[str, str] | None = None
    """The name and hash of the benchmark."""
    scene: tuple[str, str] | None = None
    """The name and hash of the scene."""
    assets: Mapping[str, str] | None = None
    """The hash of each file that scene and benchmark name."""
    plugins: tuple[tuple[str, str], ...] | None = None
    """The name and hash of each plugin."""
    algorithm: Mapping[str, str] | None = None
    """The hash of each source file of the algorithm."""

    @property
    def title(self) -> str:
        """The name of the benchmark file without its suffix; ``benchmark`` if it is unknown."""
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

    def drop_algorithm(self) -> Inputs:
        """Return the inputs without the files of the algorithm."""
        return replace(self, algorithm=None)


def input_differences(old_inputs: Inputs, new_inputs: Inputs) -> list[str]:
    """Return the differences between two sets of inputs, a line each."""
    old_files, new_files = (
        {(r, n): d for r, n, d in inputs.files()} for inputs in (old_inputs, new_inputs)
    )
    lines = []
    for role, name in dict.fromkeys([*old_files, *new_files]):
        old_hash, new_hash = old_files.get((role, name)), new_files.get((role, name))
        file = name if role == ASSETS else f"{role} {name}"
        if old_hash is None:
            lines.append(f"{file} was not used then")
        elif new_hash is None:
            lines.append(f"{file} is not used any more")
        elif old_hash != new_hash:
            lines.append(
                f"{file} is another file now ({short_hash(old_hash)} then, "
                f"{short_hash(new_hash)} now)"
            )
    return (
        lines if len(lines) <= MAX_LINES else [*lines[:MAX_LINES], f"{len(lines) - MAX_LINES} more"]
    )


def short_hash(digest: object) -> str:
    """Return the first digits of a hash."""
    return str(digest).removeprefix("sha256:")[:HASH_DIGITS]
