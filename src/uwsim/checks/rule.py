"""A rule about files, and the inputs that it needs."""

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
    """The input of a rule; a rule is applied only if its input could be made."""

    DOCUMENT = 0
    """The document with its macros expanded."""
    SPEC = 1
    """The spec that the reader made of the document, perhaps with errors. The diagnostics of these
    rules are sorted by line, together with the diagnostics of the reader."""
    FILES = 2
    """The spec, and the files that it names."""
    VALID = 3
    """A spec without errors that has anything to simulate, such as a vehicle or a current."""
    MODEL = 4
    """The model that is compiled from the spec."""


@dataclass(frozen=True)
class Rule(Generic[S]):
    """A rule of one of the tables in `uwsim.checks.table`."""

    find: Callable[[S], Iterable[Diagnostic]]
    """The function that yields the errors and warnings about a subject."""
    need: Need
    """The input that the function needs."""
    in_check: bool = True
    """True if ``uwsim check`` applies the rule."""
    in_runs: bool = False
    """True if a run applies the rule before it begins, for its warnings."""

    @property
    def name(self) -> str:
        """The module and name of the function."""
        function = self.find.func if isinstance(self.find, partial) else self.find
        return f"{function.__module__}.{getattr(function, '__qualname__', type(function).__name__)}"

    def apply(
        self, subject: S, context: AbstractContextManager[None] | None = None
    ) -> Iterator[Diagnostic]:
        """Yield the errors and warnings about a subject.

        Args:
            subject: the file to check.
            context: a context manager that adds information to errors of the rule.

        Raises:
            UwsimError: the function raised an exception, or yielded an object that is not a
                Diagnostic; the error message names the function.
        """
        try:
            with context or nullcontext():
                for diagnostic in self.find(subject):
                    if not isinstance(diagnostic, Diagnostic):
                        type_text = f"{short_repr(diagnostic)}; expected a Diagnostic"
                        raise UwsimError(f"The rule {self.name} yields {type_text}.")
                    yield diagnostic
        except UwsimError:
            raise
        except Exception as error:
            raise UwsimError(f"The rule {self.name} raised {type_and_text(error)}.") from error
