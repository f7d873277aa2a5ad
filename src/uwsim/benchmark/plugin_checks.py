"""Checks that the measures, updaters and algorithms of plugins return values of the right types.

Python does not check type annotations, and results can only be written if, for example, names are
text and a log sample has one value for each column. Values are therefore checked when they are
read.
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

TEXT_ATTRIBUTES = ("missing_reason", "ends_level")
"""The attributes of a measure that are text or None."""
DICT_ATTRIBUTES = ("details", "detail_units", "reasons")
"""The attributes of a measure that are dicts; their keys are the names of its details."""


class ContractViolation(Exception):
    """The error that an attribute or method of a plugin's object has a value of the wrong type."""

    def __init__(self, part: object, attribute: str, message: str) -> None:
        self.part, self.attribute = part, attribute
        super().__init__(f"{type(part).__name__}.{attribute} {message}")


def check_values(measure: Measure) -> None:
    """Check the texts, dicts and times of a measure at the end of a level.

    Raises:
        ContractViolation: an attribute has the wrong type, or `reasons` explains the absence of a
            detail that is not absent.
    """

    def expect(attribute: str, is_valid: Callable[[object], bool], expected: str) -> None:
        value = getattr(measure, attribute)
        if not is_valid(value):
            message = f"is {_describe(value)}; expected {expected}"
            raise ContractViolation(measure, attribute, message)

    for attribute in TEXT_ATTRIBUTES:
        expect(attribute, lambda answer: isinstance(answer, str | None), "text or None")
    for attribute in DICT_ATTRIBUTES:
        expect(attribute, lambda answer: isinstance(answer, Mapping), "a dict by names of details")
        for key in getattr(measure, attribute):
            if not isinstance(key, str) or key == "":
                raise ContractViolation(measure, attribute, f"has the key {key!r}; expected a name")
    for attribute in ("detail_units", "reasons"):
        for key, text in getattr(measure, attribute).items():
            if not isinstance(text, str) or text == "":
                message = f"has {_describe(text)} for {key!r}, no text"
                raise ContractViolation(measure, attribute, message)
    details = measure.details
    for key in measure.reasons:
        if key not in details or details[key] is not None:
            message = f"is about {key!r}, which is no detail without a value"
            raise ContractViolation(measure, "reasons", message)
    expect("longest_silence", lambda answer: isinstance(answer, Real), "a time [s]")
    expect("notes", _are_texts, "a tuple of text")
    expect("log_header", _are_texts, "a tuple of text")


def log_sample(measure: Measure) -> Sequence[object]:
    """Return the present values of the columns of a measure's log.

    Raises:
        ContractViolation: the log has another number of columns than of values.
    """
    values: object = measure.log_values
    if not isinstance(values, tuple | list):
        message = f"is {_describe(values)}; expected a tuple of numbers"
        raise ContractViolation(measure, "log_values", message)
    if len(values) != len(measure.log_header):
        message = f"has {len(values)} values; log_header has {len(measure.log_header)} names"
        raise ContractViolation(measure, "log_values", message)
    return values


def read_parameters(
    algorithm: object, user_parameters: Mapping[str, float | str], *, name: str
) -> dict[str, float | int | str]:
    """Return the parameters that an algorithm reports.

    Args:
        algorithm: the algorithm under test.
        user_parameters: the parameters that the user set; returned for an algorithm that has no
            attribute ``parameters``.
        name: the name of the algorithm's class, for messages.

    Raises:
        RunFailed: the parameters are not a dict of name -> number or text.
    """
    reports: object = untracked_parameters(getattr(algorithm, "parameters", user_parameters))
    subject = f"Algorithm {name}: its attribute parameters"
    if not isinstance(reports, Mapping):
        text = f"{subject} is {_describe(reports)}"
        raise RunFailed(f"{text}; expected a dict of name -> number or text.")
    parameters: dict[str, float | int | str] = {}
    for name, value in reports.items():
        number = _as_float(value) if isinstance(value, Real) else None
        if not isinstance(name, str) or not (
            isinstance(value, str) or (number is not None and math.isfinite(number))
        ):
            text = f"{subject} has {_describe(value)} for {name!r}"
            raise RunFailed(f"{text}; expected a name, and a number or text.")
        parameters[name] = value if isinstance(value, str | int) or number is None else number
    return parameters


def _as_float(value: Real) -> float:
    try:
        return float(value)
    except OverflowError:  # an int of hundreds of digits
        return math.inf


def updater_files(updater: SceneUpdaterSpec, stage: Stage) -> Mapping[str, Path]:
    """Return the files that an updater reads, by their names in the benchmark file.

    Raises:
        ContractViolation: the updater returns no dict of name -> path, or a file does not exist.
    """
    files: object = updater.files(stage)
    if not isinstance(files, Mapping):
        raise ContractViolation(
            updater, "files", f"gives {_describe(files)}; expected name -> path"
        )
    for name, path in files.items():
        if not (isinstance(name, str) and isinstance(path, Path) and path.exists()):
            message = f"gives {str(path)[:200]!r} for {name!r}; expected the path of a file"
            raise ContractViolation(updater, "files", message)
    return files


def _are_texts(value: object) -> bool:
    return isinstance(value, tuple | list) and all(isinstance(text, str) for text in value)


def _describe(value: object) -> str:
    """Return the type of a value, and its text if that is the same in every run."""
    kind = type(value).__name__
    if not isinstance(value, str | Real):
        return kind
    try:
        return f"{kind} {str(value)[:40]!r}"
    except ValueError:  # an int of more digits than Python writes
        return kind
