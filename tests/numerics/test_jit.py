"""Compiled functions in numba's cache: they heal, and what is read back was compiled from this."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numba
import numpy as np
import pytest

from uwsim.base.numerics import compiling
from uwsim.base.numerics.jit import CompiledFiles

SOURCE = """
from uwsim.base.numerics import jit

@jit.njit
def twice(x: float) -> float:
    return 2.0 * x

@jit.elementwise
def half(x: float) -> float:
    return 0.5 * x
"""


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    numba.config.reload_config()
    (tmp_path / "doubles.py").write_text(SOURCE)
    return tmp_path / "cache"


def fresh(cache: Path) -> ModuleType:
    """Load the module as a new process would."""
    spec = importlib.util.spec_from_file_location("doubles", cache.parent / "doubles.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["doubles"] = module
    spec.loader.exec_module(module)
    return module


def files(cache: Path) -> list[Path]:
    return sorted(path for path in cache.rglob("*") if path.is_file())


def started(cache: Path, code: str) -> list[str]:
    """Run code in a process of its own; the words that it prints."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(cache.parent), *sys.path])}
    run = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    return run.stdout.split()


def test_what_was_compiled_is_read_back(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    module = fresh(cache)
    assert (module.twice(1.5), module.half(np.ones(2)).tolist()) == (3.0, [0.5, 0.5])
    assert len(files(cache)) == 2
    module = fresh(cache)
    monkeypatch.setattr(
        "numba.core.compiler.compile_extra", lambda *_, **__: pytest.fail("compiled")
    )
    assert (module.twice(1.5), module.half(np.ones(2)).tolist()) == (3.0, [0.5, 0.5])
    assert sum(module.twice.stats.cache_hits.values()) == 1


DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _: b"",
    "cut off": lambda data: data[: len(data) // 2],
    "one byte": lambda data: data[:-900] + bytes([data[-900] ^ 1]) + data[-899:],
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_file_is_compiled_anew_and_that_is_reported_once(
    cache: Path, damage: Callable[[bytes], bytes], caplog: pytest.LogCaptureFixture
) -> None:
    assert fresh(cache).twice(1.5) == 3.0
    for file in files(cache):
        file.write_bytes(damage(file.read_bytes()))
    assert fresh(cache).twice(1.5) == 3.0
    module = fresh(cache)
    assert module.twice(1.5) == 3.0
    assert sum(module.twice.stats.cache_hits.values()) == 1
    assert [" is damaged; its content" in entry.getMessage() for entry in caplog.records] == [True]


def test_what_calls_a_module_that_was_moved_is_compiled_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    moved = ModuleType("moved")
    moved.Compiled = type("Compiled", (), {"__module__": "moved"})  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "moved", moved)
    signatures = CompiledFiles(folder=tmp_path, base="twice", stamp=lambda: "the same")
    signatures.save("key", moved.Compiled())
    assert signatures.load("key") is not None
    monkeypatch.delitem(sys.modules, "moved")
    assert signatures.load("key") is None


def test_a_changed_source_is_compiled_anew(cache: Path) -> None:
    assert fresh(cache).twice(1.5) == 3.0
    source = cache.parent / "doubles.py"
    source.write_text(SOURCE.replace("2.0", "7.0"))
    os.utime(source, ns=(0, 0))  # Python's own cache goes by time and size, and a second is long
    assert fresh(cache).twice(1.0) == 7.0


@pytest.mark.parametrize(
    ("old", "new"), [("FACTOR = 3.0", "FACTOR = 7.0"), ("1.0 * x", "7.0 / 3.0 * x")]
)
def test_a_changed_constant_or_function_of_another_module_is_compiled_anew(
    cache: Path, monkeypatch: pytest.MonkeyPatch, old: str, new: str
) -> None:
    other = (
        "from uwsim.base.numerics import jit\nFACTOR = 3.0\n\n"
        "@jit.njit\ndef same(x):\n    return 1.0 * x\n"
    )
    user = """
from uwsim.base.numerics import jit
import factors
from factors import FACTOR, same

@jit.njit
def times(x):
    return later(x)

@jit.njit
def later(x):
    return (0.5 * FACTOR + 0.5 * factors.FACTOR) * same(x)
"""
    (cache.parent / "doubles.py").write_text(user)
    monkeypatch.syspath_prepend(cache.parent)
    for text, product in ((other, 3.0), (other.replace(old, new), 7.0)):
        (cache.parent / "factors.py").write_text(text)
        os.utime(cache.parent / "factors.py", ns=(0, len(text)))
        sys.modules.pop("factors", None)
        shutil.rmtree(cache.parent / "__pycache__", ignore_errors=True)
        assert fresh(cache).times(1.0) == pytest.approx(product, abs=1e-12)


@pytest.mark.parametrize("is_gone_after", [0, 1])
def test_without_a_place_to_keep(cache: Path, is_gone_after: int) -> None:
    module = fresh(cache)
    for number in (1.5, 3)[:is_gone_after]:
        assert module.twice(number) == 2.0 * number
    shutil.rmtree(cache, ignore_errors=True)
    cache.touch()
    assert module.twice(3) == 6.0
    assert cache.is_file()


def test_a_folder_to_keep_in_is_looked_for_at_the_first_call(cache: Path) -> None:
    module = fresh(cache)
    assert not cache.exists()
    assert module.twice(1.5) == 3.0
    assert len(files(cache)) == 1


def test_what_is_read_back_needs_none_of_the_tables_for_compiling(cache: Path) -> None:
    assert fresh(cache).twice(1.5) == 3.0
    code = (
        "import doubles, sys; print(doubles.twice(1.5), 'numba.cpython.printimpl' in sys.modules)"
    )
    assert started(cache, code) == ["3.0", "False"]


SUMS = """
import numpy as np
from uwsim.base.numerics import jit

@jit.njit
def running(x):
    found = np.empty(len(x))
    total = 0.0
    for i in range(len(x)):
        total += x[i]
        found[i] = total
    return found

@jit.njit
def last(x):
    return running(x)[-1]
"""
READ_BACK = """
def fail(*_):
    raise AssertionError("a function is compiled")

import numpy as np
import doubles
from numba.core import dispatcher
dispatcher._FunctionCompiler.compile = fail
print(*doubles.running(np.ones(3)))
"""


@pytest.mark.slow
def test_what_is_read_back_needs_no_compiler(cache: Path) -> None:
    (cache.parent / "doubles.py").write_text(SUMS)
    with pytest.raises(subprocess.CalledProcessError):
        started(cache, READ_BACK)
    assert started(cache, "import numpy, doubles; doubles.running(numpy.ones(3))") == []
    assert started(cache, READ_BACK) == ["1.0", "2.0", "3.0"]


@pytest.mark.slow
def test_errors_of_numbas_own_functions_are_those_of_numpy_in_what_is_read_back(
    cache: Path,
) -> None:
    (cache.parent / "doubles.py").write_text(SUMS.replace("np.empty(len(x))", "np.empty(x[0])"))
    code = """
import numpy, sys, doubles
try:
    doubles.running(numpy.array([-1]))
except ValueError as error:
    print(error, 'numba.np.arraymath' in sys.modules)
"""
    assert started(cache, code) == ["negative", "dimensions", "not", "allowed", "True"]
    assert started(cache, code) == ["negative", "dimensions", "not", "allowed", "False"]


@pytest.mark.slow
def test_a_function_that_is_compiled_alone_calls_one_that_was_read_back(cache: Path) -> None:
    (cache.parent / "doubles.py").write_text(SUMS)
    code = "import numpy, doubles; print(doubles.running(numpy.ones(3))[2])"
    assert started(cache, code) == ["3.0"]
    both = "import numpy, doubles; x = numpy.ones(3); print(doubles.running(x)[2], doubles.last(x))"
    assert started(cache, both) == ["3.0", "3.0"]


def test_read_back_code_is_called_by_what_is_compiled_later(cache: Path) -> None:
    assert fresh(cache).twice(1.5) == 3.0
    module = fresh(cache)
    assert module.twice(1.5) == 3.0
    twice = module.twice
    assert numba.njit(lambda x: twice(x) + 1.0)(1.5) == 4.0


def test_a_c_function_is_read_back(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import ctypes

    source = """
from numba import types
from uwsim.base.numerics import jit

def thrice(x):
    return 3.0 * x

COMPILED = jit.compile_c_function(thrice, types.float64(types.float64))
"""
    (cache.parent / "doubles.py").write_text(source)
    call = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)
    assert call(fresh(cache).COMPILED.address)(2.0) == 6.0
    assert len(files(cache)) == 1
    monkeypatch.setattr(
        "numba.core.ccallback._CFuncCompiler.compile", lambda *_, **__: pytest.fail("compiled")
    )
    assert call(fresh(cache).COMPILED.address)(2.0) == 6.0


def test_one_is_told_when_many_functions_are_compiled_and_not_of_those_read(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compiling, "_n_compiled", 0)
    told: list[int] = []
    compiling.on_slow_start(lambda: told.append(compiling._n_compiled))
    module = fresh(cache)
    module.twice(1.5), module.half(np.ones(2))
    assert told == []
    again = fresh(cache)
    again.twice(1.5), again.half(np.ones(2))
    assert compiling._n_compiled == 2
    module.twice(1)  # of a whole number
    assert told == [compiling.SLOW_START_COUNT]
    module.twice(np.float32(1.0))
    assert told == [compiling.SLOW_START_COUNT]
