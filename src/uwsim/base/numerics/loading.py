"""Loading of compiled code without the compiler, which is most of what numba keeps in memory.

numba compiles its own functions that count references at every start, reads the bitcode of each
function besides its machine code, and imports the modules of its own functions that a function
calls. The first are kept on the disk here, like any other function; bitcode is read when another
function is compiled that calls it; and modules of numba are imported when anything is compiled.
"""

from __future__ import annotations

import hashlib
import importlib
import io
import pickle
import sys
from pathlib import Path
from typing import Any

import numba
from numba.core import environment
from numba.core.caching import CompileResultCacheImpl
from numba.core.codegen import JITCodeLibrary
from numba.core.runtime import nrtdynmod
from numba.core.runtime.nrt import rtsys

from ..files import disk_cache

_binding: Any = importlib.import_module("llvmlite.binding")  # of numba; it has no types


FORMAT = 2
"""Of the files of compiled code."""
State = tuple[str, str, tuple[Any, ...]]
"""Of a library, as numba writes it: name, kind, machine code and bitcode."""


def with_symbols(state: State) -> State:
    """Add the names of what is defined in a library's bitcode."""
    name, kind, (machine_code, bitcode) = state
    module = _binding.parse_bitcode(bitcode)
    defined = [each.name for each in module.functions if not each.is_declaration]
    defined += [each.name for each in module.global_variables if not each.is_declaration]
    return name, kind, (machine_code, bitcode, defined)


class LoadedLibrary(JITCodeLibrary):
    """Machine code from the disk, with bitcode that is read when it is needed."""

    _bitcode = b""  # of one that another thread compiles meanwhile

    @classmethod
    def _unserialize(cls, codegen: Any, state: State) -> Any:
        name, _, (machine_code, bitcode, defined) = state
        found: Any = cls(codegen, name)
        found._bitcode = bitcode
        found.enable_object_caching()
        found._set_compiled_object(machine_code)
        found._finalize_final_module()
        codegen._engine._defined_symbols.update(defined)
        return found

    def _get_module_for_linking(self) -> Any:
        if self._bitcode and self._shared_module is None:
            self._shared_module = _binding.parse_bitcode(self._bitcode)
        return super()._get_module_for_linking()  # type: ignore[no-untyped-call]


class LibraryCache(CompileResultCacheImpl):
    """How a function's library is written to the disk and read from it."""

    def reduce(self, compiled: Any) -> tuple[Any, ...]:
        """Return what is kept of a compiled function."""
        library, *others = super().reduce(compiled)  # type: ignore[no-untyped-call]
        return with_symbols(library), *others

    def rebuild(self, context: Any, kept: tuple[Any, ...]) -> Any:
        """Make a compiled function of it."""
        codegen = context.codegen()
        codegen._library_class = LoadedLibrary
        try:
            return super().rebuild(context, kept)  # type: ignore[no-untyped-call]
        finally:
            del codegen._library_class  # an attribute of its class again


def unpacked(data: bytes) -> tuple[Any, ...]:
    """Read what was pickled with compiled code, without importing more of numba."""
    found: tuple[Any, ...] = _Unpickler(io.BytesIO(data)).load()
    return found


class _Unpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        if (module, name) == (environment.__name__, environment._rebuild_env.__name__):
            return _environment
        return super().find_class(module, name)


def _environment(module: str, constants: list[Any], name: str) -> Any:
    """Make what a function's machine code finds its constants in; its globals are for numba."""
    known = module in sys.modules or not module.startswith("numba.")
    if known or environment.lookup_environment(name) is not None:  # type: ignore[no-untyped-call]
        return environment._rebuild_env(module, constants, name)  # type: ignore[no-untyped-call]
    made: Any = environment.Environment({"__name__": module})
    made.consts[:] = constants
    made.env_name = name
    environment.Environment._memo[name] = made
    return made


def start_runtime(context: Any, folder: Path) -> None:
    """Initialise the counting of references, with its functions kept in a folder."""
    compile_anew = nrtdynmod.compile_nrt_functions
    nrtdynmod.compile_nrt_functions = lambda context: _functions(context, folder)
    try:
        rtsys.initialize(context)
    finally:
        nrtdynmod.compile_nrt_functions = compile_anew


def _functions(context: Any, folder: Path) -> Any:
    """Read the functions, or compile and keep them."""
    codegen = context.codegen()
    key = (FORMAT, numba.__version__, _binding.llvm_version_info, codegen.magic_tuple())
    called = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
    file = folder / f"numba_runtime.{called}.uwsim"
    kept = disk_cache.read(file)
    if kept is not None:
        return LoadedLibrary._unserialize(codegen, pickle.loads(kept))
    module, library = nrtdynmod.create_nrt_module(context)  # type: ignore[no-untyped-call]
    library.enable_object_caching()
    library.add_ir_module(module)
    library.finalize()
    codegen._engine.finalize_object()
    disk_cache.write(file, pickle.dumps(with_symbols(library.serialize_using_object_code())))
    return library
