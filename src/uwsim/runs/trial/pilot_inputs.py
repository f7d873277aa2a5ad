"""A pilot's inputs: published at the end of a step, stored, and published again in a later run.

.. code-block:: text

    {"uwsim_inputs": 1, "axes": ["surge", ...]}
    {"step": 1503, "values": [0.5, 0.0, ...]}

The file is beside the journal of the trial. A changed input is published at once, but not earlier
than 1 / `RATE` after the previous one. An input is published at the end of its step and delivered
at the end of the next, so a run with stored inputs repeats the run in which they were recorded.
Inputs of an earlier version may lack axes that were added later.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...algorithms.pilot import AXES, TOPIC
from ...base.files.json_text import read_json
from ...errors import ResultError, RunFailed
from ...messages import Float64MultiArray, MultiArrayLayout
from ...simulation import Simulation
from ..planning.plan import Plan, Trial
from .trial_observer import TrialObserver

VERSION = 1
RATE = 30.0
"""The greatest rate of inputs in simulation time [Hz]."""


@dataclass(frozen=True, kw_only=True)
class StoredInputs:
    """The inputs of a pilot in an earlier run."""

    axes: tuple[str, ...]
    """The names of the axes: `AXES`, or its first entries if an earlier version stored the
    inputs."""
    values_by_step: Mapping[int, tuple[float, ...]]
    """The values of the axes, -1..1, by step."""


class PilotInputs:
    """The publisher of a pilot's inputs while a simulation runs.

    Args:
        simulation: the simulation.
        read_pilot: the function that returns the pilot's inputs, -1..1 for each axis; None before
            the first input.
        stored_inputs: the inputs of an earlier run, which are used instead of a pilot; None: the
            inputs of the pilot.
    """

    def __init__(
        self,
        simulation: Simulation,
        read_pilot: Callable[[], Sequence[float] | None],
        stored_inputs: StoredInputs | None = None,
    ) -> None:
        self._simulation, self._read_pilot = simulation, read_pilot
        self._stored_inputs = stored_inputs
        self._axes = AXES if stored_inputs is None else stored_inputs.axes
        self._min_steps = max(1, round(1.0 / (RATE * simulation.timestep)))
        self._publish = simulation.bus.publisher(TOPIC, Float64MultiArray)
        self._inputs: list[tuple[int, tuple[float, ...]]] = []
        simulation.watch(self._update)

    def data(self) -> bytes:
        """Return the content of the file with the inputs so far."""
        head = {"uwsim_inputs": VERSION, "axes": self._axes}
        lines = [{"step": step, "values": values} for step, values in self._inputs]
        return "".join(json.dumps(line) + "\n" for line in (head, *lines)).encode()

    def _update(self) -> None:
        step = self._simulation.step
        values = self._next_values(step)
        if values is None or (self._stored_inputs is None and not self._is_new(values)):
            return
        self._inputs.append((step, values))
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish(Float64MultiArray(layout=layout, data=np.array(values)))

    def _next_values(self, step: int) -> tuple[float, ...] | None:
        if self._stored_inputs is not None:
            return self._stored_inputs.values_by_step.get(step)
        if self._inputs and step - self._inputs[-1][0] < self._min_steps:
            return None
        values = self._read_pilot()
        return None if values is None else tuple(round(float(value), 4) for value in values)

    def _is_new(self, values: tuple[float, ...]) -> bool:
        return not self._inputs or self._inputs[-1][1] != values


def read_inputs(data: bytes) -> StoredInputs:
    """Read the content of a file of inputs; raise ResultError if it is invalid."""
    try:
        head, *lines = [read_json(line) for line in data.splitlines()]
        axes = tuple(map(str, head["axes"]))
        if head["uwsim_inputs"] != VERSION or axes != AXES[: len(axes)]:
            raise ValueError("made by another version")
        values = {int(entry["step"]): tuple(map(float, entry["values"])) for entry in lines}
        if any(len(v) != len(axes) or not np.isfinite(v).all() for v in values.values()):
            raise ValueError("a line does not have a finite number for each axis")
    except (ValueError, KeyError, TypeError, OverflowError) as error:
        raise ResultError(f"is no file of a pilot's inputs: {error}") from None
    return StoredInputs(axes=axes, values_by_step=values)


def pilot_inputs(
    plan: Plan, trial: Trial, simulation: Simulation, observer: TrialObserver | None
) -> PilotInputs | None:
    """Return the publisher of a pilot's inputs, live or stored; None if no pilot is needed."""
    if not plan.algorithm.facts.is_piloted:
        return None
    data = plan.inputs.get(trial.index)
    if data is not None:
        return PilotInputs(simulation, lambda: None, read_inputs(data))
    if observer is None:
        raise RunFailed(f"{plan.algorithm.name} needs a pilot; use --view.")
    return PilotInputs(simulation, observer.pilot)
