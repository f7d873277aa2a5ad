"""Search for the file of a Python module without running the module's code."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.machinery import PathFinder


def find_module_file(module: str) -> str:
    """Return the file of a module on Python's path; empty if it has none, as namespace packages.

    Raises:
        ModuleNotFoundError: the module does not exist; ``name`` is the missing part.
    """
    parts = module.split(".")
    path: Sequence[str] | None = None
    origin = ""
    for i, part in enumerate(parts):
        name = ".".join(parts[: i + 1])
        loaded_module = sys.modules.get(name)
        if loaded_module is not None or (i == 0 and part in sys.builtin_module_names):
            path = getattr(loaded_module, "__path__", None)
            origin = getattr(loaded_module, "__file__", None) or ""
            continue
        is_in_none = i > 0 and path is None  # the parent is not a package
        spec = None if is_in_none else PathFinder.find_spec(name, path)
        if spec is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        path = spec.submodule_search_locations
        origin = spec.origin or ""
    return origin
