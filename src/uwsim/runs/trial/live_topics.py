"""The topics BenchmarkInfo and BenchmarkResults, published while a benchmark runs.

As the original's, but in simulation time, so that an observer may subscribe and every run says the
same. Nothing is computed for a topic without subscribers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...base.expression import Expression
from ...benchmark.spec import FunctionSpec
from ...benchmark.updaters import Level, steps
from ...messages import Float32MultiArray, String, floats
from ...simulation import Simulation
from ..uwsim_files import details
from .triggered_measure import TriggeredMeasure, finite

INFO = "BenchmarkInfo"
RESULTS = "BenchmarkResults"
RATE = 10.0
"""Of the messages on both [Hz]."""


class LiveTopics:
    """``BenchmarkInfo`` (std_msgs/String) and ``BenchmarkResults`` (std_msgs/Float32MultiArray).

    Both carry a message every 0.1 s. Info is empty, except once after the scene was changed:
    ``Updated scene 1`` when the outermost updater stepped, ``Updated scene n`` when the n-th from
    outside was the outermost that did. Results, if the function has ``publishResult``, are empty,
    except that every ``publishRate`` seconds (at least) one entry is added: the updaters' values,
    outermost first; the running time without pauses [s]; every measure's details, in the order of
    its original log; the score. An entry in which a measure or the score has no value is left out.
    Several entries that fall into 0.1 s share a message. They contain the error of the estimate,
    and so the truth: no algorithm under test hears them.
    """

    def __init__(
        self, function: FunctionSpec, expression: Expression, simulation: Simulation
    ) -> None:
        self._expression, self._simulation = expression, simulation
        self._say_info = simulation.bus.publisher(INFO, String)
        self._say_results = simulation.bus.publisher(RESULTS, Float32MultiArray)
        simulation.bus.withhold(RESULTS)
        self._publishes_results = function.publish_result
        self._period = max(1, math.ceil(function.publish_rate / simulation.timestep - 1e-9))
        self._due = 0  # step from which on the next entry may be taken
        self._news = ""
        self._entries: list[float] = []
        simulation.world.schedule.every(RATE, self._speak)

    def changed(self, level: Level, *, after: Level | None) -> None:
        """Take note that the scene was brought to ``level``; the first one changes nothing."""
        if after is not None and level != after:
            self._news = f"Updated scene {steps(level, after).index(True) + 1}"

    def update(self, level: Level, time: float, measures: Sequence[TriggeredMeasure]) -> None:
        """Take an entry, if one is due; ``time`` is the benchmark's running time [s]."""
        step = self._simulation.step
        if not self._publishes_results or step < self._due:
            return
        if not self._simulation.bus.has_readers(RESULTS):
            return
        values = {triggered.spec.name: finite(triggered.value)[0] for triggered in measures}
        total = self._expression.evaluate(values)
        if total is None or any(value is None for value in values.values()):
            return
        self._due = step + self._period
        self._entries += [*(value for _, value in level.values), time]
        for triggered in measures:
            self._entries += [math.nan if value is None else value for value in details(triggered)]
        self._entries.append(total)

    def _speak(self) -> None:
        if self._simulation.bus.has_readers(INFO):
            self._say_info(String(data=self._news))
        self._news = ""
        if self._publishes_results and self._simulation.bus.has_readers(RESULTS):
            self._say_results(floats(self._entries))
        self._entries = []
