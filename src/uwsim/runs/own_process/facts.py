"""What a run needs to know of an algorithm's class, which its own process alone may import.

The file of a submission's algorithm is code of somebody else. Where it is imported, it can replace
any function of uwsim. So the process that plans and compares asks a process of its own.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...algorithms.policy import is_policy


@dataclass(frozen=True, kw_only=True)
class AlgorithmFacts:
    """The attributes of an algorithm's class that a run needs."""

    module: str
    """The module in which its process finds the class."""
    qualname: str
    """The qualified name of the class in the module."""
    parameter_names: tuple[str, ...] | None = None
    """The names in ``PARAMETERS``; None without that attribute."""
    is_piloted: bool = False
    """True if a human pilots (``IS_PILOTED``)."""
    is_policy: bool = False
    """True if its objects are functions of an observation."""

    @property
    def name(self) -> str:
        """The name of the class."""
        return self.qualname.rpartition(".")[2]


@dataclass(frozen=True, kw_only=True)
class Description:
    """The answer of an algorithm's process about its class."""

    facts: AlgorithmFacts
    """The facts."""
    refusals: Mapping[str, str]
    """The errors of the user's parameters, by the name of the parameter."""
    sources: Mapping[str, Path]
    """The files of the class, by their names in a result (`find_sources`)."""


def facts_of(algorithm: type[Any] | AlgorithmFacts) -> AlgorithmFacts:
    """Return the facts of a class; facts are returned unchanged."""
    if isinstance(algorithm, AlgorithmFacts):
        return algorithm
    defaults: object = getattr(algorithm, "PARAMETERS", None)
    return AlgorithmFacts(
        module=algorithm.__module__,
        qualname=algorithm.__qualname__,
        parameter_names=tuple(map(str, defaults)) if isinstance(defaults, Mapping) else None,
        is_piloted=bool(getattr(algorithm, "IS_PILOTED", False)),
        is_policy=is_policy(algorithm),
    )


def search_path(folder: Path | None) -> list[str]:
    """Return the folders in which an algorithm's process searches for modules.

    Args:
        folder: the folder of the algorithm's files, which comes first; None without one.
    """
    return sys.path if folder is None else [str(folder), *(p for p in sys.path if p)]
