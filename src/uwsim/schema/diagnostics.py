"""The errors and warnings of one file."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal, cast

from lxml import etree

from ..errors import Diagnostic, FileError, did_you_mean
from .source_line import Spec, line_of

MAX_DIAGNOSTICS = 100
"""The greatest number of errors, and the greatest number of warnings, that are listed."""


class Diagnostics:
    """The errors and warnings of a file; beyond `MAX_DIAGNOSTICS` they are only counted."""

    def __init__(self, file: Path | str, *, is_strict: bool = False) -> None:
        self.file = str(file)
        self.is_strict = is_strict
        self.allows_trailing_text = False
        """True if text after a number is a warning: the original uses ``atof`` there."""
        self._reason = ""
        self._entries: list[Diagnostic] = []
        self._n_unlisted = {"error": 0, "warning": 0, "note": 0}

    def error(self, location: object, message: str) -> None:
        """Add an error at an element, a spec or a line number; see `errors_as_warnings`."""
        if self._reason:
            self._append(location, f"{message.removesuffix('.')}; {self._reason}", "warning")
        else:
            self._append(location, message, "error")

    @contextmanager
    def errors_as_warnings(self, reason: str) -> Iterator[None]:
        """Turn the errors added in this block into warnings with ``reason``, unless strict."""
        previous_reason, self._reason = self._reason, "" if self.is_strict else reason
        try:
            yield
        finally:
            self._reason = previous_reason

    def warning(self, location: object, message: str) -> None:
        """Add a warning at an element, a spec or a line number; the file stays valid."""
        self._append(location, message, "warning")

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add errors and warnings one by one: a generator of them may call `suggest` meanwhile."""
        for diagnostic in diagnostics:
            self._add(diagnostic)

    def report_unknown(
        self, node: etree._Element, message: str, name: str, valid_names: Iterable[str]
    ) -> None:
        """Report that ``name`` is not one of ``valid_names``, with the nearest of them."""
        self.error(node, f"{message}.{self.suggest(name, valid_names)}")

    def suggest(self, name: str, valid_names: Iterable[str], severity: str = "error") -> str:
        """Return " Did you mean x?"; "" for long names, and when no more diagnostics are listed."""
        if len(name) > 80 or not self._can_list(severity):
            return ""
        return did_you_mean(name, itertools.islice(valid_names, 1000)).replace("'", "")

    @property
    def has_errors(self) -> bool:
        """True if the file has errors (warnings do not count)."""
        return any(diagnostic.severity == "error" for diagnostic in self._entries)

    def to_list(self) -> list[Diagnostic]:
        """Return the errors and warnings in the order of the file."""
        diagnostics = sorted(self._entries, key=lambda diagnostic: diagnostic.line or 0)
        for severity, count in self._n_unlisted.items():
            if count:
                message = f"and {count} more {severity}s"
                diagnostics.append(_diagnostic(self.file, None, message, severity))
        return diagnostics

    def check(self, error: type[FileError] = FileError) -> None:
        """Raise ``error`` with all errors, if there are any."""
        if self.has_errors:
            raise error([item for item in self.to_list() if item.severity == "error"])

    def _can_list(self, severity: str) -> bool:
        return sum(entry.severity == severity for entry in self._entries) < MAX_DIAGNOSTICS

    def _append(self, location: object, message: str, severity: str) -> None:
        if isinstance(location, Spec):
            line: object = line_of(location)
        else:
            line = getattr(location, "sourceline", location)
        line = line if isinstance(line, int) else None
        self._add(_diagnostic(self.file, line, message, severity))

    def _add(self, diagnostic: Diagnostic) -> None:
        if self._n_unlisted[diagnostic.severity] or not self._can_list(diagnostic.severity):
            self._n_unlisted[diagnostic.severity] += 1
        else:
            self._entries.append(diagnostic)


def diagnostic_at(
    spec: object,
    message: str,
    element: str = "",
    *,
    file: str | None = None,
    severity: Literal["error", "warning", "note"] = "error",
) -> Diagnostic:
    """Make an error or a warning at the line of the first ``element`` in a spec, else of the spec.

    Args:
        spec: the spec that has the error.
        message: the text of the diagnostic.
        element: the qualified name of the element in the spec.
        file: the name of the file, for a spec that was not read from one.
        severity: the severity of the diagnostic.
    """
    source = spec.source_line if isinstance(spec, Spec) else None
    name = (file or "the scene") if source is None else source.file
    return Diagnostic(file=name, line=line_of(spec, element), message=message, severity=severity)


def _diagnostic(file: str, line: int | None, message: str, severity: str) -> Diagnostic:
    kind = cast(Literal["error", "warning", "note"], severity)
    return Diagnostic(file=file, line=line, message=message, severity=kind)
