"""Inputs of a pilot: published at the ends of steps, kept, and published again.

.. code-block:: text

    {"uwsim_inputs": 1, "axes": ["surge", ...]}
    {"step": 1503, "values": [0.5, 0.0, ...]}

They lie beside the journal of the trial. A change is published at once, or, soon after another
one, when 1 / `RATE` has passed. An input is published at the end of its step and delivered at the
end of the next, so a run with stored inputs is the one in which they were made.
Inputs of an earlier version may lack axes that came later; they stay without them.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...algorithms.pilot import AXES, TOPIC
from ...errors import ResultError, RunFailed
from ...messages import Float64MultiArray, MultiArrayLayout
from ...simulation import Simulation
from ..planning.plan import Plan, Trial
from .onlooker import Onlooker

VERSION = 1
RATE = 30.0
"""Most inputs a second of simulation time [Hz]."""


@dataclass(frozen=True, kw_only=True)
class StoredInputs:
    """Inputs of an earlier run."""

    axes: tuple[str, ...]
    """The first of `AXES`; all of them but in runs of earlier versions."""
    by_step: Mapping[int, tuple[float, ...]]
    """Step -> a value of each axis, -1..1."""


class PilotInputs:
    """Publishes inputs while a simulation runs.

    Args:
        simulation: the one.
        live: returns what the pilot does now, a number of each axis; None: nobody pilots.
        stored: inputs of an earlier run instead.
    """

    def __init__(
        self,
        simulation: Simulation,
        live: Callable[[], Sequence[float] | None],
        stored: StoredInputs | None = None,
    ) -> None:
        self._simulation, self._live, self._stored = simulation, live, stored
        self._axes = AXES if stored is None else stored.axes
        self._every = max(1, round(1.0 / (RATE * simulation.timestep)))
        self._publish = simulation.bus.publisher(TOPIC, Float64MultiArray)
        self._kept: list[tuple[int, tuple[float, ...]]] = []
        simulation.watch(self._look)

    def data(self) -> bytes:
        """Return the file of the inputs so far."""
        head = {"uwsim_inputs": VERSION, "axes": self._axes}
        lines = [{"step": step, "values": values} for step, values in self._kept]
        return "".join(json.dumps(line) + "\n" for line in (head, *lines)).encode()

    def _look(self) -> None:
        step = self._simulation.step
        values = self._now(step)
        if values is None or (self._stored is None and not self._is_news(values)):
            return
        self._kept.append((step, values))
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish(Float64MultiArray(layout=layout, data=np.array(values)))

    def _now(self, step: int) -> tuple[float, ...] | None:
        if self._stored is not None:
            return self._stored.by_step.get(step)
        if self._kept and step - self._kept[-1][0] < self._every:
            return None
        values = self._live()
        return None if values is None else tuple(round(float(value), 4) for value in values)

    def _is_news(self, values: tuple[float, ...]) -> bool:
        return not self._kept or self._kept[-1][1] != values


def read_inputs(data: bytes) -> StoredInputs:
    """Read a file of inputs; raises ResultError where it is none."""
    try:
        head, *lines = [json.loads(line) for line in data.splitlines()]
        axes = tuple(map(str, head["axes"]))
        if head["uwsim_inputs"] != VERSION or axes != AXES[: len(axes)]:
            raise ValueError("made by another version")
        found = {int(each["step"]): tuple(map(float, each["values"])) for each in lines}
        if any(len(v) != len(axes) or not np.isfinite(v).all() for v in found.values()):
            raise ValueError("a line has not a number for each axis")
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        raise ResultError(f"is no file of a pilot's inputs: {error}") from None
    return StoredInputs(axes=axes, by_step=found)


def pilot_inputs(
    plan: Plan, trial: Trial, simulation: Simulation, onlooker: Onlooker | None
) -> PilotInputs | None:
    """A pilot's inputs, live or stored; None where the algorithm takes none."""
    if not getattr(plan.algorithm.cls, "IS_PILOTED", False):
        return None
    stored = plan.inputs.get(trial.index)
    if stored is not None:
        return PilotInputs(simulation, lambda: None, read_inputs(stored))
    if onlooker is None:
        raise RunFailed(f"{plan.algorithm.name} needs somebody who pilots: --view.")
    return PilotInputs(simulation, onlooker.pilot)
