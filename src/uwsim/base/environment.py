"""Environment variables: setting some for the duration of a block, and removing secrets."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

WEB_TOKEN = "UWSIM_WEB_TOKEN"
"""The environment variable with the token of web clients."""
CLIENT_SECRET = "UWSIM_CLIENT_SECRET"
"""The environment variable with the secret that a client in lock-step sends when it joins."""


def remove_secrets(variables: Mapping[str, str]) -> dict[str, str]:
    """Return the variables without those that hold secrets, for a process that needs none."""
    secrets = (WEB_TOKEN, CLIENT_SECRET)
    return {name: value for name, value in variables.items() if name not in secrets}


def select_unset(variables: Mapping[str, str]) -> dict[str, str]:
    """Return the variables that the user has not set."""
    return {name: value for name, value in variables.items() if name not in os.environ}


@contextmanager
def set_environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Set the variables that the user has not set, for the duration of the block."""
    unset_variables = select_unset(variables)
    os.environ.update(unset_variables)
    try:
        yield
    finally:
        for name in unset_variables:
            del os.environ[name]
