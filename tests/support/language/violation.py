"""A violation of a language rule."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Violation:
    """A violation of a language rule, with its place."""

    path: str
    """The path of the file, relative to the repository."""
    line: int
    """The line number, from 1."""
    kind: str
    """The rule: function, class, constant, variable, docstring, article, message or page."""
    name: str
    """The qualified name of what violates the rule."""
    reason: str
    """The reason."""

    @property
    def key(self) -> str:
        """The path, kind and qualified name, which do not depend on the line number."""
        return f"{self.path}: {self.kind}: {self.name}"

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.kind}: {self.name}: {self.reason}"
