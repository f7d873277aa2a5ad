"""The file of violations that are not corrected yet."""

from __future__ import annotations

from .scan import ROOT, Report

EXCEPTIONS = ROOT / "tests" / "names_exceptions.txt"
"""One line for each violation: path, kind and qualified name, in sorted order."""


def read_exceptions() -> list[str]:
    """Read the lines of the file; none if the file is absent."""
    return EXCEPTIONS.read_text().splitlines() if EXCEPTIONS.exists() else []


def remove_corrected(report: Report) -> int:
    """Remove the exceptions that no longer hold and return their number; add none."""
    keys = {violation.key for violation in report.violations}
    lines = read_exceptions()
    remaining_lines = [line for line in lines if line in keys]
    EXCEPTIONS.write_text("".join(f"{line}\n" for line in remaining_lines))
    return len(lines) - len(remaining_lines)
