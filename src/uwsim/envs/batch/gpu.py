"""Rows of free vehicles on a GPU of NVIDIA: the functions of `loops`, compiled by numba-cuda.

This driver has not been run on a GPU yet. A test compiles its step to PTX, the assembly language
of these GPUs. The compiler may contract products and sums, and has its own sine and cosine: results
are expected to agree with those of the CPU to about 1e-12 in a step, not to the bit.

`reset` draws on the CPU and copies the rows of the batch to the GPU. `step` runs there; actions and
results are arrays of the GPU, which other libraries read without a copy by
``__cuda_array_interface__``. It needs the extra ``gpu``.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from ...errors import BadSetting
from ...physics.hydrodynamics.kernel.free_step import WORK
from .loops import SCRATCH, step_row
from .rows import Rows
from .variation import vehicle_of_row

THREADS_PER_BLOCK = 64
"""The number of threads of a block."""
MAX_ACTUATORS = 32
"""The greatest number of actuators of a vehicle on a GPU."""


def kernel_function(cuda: Any) -> Callable[..., None]:
    """Return the function of the kernel, before its compilation.

    Args:
        cuda: the module ``numba.cuda`` of numba-cuda.
    """

    def step_on_gpu(vehicles: Any, is_varied: bool, task: Any, rows: Any, actions: Any) -> None:
        row = cuda.grid(1)
        if row < actions.shape[0]:
            work = cuda.local.array(WORK, np.float64)
            scratch = cuda.local.array(SCRATCH, np.float64)
            commands = cuda.local.array(MAX_ACTUATORS, np.float64)
            vehicle = vehicle_of_row(vehicles, row if is_varied else 0)
            n = task.mixing.shape[0]
            step_row(row, vehicle, task, rows, actions[row], commands[:n], work, scratch, None)

    return step_on_gpu


class GpuRows:
    """The rows of a batch on a GPU; see the module about what has been tested.

    Args:
        rows: the batch, which resets on the CPU.

    Raises:
        BadSetting: numba-cuda or a GPU is missing, the vehicle has too many actuators, or the water
            of the rows moves.
    """

    def __init__(self, rows: Rows) -> None:
        try:
            cuda: Any = importlib.import_module("numba.cuda")  # it has no types
        except ImportError as error:
            raise BadSetting("numba-cuda is not installed; install uwsim[gpu].") from error
        if not cuda.is_available():
            raise BadSetting("numba-cuda finds no GPU; step the rows on the CPU with `Rows`.")
        n_actuators = len(rows.numbers.mixing)
        if n_actuators > MAX_ACTUATORS:
            raise BadSetting(f"The vehicle has {n_actuators} actuators; at most {MAX_ACTUATORS}.")
        if rows.flows is not None:
            raise BadSetting("The water of a row moves; expected water that does not on a GPU.")
        self._rows, self._cuda = rows, cuda
        self._kernel: Any = cuda.jit(kernel_function(cuda))
        self._task = self._copy(rows.numbers)
        self.upload()

    def upload(self) -> None:
        """Copy the states of all rows to the GPU, as after a reset."""
        self.vehicles = self._copy(self._rows.vehicles)
        """The numbers of the vehicles on the GPU."""
        self.arrays = self._copy(self._rows.arrays)
        """The arrays of the rows on the GPU (`RowArrays`)."""

    def download(self) -> None:
        """Copy the states and results of all rows to the CPU, as before a reset."""
        for array, copy in zip(self._rows.arrays, self.arrays, strict=True):
            copy.copy_to_host(array)

    def step(self, actions: Any) -> None:
        """Take a step of the environment with all rows.

        Args:
            actions: the actions from -1 to 1 on the GPU, (n, a).
        """
        blocks = -(-self._rows.n // THREADS_PER_BLOCK)
        self._kernel[blocks, THREADS_PER_BLOCK](
            self.vehicles, self._rows.is_varied, self._task, self.arrays, actions
        )

    def _copy(self, numbers: Any) -> Any:
        """Return a named tuple with its arrays on the GPU."""
        to_device = self._cuda.to_device
        return type(numbers)(
            *(to_device(item) if isinstance(item, np.ndarray) else item for item in numbers)
        )
