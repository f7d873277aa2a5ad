"""Creation of Python modules from source code in memory."""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import importlib.util
import sys
from types import CodeType, ModuleType


def source_module(name: str, path: str, source: bytes) -> ModuleType:
    """Return the module ``name``; create it from source code unless it is loaded already.

    Args:
        name: the name in ``sys.modules``.
        path: the path of the source file that error messages show.
        source: the source code.

    Raises:
        BaseException: any exception of the code; the module is then not in ``sys.modules``.
    """
    if name in sys.modules:
        return sys.modules[name]
    loader = _Loader(path, source)
    spec = importlib.machinery.ModuleSpec(name, loader, origin=path)
    module = importlib.util.module_from_spec(spec)
    module.__file__ = path
    sys.modules[name] = module
    try:
        loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


class _Loader(importlib.abc.InspectLoader):
    """A loader of a module from its source code."""

    def __init__(self, path: str, source: bytes) -> None:
        self._path, self._source = path, source

    def get_source(self, fullname: str) -> str:
        return importlib.util.decode_source(self._source)

    def get_code(self, fullname: str) -> CodeType:
        return self.source_to_code(self._source, self._path)
