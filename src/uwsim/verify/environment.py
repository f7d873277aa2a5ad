"""Environments of the recording and of the replay, and likely causes of differences."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..results.chosen_code import code_differences
from ..results.provenance import codes_of, load_provenance, machine
from ..results.result import Result
from ..results.run_info import RunInfo
from .verify import ENVIRONMENT, Verification

MEANS = {
    "version": "uwsim",
    "physics": "physics",
    "renderer": "renderer",
    "numpy": "numpy",
    "cpu": "processor",
    "code": "code for the processor",
    "system": "system",
    "python": "Python",
}
"""What a result was made with, in words."""
PROMISES = {
    "version": "between versions of uwsim nothing is promised",
    "physics": "between versions of MuJoCo nothing is promised",
    "renderer": "another renderer draws single grey levels otherwise: promised is the motion of "
    "whatever no image steers, not images nor what is found in them",
    "numpy": "between versions of numpy random numbers and sums may differ",
    "cpu": "another processor may round otherwise: its kernels are compiled for it",
    "code": "what is bundled gives the same bytes all the same; an algorithm or a measure of one's "
    "own may not",
    "system": "another system has other libraries of mathematics",
    "python": "between versions of Python nothing is expected to differ",
}
"""What holds where that differs."""


def made_otherwise(stored: Result, directory: Path, run: RunInfo) -> dict[str, str]:
    """Return the differences between the recorded environment and that of the replay."""
    pairs = {name: (getattr(stored.run, name), getattr(run, name)) for name in ENVIRONMENT}
    recorded, here = load_provenance(directory), machine()
    for name in ("system", "python", *(["cpu"] if "code" not in recorded else [])):
        if name in recorded:
            pairs[name] = (recorded[name], here[name])
    messages = {
        name: f"{MEANS[name]}: made with {before}, replayed with {now}; {PROMISES[name]}"
        for name, (before, now) in pairs.items()
        if before != now
    }
    if codes := [text for code in codes_of(recorded) if (text := code_differences(code))]:
        messages["code"] = f"{MEANS['code']}: {'; '.join(codes)}; {PROMISES['code']}"
    return messages


def blame(found: Verification, others: Mapping[str, str]) -> str:
    """Return the part of the program that the differences point to."""
    bodies = [part for part in found.parts if not part.startswith("/")]
    if bodies:
        where = f"It begins in the physics: {', '.join(bodies)} moved otherwise."
        return where + _because(others, ("version", "physics", "numpy", "cpu", "code", "system"))
    if found.parts:
        where = f"Every body moved the same; the images on {', '.join(found.parts)} are others."
        return where + _because(others, ("version", "renderer", "numpy", "cpu", "code", "system"))
    if found.is_replayed:
        return "Every replayed trial gave what it stored; other parts of the result were changed."
    if not found.is_steady:
        return "Its stored fingerprints are not those of a replay."
    return (
        "Every body moved and every image was the same: what is stored was changed, or the "
        "algorithm or a measure is not repeatable (its own chance, a clock, threads)."
    )


def _because(others: Mapping[str, str], names: tuple[str, ...]) -> str:
    known = [MEANS[name] for name in names if name in others]
    return f" Made otherwise: {', '.join(known)}." if known else ""
