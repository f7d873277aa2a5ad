"""Options as typed values: a parameter of a command may be a frozen dataclass of options.

Each of its fields is annotated as a parameter of a command is (``Annotated[int, in_group(...)]``);
a field may be such a dataclass again. So several commands share options, and hand them on, as one
object.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, get_type_hints


def with_flat_options(command: Callable[..., object]) -> Callable[..., object]:
    """Return the command as typer understands it: each field of its dataclasses is a parameter."""
    hints = get_type_hints(command, include_extras=True)
    given = inspect.signature(command).parameters
    parameters: list[inspect.Parameter] = []
    for name, parameter in given.items():
        if is_dataclass(hints[name]):
            parameters += _options(hints[name])
        else:
            parameters.append(_parameter(name, hints[name], parameter.default))

    @functools.wraps(command)
    def call(**values: Any) -> object:
        return command(**{name: _value(name, hints[name], values) for name in given})

    call.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    call.__annotations__ = {each.name: each.annotation for each in parameters}
    return call


def _options(group: Any) -> Iterator[inspect.Parameter]:
    """Give the fields of a dataclass, and of those in it, as parameters."""
    hints = get_type_hints(group, include_extras=True)
    for field in fields(group):
        if is_dataclass(hints[field.name]):
            yield from _options(hints[field.name])
        else:
            default = inspect.Parameter.empty if field.default is MISSING else field.default
            yield _parameter(field.name, hints[field.name], default)


def _parameter(name: str, annotation: Any, default: Any) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(name, kind, annotation=annotation, default=default)


def _value(name: str, kind: Any, values: Mapping[str, Any]) -> Any:
    """Return the value of a parameter, or the dataclass filled with those of its fields."""
    if not is_dataclass(kind):
        return values[name]
    hints = get_type_hints(kind, include_extras=True)
    filled: Any = kind
    return filled(**{f.name: _value(f.name, hints[f.name], values) for f in fields(kind)})
