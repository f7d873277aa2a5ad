"""A rule about files, and what it may need."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from enum import IntEnum
from functools import partial
from typing import Generic, TypeVar

from ..errors import Diagnostic, UwsimError, short_repr, type_and_text

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

    @property
    def name(self) -> str:
        """Module and name of its function."""
        function = self.find.func if isinstance(self.find, partial) else self.find
        return f"{function.__module__}.{getattr(function, '__qualname__', type(function).__name__)}"

    def apply(
        self, subject: S, within: AbstractContextManager[None] | None = None
    ) -> Iterator[Diagnostic]:
        """Yield what it finds.

        Args:
            subject: what it is about.
            within: of the block in which the rule is asked; it may explain what is raised there.

        Raises:
            UwsimError: the rule raises, or gives something else; names its function.
        """
        try:
            with within or nullcontext():
                for each in self.find(subject):
                    if not isinstance(each, Diagnostic):
                        raise UwsimError(
                            f"The rule {self.name} gives {short_repr(each)}; expected a Diagnostic."
                        )
                    yield each
        except UwsimError:
            raise
        except Exception as error:
            raise UwsimError(f"The rule {self.name} raised {type_and_text(error)}.") from error
