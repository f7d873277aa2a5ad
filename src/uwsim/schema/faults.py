"""Everything that is wrong with one file, collected."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from pathlib import Path
from typing import Literal, cast

from lxml import etree

from ..errors import Fault, FileError, did_you_mean

MAX_FAULTS = 100
"""So many faults are said in full; so many notices too."""


class Faults:
    """Collects what is wrong with one file; at most `MAX_FAULTS` in full, the others counted."""

    def __init__(self, file: Path | str, *, strict: bool = False) -> None:
        self.file = str(file)
        self.strict = strict
        self.lenient = False
        """Whether junk behind a number is a notice, as where the original used atof."""
        self._found: list[Fault] = []
        self._uncounted = {"fault": 0, "notice": 0}
        self._nodes: dict[int, tuple[object, etree._Element]] = {}

    def add(self, node: etree._Element | int | None, message: str) -> None:
        """Say that something is wrong at ``node`` (or at a line number)."""
        self._append(node, message, "fault")

    def notice(self, node: etree._Element | int | None, message: str) -> None:
        """Say something worth knowing that does not make the file wrong."""
        self._append(node, message, "notice")

    def unknown(self, node: etree._Element, what: str, name: str, known: Iterable[str]) -> None:
        """Say that ``name`` is not one of ``known``, with the nearest right one."""
        self.add(node, f"{what}.{self.near(name, known)}")

    def near(self, name: str, known: Iterable[str], severity: str = "fault") -> str:
        """Return " Did you mean x?", or nothing where nobody would read it."""
        if len(name) > 80 or not self._has_room(severity):
            return ""
        return did_you_mean(name, itertools.islice(known, 1000)).replace("'", "")

    def remember(self, spec: object, node: etree._Element) -> None:
        """Keep the element a spec was read from, so that later checks can name its line."""
        self._nodes[id(spec)] = (spec, node)

    def node_of(self, spec: object) -> etree._Element | None:
        """Return the element ``spec`` was read from."""
        return self._nodes.get(id(spec), (None, None))[1]

    @property
    def any(self) -> bool:
        """Whether the file is wrong (notices do not count)."""
        return any(fault.severity == "fault" for fault in self._found)

    def all(self) -> list[Fault]:
        """Everything found, in the order of the file."""
        found = sorted(self._found, key=lambda fault: fault.line or 0)
        for severity, count in self._uncounted.items():
            if count:
                message = f"and {count} more {severity}s"
                found.append(_fault(self.file, None, message, severity))
        return found

    def check(self, error: type[FileError] = FileError) -> None:
        """Raise ``error`` with every fault, if there is one."""
        if self.any:
            raise error([fault for fault in self.all() if fault.severity == "fault"])

    def _has_room(self, severity: str) -> bool:
        return sum(fault.severity == severity for fault in self._found) < MAX_FAULTS

    def _append(self, node: etree._Element | int | None, message: str, severity: str) -> None:
        if self._uncounted[severity] or not self._has_room(severity):
            self._uncounted[severity] += 1
            return
        line = cast(int | None, getattr(node, "sourceline", node))
        self._found.append(_fault(self.file, line, message, severity))


def _fault(file: str, line: int | None, message: str, severity: str) -> Fault:
    kind = cast(Literal["fault", "notice"], severity)
    return Fault(file=file, line=line, message=message, severity=kind)
