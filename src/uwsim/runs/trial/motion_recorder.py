"""Keeps the motion of a trial: the poses of all bodies, and the scene as it changes."""

from __future__ import annotations

import numpy as np

from ...geometry import Array
from ...simulation import Simulation
from ...simulation.tracked_bodies import TrackedBodies
from ...tracks import RATE, Channel, TrackLevel, track_bytes
from ...tracks.motion_track import quantised, resolutions_of
from .level_row import LevelRow

CHANNELS = (
    Channel(name="fog", unit="1/m"),
    Channel(name="light", unit="1"),
    Channel(name="current.x", unit="m/s", resolution=1e-3),
    Channel(name="current.y", unit="m/s", resolution=1e-3),
    Channel(name="current.z", unit="m/s", resolution=1e-3),
)
"""The water and the sun, and the current in W at the first vehicle."""


class MotionRecorder:
    """Samples a simulation 30 times a second of simulation time.

    Args:
        simulation: the one; its first frame is taken by `start`.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation, self._world = simulation, simulation.world
        self._bodies = TrackedBodies(simulation.world)
        self._resolutions = resolutions_of(len(self._bodies.names), CHANNELS)
        self._rows: list[Array] = []  # quantised
        self._before: Array | None = None  # quaternions of the last frame
        self._levels: list[TrackLevel] = []
        self._due = 0
        simulation.watch(self._look)

    def start(self) -> None:
        """Take the first frame, at step 0."""
        self._look()

    def end_level(self, row: LevelRow) -> None:
        """Note a level that has just been measured."""
        duration = row.duration
        level = TrackLevel(
            values=dict(row.values),
            began=round(row.ended_at - duration, 9),
            duration=round(duration, 9),
            status=row.status,
        )
        self._levels.append(level)

    def track(self) -> bytes:
        """Return the file of the track up to now."""
        table = np.array(self._rows, dtype=np.int32).reshape(-1, len(self._resolutions))
        return track_bytes(self._bodies.names, CHANNELS, table, self._levels)

    def _look(self) -> None:
        while self._simulation.step >= self._due:
            self._rows.append(quantised(self._row(), self._resolutions))
            self._due = round(len(self._rows) / (RATE * self._simulation.timestep))

    def _row(self) -> Array:
        rows = self._bodies.rows()
        if self._before is not None:  # of the two quaternions of a rotation the nearer one
            rows[(rows[:, 3:] * self._before).sum(axis=1) < 0.0, 3:] *= -1.0
        self._before = rows[:, 3:].copy()
        scenery = self._world.scenery
        return np.array([*rows.reshape(-1), scenery.water.fog, scenery.light.rate, *self._current()])

    def _current(self) -> Array:
        """Velocity of the water at the first vehicle, (3,) [m/s]."""
        vehicles = self._world.vehicles
        if self._world.water.is_still or not vehicles:
            return np.zeros(3)
        here = self._world.state.poses.vehicle(0).position
        velocity: Array = self._world.water_velocity(here[None], self._world.time, vehicles[0])[0]
        return velocity
