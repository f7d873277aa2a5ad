"""The code of a GPU: the step of a row compiles to PTX, the assembly language of NVIDIA's GPUs.

The LLVM of numba's llvmlite has a back end for it, which needs neither a GPU nor NVIDIA's compiler.
The back end gets the code that numba makes of the step. NVIDIA's library has the functions that the
PTX calls. The driver itself needs numba-cuda.
"""

from __future__ import annotations

import importlib.util
import re
from types import SimpleNamespace
from typing import Any

import llvmlite.binding as llvm
import numba
import pytest
from numba import types

from tests.envs.batch.batch_rows import bluerov2, station_rows
from uwsim.envs.batch.gpu import GpuRows, kernel_function
from uwsim.envs.batch.loops import step_row
from uwsim.errors import BadSetting
from uwsim.physics.hydrodynamics.kernel import free_step

HAS_COMPILER = importlib.util.find_spec("numba_cuda") is not None
ARCHITECTURE = (9, 0)
TRIPLE = "nvptx64-nvidia-cuda"
LIBRARY = {"sin", "cos", "sqrt", "expm1", "atan2", "exp", "log", "pow"}
"""The functions of C that NVIDIA's library has, as ``__nv_sin`` and so on."""


def compile_to_ptx(function: Any, arguments: tuple[object, ...]) -> str:
    """Return the PTX of a compiled function of the project for some arguments.

    The functions of NumPy's numbers are the only change: the back end has no sine of its own.
    """
    compiled_function = numba.njit(
        nogil=True, error_model="numpy", _nrt=False, no_cpython_wrapper=True, no_cfunc_wrapper=True
    )(function.py_func)
    compiled_function.compile(tuple(map(numba.typeof, arguments)))
    (code,) = compiled_function.inspect_llvm().values()
    code = re.sub(r"(?m)^target datalayout.*\n", "", code)
    code = re.sub(r"(?m)^target triple.*$", f'target triple = "{TRIPLE}"', code)
    code = re.sub(r"@llvm\.(sin|cos|exp|log|pow)\.f64", r"@\1", code)
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(code)
    module.verify()
    version = "sm_{}{}".format(*ARCHITECTURE)
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(cpu=version)
    return str(machine.emit_assembly(module))


def check_ptx(code: str, name: str) -> None:
    """Check that PTX defines a function, and calls nothing but functions of C."""
    assert ".target sm_90" in code
    assert re.search(rf"(?m)^\.visible \.func .*{len(name)}{name}", code)
    calls = set(re.findall(r"(?m)^\.extern \.func .* (\w+)$", code))
    assert "sqrt" in calls
    assert calls <= LIBRARY
    assert not re.search(r"\b(NRT|Py)_?[A-Z]\w*|malloc|numba_", code)


@pytest.mark.slow
def test_the_step_of_a_vehicle_compiles_to_ptx() -> None:
    rows = station_rows(2)
    arrays = rows.arrays
    arguments = (
        bluerov2(), arrays.rotors[0], arrays.states[0], rows.numbers.mixing[0], arrays.water[0],
        0.01, arrays.rewards,
    )  # fmt: skip

    check_ptx(compile_to_ptx(free_step.step_one, arguments), "step_one")


@pytest.mark.slow
def test_the_step_with_observations_and_rewards_compiles_to_ptx() -> None:
    rows = station_rows(2)
    scratch = rows.arrays.rewards
    arguments = (
        0, bluerov2(), rows.numbers, rows.arrays, rows.numbers.mixing[0], scratch, scratch, scratch,
        None,
    )  # fmt: skip

    check_ptx(compile_to_ptx(step_row, arguments), "step_row")


@pytest.fixture
def cuda(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The module of numba-cuda with a device that only has an architecture."""
    if not HAS_COMPILER:
        pytest.skip("numba-cuda with NVIDIA's compiler (260 MB) is not installed: uwsim[gpu]")
    from numba import cuda
    from numba.cuda import dispatcher

    device = SimpleNamespace(compute_capability=ARCHITECTURE, id=0)
    monkeypatch.setattr(dispatcher, "get_current_device", lambda: device)
    return cuda


def test_the_kernel_of_the_driver_compiles_to_ptx(cuda: Any) -> None:
    rows = station_rows(2)
    arguments = (rows.vehicles, False, rows.numbers, rows.arrays, rows.arrays.states[:, :8].copy())
    signature = types.void(*map(numba.typeof, arguments))

    code, _ = cuda.compile(
        kernel_function(cuda), signature, cc=ARCHITECTURE, device=False, abi="numba", output="ptx"
    )

    assert ".entry" in code


def test_rows_on_a_gpu_need_numba_cuda_and_a_gpu() -> None:
    with pytest.raises(BadSetting, match=r"GPU|numba-cuda"):
        GpuRows(station_rows(1))
