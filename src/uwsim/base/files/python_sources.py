"""Search for the source files of a module and of the user's modules that it imports.

Installed packages, Python's library and uwsim are left out: a result states their versions. Files
that a module opens, or imports by other means than an ``import`` statement, are not found.
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
"""The names of the folders of installed packages."""
MAX_MODULES = 2000
"""The greatest number of modules that are read."""


def find_sources(module: str) -> dict[str, Path]:
    """Return the files of an imported module and of the user's modules that it imports.

    The keys are the modules' names as paths, ``package/module.py``, sorted. If the module itself is
    in an installed package, the files of this package are included.
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
        search_path: Sequence[str] | None = getattr(sys.modules.get(parent), "__path__", None)
        if parent and search_path is None:
            return None
        with suppress(Exception):  # a third-party finder may raise any exception
            spec = PathFinder.find_spec(module, search_path)
            file = None if spec is None or not spec.has_location else spec.origin
    path = Path(str(file)) if file else None
    return path if path is not None and path.is_file() else None


def _is_user_file(path: Path) -> bool:
    """Return whether a file belongs to the user: neither to Python nor to an installed package."""
    resolved_path = path.resolve()
    folders = {sysconfig.get_path(name) for name in ("stdlib", "platstdlib")}
    folders.add(site.getusersitepackages())
    return not any(part in INSTALL_FOLDERS for part in resolved_path.parts) and not any(
        resolved_path.is_relative_to(Path(folder).resolve()) for folder in folders if folder
    )


def _imported_names(path: Path, module: str) -> Iterator[str]:
    """Yield the names in all imports of a module's file, which may be names of modules."""
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
