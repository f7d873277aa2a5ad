"""Programs of the user's own: a name, ``module:Class``, ``FILE.py`` or ``FILE.py:Class``."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import BadSetting, did_you_mean

if TYPE_CHECKING:
    from ..bus import Algorithm


def load_program(name: str, table: Mapping[str, type[Algorithm]]) -> type[Algorithm]:
    """Find the class of a program; a module may lie in the current directory.

    Raises:
        BadSetting: there is none of that name.
        PluginError: a file cannot be read or imported.
    """
    from ..algorithms import load_algorithm

    file, _, class_name = name.partition(":")
    if file.endswith(".py"):
        return _in_file(Path(file), class_name)
    if ":" in name and "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    return load_algorithm(name, table)


def _in_file(path: Path, class_name: str) -> type[Algorithm]:
    """Return the class of a file, which need not be named where there is one with ``start``."""
    from ..benchmark.plugin import read_plugin

    plugin = read_plugin(path)
    own = {
        name: value
        for name, value in vars(plugin.module()).items()
        if isinstance(value, type)
        and value.__module__ == plugin.module_name
        and callable(getattr(value, "start", None))
    }
    if class_name in own:
        return own[class_name]
    if class_name:
        raise BadSetting(
            f"{path}: has no class {class_name!r} with a method start(node)."
            f"{did_you_mean(class_name, own)}"
        )
    if not own:
        raise BadSetting(f"{path}: has no class with a method start(node).")
    if len(own) > 1:
        raise BadSetting(
            f"{path}: has {len(own)} classes with a method start(node): {', '.join(own)}; "
            f"expected one of them by name, as {path}:{next(iter(own))}."
        )
    return next(iter(own.values()))
