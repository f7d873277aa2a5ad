from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.support.opened import open_scene
from tests.support.packs import read_array
from uwsim.base.geometry import Pose
from uwsim.simulation.tracked_bodies import TrackedBodies
from uwsim.simulation.views import FIELD_OF_VIEW, find_focus, orbit_view
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob

Json = dict[str, Any]


@pytest.fixture(scope="module")
def described() -> tuple[Json, bytes, uwsim.Simulation]:
    blob = Blob()
    with uwsim.load("currents-scene") as simulation:
        return scene_head(simulation, "a title", blob), blob.data, simulation


def pose(row: list[float]) -> Pose:
    return Pose.from_quaternion(np.array(row[:3]), np.array(row[3:]))


def test_every_body_of_a_motion_track_is_among_the_bodies(described: Any) -> None:
    head, _, simulation = described
    names = {body["name"] for body in head["bodies"]}
    assert set(TrackedBodies(simulation.world).names) <= names


def test_visuals_are_where_the_renderer_has_them(described: Any) -> None:
    head, _, simulation = described
    scenery = simulation.world.scenery
    found = [
        pose(body["pose"]).matrix @ np.array(visual["matrix"]).reshape(4, 4)
        for body in head["bodies"]
        for visual in body["visuals"]
    ]
    for part in scenery.parts:
        wanted = scenery.world_from_mesh(part)
        assert min(np.abs(matrix - wanted).max() for matrix in found) < 1e-6


def test_meshes_have_all_triangles_of_the_models(described: Any) -> None:
    head, data, simulation = described
    models = {id(part.model): part.model for part in simulation.world.scenery.parts}
    wanted = sum(model.n_triangles for model in models.values())
    assert sum(mesh["triangles"][1] for mesh in head["meshes"]) == 3 * wanted
    for mesh in head["meshes"]:
        n_vertices = mesh["positions"][1] // 3
        assert read_array(mesh["triangles"], data).max() < n_vertices
        assert sum(piece[1] for piece in mesh["pieces"]) == mesh["triangles"][1]


def test_a_camera_is_where_the_simulation_has_it(described: Any) -> None:
    head, _, simulation = described
    (camera,) = head["cameras"]
    body = next(body for body in head["bodies"] if body["name"] == camera["body"])
    found = pose(body["pose"]) @ pose(camera["pose"])
    wanted = simulation.world.sensors.camera(camera["name"]).world_from_camera
    assert np.abs(found.matrix - wanted.matrix).max() < 1e-6
    assert (camera["width"], camera["height"]) == (640, 480)


@pytest.mark.parametrize(
    ("scene", "key", "n"),
    [
        pytest.param("shipwreck-scene", "lamps", 1, marks=pytest.mark.slow),
        pytest.param("structured-light-scene", "projector", 4, marks=pytest.mark.slow),
        ("currents-scene", "vehicles", 1),
    ],
)
def test_lamps_projectors_and_vehicles_are_described(scene: str, key: str, n: int) -> None:
    with uwsim.load(scene) as simulation:
        head = scene_head(simulation, scene, Blob())
    assert len(head[key]) >= n


def test_the_view_of_the_file_is_that_of_its_camera(described: Any) -> None:
    head, _, simulation = described
    camera, view = simulation.world.model.scene.camera, head["file_view"]
    first = pose(view["pose"])
    assert view["fovy"] == pytest.approx(np.radians(camera.fov))
    assert first.position == pytest.approx(camera.position)
    assert view["at"] == pytest.approx(camera.look_at, abs=1e-6)
    ahead = np.subtract(camera.look_at, camera.position)
    assert -first.rotation[:, 2] == pytest.approx(ahead / np.linalg.norm(ahead), abs=1e-6)


@pytest.mark.parametrize(
    "scene",
    [
        "currents-scene",
        pytest.param("cirs", marks=pytest.mark.slow),
        pytest.param("remus-scene", marks=pytest.mark.slow),
        pytest.param("two-vehicles-scene", marks=pytest.mark.slow),
    ],
)
def test_the_first_view_is_the_orbit_of_a_render_and_has_vehicle_and_task_in_it(scene: str) -> None:
    with uwsim.load(scene) as simulation:
        view = scene_head(simulation, scene, Blob())["view"]
        orbit, corners = orbit_view(simulation, (960, 720)), find_focus(simulation).corners
    first = pose(view["pose"])
    assert np.abs(first.matrix - orbit.world_from_camera.matrix).max() < 1e-6
    assert view["fovy"] == pytest.approx(FIELD_OF_VIEW)
    ahead = np.subtract(view["at"], first.position)  # the page looks there from the same place
    assert -first.rotation[:, 2] == pytest.approx(ahead / np.linalg.norm(ahead), abs=1e-6)
    pixels = orbit.intrinsics.project(first.inverse().transform(corners))
    assert (pixels >= 0.0).all()
    assert (pixels <= (960, 720)).all()


def test_a_scene_without_a_camera_has_no_view_of_the_file(described: Any) -> None:
    _, _, simulation = described
    scene = dataclasses.replace(simulation.world.model.scene, camera=None)
    with open_scene(scene) as plain:
        assert scene_head(plain, "scene", Blob())["file_view"] is None
