"""Comparison of the environments of a result and its replay, and likely causes of differences.

The environment consists of the versions of the software and of the processor.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..results.code_paths import code_differences
from ..results.provenance import codes_of, load_provenance, machine
from ..results.result import Result
from ..results.run_info import RunInfo
from .verify import ENVIRONMENT, Verification

PART_NAMES = {
    "version": "uwsim",
    "physics": "physics",
    "renderer": "renderer",
    "numpy": "numpy",
    "cpu": "processor",
    "code": "code for the processor",
    "system": "system",
    "python": "Python",
}
"""The names of the parts of the environment in messages."""
GUARANTEES = {
    "version": "results of other versions of uwsim may differ",
    "physics": "results of other versions of MuJoCo may differ",
    "renderer": "another renderer draws single grey levels otherwise: guaranteed is the motion of "
    "all that no image steers, not images nor values computed from them",
    "numpy": "between versions of numpy random numbers and sums may differ",
    "cpu": "another processor may round otherwise: its kernels are compiled for it",
    "code": "bundled code gives the same bytes; your own algorithms and measures may not",
    "system": "another system has other libraries of mathematics",
    "python": "between versions of Python nothing is expected to differ",
}
"""The sentence that states what a difference in each part of the environment can change."""


def environment_differences(result: Result, directory: Path, run: RunInfo) -> dict[str, str]:
    """Return a message for each part of the environment that differs.

    Args:
        result: the stored result.
        directory: the directory of the result.
        run: the description of the replay.
    """
    pairs = {name: (getattr(result.run, name), getattr(run, name)) for name in ENVIRONMENT}
    provenance, current_machine = load_provenance(directory), machine()
    for name in ("system", "python", *(["cpu"] if "code" not in provenance else [])):
        if name in provenance:
            pairs[name] = (provenance[name], current_machine[name])
    messages = {
        name: f"{PART_NAMES[name]}: made with {old_value}, replayed with {new_value}; "
        f"{GUARANTEES[name]}"
        for name, (old_value, new_value) in pairs.items()
        if old_value != new_value
    }
    if codes := [text for code in codes_of(provenance) if (text := code_differences(code))]:
        messages["code"] = f"{PART_NAMES['code']}: {'; '.join(codes)}; {GUARANTEES['code']}"
    return messages


def likely_cause(report: Verification, changes: Mapping[str, str]) -> str:
    """Return a sentence about the likely cause of the differences.

    Args:
        report: the verification.
        changes: the output of `environment_differences`.
    """
    bodies = [part for part in report.diverging_parts if not part.startswith("/")]
    if bodies:
        message = f"It begins in the physics: {', '.join(bodies)} moved otherwise."
        return message + _causes(changes, ("version", "physics", "numpy", "cpu", "code", "system"))
    if report.diverging_parts:
        message = (
            f"Every body moved the same; the images on {', '.join(report.diverging_parts)} differ."
        )
        return message + _causes(changes, ("version", "renderer", "numpy", "cpu", "code", "system"))
    if report.has_same_values:
        return "Every replayed trial gave its stored values; other parts of the result differ."
    if not report.has_same_motion:
        return "Its stored fingerprints are not those of a replay."
    return (
        "Every motion and every image was the same. Either the stored values were changed, or the "
        "algorithm or a measure is not repeatable (own random numbers, a clock, threads)."
    )


def _causes(changes: Mapping[str, str], names: tuple[str, ...]) -> str:
    part_names = [PART_NAMES[name] for name in names if name in changes]
    return f" Made otherwise: {', '.join(part_names)}." if part_names else ""
