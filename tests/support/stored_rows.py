"""Rows and ends as a trial's journal has them, with chosen values."""

from __future__ import annotations

from typing import Any

from uwsim.results.stored.stored_row import StoredEnd, StoredRow


def row_record(**given: Any) -> dict[str, Any]:
    """A row of one level as it is written; ``given`` stands in it as it is."""
    return {
        "values": [0.0],
        "measures": {"corners": [1.5, "px"]},
        "details": {},
        "total": 1.5,
        "status": "ok",
        "missing": {},
        "duration": 2.0,
        "logs": {},
        "log_headers": {},
        "pictures": [],
        **given,
    }


def end_record(**given: Any) -> dict[str, Any]:
    """The end of a trial as it is written; ``given`` stands in it as it is."""
    return {"facts": {}, "parameters": {}, "streams": [], "notes": [], **given}


def stored_row(**given: Any) -> StoredRow:
    """A row of one level; ``given`` are values as they are written."""
    return StoredRow.from_dict(row_record(**given))


def stored_end(**given: Any) -> StoredEnd:
    """The end of a trial; ``given`` are values as they are written."""
    return StoredEnd.from_dict(end_record(**given))
