"""Typed decorators for compilation by numba, with a safe cache on disk.

numba's own cache passes any file on the disk to pickle and the linker: a truncated file ends every
command, and a file with a changed byte may give other results. Here the compiled code for each
signature has its own file, which begins with its hash. Code that was compiled from another source
or with other constants (`compiled_source`) is not used.
"""

from __future__ import annotations

import functools
import hashlib
import importlib
import os
import pickle
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any, ParamSpec, TypeVar, cast

# Intel's functions, if they are installed, differ from processor to processor.
os.environ.setdefault("NUMBA_DISABLE_INTEL_SVML", "1")

import numba
import numpy as np
import numpy.typing as npt
from numba.core.caching import FunctionCache, NullCache
from numba.core.ccallback import CFunc
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps

from ..files import disk_cache
from .compiled_source import source_digest
from .compiling import count_compilation

FORMAT = 6
"""The version of the format of the files with compiled code."""
P = ParamSpec("P")
R = TypeVar("R")
Elementwise = Callable[..., npt.NDArray[np.float64]]


def njit(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function with numba: cached on disk, GIL released, no fast-math, one thread.

    A division by zero gives infinity or NaN, as in numpy.
    """
    dispatcher: Any = numba.njit(nogil=True, error_model="numpy")(function)
    if dispatcher is not function:  # it is the function with NUMBA_DISABLE_JIT
        dispatcher._cache = CacheOnUse(function)
    return cast("Callable[P, R]", dispatcher)


def njit_borrowed(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function as `njit` does that neither creates nor returns arrays.

    Its code does not count references to the arrays that it reads and writes, which the caller
    holds. Counting them would take most of the time of a function of a few numbers. The code is
    part of that of its caller: a call would take a quarter of the time of a step of a vehicle.
    """
    options: Any = {"_nrt": False, "forceinline": True}  # which numba's types do not list
    dispatcher: Any = numba.njit(nogil=True, error_model="numpy", **options)(function)
    if dispatcher is not function:  # it is the function with NUMBA_DISABLE_JIT
        dispatcher._cache = CacheOnUse(function)
    return cast("Callable[P, R]", dispatcher)


def elementwise(function: Callable[..., float]) -> Elementwise:
    """Compile a function of numbers as a function of arrays, element by element, as in numpy.

    The compilation needs all tables of numba, so it is delayed until the first call.
    """

    @functools.cache
    def compile_once() -> Any:
        ufunc: Any = numba.vectorize(function)  # type: ignore[no-untyped-call]
        ufunc._dispatcher.cache = CacheOnUse(function, is_typed=True)
        return ufunc

    @functools.wraps(function)
    def apply(*arrays: npt.ArrayLike) -> npt.NDArray[np.float64]:
        return cast("npt.NDArray[np.float64]", compile_once()(*arrays))

    return apply


def link_library(path: str) -> None:
    """Load a shared library, so that compiled code can call its functions by name."""
    binding: Any = importlib.import_module("llvmlite.binding")  # of numba; it has no types
    binding.load_library_permanently(path)


def compile_c_function(function: Callable[..., object], signature: Any) -> Any:
    """Compile a function of a module as a C function, with ``address``; cached on disk."""
    arguments = (signature.args, signature.return_type)
    compiled_function: Any = CFunc(function, arguments, {}, {"error_model": "numpy"})
    compiled_function._cache = CacheOnUse(function)
    compiled_function.compile()
    return compiled_function


class HashedCache(FunctionCache):
    """The cache of numba for a function, with files that are checked by their hash."""

    def __init__(self, function: FunctionType) -> None:
        super().__init__(function)  # type: ignore[no-untyped-call]
        locator = self._impl.locator
        self._cache_file: Any = CompiledFiles(
            folder=Path(locator.get_cache_path()),
            base=self._impl.filename_base,
            stamp=lambda: source_digest(function),
        )

    def load_overload(self, sig: object, target_context: Any) -> object | None:
        """Load compiled code; return None if there is none.

        numba's method would first fill all of its tables, which takes 0.2 s and 20 MB. Compiled
        code needs only the functions that count references.
        """
        rtsys.initialize(target_context)
        return cast("object | None", super()._load_overload(sig, target_context))  # type: ignore[no-untyped-call]

    def save_overload(self, sig: object, data: object) -> None:
        """Store compiled code if possible: a full disk or a deleted folder is no error."""
        try:
            super().save_overload(sig, data)  # type: ignore[no-untyped-call]
        except OSError:
            self.disable()  # type: ignore[no-untyped-call]


class CompiledFiles:
    """The files with the compiled code of one function, for each signature and type of processor.

    Args:
        folder: the folder of the files.
        base: the beginning of the files' names.
        stamp: a function that returns the digest of the source; it is called only after all
            functions that the source refers to are defined.
    """

    def __init__(self, *, folder: Path, base: str, stamp: Callable[[], str]) -> None:
        self.folder, self._base = folder, base
        self._find_stamp = functools.cache(stamp)

    def load(self, key: object) -> object | None:
        """Return the code compiled from this source for this key; None if there is none."""
        code = self._read(key)
        if code is None:
            count_compilation()
        return code

    def _read(self, key: object) -> object | None:
        data = disk_cache.read(self._file(key))
        if data is None:
            return None
        try:
            stamp, stored_key, code = pickle.loads(data)
        except (ImportError, AttributeError):  # it refers to a name that does not exist any more
            return None
        return code if (stamp, stored_key) == (self._find_stamp(), key) else None

    def save(self, key: object, code: object) -> None:
        """Store compiled code in place of that of an older source."""
        disk_cache.write(self._file(key), dumps((self._find_stamp(), key, code)))  # type: ignore[no-untyped-call]

    def flush(self) -> None:
        """Remove all files."""
        for file in self.folder.glob(f"{self._base}.*.uwsim"):
            file.unlink(missing_ok=True)

    def _file(self, key: object) -> Path:
        key_digest = hashlib.sha256(repr((FORMAT, numba.__version__, key)).encode()).hexdigest()[
            :16
        ]
        return self.folder / f"{self._base}.{key_digest}.uwsim"


class NoCache(NullCache):
    """The cache of a function whose compiled code is not stored."""

    def load_overload(self, sig: object, target_context: object) -> None:
        """Return None: the function is compiled."""
        count_compilation()


class CacheOnUse(NullCache):
    """The cache of a function, created at its first call, because numba tests its folder.

    Args:
        function: the function.
        is_typed: True if other code is compiled that calls the loaded code, which needs numba's
            tables.
    """

    def __init__(self, function: Callable[..., object], *, is_typed: bool = False) -> None:
        self._function, self._is_typed = cast("FunctionType", function), is_typed

    @functools.cached_property
    def _cache(self) -> HashedCache | NoCache:
        try:
            return HashedCache(self._function)
        except RuntimeError:  # no folder is writable
            return NoCache()

    def load_overload(self, sig: object, target_context: Any) -> object | None:
        """Load compiled code; return None if there is none."""
        code = self._cache.load_overload(sig, target_context)
        if code is None or self._is_typed:
            target_context.refresh()
        return code

    def save_overload(self, sig: object, data: object) -> None:
        """Store compiled code if possible."""
        self._cache.save_overload(sig, data)
