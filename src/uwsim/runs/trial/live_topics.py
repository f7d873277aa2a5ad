"""The topics BenchmarkInfo and BenchmarkResults, published while a benchmark runs.

Both are topics of the original UWSim. Here their rates are in simulation time, so that every run
publishes the same messages. Nothing is computed for a topic without subscribers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...base.expression import Expression
from ...benchmark.spec import FunctionSpec
from ...benchmark.updaters import Level, find_steps
from ...messages import Float32MultiArray, String, floats
from ...simulation import Simulation
from ..uwsim_files import details
from .triggered_measure import TriggeredMeasure, finite_value

INFO = "BenchmarkInfo"
RESULTS = "BenchmarkResults"
RATE = 10.0
"""The rate of the messages on both topics, in simulation time [Hz]."""


class LiveTopics:
    """``BenchmarkInfo`` (std_msgs/String) and ``BenchmarkResults`` (std_msgs/Float32MultiArray).

    A message is published on both topics every 0.1 s. A message of BenchmarkInfo is empty, except
    once after the scene was changed: it is ``Updated scene n`` if updater n, counted from the
    outermost as 1, is the outermost updater that stepped.

    BenchmarkResults is published if the function has ``publishResult``. Its message holds the
    entries of the last 0.1 s, and is mostly empty, as an entry is added every ``publishRate``
    seconds at most. An entry has the updaters' values, outermost first; the running time without
    pauses [s]; every measure's details, in the order of its log in the original UWSim; the score.
    An entry is left out if a measure or the score has no value. No algorithm under test
    receives this topic, because the errors reveal the ground truth.
    """

    def __init__(
        self, function: FunctionSpec, expression: Expression, simulation: Simulation
    ) -> None:
        self._expression, self._simulation = expression, simulation
        self._publish_info = simulation.bus.publisher(INFO, String)
        self._publish_results = simulation.bus.publisher(RESULTS, Float32MultiArray)
        simulation.bus.hide_topic(RESULTS)
        self._publishes_results = function.publish_result
        self._period = max(1, math.ceil(function.publish_rate / simulation.timestep - 1e-9))
        self._due = 0  # the first step at which the next entry may be added
        self._scene_change = ""
        self._entries: list[float] = []
        simulation.world.schedule.create_timer(RATE, self._publish)

    def record_change(self, level: Level, *, last_level: Level | None) -> None:
        """Record the change of the scene to ``level``; the first level is no change."""
        if last_level is not None and level != last_level:
            self._scene_change = f"Updated scene {find_steps(level, last_level).index(True) + 1}"

    def update(self, level: Level, time: float, measures: Sequence[TriggeredMeasure]) -> None:
        """Add an entry, if one is due; ``time`` is the benchmark's running time [s]."""
        step = self._simulation.step
        if not self._publishes_results or step < self._due:
            return
        if not self._simulation.bus.has_subscribers(RESULTS):
            return
        values = {measure.spec.name: finite_value(measure.value)[0] for measure in measures}
        total = self._expression.evaluate(values)
        if total is None or any(value is None for value in values.values()):
            return
        self._due = step + self._period
        self._entries += [*(value for _, value in level.values), time]
        for measure in measures:
            self._entries += [math.nan if value is None else value for value in details(measure)]
        self._entries.append(total)

    def _publish(self) -> None:
        if self._simulation.bus.has_subscribers(INFO):
            self._publish_info(String(data=self._scene_change))
        self._scene_change = ""
        if self._publishes_results and self._simulation.bus.has_subscribers(RESULTS):
            self._publish_results(floats(self._entries))
        self._entries = []
