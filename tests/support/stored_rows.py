"""Rows and ends as a unit's file has them, with chosen values (no module under test)."""

from __future__ import annotations

from typing import Any


def stored_row(**given: Any) -> dict[str, Any]:
    """A row of one level; ``given`` stands in it as it is."""
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


def stored_end(**given: Any) -> dict[str, Any]:
    """The end of a unit; ``given`` stands in it as it is."""
    return {"facts": {}, "parameters": {}, "streams": [], "notes": [], **given}
