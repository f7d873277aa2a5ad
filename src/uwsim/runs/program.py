"""The class of a user's program: a name, ``module:Class``, ``FILE.py`` or ``FILE.py:Class``."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import BadSetting, did_you_mean

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin
    from ..bus import Algorithm

METHODS = "method start(node), or __call__(observation) of a policy"
"""The methods that make a class a program."""


def load_program(name: str, table: Mapping[str, type[Algorithm]]) -> type[Algorithm]:
    """Find the class of a program; a module may be in the current directory.

    Args:
        name: the program, as the user names it.
        table: the classes that can be selected by a name alone.

    Raises:
        BadSetting: no program has that name.
        PluginError: a file cannot be read or imported.
    """
    from ..algorithms import load_algorithm
    from ..benchmark.plugin import read_plugin

    file, _, class_name = name.partition(":")
    if file.endswith(".py"):
        return class_of_file(read_plugin(Path(file)), class_name)
    if ":" in name and "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    return load_algorithm(name, table)


def class_of_file(plugin: Plugin, class_name: str) -> type[Algorithm]:
    """Import a file and return its class; the name may be empty if only one class has ``start``.

    Raises:
        BadSetting: the file has no such class.
        PluginError: the file cannot be imported.
    """
    from ..algorithms.policy import is_policy

    path, names = plugin.path, vars(plugin.module())
    classes = {
        name: value
        for name, value in names.items()
        if isinstance(value, type)
        and value.__module__ == plugin.module_name
        and (callable(getattr(value, "start", None)) or is_policy(value))
    }
    if class_name in classes:
        return classes[class_name]
    if class_name:
        value = names.get(class_name)
        fault = f"has no class {class_name!r}"
        if isinstance(value, type):
            fault = f"the class {class_name!r} has no {METHODS}"
        elif value is not None:
            fault = f"{class_name!r} is no class; expected a class with a {METHODS}"
        choices = f" Known: {', '.join(classes)}." if classes else ""
        raise BadSetting(f"{path}: {fault}.{did_you_mean(class_name, classes) or choices}")
    if not classes:
        raise BadSetting(f"{path}: has no class with a {METHODS}.")
    if len(classes) > 1:
        raise BadSetting(
            f"{path}: has {len(classes)} classes with a {METHODS}: {', '.join(classes)}; "
            f"expected one of them by name, as {path}:{next(iter(classes))}."
        )
    return next(iter(classes.values()))
