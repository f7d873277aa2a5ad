"""An algorithm that spawns, moves and deletes markers."""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import (
    ColorRGBA,
    Duration,
    Empty,
    Marker,
    Point,
    Pose,
    Quaternion,
    SpawnMarker,
    Vector3,
)

BOX, FLASH = "1+goal", "2+goal"
SPAWN_TIME, MOVE_TIME, DELETE_TIME = 0.4, 0.8, 1.2
"""The times of the spawn, move and deletion of the box [s]; the flash lasts 0.2 s from the move."""


class MarkingAlgorithm:
    """An algorithm that spawns a box, moves it 0.2 m along x of L, adds a text, deletes the box."""

    def start(self, node: Node) -> None:
        self._node, self._n = node, 0
        node.call("startBench", Empty())
        node.create_timer(SPAWN_TIME, self._act)

    def _act(self) -> None:
        acts = [Marker.DELETE] if self._n == 3 else [Marker.ADD] if self._n in (1, 2) else []
        for action in acts:
            self._call(1, action, type=Marker.CUBE, x=2.0 if self._n == 1 else 2.2)
        if self._n == 2:
            life = Duration(sec=0, nanosec=200_000_000)
            self._call(2, Marker.ADD, type=Marker.TEXT_VIEW_FACING, x=2.0, text="x", lifetime=life)
        self._n += 1

    def _call(self, number: int, action: int, *, x: float, **fields: object) -> None:
        pose = Pose(
            position=Point(x=x, y=0.35, z=4.5), orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
        )
        marker = Marker(
            ns="goal",
            id=number,
            action=action,
            pose=pose,
            scale=Vector3(x=0.4, y=0.3, z=0.3),
            color=ColorRGBA(r=1.0, g=0.2, b=0.0, a=1.0),
            **fields,  # type: ignore[arg-type]
        )
        self._node.call("SpawnMarker", SpawnMarker(marker=marker))
