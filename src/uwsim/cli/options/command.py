"""A command of ``uwsim``: its module, its help and its examples."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from .option_groups import flatten_options


@dataclass(frozen=True, kw_only=True)
class Command:
    """A command of ``uwsim``, which is imported only when it runs."""

    module: str
    """The name of the command's module in this package."""
    function: str
    """The name of the function in that module, whose docstring is the help of the command."""
    summary: str
    """The summary in one line for ``uwsim --help``."""
    examples: tuple[str, ...]
    """The examples that ``uwsim COMMAND --help`` shows."""
    subcommands: Mapping[str, Command] = field(default_factory=dict)
    """The commands of a group by their second word; empty if it is no group."""

    def load(self) -> Callable[..., object]:
        """Import the module and return its function."""
        module = importlib.import_module(f"..{self.module}", __package__)
        return flatten_options(getattr(module, self.function))
