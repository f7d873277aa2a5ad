"""The code of a GPU: the step of a row compiles to PTX, which needs numba-cuda but no GPU."""

from __future__ import annotations

import importlib.util
from types import SimpleNamespace
from typing import Any

import numba
import pytest
from numba import types

from tests.envs.batch.batch_rows import bluerov2, station_rows
from uwsim.envs.batch.gpu import GpuRows, kernel_function
from uwsim.errors import BadSetting
from uwsim.physics.hydrodynamics.kernel import free_step

HAS_COMPILER = importlib.util.find_spec("numba_cuda") is not None
ARCHITECTURE = (9, 0)


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


def type_of(value: Any) -> Any:
    return numba.typeof(value)


def test_the_step_of_a_vehicle_compiles_to_ptx(cuda: Any) -> None:
    rows, arrays = station_rows(2), station_rows(2).arrays
    arguments = (
        bluerov2(), arrays.rotors[0], arrays.states[0], rows.numbers.mixing[0], arrays.water[0],
        0.01, arrays.rewards,
    )  # fmt: skip
    signature = types.void(*map(type_of, arguments))

    code, _ = cuda.compile(
        free_step.step_one.py_func,  # type: ignore[attr-defined]
        signature, cc=ARCHITECTURE, device=True, abi="numba", output="ptx",
    )  # fmt: skip

    assert ".target sm_90" in code
    assert ".f64" in code


def test_the_step_with_observations_and_rewards_compiles_to_ptx(cuda: Any) -> None:
    rows = station_rows(2)
    arguments = (rows.vehicles, False, rows.numbers, rows.arrays, rows.arrays.states[:, :8].copy())
    signature = types.void(*map(type_of, arguments))

    code, _ = cuda.compile(
        kernel_function(cuda), signature, cc=ARCHITECTURE, device=False, abi="numba", output="ptx"
    )

    assert ".entry" in code


def test_rows_on_a_gpu_need_numba_cuda_and_a_gpu() -> None:
    with pytest.raises(BadSetting, match=r"GPU|numba-cuda"):
        GpuRows(station_rows(1))
