"""What of a scene changes now and then, between the frames of its motion: sand and markers."""

from __future__ import annotations

import numpy as np

from ...messages import Marker
from ...results.motion import DrawnMarker, DugSand, MarkerChange, Spot
from ...results.motion.dug_sand import COLUMNS, NO_VALUE
from ...simulation import Simulation
from ...simulation.markers.lines import MAX_POINTS, look_of, n_points

MAX_CHANGES = 100_000
"""Of markers in a trial; those after it are not kept."""
MAX_KEPT = 200_000
"""Points of all shapes that are kept; of markers after it the name alone is."""


class SandLog:
    """Notes where sand was taken between one frame and the next.

    Args:
        simulation: whose sand it is.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._heaps = simulation.world.scenery.heaps
        self._seen: list[list[Spot]] = [[] for _ in self._heaps]
        self._versions = [heap.version for heap in self._heaps]
        self._rows: list[tuple[int, ...]] = []

    def look(self, frame: int) -> None:
        """Note what was taken until a frame."""
        for number, heap in enumerate(self._heaps):
            if heap.version == self._versions[number]:
                continue
            self._versions[number] = heap.version
            n = len(self._seen[number])
            if heap.state.taken[:n] != self._seen[number]:  # it was put back meanwhile
                self._rows.append((frame, number, NO_VALUE, NO_VALUE, NO_VALUE))
                n = 0
            self._rows += [(frame, number, *spot) for spot in heap.state.taken[n:]]
            self._seen[number] = list(heap.state.taken)

    def dug(self) -> DugSand:
        """Return all so far."""
        return DugSand(table=np.array(self._rows, np.int32).reshape(-1, COLUMNS))


class MarkerLog:
    """Notes the markers that came, changed or went between one frame and the next.

    Args:
        simulation: whose markers they are.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._world = simulation.world
        self._markers: dict[str, Marker] = {}
        self._looks: dict[str, DrawnMarker] = {}
        self._shapes: set[object] = set()
        self._room, self._drawn = MAX_KEPT, 0  # points that may be kept, and that are shown now
        self.changes: list[MarkerChange] = []
        """All so far."""

    def look(self, frame: int) -> None:
        """Note what has changed until a frame."""
        if (is_full := len(self.changes) >= MAX_CHANGES) and not self._markers:
            return
        shown = {} if is_full else self._world.markers.shown
        before, self._markers = self._markers, shown
        gone = [name for name in before if name not in shown]
        for name in gone:
            self._drawn -= n_points(self._looks.pop(name))
        self.changes += [MarkerChange(frame=frame, name=name, marker=None) for name in gone]
        for name, marker in shown.items():
            if before.get(name) is not marker:
                self._renew(name, marker)
                self.changes.append(MarkerChange(frame=frame, name=name, marker=self._looks[name]))

    def _renew(self, name: str, marker: Marker) -> None:
        """Draw a marker anew, with as many points as viewers take and the track may hold."""
        if name in self._looks:
            self._drawn -= n_points(self._looks[name])
        room = max(0, min(MAX_POINTS - self._drawn, self._room))
        look = look_of(marker, self._world.model.scene.world_from_localized, room)
        if look.lines not in self._shapes:
            self._shapes.add(look.lines)
            self._room -= n_points(look)
        self._drawn += n_points(look)
        self._looks[name] = look
