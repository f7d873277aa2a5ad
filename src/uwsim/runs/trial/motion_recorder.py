"""The recorder of the motion of a trial: the poses of all bodies, and the changes of the scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ...base.geometry import Array
from ...benchmark.ground_truth import CornersFromCameraSpec
from ...benchmark.measures import EuclideanNorm, EuclideanNormSpec, MeasureSpec
from ...results.motion import RATE, Signal, TrackLevel, track_bytes
from ...results.motion.motion_track import quantise, steps_of
from ...results.motion.packing import Table
from ...simulation import Simulation
from ...simulation.tracked_state import BRIGHTNESS_RESOLUTION, LAMP_PREFIX, TrackedState
from .level_row import LevelRow
from .motion_events import MarkerLog, SandLog, SedimentLog
from .triggered_measure import TriggeredMeasure

CORNERS = 8
"""The number of coordinates of a quadrangle in an image: x, y of four corners."""
BATCH_SIZE = 300
"""The number of rows that are quantised at a time."""
PIXEL_RESOLUTION = 0.5
"""The resolution of image coordinates [px]."""


class MotionRecorder:
    """A recorder that samples a simulation 30 times a second of simulation time.

    Args:
        simulation: the simulation; `start` records its first frame.
        measures: the measures of the benchmark, whose true and estimated quadrangles are recorded.
        is_active: False for a recorder whose track has no frames.
    """

    def __init__(
        self, simulation: Simulation, measures: Sequence[MeasureSpec], *, is_active: bool = True
    ) -> None:
        self._simulation = simulation
        self._state = TrackedState(simulation.world)
        self._cameras = _compared_measures(measures)
        self._measures: dict[str, EuclideanNorm] = {}  # the measure of this level, by camera
        self._signals = (*self._state.signals, *_corner_signals(self._cameras))
        self._steps = steps_of(len(self._state.bodies), self._signals)
        self._tables: list[Table] = []  # the quantised rows
        self._rows: list[Array] = []  # the newest rows, not yet quantised
        self._n_rows = 0
        self._levels: list[TrackLevel] = []
        self._sand, self._markers = SandLog(simulation), MarkerLog(simulation)
        self._sediment = SedimentLog(simulation)
        self._due = 0
        self._is_active = is_active
        if is_active:
            simulation.watch(self._update)

    def start(self) -> None:
        """Record the first frame, at step 0."""
        if self._is_active:
            self._update()

    def begin_level(self, measures: Iterable[TriggeredMeasure]) -> None:
        """Begin the measurement of a level."""
        measures_by_name = {measure.spec.name: measure.measure for measure in measures}
        for camera, name in self._cameras.items():
            measure = measures_by_name[name]
            if isinstance(measure, EuclideanNorm):
                self._measures[camera] = measure

    def end_level(self, row: LevelRow) -> None:
        """Record a level whose measurement has ended."""
        self._measures = {}
        level = TrackLevel(
            values=dict(row.values),
            start_time=round(row.ended_at - row.duration, 9),
            duration=round(row.duration, 9),
            status=row.status,
        )
        self._levels.append(level)

    def track(self) -> bytes:
        """Return the file of the track up to now."""
        self._pack()
        table = np.concatenate(self._tables or [np.zeros((0, len(self._steps)), np.int32)])
        signals = compact_lamps(self._signals, table)
        sand, markers = self._sand.sand(), self._markers.changes
        bodies, levels, sediment = self._state.bodies, self._levels, self._sediment.sediment()
        return track_bytes(
            bodies, signals, table, levels, sand=sand, markers=markers, sediment=sediment
        )

    def _update(self) -> None:
        while self._simulation.step >= self._due:
            self._rows.append(self._row())
            self._sand.update(self._n_rows)
            self._markers.update(self._n_rows)
            self._sediment.update()
            self._n_rows += 1
            self._due = round(self._n_rows / (RATE * self._simulation.timestep))
            if len(self._rows) == BATCH_SIZE:
                self._pack()

    def _pack(self) -> None:
        if self._rows:
            self._tables.append(quantise(np.array(self._rows), self._steps))
            self._rows = []

    def _row(self) -> Array:
        corners = [self._corners(self._measures.get(camera)) for camera in self._cameras]
        return np.concatenate([self._state.row(), *corners])

    @staticmethod
    def _corners(measure: EuclideanNorm | None) -> list[float]:
        """Return the true and the estimated corners in an image, (16,) [px]; NaN if unknown."""
        numbers: list[float] = []
        for quad in (None, None) if measure is None else (measure.ground_truth, measure.estimate):
            is_complete = quad is not None and quad.shape == (CORNERS,)
            numbers += quad.tolist() if quad is not None and is_complete else [np.nan] * CORNERS
        return numbers


def compact_lamps(signals: Sequence[Signal], table: Table) -> tuple[Signal, ...]:
    """Store lamps that are never dimmed as on or off: 1 or 0 instead of multiples of 0.01.

    Args:
        signals: the signals, which are the last columns of the table.
        table: quantised rows, (frames, 7 bodies + signals); the columns of such lamps are changed.

    Returns:
        The signals, with new resolutions (`Signal.step`) for the changed columns.
    """
    new_signals, n_steps = list(signals), round(1.0 / BRIGHTNESS_RESOLUTION)
    for k, signal in enumerate(signals, start=-len(signals)):
        if signal.name.startswith(LAMP_PREFIX) and not (table[:, k] % n_steps).any():
            table[:, k] //= n_steps
            new_signals[k] = replace(signal, step=1.0)
    return tuple(new_signals)


def _compared_measures(measures: Sequence[MeasureSpec]) -> dict[str, str]:
    """Return, by camera, the name of the first measure that compares quadrangles in its images."""
    names: dict[str, str] = {}
    for spec in measures:
        if isinstance(spec, EuclideanNormSpec) and isinstance(
            spec.ground_truth, CornersFromCameraSpec
        ):
            names.setdefault(spec.ground_truth.camera, spec.name)
    return names


def _corner_signals(cameras: Iterable[str]) -> list[Signal]:
    return [
        Signal(name=f"{kind}/{camera}/{corner}/{axis}", unit="px", step=PIXEL_RESOLUTION)
        for camera in cameras
        for kind in ("truth", "estimate")
        for corner in range(CORNERS // 2)
        for axis in "uv"
    ]
