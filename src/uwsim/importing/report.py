"""The report of an import: what happened to each element of the read files, and why."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import asdict, dataclass, field
from typing import Literal

Status = Literal["imported", "changed", "left out"]
"""The fate of an element: it has the same meaning in the scene, or another one that the reason
states, or it is not in the scene."""
STATUSES: tuple[Status, ...] = ("imported", "changed", "left out")
MAX_ROWS = 5000
"""The greatest number of rows; of further elements only the number is kept."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """The place of an element in a file."""

    file: str
    """The name of the file, as the user or another file named it."""
    line: int
    """The line number from 1."""


@dataclass(frozen=True, kw_only=True)
class ImportRow:
    """The fate of one element."""

    status: Status
    """The fate."""
    element: str
    """The element with its name: ``joint arm::elbow``."""
    file: str
    """The name of the file."""
    line: int
    """The line of the element."""
    reason: str
    """The part of the scene that it became, or the reason why it is not there."""


@dataclass(kw_only=True)
class ImportReport:
    """The rows of an import, in the order in which the elements were processed."""

    rows: list[ImportRow] = field(default_factory=list)
    """The rows."""
    n_unlisted: int = 0
    """The number of elements without a row, beyond `MAX_ROWS`."""

    def add(self, status: Status, element: str, place: Place, reason: str) -> None:
        """Add a row."""
        if len(self.rows) >= MAX_ROWS:
            self.n_unlisted += 1
            return
        row = ImportRow(
            status=status, element=element, file=place.file, line=place.line, reason=reason
        )
        if row not in self.rows[-50:]:  # a file that is included several times
            self.rows.append(row)

    def count(self, status: Status) -> int:
        """Return the number of rows with a status."""
        return Counter(row.status for row in self.rows)[status]

    def to_json(self, scene: str) -> str:
        """Return the report as JSON, with the path of the scene file."""
        content = {
            "scene": scene,
            "counts": {status: self.count(status) for status in STATUSES},
            "n_unlisted": self.n_unlisted,
            "rows": [asdict(row) for row in self.rows],
        }
        return json.dumps(content, indent=1)
