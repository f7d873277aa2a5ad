"""Provenance: machine, date and timing of a run.

``provenance.json`` holds the facts that may differ between two runs with the same result: host,
CPU, load, dates, wall time, workers, resumed levels, the real-time factor, versions of the
packages, the code paths that libraries chose for the processor. No score depends on them.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..errors import ResultError
from .atomic_file import write_text
from .code_paths import chosen_code, code_differences
from .stored.stored_shapes import PROVENANCE

EARLIER_CODES = "code_before"
"""The key of the code paths that libraries chose on other machines, in earlier parts of the run."""


def save_provenance(provenance: Mapping[str, object], directory: Path) -> Path:
    """Write ``provenance.json`` into the result directory."""
    path = directory / "provenance.json"
    write_text(path, json.dumps(provenance, indent=2, ensure_ascii=False) + "\n")
    return path


def save_beginning(command: Sequence[str], directory: Path) -> str:
    """Write the provenance at the start of a run, unless the run resumes an earlier one.

    Args:
        command: the arguments of the command ``uwsim``.
        directory: the directory of the result or the envelope.

    Returns:
        A warning if libraries had chosen other code paths when the run was begun, or else an empty
        text. Both choices are recorded.
    """
    provenance = load_provenance(directory)
    if not provenance:
        save_provenance({"command": list(command), **machine()}, directory)
        return ""
    change = code_differences(provenance.get("code"))
    if not change:
        return ""
    codes = {EARLIER_CODES: [*codes_of(provenance)[1:], provenance["code"]]}
    save_provenance({**provenance, **machine(), **codes}, directory)
    return (
        f"the run was begun where libraries chose other code for the processor: {change}. Bundled "
        "code gives the same bytes; your own algorithms and measures may not."
    )


def codes_of(provenance: Mapping[str, object]) -> list[object]:
    """Return the code paths that libraries chose, in this and earlier parts of the run."""
    earlier_codes = provenance.get(EARLIER_CODES)
    return [provenance.get("code"), *(earlier_codes if isinstance(earlier_codes, list) else [])]


def lasting_provenance(directory: Path) -> dict[str, object]:
    """Return the recorded part of the provenance to keep when the run writes a new one."""
    return {k: v for k, v in load_provenance(directory).items() if k == EARLIER_CODES}


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
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return platform.processor()
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor()


def load_provenance(directory: Path) -> dict[str, object]:
    """Read ``provenance.json``; return an empty dict if it is absent, damaged or invalid."""
    try:
        provenance = json.loads((directory / "provenance.json").read_text(encoding="utf-8"))
        PROVENANCE(provenance, "")
    except (OSError, ValueError, RecursionError, ResultError):
        return {}
    return dict(provenance)
