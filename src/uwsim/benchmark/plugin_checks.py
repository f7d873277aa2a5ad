"""Checks of what a plugin's measures, triggers and updaters return against their contract.

Annotations are not looked at when Python runs, and a result is only whole if names are text and
samples fit their header; so what leaves a measure is checked where it is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from numbers import Real
from pathlib import Path

from ..base.tracked_parameters import untracked_parameters
from ..errors import RunFailed
from ..world import Stage
from .measures import Measure
from .updaters import SceneUpdaterSpec

TEXTS = ("why", "ends_level")
"""Attributes of a measure that are text or None."""
BY_NAME = ("details", "detail_units", "reasons")
"""What it has by the names of its details."""


class ContractViolation(Exception):
    """A plugin violates its interface."""

    def __init__(self, part: object, attribute: str, message: str) -> None:
        self.part, self.attribute = part, attribute
        super().__init__(f"{type(part).__name__}.{attribute} {message}")


def check_values(measure: Measure) -> None:
    """Check all attributes of a measure that are not numbers, at the end of a level.

    Raises:
        ContractViolation: names are no text, or a reason belongs to nothing.
    """

    def expect(attribute: str, fits: Callable[[object], bool], expected: str) -> None:
        answer = getattr(measure, attribute)
        if not fits(answer):
            raise ContractViolation(measure, attribute, f"is {_shown(answer)}; expected {expected}")

    for attribute in TEXTS:
        expect(attribute, lambda answer: isinstance(answer, str | None), "text or None")
    for attribute in BY_NAME:
        expect(attribute, lambda answer: isinstance(answer, Mapping), "a dict by names of details")
        for key in getattr(measure, attribute):
            if not isinstance(key, str) or key == "":
                raise ContractViolation(measure, attribute, f"has the key {key!r}; expected a name")
    for attribute in ("detail_units", "reasons"):
        for key, text in getattr(measure, attribute).items():
            if not isinstance(text, str) or text == "":
                raise ContractViolation(
                    measure, attribute, f"has {_shown(text)} for {key!r}, no text"
                )
    details = measure.details
    for key in measure.reasons:
        if key not in details or details[key] is not None:
            what = f"is about {key!r}, which is no detail without a value"
            raise ContractViolation(measure, "reasons", what)
    expect("longest_silence", lambda answer: isinstance(answer, Real), "a time [s]")
    expect("notes", _are_texts, "a tuple of text")
    expect("log_header", _are_texts, "a tuple of text")


def sample_of(measure: Measure) -> Sequence[object]:
    """Return a line of a measure's log, as of now.

    Raises:
        ContractViolation: it has not as many values as the header has names.
    """
    values: object = measure.log_values
    if not isinstance(values, tuple | list):
        message = f"is {_shown(values)}; expected a tuple of numbers"
        raise ContractViolation(measure, "log_values", message)
    if len(values) != len(measure.log_header):
        message = f"has {len(values)} values; log_header has {len(measure.log_header)} names"
        raise ContractViolation(measure, "log_values", message)
    return values


def parameters_of(
    algorithm: object, given: Mapping[str, float | str], *, name: str
) -> dict[str, float | int | str]:
    """Return the parameters that an algorithm reports; without them, those given.

    Args:
        algorithm: the algorithm.
        given: what the user set.
        name: of its class.

    Raises:
        RunFailed: they are no dict of name -> number or text, which is what a result can hold.
    """
    returned: object = untracked_parameters(getattr(algorithm, "parameters", given))
    who = f"Algorithm {name}: its attribute parameters"
    if not isinstance(returned, Mapping):
        raise RunFailed(f"{who} is {_shown(returned)}; expected a dict of name -> number or text.")
    found: dict[str, float | int | str] = {}
    for name, value in returned.items():
        number = _as_float(value) if isinstance(value, Real) else None
        if not isinstance(name, str) or not (
            isinstance(value, str) or (number is not None and math.isfinite(number))
        ):
            raise RunFailed(
                f"{who} has {_shown(value)} for {name!r}; expected a name, and a number or text."
            )
        found[name] = value if isinstance(value, str | int) or number is None else number
    return found


def _as_float(value: Real) -> float:
    try:
        return float(value)
    except OverflowError:  # an int of hundreds of digits
        return math.inf


def files_of(updater: SceneUpdaterSpec, stage: Stage) -> Mapping[str, Path]:
    """Return the files that an updater reads.

    Raises:
        ContractViolation: it is no dict of name -> path, or one is not there.
    """
    files: object = updater.files(stage)
    if not isinstance(files, Mapping):
        raise ContractViolation(updater, "files", f"gives {_shown(files)}; expected name -> path")
    for name, path in files.items():
        if not (isinstance(name, str) and isinstance(path, Path) and path.exists()):
            message = f"gives {str(path)[:200]!r} for {name!r}; expected the path of a file"
            raise ContractViolation(updater, "files", message)
    return files


def _are_texts(answer: object) -> bool:
    return isinstance(answer, tuple | list) and all(isinstance(text, str) for text in answer)


def _shown(answer: object) -> str:
    """Describe a value in a few words that are the same in every run."""
    kind = type(answer).__name__
    if not isinstance(answer, str | Real):
        return kind
    try:
        return f"{kind} {str(answer)[:40]!r}"
    except ValueError:  # an int of more digits than Python writes
        return kind
