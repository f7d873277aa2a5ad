"""Decorators for old names of the public interface, which still work with a warning.

A use of an old name gives a DeprecationWarning that states the new name. The rules are in
``docs/python.md``, "Stability".
"""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable
from typing import Any, TypeVar, cast

F = TypeVar("F", bound=Callable[..., Any])


def deprecated_name(new_name: str) -> Callable[[F], F]:
    """Return a decorator for a method, or a property's getter, that is kept under its old name."""

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def call_old_name(*args: Any, **kwargs: Any) -> Any:
            warn_old_name(function.__name__, new_name)
            return function(*args, **kwargs)

        return cast("F", call_old_name)

    return decorate


def renamed_parameters(**new_names: str) -> Callable[[F], F]:
    """Return a decorator for a function that accepts old keywords: ``old_name="new_name"``."""

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
    """Warn that an old name is used; ``stacklevel`` is that of ``warnings.warn``."""
    text = f"{old_name!r} is deprecated since uwsim 0.2.0; use {new_name!r}."
    warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)
