"""A rule about files, and what it may need."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import IntEnum
from typing import Generic, TypeVar

from ..errors import Diagnostic

S = TypeVar("S")


class Need(IntEnum):
    """What a rule reads; a rule is applied only where that could be made."""

    DOCUMENT = 0
    """The document with its macros expanded."""
    SPEC = 1
    """What the reader made of the document, perhaps with errors; listed by line."""
    FILES = 2
    """The same, and the files that it names; listed after it."""
    VALID = 3
    """A spec without errors, of which something is simulated."""
    MODEL = 4
    """What follows from it: a model that could be compiled."""


@dataclass(frozen=True)
class Rule(Generic[S]):
    """A rule of one of the tables in `uwsim.checks.table`."""

    find: Callable[[S], Iterable[Diagnostic]]
    """Yields the errors and warnings about a subject."""
    needs: Need
    """What it reads of the subject."""
    in_check: bool = True
    """Whether ``uwsim check`` applies it."""
    in_runs: bool = False
    """Whether a run applies it before it begins, for its warnings."""
