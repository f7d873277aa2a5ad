"""Groups of options: a parameter of a command may be a frozen dataclass of options.

Each of its fields has the annotation of a command's parameter (``Annotated[int, option(...)]``);
a field may be such a dataclass again. Several commands share options, and pass them on, as one
object.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, get_type_hints


def flatten_options(command: Callable[..., object]) -> Callable[..., object]:
    """Return the command for typer, with a parameter for each field of its dataclasses."""
    hints = get_type_hints(command, include_extras=True)
    inputs = inspect.signature(command).parameters
    parameters: list[inspect.Parameter] = []
    for name, parameter in inputs.items():
        if is_dataclass(hints[name]):
            parameters += _flat_parameters(hints[name])
        else:
            parameters.append(_parameter(name, hints[name], parameter.default))

    @functools.wraps(command)
    def call(**values: Any) -> object:
        return command(**{name: _value_of(name, hints[name], values) for name in inputs})

    call.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    call.__annotations__ = {entry.name: entry.annotation for entry in parameters}
    return call


def _flat_parameters(group: Any) -> Iterator[inspect.Parameter]:
    """Yield the fields of a dataclass, and of the dataclasses in it, as parameters."""
    hints = get_type_hints(group, include_extras=True)
    for field in fields(group):
        if is_dataclass(hints[field.name]):
            yield from _flat_parameters(hints[field.name])
        else:
            default = inspect.Parameter.empty if field.default is MISSING else field.default
            yield _parameter(field.name, hints[field.name], default)


def _parameter(name: str, annotation: Any, default: Any) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(name, kind, annotation=annotation, default=default)


def _value_of(name: str, kind: Any, values: Mapping[str, Any]) -> Any:
    """Return the value of a parameter; for a dataclass, an instance of it with these values."""
    if not is_dataclass(kind):
        return values[name]
    hints = get_type_hints(kind, include_extras=True)
    group: Any = kind
    return group(**{f.name: _value_of(f.name, hints[f.name], values) for f in fields(kind)})
