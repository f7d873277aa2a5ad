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
"""Greatest number of errors, and of warnings, that are listed."""


class Diagnostics:
    """Errors and warnings of one file: `MAX_DIAGNOSTICS` of each in full, the others counted."""

    def __init__(self, file: Path | str, *, strict: bool = False) -> None:
        self.file = str(file)
        self.strict = strict
        self.lenient = False
        """Whether junk behind a number is a warning, as where the original used atof."""
        self._excuse = ""
        self._found: list[Diagnostic] = []
        self._uncounted = {"error": 0, "warning": 0}

    def error(self, place: object, message: str) -> None:
        """Add an error at an element, a spec or a line number; a warning if it is `excused`."""
        if self._excuse:
            self._append(place, f"{message.removesuffix('.')}; {self._excuse}", "warning")
        else:
            self._append(place, message, "error")

    @contextmanager
    def excused(self, why: str) -> Iterator[None]:
        """Make warnings of the errors in this block, with the reason; with ``strict`` they stay."""
        before, self._excuse = self._excuse, "" if self.strict else why
        try:
            yield
        finally:
            self._excuse = before

    def warning(self, place: object, message: str) -> None:
        """Add a warning at an element, a spec or a line number; the file stays valid."""
        self._append(place, message, "warning")

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add errors and warnings as they are made, so that `near` knows whether one is listed."""
        for diagnostic in diagnostics:
            self._add(diagnostic)

    def unknown(self, node: etree._Element, what: str, name: str, known: Iterable[str]) -> None:
        """Say that ``name`` is not one of ``known``, with the nearest right one."""
        self.error(node, f"{what}.{self.near(name, known)}")

    def near(self, name: str, known: Iterable[str], severity: str = "error") -> str:
        """Return " Did you mean x?"; empty for long names and beyond the listed diagnostics."""
        if len(name) > 80 or not self._has_room(severity):
            return ""
        return did_you_mean(name, itertools.islice(known, 1000)).replace("'", "")

    @property
    def any(self) -> bool:
        """Whether the file is wrong (warnings do not count)."""
        return any(diagnostic.severity == "error" for diagnostic in self._found)

    def all(self) -> list[Diagnostic]:
        """Everything found, in the order of the file."""
        found = sorted(self._found, key=lambda diagnostic: diagnostic.line or 0)
        for severity, count in self._uncounted.items():
            if count:
                message = f"and {count} more {severity}s"
                found.append(_diagnostic(self.file, None, message, severity))
        return found

    def check(self, error: type[FileError] = FileError) -> None:
        """Raise ``error`` with every error, if there is one."""
        if self.any:
            raise error([diagnostic for diagnostic in self.all() if diagnostic.severity == "error"])

    def _has_room(self, severity: str) -> bool:
        return sum(diagnostic.severity == severity for diagnostic in self._found) < MAX_DIAGNOSTICS

    def _append(self, place: object, message: str, severity: str) -> None:
        line = line_of(place) if isinstance(place, Spec) else getattr(place, "sourceline", place)
        line = line if isinstance(line, int) else None
        self._add(_diagnostic(self.file, line, message, severity))

    def _add(self, diagnostic: Diagnostic) -> None:
        if self._uncounted[diagnostic.severity] or not self._has_room(diagnostic.severity):
            self._uncounted[diagnostic.severity] += 1
        else:
            self._found.append(diagnostic)


def diagnostic_at(
    spec: object,
    message: str,
    element: str = "",
    *,
    file: str | None = None,
    severity: Literal["error", "warning"] = "error",
) -> Diagnostic:
    """Make an error or a warning at the first ``element`` in a spec, else at the spec.

    Args:
        spec: what is wrong.
        message: why.
        element: qualified name of the element in it.
        file: named where the spec was read from none.
        severity: of the diagnostic.
    """
    source = spec.source_line if isinstance(spec, Spec) else None
    name = (file or "the scene") if source is None else source.file
    return Diagnostic(file=name, line=line_of(spec, element), message=message, severity=severity)


def _diagnostic(file: str, line: int | None, message: str, severity: str) -> Diagnostic:
    kind = cast(Literal["error", "warning"], severity)
    return Diagnostic(file=file, line=line, message=message, severity=kind)
