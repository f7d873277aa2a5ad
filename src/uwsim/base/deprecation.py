"""Decorators for old names of the public interface, which still work with a warning.

A use of an old name gives a DeprecationWarning that states the new name. The rules are in
``docs/python.md``, "Stability".
"""

from __future__ import annotations

import functools
import inspect
import warnings
from collections.abc import Callable, Mapping
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


def accept_old_members(cls: type, new_names: Mapping[str, str], *, stacklevel: int = 3) -> None:
    """Give a member that a class defines by an old name its new name, with a warning.

    A member that the class defines by a new name can also be used by its old name, with a warning.
    A base class calls this function for itself, and in ``__init_subclass__``.

    Args:
        cls: the class.
        new_names: old name -> new name of each renamed method or property.
        stacklevel: the ``stacklevel`` of ``warnings.warn`` for the definition by an old name.
    """
    for old_name, new_name in new_names.items():
        members = vars(cls)
        if old_name in members:
            warn_old_name(old_name, new_name, stacklevel=stacklevel)
            setattr(cls, new_name, members[old_name])
        elif new_name in members:
            setattr(cls, old_name, _old_member(old_name, new_name, members[new_name]))


def _old_member(old_name: str, new_name: str, member: Any) -> Any:
    """Return a method, or a property if the member is not a function, that warns at each use."""
    is_method = inspect.isfunction(member)

    def use_member(instance: Any, *args: Any, **kwargs: Any) -> Any:
        warn_old_name(old_name, new_name)
        bound_member = member.__get__(instance) if hasattr(member, "__get__") else member
        return bound_member(*args, **kwargs) if is_method else bound_member

    return use_member if is_method else property(use_member)


def warn_old_name(old_name: str, new_name: str, *, stacklevel: int = 3) -> None:
    """Warn that an old name is used; ``stacklevel`` is that of ``warnings.warn``."""
    text = f"{old_name!r} is deprecated since uwsim 0.2.0; use {new_name!r}."
    warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)
