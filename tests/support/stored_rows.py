"""The records of rows and of ends in the journal of a trial, with values for tests."""

from __future__ import annotations

from typing import Any

from uwsim.results.stored.stored_row import StoredEnd, StoredRow


def row_record(**values: Any) -> dict[str, Any]:
    """Return the record of a level's row; ``values`` replace or add to its fields."""
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
        **values,
    }


def end_record(**values: Any) -> dict[str, Any]:
    """Return the record of a trial's end; ``values`` replace or add to its fields."""
    return {"facts": {}, "parameters": {}, "streams": [], "notes": [], **values}


def stored_row(**values: Any) -> StoredRow:
    """Return a level's row with values as in a record."""
    return StoredRow.from_dict(row_record(**values))


def stored_end(**values: Any) -> StoredEnd:
    """Return a trial's end with values as in a record."""
    return StoredEnd.from_dict(end_record(**values))
