"""What is touched of a fixed mesh: itself if it is small, else another within an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from tests.physics.collision.surfaces import grid, irregular, model_of, rock
from uwsim.assets import load_model
from uwsim.base.geometry import Array
from uwsim.errors import UwsimError
from uwsim.model.collision import fixed_mesh as fixed_mesh_module
from uwsim.model.collision.convex_faces import convex_faces, count_patches
from uwsim.model.collision.fixed_mesh import (
    DEFAULT_ERROR,
    MAX_EXACT_FACES,
    MAX_TRIANGLES,
    FixedMesh,
    fixed_mesh,
)
from uwsim.model.collision.fixed_mesh_cache import cached_mesh
from uwsim.model.collision.shapes import shapes_of
from uwsim.model.collision.simplification import simplify

ROCK = rock()


def distance(points: Array, triangles: Array) -> float:
    """Greatest distance of points from a surface by another implementation [m]."""
    found = 0.0
    for point in points:
        nearest = trimesh.triangles.closest_point(
            triangles, np.broadcast_to(point, (len(triangles), 3))
        )
        found = max(found, float(np.linalg.norm(nearest - point, axis=1).min()))
    return found


@pytest.mark.parametrize("scale", [0.2, 1.0, 30.0])
@pytest.mark.parametrize("share", [0.01, 0.05])
def test_a_mesh_is_simplified_within_an_error_in_metres(scale: float, share: float) -> None:
    mesh = ROCK * scale
    found = simplify(mesh, share * scale, len(mesh))
    assert 12 < len(found.triangles) < 0.35 * len(mesh)
    assert found.error <= share * scale
    some = np.random.default_rng(1).permutation(len(mesh))[:60]
    there = distance(mesh[some, 0], found.triangles)
    back = distance(found.triangles[::20, 0], mesh)
    assert 0.0 < max(there, back) <= found.error * (1.0 + 1e-5) + 1e-6


def test_a_greater_error_leaves_fewer_triangles_and_none_leaves_all() -> None:
    counts = [len(simplify(ROCK, error, len(ROCK)).triangles) for error in (0.0, 0.01, 0.03, 0.1)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] == len(ROCK)


def test_the_greatest_number_of_triangles_goes_before_the_error() -> None:
    found = simplify(ROCK, 1e-4, 400)
    assert len(found.triangles) <= 400
    assert found.error > 1e-4


def test_a_mesh_of_few_faces_is_touched_as_it_is() -> None:
    small = rock(subdivisions=3)  # 1280 triangles
    found = fixed_mesh([small], None)
    assert np.array_equal(found.faces, small)
    assert found.is_exact
    assert not found.fields


def test_a_mesh_of_many_triangles_in_few_planes_is_touched_as_it_is() -> None:
    flat = grid(41, 61) * [1.0, 1.0, 0.0]
    walls = np.concatenate([flat, flat[:, :, [2, 0, 1]], flat[:, :, [1, 2, 0]]])
    assert len(walls) > MAX_EXACT_FACES
    assert np.array_equal(fixed_mesh([walls], None).faces, walls)


def test_patches_are_counted_as_faces_are_joined() -> None:
    tank = load_model("terrain/CIRS/cirs_trident.osg")
    for parts in ([mesh.vertices[mesh.triangles].astype(float) for mesh in tank.meshes], [ROCK]):
        whole = np.concatenate(parts)
        assert 0.9 * len(convex_faces(whole)) <= count_patches(whole) <= len(convex_faces(whole))


def test_a_large_rock_is_simplified_and_says_by_how_much() -> None:
    found = fixed_mesh([ROCK], None)
    assert 0.0 < found.error <= DEFAULT_ERROR
    assert len(found.faces) < 0.1 * len(ROCK)
    assert not found.is_exact


@pytest.mark.parametrize("error", [0.005, 0.06])
def test_the_error_of_the_file_holds_for_small_meshes_too(error: float) -> None:
    small = rock(2, subdivisions=3)
    found = fixed_mesh([small], error)
    assert 0.0 < found.error <= error
    assert len(found.faces) < len(small)


def test_an_error_of_zero_leaves_every_face() -> None:
    assert np.array_equal(fixed_mesh([ROCK], 0.0).faces, ROCK)
    sheet = grid(50, 50)
    (field,) = fixed_mesh([sheet], 0.0).fields  # exact as well
    assert field.error < 1e-9


@pytest.mark.parametrize("error", [None, 0.0, 0.1])
def test_a_sheet_leaves_no_faces_to_simplify(error: float | None) -> None:
    found = fixed_mesh([grid(50, 50)], error)
    assert (len(found.faces), len(found.fields)) == (0, 1)


def test_each_material_is_looked_at_alone() -> None:
    sheet, stone = grid(50, 50), rock(3, subdivisions=3)
    found = fixed_mesh([sheet, stone], None)
    assert len(found.fields) == 1
    assert np.array_equal(found.faces, stone)
    assert len(found.triangles()) == len(sheet) + len(stone)


def test_a_mesh_that_no_error_makes_small_enough_is_simplified_further(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(fixed_mesh_module, "MAX_TRIANGLES", 100)
    found = fixed_mesh([ROCK], None)
    assert len(found.faces) <= 100
    assert found.error > DEFAULT_ERROR
    assert MAX_TRIANGLES > 100


def test_too_many_plates_name_the_remedy() -> None:
    rough = np.concatenate([rock(seed) * (1.0 + 0.5 * seed) for seed in range(3)])
    with pytest.raises(
        UwsimError, match=r"plates; expected at most 10000. Set a greater <u:contactError>"
    ):
        shapes_of(model_of(rough), np.eye(4), "trimesh", is_fixed=True, error=0.0)
    assert len(shapes_of(model_of(rough), np.eye(4), "trimesh", is_fixed=True)) < 4000


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "uwsim" / "fixed-meshes"


def bytes_of(mesh: FixedMesh) -> tuple[bytes, ...]:
    arrays = [mesh.faces, *(field.heights for field in mesh.fields), mesh.triangles()]
    return (*(np.ascontiguousarray(array).tobytes() for array in arrays), repr(mesh.error).encode())


def test_what_was_found_is_read_back_as_it_was(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = [irregular(2500), grid(50, 50), ROCK]
    found = bytes_of(cached_mesh(parts, None))
    assert found == bytes_of(fixed_mesh(parts, None))
    others = [([parts[0][1:], *parts[1:]], None), (parts, 0.04), (parts[1:], None)]
    for other in others:
        assert bytes_of(cached_mesh(*other)) != found
    with monkeypatch.context() as patch:
        patch.setattr(fixed_mesh_module, "fixed_mesh", lambda *_: pytest.fail("was found again"))
        assert bytes_of(cached_mesh(parts, None)) == found
    for file in cache.iterdir():
        file.write_bytes(file.read_bytes()[:-9])
    assert bytes_of(cached_mesh(parts, None)) == found


def test_small_meshes_leave_nothing_on_the_disk(cache: Path) -> None:
    cached_mesh([rock(subdivisions=2)], None)
    assert not cache.exists()
