"""Environment variables that are set for the duration of a block."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager


def not_chosen(variables: Mapping[str, str]) -> dict[str, str]:
    """Return those of the variables that the user has not set."""
    return {name: value for name, value in variables.items() if name not in os.environ}


@contextmanager
def environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Set the variables, where the user has not, for as long as the block lasts."""
    ours = not_chosen(variables)
    os.environ.update(ours)
    try:
        yield
    finally:
        for name in ours:
            del os.environ[name]
