"""Logs of changes of a scene between frames of its motion: sand, sediment, and markers."""

from __future__ import annotations

import numpy as np

from ...messages import Marker
from ...particles import puffs as p
from ...results.motion import DrawnMarker, DugSand, MarkerChange, Spot, StirredSediment
from ...results.motion.dug_sand import COLUMNS, NO_VALUE
from ...results.motion.motion_track import quantise
from ...results.motion.packing import Table
from ...results.motion.stirred_sediment import STEPS, make_removal, no_births
from ...simulation import Simulation
from ...simulation.markers.lines import MAX_POINTS, count_points, draw_marker

MAX_CHANGES = 100_000
"""The greatest number of marker changes in a trial; later ones are not stored."""
MAX_STORED_POINTS = 200_000
"""The greatest number of points of all shapes; later markers are stored by name only."""


class SandLog:
    """A log of the spots where sand was dug away between one frame and the next.

    Args:
        simulation: the simulation with the sand.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._heaps = simulation.world.scenery.heaps
        self._known_spots: list[list[Spot]] = [[] for _ in self._heaps]
        self._versions = [heap.version for heap in self._heaps]
        self._rows: list[tuple[int, ...]] = []

    def update(self, frame: int) -> None:
        """Record the spots that were dug since the last call, for the frame with this index."""
        for heap_index, heap in enumerate(self._heaps):
            if heap.version == self._versions[heap_index]:
                continue
            self._versions[heap_index] = heap.version
            n = len(self._known_spots[heap_index])
            if heap.state.spots[:n] != self._known_spots[heap_index]:  # the sand was restored
                self._rows.append((frame, heap_index, NO_VALUE, NO_VALUE, NO_VALUE))
                n = 0
            self._rows += [(frame, heap_index, *spot) for spot in heap.state.spots[n:]]
            self._known_spots[heap_index] = list(heap.state.spots)

    def sand(self) -> DugSand:
        """Return all spots dug so far."""
        return DugSand(table=np.array(self._rows, np.int32).reshape(-1, COLUMNS))


class SedimentLog:
    """A log of the puffs of sediment that were born between one frame and the next.

    Args:
        simulation: the simulation with the sediment, if it has any.
    """

    def __init__(self, simulation: Simulation) -> None:
        particles = simulation.world.scenery.particles
        self._sediment = None if particles is None else particles.sediment
        self._n_born = 0
        self._tables: list[Table] = []

    def update(self) -> None:
        """Record the puffs that were born since the last call."""
        if self._sediment is None or self._sediment.puffs.state.n_born == self._n_born:
            return
        state = self._sediment.puffs.state
        births = state.puffs[: state.n_puffs]
        if state.n_born < self._n_born:  # the scene was reset
            self._tables.append(make_removal(state.time))
        else:
            births = births[births[:, p.NUMBER] >= self._n_born]
        self._n_born = state.n_born
        columns = [np.full(len(births), state.time), births[:, p.NUMBER]]
        columns += [births[:, column] for column in (p.X, p.Y, p.Z)]
        columns.append(np.sqrt(births[:, p.VARIANCE]))
        columns += [births[:, c] for c in (p.MASS, p.VELOCITY_X, p.VELOCITY_Y, p.VELOCITY_Z)]
        columns.append(births[:, p.FLOOR])
        self._tables.append(quantise(np.stack(columns, axis=1), np.array(STEPS)))

    def sediment(self) -> StirredSediment:
        """Return all puffs so far."""
        return StirredSediment(table=np.concatenate([no_births(), *self._tables]))


class MarkerLog:
    """A log of the markers that were added, changed or removed between one frame and the next.

    Args:
        simulation: the simulation with the markers.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._world = simulation.world
        self._markers: dict[str, Marker] = {}
        self._drawings: dict[str, DrawnMarker] = {}
        self._shapes: set[object] = set()
        # the number of points that may still be stored, and that are drawn now
        self._n_free, self._n_drawn = MAX_STORED_POINTS, 0
        self.changes: list[MarkerChange] = []
        """All changes so far."""

    def update(self, frame: int) -> None:
        """Record the changes since the last call, for the frame with this index."""
        if (is_full := len(self.changes) >= MAX_CHANGES) and not self._markers:
            return
        markers = {} if is_full else self._world.markers.active_markers
        old_markers, self._markers = self._markers, markers
        names = [name for name in old_markers if name not in markers]
        for name in names:
            self._n_drawn -= count_points(self._drawings.pop(name))
        self.changes += [MarkerChange(frame=frame, name=name, marker=None) for name in names]
        for name, marker in markers.items():
            if old_markers.get(name) is not marker:
                self._redraw(name, marker)
                self.changes.append(
                    MarkerChange(frame=frame, name=name, marker=self._drawings[name])
                )

    def _redraw(self, name: str, marker: Marker) -> None:
        """Draw a marker again, with as many points as viewers accept and the track may hold."""
        if name in self._drawings:
            self._n_drawn -= count_points(self._drawings[name])
        n_max = max(0, min(MAX_POINTS - self._n_drawn, self._n_free))
        drawn_marker = draw_marker(marker, self._world.model.scene.world_from_localized, n_max)
        if drawn_marker.lines not in self._shapes:
            self._shapes.add(drawn_marker.lines)
            self._n_free -= count_points(drawn_marker)
        self._n_drawn += count_points(drawn_marker)
        self._drawings[name] = drawn_marker
