"""The pairwise statistical comparison of the results of one experiment."""

from __future__ import annotations

from .compare import compare, compare_files
from .inputs import Entry, differences, read_entries, remarks, shared_column
from .model import Comparison
from .write import write_comparison

__all__ = [
    "Comparison",
    "Entry",
    "compare",
    "compare_files",
    "differences",
    "read_entries",
    "remarks",
    "shared_column",
    "write_comparison",
]
