"""Markers: the service ``SpawnMarker``, and the frames of what it adds."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.messages import Duration, Marker, Point, Pose, SpawnMarker, SpawnMarkerResponse

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "cirs.xml"


@pytest.fixture
def simulation() -> Iterator[uwsim.Simulation]:
    with uwsim.load("visibility-scene") as opened:
        yield opened


def spawn(simulation: uwsim.Simulation, **fields: object) -> SpawnMarkerResponse:
    marker = Marker(**{"ns": "buoy", "id": 7, "type": Marker.CUBE, **fields})
    answer = simulation.call("SpawnMarker", SpawnMarker(marker))
    assert isinstance(answer, SpawnMarkerResponse)
    return answer


def test_a_marker_is_added_modified_and_deleted(simulation: uwsim.Simulation) -> None:
    markers = simulation.world.markers
    said = spawn(simulation)
    assert (said.success, said.status_message) == (True, "object 7 buoy was successfully ADDED.")
    said = spawn(simulation, type=Marker.SPHERE)
    assert said.status_message == "object 7 buoy was successfully MODIFIED."
    assert [(name, each.type) for name, each in markers.active_markers.items()] == [
        ("7+buoy", Marker.SPHERE)
    ]
    said = spawn(simulation, action=Marker.DELETE)
    assert said.status_message == "object 7 buoy was successfully DELETED."
    said = spawn(simulation, action=Marker.DELETE)
    assert (said.success, said.status_message) == (False, "object 7 buoy not found.")
    spawn(simulation, id=1)
    spawn(simulation, id=2)
    assert spawn(simulation, action=Marker.DELETEALL).success
    assert markers.active_markers == {}


@pytest.mark.parametrize("kind", range(12))
def test_every_type_is_kept(simulation: uwsim.Simulation, kind: int) -> None:
    assert spawn(simulation, type=kind, mesh_resource="objects/torus.osg").success


@pytest.mark.parametrize(
    "fields",
    [
        {"type": 12},
        {"type": Marker.MESH_RESOURCE},
        {"type": Marker.MESH_RESOURCE, "mesh_resource": "package://gone/buoy.stl"},
        {"type": Marker.MESH_RESOURCE, "mesh_resource": "buoy.stl"},
        {"type": Marker.MESH_RESOURCE, "mesh_resource": "file:///home/someone/buoy.dae"},
        {"type": Marker.MESH_RESOURCE, "mesh_resource": "file:///etc/passwd"},
        {"type": Marker.TRIANGLE_LIST, "points": [Point()]},
        {"pose": Pose(position=Point(x=float("nan")))},
    ],
)
def test_what_cannot_be_shown_is_refused(simulation: uwsim.Simulation, fields: dict) -> None:
    said = spawn(simulation, **fields)
    assert not said.success
    assert said.status_message.startswith("object 7 buoy was not added: ")


def test_a_marker_goes_when_its_lifetime_is_over(simulation: uwsim.Simulation) -> None:
    spawn(simulation, lifetime=Duration(nanosec=10_000_000))
    simulation.advance(0.008)
    saved = simulation.save()
    assert simulation.world.markers.active_markers
    simulation.advance(0.004)
    assert not simulation.world.markers.active_markers
    simulation.restore(saved)
    assert simulation.world.markers.active_markers


def test_markers_are_on_tf_with_the_objects() -> None:
    with uwsim.load(SCENE) as simulation:
        simulation.latest_message("/tf")
        spawn(simulation, pose=Pose(position=Point(1.0, 2.0, 3.0)))
        simulation.advance(0.1)
        frames = {each.child_frame_id: each for each in simulation.latest_message("/tf").transforms}
        found = frames["7+buoy"]
        assert found.header.frame_id == "world"
        place = found.transform.translation
        assert np.array([place.x, place.y, place.z]) == pytest.approx([1.0, 2.0, 3.0])


@pytest.mark.parametrize("by", ["name", "package", "data path"])
def test_a_mesh_next_to_the_scene_or_in_a_data_path_is_shown(by: str, tmp_path: Path) -> None:
    scene = tmp_path / "scenes" / "scene.xml"
    scene.parent.mkdir()
    scene.write_text("<UWSimScene/>")
    folder = {"name": scene.parent, "package": tmp_path / "toys"}.get(by, tmp_path / "data")
    folder.mkdir(exist_ok=True)
    (folder / "buoy.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    name = "package://toys/buoy.obj" if by == "package" else "buoy.obj"
    data_path = [tmp_path / "data"] if by == "data path" else []
    with uwsim.load(scene, data_path=data_path) as simulation:
        fields = {"type": Marker.MESH_RESOURCE, "mesh_resource": name}
        assert spawn(simulation, **fields).success
        (folder / "buoy.obj").unlink()
        said = spawn(simulation, **fields)
    assert not said.success
    assert f"there is no mesh {name!r}" in said.status_message
