"""Old names of the public interface, which still work; `docs/python.md`, "Stability", has the rule.

`deprecated_name` and `renamed_parameters` make decorators. The caller of an old name gets a
DeprecationWarning, which states the new one.
"""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable
from typing import Any, TypeVar, cast

F = TypeVar("F", bound=Callable[..., Any])


def deprecated_name(new_name: str) -> Callable[[F], F]:
    """Return the decorator of a method, or of a property's getter, that has an old name."""

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def call_old_name(*args: Any, **kwargs: Any) -> Any:
            warn_old_name(function.__name__, new_name)
            return function(*args, **kwargs)

        return cast("F", call_old_name)

    return decorate


def renamed_parameters(**new_names: str) -> Callable[[F], F]:
    """Return the decorator of a function that accepts old keywords: old name = new name."""

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def call_new_names(*args: Any, **kwargs: Any) -> Any:
            for old_name, new_name in new_names.items():
                if old_name in kwargs and new_name not in kwargs:
                    warn_old_name(old_name, new_name)
                    kwargs[new_name] = kwargs.pop(old_name)
            return function(*args, **kwargs)

        return cast("F", call_new_names)

    return decorate


def warn_old_name(old_name: str, new_name: str, *, stacklevel: int = 3) -> None:
    """Warn the caller of the calling function, or one further up the stack, of an old name."""
    text = f"{old_name!r} is deprecated since uwsim 0.2.0; use {new_name!r}."
    warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)
