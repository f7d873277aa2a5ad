"""The residuals of sensors: readings of the simulated sensors minus those of the log.

A sensor of the log is compared with the topic of the scene that has the same kind of messages, and
the same name if there are several. The simulated vehicle follows the windows up to the shortest
horizon, so that the error of the motion hardly contributes. Simulated readings have their noise,
and are linear between samples.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..logs import SensorSeries
from ..logs.message_readings import SENSOR_READERS, SensorReader
from ..logs.units import GRAVITY
from ..simulation import Simulation
from .vehicle_run import VehicleRun
from .windows import Windows

DEPTH_SCALES = {
    "depth": 1.0,
    "range": -1.0,
    "altitude": -1.0,
    "pressure": 1.0 / (1000.0 * GRAVITY),
}
"""The depth of a vehicle by a reading, of fresh water for a pressure [m per unit]."""
MIN_OFFSET = 0.05
"""The least constant offset of a depth that is remarked [m]."""
OFFSET_SPREADS = 2.0
"""The least constant offset of a depth, in standard deviations of the residual."""
MIN_READINGS = 8
"""The least number of compared readings of a sensor."""


@dataclass(frozen=True, kw_only=True)
class SensorResidual:
    """The residual of one number of a sensor."""

    sensor: str
    """The name of the sensor in the log."""
    topic: str
    """The topic of the simulated sensor."""
    quantity: str
    """The name of the number."""
    unit: str
    """The unit."""
    n_readings: int
    """The number of compared readings."""
    rms: float
    """The root mean square of the residual."""
    bias: float
    """The mean of the residual: simulated minus measured."""
    measured_deviation: float
    """The standard deviation of the measured readings, for comparison."""


class SensorComparison:
    """The comparison of the log's sensors with those of the scene.

    Args:
        simulation: the simulation.
        sensors: the sensors of the log.
        vehicle: the name of the vehicle, for the choice of topics.
    """

    def __init__(
        self, simulation: Simulation, sensors: Mapping[str, SensorSeries], vehicle: str
    ) -> None:
        self._sensors = sensors
        self._topics = match_topics(simulation.topics, sensors, vehicle)
        self._readings: dict[str, list[tuple[float, tuple[float, ...]]]] = {}
        for name, topic in self._topics.items():
            self._subscribe(simulation, name, topic)
        self._residuals: dict[str, list[Array]] = {name: [] for name in self._topics}

    def _subscribe(self, simulation: Simulation, name: str, topic: str) -> None:
        from ..middleware.types import message_class

        reader = SENSOR_READERS[simulation.topics[topic]]
        readings = self._readings.setdefault(name, [])

        def receive(message: Any) -> None:
            stamp = message.header.stamp
            readings.append((stamp.sec + 1e-9 * stamp.nanosec, reader.read(message)))

        simulation.bus.subscribe(topic, message_class(simulation.topics[topic]), receive)

    @property
    def is_empty(self) -> bool:
        """True if no sensor of the log has a counterpart."""
        return not self._topics

    def compare_windows(
        self,
        run: VehicleRun,
        windows: Windows,
        horizon: float,
        on_window: Callable[[], None] = lambda: None,
    ) -> tuple[SensorResidual, ...]:
        """Run the windows up to a horizon, and return the residuals."""
        for start in windows.starts.tolist():
            for readings in self._readings.values():
                readings.clear()
            run.begin(start)
            origin = run.simulation.time
            run.run(start, [horizon])
            for name in self._topics:
                self._add_window(name, start, horizon, origin)
            on_window()
        return tuple(
            residual for name in self._topics for residual in self._summarize(name, self._topics)
        )

    def _add_window(self, name: str, start: float, horizon: float, origin: float) -> None:
        readings = self._readings[name]
        if len(readings) < 2:
            return
        times = np.array([time for time, _ in readings]) - origin + start
        values = np.array([row for _, row in readings])
        series = self._sensors[name]
        is_inside = (series.times >= max(times[0], start)) & (series.times <= times[-1])
        names = self._names(name)
        columns = []
        for column in names:
            predictions = values[:, names[column]]
            measurements = series.values[is_inside, series.names.index(column)]
            is_valid = np.isfinite(predictions)
            if is_valid.sum() < 2:
                columns.append(np.full((2, int(is_inside.sum())), np.nan))
                continue
            at_times = np.interp(series.times[is_inside], times[is_valid], predictions[is_valid])
            columns.append(np.array([at_times - measurements, measurements]))
        self._residuals[name].append(np.array(columns))

    def _names(self, name: str) -> dict[str, int]:
        reader = self._reader(name)
        return {c: reader.names.index(c) for c in self._sensors[name].names if c in reader.names}

    def _reader(self, name: str) -> SensorReader:
        kinds = [reader for reader in SENSOR_READERS.values()]
        series = self._sensors[name]
        return next(
            reader
            for reader in kinds
            if reader.kind == series.kind and set(reader.names) & set(series.names)
        )

    def _summarize(self, name: str, topics: Mapping[str, str]) -> list[SensorResidual]:
        if not self._residuals[name]:
            return []
        table = np.concatenate(self._residuals[name], axis=2)  # (columns, 2, readings)
        series, rows = self._sensors[name], []
        for index, column in enumerate(self._names(name)):
            residuals, measurements = table[index]
            is_valid = np.isfinite(residuals)
            if is_valid.sum() < MIN_READINGS:
                continue
            residuals, measurements = residuals[is_valid], measurements[is_valid]
            rows.append(
                SensorResidual(
                    sensor=name,
                    topic=topics[name],
                    quantity=column,
                    unit=series.units[series.names.index(column)],
                    n_readings=len(residuals),
                    rms=math.sqrt(float((residuals * residuals).mean())),
                    bias=float(residuals.mean()),
                    measured_deviation=float(measurements.std()),
                )
            )
        return rows


def match_topics(
    topics: Mapping[str, str], sensors: Mapping[str, SensorSeries], vehicle: str
) -> dict[str, str]:
    """Return the topic of the scene for each sensor of the log that has one."""
    matches: dict[str, str] = {}
    for name, series in sensors.items():
        candidates = [
            topic
            for topic, message_type in topics.items()
            if message_type in SENSOR_READERS
            and SENSOR_READERS[message_type].kind == series.kind
            and set(SENSOR_READERS[message_type].names) & set(series.names)
        ]
        own_topics = [topic for topic in candidates if vehicle in topic.split("/")] or candidates
        same_names = [topic for topic in own_topics if topic.rsplit("/", 1)[-1] == name]
        matching_topics = same_names or own_topics
        if len(matching_topics) == 1:
            matches[name] = matching_topics[0]
    return matches


def describe_offsets(residuals: Sequence[SensorResidual]) -> list[str]:
    """Return a remark for each depth or height with a constant residual: another origin."""
    remarks = []
    for residual in residuals:
        scale = DEPTH_SCALES.get(residual.quantity)
        if scale is None:
            continue
        offset = scale * residual.bias  # positive: the simulated vehicle is too deep [m]
        spread = abs(scale) * math.sqrt(max(0.0, residual.rms**2 - residual.bias**2))
        if abs(offset) > max(MIN_OFFSET, OFFSET_SPREADS * spread):
            side = "below" if offset > 0.0 else "above"
            remarks.append(
                f"{residual.sensor}: the log's depth lies {abs(offset):.2f} m {side} that of the "
                f"scene, at all times. Add {-offset:.2f} to z of origin in [frames] of a "
                "mapping file."
            )
    return remarks
