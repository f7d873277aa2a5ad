"""The formats of labels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..request import DatasetRequest
from .plain import write_plain


def write_formats(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write the labels of a data set in all requested formats."""
    write_plain(request, records)
