"""Provenance: machine, date and timing of a run.

``provenance.json`` holds what differs between two runs that found the same: host, CPU, load, dates,
wall time, workers, resumes, the achieved real-time factor, versions of the packages, what code
libraries chose for the processor. Nothing here is ever part of a score.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..errors import ResultError
from .atomic_file import write_text
from .chosen_code import chosen_code, other_code
from .stored.stored_shapes import PROVENANCE

BEFORE = "code_before"
"""What libraries had chosen on other machines, on which the run was begun."""


def save_provenance(provenance: Mapping[str, object], directory: Path) -> Path:
    """Write ``provenance.json`` into the result directory."""
    path = directory / "provenance.json"
    write_text(path, json.dumps(provenance, indent=2, ensure_ascii=False) + "\n")
    return path


def save_beginning(command: Sequence[str], directory: Path) -> str:
    """Write the provenance at the start of a run, unless it resumes another.

    Args:
        command: what was typed behind ``uwsim``.
        directory: of the result, or of the envelope.

    Returns:
        A warning if libraries had chosen other code for the processor when the run was begun,
        else nothing. Both choices are recorded.
    """
    before = load_provenance(directory)
    if not before:
        save_provenance({"command": list(command), **machine()}, directory)
        return ""
    change = other_code(before.get("code"))
    if not change:
        return ""
    codes = {BEFORE: [*codes_of(before)[1:], before["code"]]}
    save_provenance({**before, **machine(), **codes}, directory)
    return (
        f"the run was begun where libraries chose other code for the processor: {change}. What is "
        "bundled gives the same bytes all the same; an algorithm or a measure of one's own may not."
    )


def codes_of(provenance: Mapping[str, object]) -> list[object]:
    """Return the code paths that libraries chose, in this and earlier parts of the run."""
    before = provenance.get(BEFORE)
    return [provenance.get("code"), *(before if isinstance(before, list) else [])]


def carried(directory: Path) -> dict[str, object]:
    """Return the provenance that is kept after the run."""
    return {name: value for name, value in load_provenance(directory).items() if name == BEFORE}


def machine() -> dict[str, object]:
    """Describe the machine of this process."""
    return {
        "host": platform.node(),
        "system": platform.platform(),
        "cpu": _cpu_name(),
        "cores": os.cpu_count(),
        "load": os.getloadavg(),
        "python": platform.python_version(),
        "code": chosen_code(),
    }


def _cpu_name() -> str:
    """Return the processor's name as the system gives it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return platform.processor()
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor()


def load_provenance(directory: Path) -> dict[str, object]:
    """Read ``provenance.json``; empty when it is not there, not whole, or of another shape."""
    try:
        provenance = json.loads((directory / "provenance.json").read_text(encoding="utf-8"))
        PROVENANCE(provenance, "")
    except (OSError, ValueError, RecursionError, ResultError):
        return {}
    return dict(provenance)
