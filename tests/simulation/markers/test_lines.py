"""Markers that programs spawn are lines of the live view."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.viewer.live.desk import Desk
from uwsim.base.geometry import Pose as Transform
from uwsim.messages import ColorRGBA, Marker, Point, Pose, Quaternion, SpawnMarker, Vector3
from uwsim.simulation.markers import SERVICE, TYPES
from uwsim.simulation.markers.lines import MAX_POINTS, describe_markers, draw_markers
from uwsim.viewer.live.session import LiveSession

NOWHERE = Transform(np.zeros(3), np.eye(3))


def marker(**fields: Any) -> Marker:
    pose = Pose(
        position=Point(x=1.0, y=2.0, z=3.0), orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    )
    size = Vector3(x=2.0, y=0.4, z=0.6)
    return Marker(**{"ns": "buoy", "id": 7, "pose": pose, "scale": size, **fields})


def corners(lines: list[list[list[float]]]) -> tuple[list[float], list[float]]:
    points = np.array([point for line in lines for point in line])
    return points.min(axis=0).tolist(), points.max(axis=0).tolist()


@pytest.mark.parametrize("kind", [Marker.CUBE, Marker.SPHERE, Marker.CYLINDER])
def test_a_shape_is_outlined_in_its_size_and_colour(kind: int) -> None:
    red = ColorRGBA(r=1.0, g=0.5, b=0.0, a=1.0)
    (one,) = describe_markers(draw_markers({"7+buoy": marker(type=kind, color=red)}, NOWHERE))
    assert (one["name"], one["colour"], one["at"]) == ("7+buoy", "#ff8000", [1.0, 2.0, 3.0])
    low, high = corners(one["lines"])
    assert low == pytest.approx([0.0, 1.8, 2.7], abs=1e-3)
    assert high == pytest.approx([2.0, 2.2, 3.3], abs=1e-3)


def test_whatever_a_marker_says_the_page_gets_numbers_and_not_too_many() -> None:
    odd = [
        Point(x=float("nan"), y=0.0, z=0.0),
        *[Point(x=0.1 * k, y=0.0, z=0.0) for k in range(9000)],
    ]
    markers = {
        f"{kind}+{k}": marker(type=kind, points=points, scale=Vector3(x=size, y=1.0, z=1.0))
        for kind in TYPES
        for k, (points, size) in enumerate([(odd, 1.0), ([], float("inf")), ([], 0.0)])
    }
    shown = describe_markers(draw_markers(markers, NOWHERE))
    json.dumps(shown, allow_nan=False)
    assert [each["name"] for each in shown] == list(markers)
    assert sum(len(line) for each in shown for line in each["lines"]) <= MAX_POINTS


def test_what_a_program_spawns_is_sent_once_and_again_when_it_is_gone() -> None:
    desk, now = Desk(), [0.0]

    def wall() -> float:
        now[0] += 0.1
        return now[0]

    def markers() -> list[dict[str, Any]]:
        return [json.loads(content) for content in desk.on("markers")]

    session = LiveSession(desk, real_time_factor=0.0, wall=wall)  # type: ignore[arg-type]
    with uwsim.load("remus-scene") as simulation:
        session.open(simulation, "scene")
        simulation.call(SERVICE, SpawnMarker(marker=marker(type=Marker.CUBE)))
        simulation.advance(0.1)
        assert [[each["name"] for each in said["markers"]] for said in markers()] == [["7+buoy"]]
        where = simulation.world.model.scene.world_from_localized.transform(
            np.array([[1.0, 2.0, 3.0]])
        )[0]
        assert markers()[0]["markers"][0]["at"] == pytest.approx(where.tolist(), abs=1e-3)
        simulation.call(SERVICE, SpawnMarker(marker=marker(action=Marker.DELETEALL)))
        simulation.advance(0.1)
        assert markers()[-1]["markers"] == []
        assert len(markers()) == 2
