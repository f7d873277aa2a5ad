"""The source files of a module: its own, and those of the user's modules that it imports.

Installed packages, Python's library and this package do not count: a result has their versions.
Files that a module opens or imports by other means than an ``import`` are not found.
"""

from __future__ import annotations

import ast
import importlib.util
import site
import sys
import sysconfig
from collections.abc import Iterator, Sequence
from contextlib import suppress
from importlib.machinery import PathFinder
from pathlib import Path

OWN_PACKAGE = "uwsim"
INSTALL_FOLDERS = ("site-packages", "dist-packages")
MAX_MODULES = 2000
"""The greatest number of modules that are read."""


def find_sources(module: str) -> dict[str, Path]:
    """Return the files of an imported module and of its imports by name, sorted by name.

    A name is that of the module as a path, ``package/module.py``. Of installed packages only the
    package of the module counts.
    """
    top = module.partition(".")[0]
    sources: dict[str, Path] = {}
    names_left, names_seen = [module], {""}
    while names_left and len(names_seen) < MAX_MODULES:
        name = names_left.pop()
        if name in names_seen:
            continue
        names_seen.add(name)
        names_left.append(name.rpartition(".")[0])
        path = None if name.partition(".")[0] == OWN_PACKAGE else _file_of(name)
        if path is None or not (name.partition(".")[0] == top or _is_user_file(path)):
            continue
        stem = f"{name.replace('.', '/')}/__init__" if path.stem == "__init__" else name
        sources[stem.replace(".", "/") + path.suffix] = path
        if path.suffix == ".py":
            names_left += _imported_names(path, name)
    return dict(sorted(sources.items()))


def _file_of(module: str) -> Path | None:
    loaded_module = sys.modules.get(module)
    file = getattr(loaded_module, "__file__", None)
    if loaded_module is None:
        parent, _, _ = module.rpartition(".")
        places: Sequence[str] | None = getattr(sys.modules.get(parent), "__path__", None)
        if parent and places is None:
            return None
        with suppress(Exception):  # a third-party finder may raise any exception
            spec = PathFinder.find_spec(module, places)
            file = None if spec is None or not spec.has_location else spec.origin
    path = Path(str(file)) if file else None
    return path if path is not None and path.is_file() else None


def _is_user_file(path: Path) -> bool:
    """Return whether a file is the user's: neither of Python nor installed."""
    resolved_path = path.resolve()
    places = {sysconfig.get_path(name) for name in ("stdlib", "platstdlib")}
    places.add(site.getusersitepackages())
    return not any(part in INSTALL_FOLDERS for part in resolved_path.parts) and not any(
        resolved_path.is_relative_to(Path(place).resolve()) for place in places if place
    )


def _imported_names(path: Path, module: str) -> Iterator[str]:
    """Yield the names of possible modules in all imports of the file of a module."""
    package = module if path.stem == "__init__" else module.rpartition(".")[0]
    try:
        tree = ast.parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError, RecursionError):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                with suppress(ImportError):
                    base = importlib.util.resolve_name("." * node.level + base, package)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names if alias.name != "*")
