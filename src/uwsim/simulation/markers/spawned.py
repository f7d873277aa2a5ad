"""Markers that programs add by the service ``SpawnMarker``, for viewers and for ``/tf``.

The name of a marker is ``<id>+<ns>``. A new marker replaces an older one with the same name;
``DELETE`` removes one marker, and ``DELETEALL`` all of them. Poses are in L, whatever frame the
header names. Markers have no mass and no contacts, and are not in the images of virtual cameras. A
mesh is searched in the folders of the scene; a marker whose mesh is missing is rejected.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

from ...base.external_values import EXPECTED_POSE, read_pose
from ...base.record import Record
from ...errors import AssetError
from ...messages import Marker, SpawnMarker, SpawnMarkerResponse
from ...messages.build import NANOSECONDS
from ...topics.frames import Frame
from .lines import localized_from_marker

SERVICE = "SpawnMarker"
TYPES = {
    **{Marker.ARROW: "ARROW", Marker.CUBE: "CUBE", Marker.SPHERE: "SPHERE"},
    **{Marker.CYLINDER: "CYLINDER", Marker.LINE_STRIP: "LINE_STRIP", Marker.POINTS: "POINTS"},
    **{Marker.LINE_LIST: "LINE_LIST", Marker.CUBE_LIST: "CUBE_LIST"},
    **{Marker.SPHERE_LIST: "SPHERE_LIST", Marker.TEXT_VIEW_FACING: "TEXT_VIEW_FACING"},
    **{Marker.MESH_RESOURCE: "MESH_RESOURCE", Marker.TRIANGLE_LIST: "TRIANGLE_LIST"},
}
"""The names of the supported types of markers."""
MAX_MARKERS = 10_000
MAX_POINTS = 1_000_000
"""The maximum number of points of a marker."""


@dataclass(slots=True)
class MarkersState(Record):
    """The markers of a running scene."""

    markers: dict[str, Marker] = field(default_factory=dict)
    """The markers, by name, in the order in which they were added."""
    ends: dict[str, float] = field(default_factory=dict)
    """The simulation time at which each marker expires, by name [s]."""


class Markers:
    """The markers of a running scene.

    Args:
        clock: returns the simulation time [s].
        has_mesh: returns whether a mesh of this name exists; raises AssetError if it is unreadable.
    """

    def __init__(self, clock: Callable[[], float], has_mesh: Callable[[str], bool]) -> None:
        self._clock, self._has_mesh = clock, has_mesh
        self.state = MarkersState()
        """The state: the markers and their times of expiry."""

    @property
    def active_markers(self) -> dict[str, Marker]:
        """The markers that have not expired, by name, in the order in which they were added."""
        now, ends = self._clock(), self.state.ends
        return {name: marker for name, marker in self.state.markers.items() if now < ends[name]}

    def frames(self) -> list[Frame]:
        """Return the frames of the active markers in L."""
        markers = self.active_markers.items()
        return [Frame("", name, partial(localized_from_marker, marker)) for name, marker in markers]

    def answer(self, request: SpawnMarker) -> SpawnMarkerResponse:
        """Add, modify or delete a marker, and return the result."""
        marker = request.marker
        name, label = f"{marker.id}+{marker.ns}", f"object {marker.id} {marker.ns}"
        self.state.markers = self.active_markers
        if marker.action == Marker.DELETEALL:
            self.state.markers = {}
            return SpawnMarkerResponse(True, "all objects were successfully DELETED.")
        if marker.action == Marker.DELETE:
            if self.state.markers.pop(name, None) is None:
                return SpawnMarkerResponse(False, f"{label} not found.")
            return SpawnMarkerResponse(True, f"{label} was successfully DELETED.")
        if error := self._find_error(name, marker):
            return SpawnMarkerResponse(False, f"{label} was not added: {error}.")
        verb = "MODIFIED" if name in self.state.markers else "ADDED"
        lifetime = marker.lifetime.sec + marker.lifetime.nanosec / NANOSECONDS
        self.state.markers[name] = marker
        self.state.ends[name] = self._clock() + lifetime if lifetime > 0.0 else math.inf
        return SpawnMarkerResponse(True, f"{label} was successfully {verb}.")

    def _find_error(self, name: str, marker: Marker) -> str | None:
        """Return the reason why a marker is rejected; None if it is valid."""
        if marker.type not in TYPES:
            return f"its type is {marker.type}; expected one of {', '.join(sorted(TYPES.values()))}"
        if name not in self.state.markers and len(self.state.markers) >= MAX_MARKERS:
            return f"there are {MAX_MARKERS} markers already"
        if len(marker.points) > MAX_POINTS:
            return f"it has more than {MAX_POINTS} points"
        if read_pose(marker.pose) is None:
            return f"its pose is not valid; expected {EXPECTED_POSE}"
        if marker.type == Marker.TRIANGLE_LIST and len(marker.points) % 3:
            return f"its {len(marker.points)} points are no triangles"
        return self._find_mesh_error(marker) if marker.type == Marker.MESH_RESOURCE else None

    def _find_mesh_error(self, marker: Marker) -> str | None:
        name = marker.mesh_resource
        if not name:
            return "it names no mesh_resource"
        try:
            is_there = self._has_mesh(name)
        except AssetError as error:
            return str(error).removesuffix(".")
        return None if is_there else f"there is no mesh {name[:200]!r} in the folders searched"
