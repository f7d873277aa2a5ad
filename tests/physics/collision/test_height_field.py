"""Ground that is a height field is touched as one: where its mesh is, by nothing else."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.physics.collision.surfaces import grid, irregular, model_of, rock
from uwsim.base.geometry import Array, Pose
from uwsim.base.numerics.linear import product
from uwsim.model.body_names import object_body
from uwsim.model.collision import height_field as fields
from uwsim.model.collision.ground import Ground
from uwsim.model.collision.height_field import ROUNDING_ERROR, TILE_CELLS, HeightField, height_field
from uwsim.model.collision.shapes import CollisionShape, shapes_of
from uwsim.model.resolved_scene import SimulatedScene
from uwsim.physics.engine_model import compile_engine_model
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec

FIXED = PhysicsSpec(mass=0.0, collision_shape_type="trimesh")


def compiled(
    ground: tuple[CollisionShape, ...], body: CollisionShape | None = None, height: float = 1.0
) -> mujoco.MjModel:
    """Ground alone, or with a loose body above its middle, in air."""
    things = [ObjectSpec(name="ground", file="", physics=FIXED)]
    shapes = {object_body(0): ground}
    if body is not None:
        position = (4.0, 0.5, height)
        things.append(
            ObjectSpec(name="body", file="", position=position, physics=PhysicsSpec(mass=50.0))
        )
        shapes[object_body(1)] = (body,)
    params = SimParamsSpec(enable_physics=True, gravity=(0.0, 0.0, -9.81))
    scene = SceneSpec(objects=tuple(things), sim_params=params)
    return compile_engine_model(
        SimulatedScene(scene=scene, robots={}, dynamics={}, shapes=shapes, timestep=0.002)
    )


def heights_seen(model: mujoco.MjModel, places: Array) -> Array:
    """Heights of the engine's surface at places (n, 2) [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geom, down = np.zeros(1, np.int32), np.array([0.0, 0.0, -1.0])
    found = []
    for x, y in places:
        above = np.array([x, y, 50.0])
        distance = mujoco.mj_ray(model, data, above, down, None, 1, -1, geom)
        found.append(50.0 - distance if distance >= 0.0 else np.nan)
    return np.array(found)


def heights_of(triangles: Array, places: Array) -> Array:
    """Heights of a mesh at places (n, 2) [m]."""
    ground = Ground(triangles)
    return np.array([ground.height_at(np.array([x, y, 50.0])) for x, y in places])


PLACES = np.random.default_rng(5).uniform([0.1, -1.9], [7.9, 2.9], (200, 2))
TURNS = {
    "z up": np.eye(3),
    "z down": np.diag([1.0, -1.0, -1.0]),
    "x up": np.roll(np.eye(3), 1, axis=0),
    "y down": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
}


@pytest.mark.parametrize("axes", TURNS)
@pytest.mark.parametrize("diagonal", ["one way", "the other"])
def test_a_regular_grid_is_converted_exactly(axes: str, diagonal: str) -> None:
    triangles = grid(34, 47)
    if diagonal == "the other":
        triangles = (triangles * [1.0, -1.0, 1.0])[:, ::-1] + [0.0, 1.0, 0.0]
    turned = product(triangles.reshape(-1, 3), TURNS[axes].T).reshape(-1, 3, 3)
    field = height_field(turned, 0.0)
    assert isinstance(field, HeightField)
    assert field.error < 1e-9
    assert field.heights.size == 34 * 47
    shown = product(field.triangles().reshape(-1, 3), TURNS[axes]).reshape(-1, 3, 3)
    places = PLACES * [1.0, -1.0] + [0.0, 1.0] if diagonal == "the other" else PLACES
    assert heights_of(shown, places) == pytest.approx(heights_of(triangles, places), abs=1e-9)


@pytest.mark.parametrize("size", [(51, 41), (52, 43), (46, 60)])
def test_the_engine_has_the_surface_of_the_mesh(size: tuple[int, int]) -> None:
    triangles = grid(*size)
    shapes = shapes_of(model_of(triangles), np.eye(4), "trimesh", is_fixed=True)
    assert {shape.kind for shape in shapes} == {"height field"}
    seen = heights_seen(compiled(shapes), PLACES)
    assert seen == pytest.approx(heights_of(triangles, PLACES), abs=2e-6)  # float32


@pytest.mark.parametrize(("n", "error"), [(2500, 0.05), (2500, 0.03), (6000, 0.02)])
def test_irregular_ground_is_sampled_within_the_error(n: int, error: float) -> None:
    triangles = irregular(n)
    field = height_field(triangles, error)
    assert field is not None
    assert ROUNDING_ERROR < field.error <= error
    between = np.abs(heights_of(field.triangles(), PLACES) - heights_of(triangles, PLACES))
    assert between.max() <= field.error + 1e-9
    assert between.max() > 0.02 * field.error


def test_the_stated_error_is_that_of_a_grid_whose_cells_are_cut_the_other_way() -> None:
    triangles = grid(3, 3).reshape(2, 2, 2, 3, 3)
    a, b, c = triangles[0, 0, 0].copy()
    d = triangles[0, 0, 1, 2].copy()
    triangles[0, 0, 0], triangles[0, 0, 1] = (a, b, d), (b, c, d)
    field = height_field(triangles.reshape(-1, 3, 3), 10.0)
    assert field is not None
    between = abs(a[2] + c[2] - b[2] - d[2]) / 2.0
    assert field.error == pytest.approx(between)
    assert height_field(triangles.reshape(-1, 3, 3), 0.9 * between) is None


def other_meshes() -> dict[str, Array]:
    sheet = grid(20, 20)
    middle = sheet.mean(axis=1)
    return {
        "closed": rock(subdivisions=2),
        "with a hole": np.delete(sheet, [300, 301], axis=0),
        "of another outline": sheet[middle[:, 0] + middle[:, 1] < 5.0],
        "in two layers": np.concatenate([sheet, sheet * [1.0, 1.0, 0.5]]),
        "folded": np.concatenate([sheet, sheet[:5, ::-1]]),
        "flat": sheet * [1.0, 1.0, 0.0],
        "empty": np.zeros((0, 3, 3)),
    }


@pytest.mark.parametrize("kind", other_meshes())
def test_what_is_no_sheet_over_a_rectangle_is_not_converted(kind: str) -> None:
    assert height_field(other_meshes()[kind], 0.1) is None


def test_ground_that_would_take_too_many_cells_is_not_converted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(fields, "MAX_CELLS", 1000)
    assert height_field(grid(40, 40), 0.1) is None
    assert height_field(irregular(2500), 0.001) is None


def test_no_tile_has_more_triangles_than_the_engine_finds_contacts() -> None:
    field = height_field(grid(53, 42), 0.0)
    assert field is not None
    assert mujoco.mjMAXCONPAIR >= 2 * TILE_CELLS * TILE_CELLS
    tiles = [heights for _, heights in field.tiles()]
    assert max(heights.size for heights in tiles) <= (TILE_CELLS + 1) ** 2
    cells = sum((rows - 1) * (columns - 1) for rows, columns in (each.shape for each in tiles))
    assert cells == 52 * 41


@pytest.mark.parametrize("cells", [40, 160])
def test_a_box_rests_on_fine_ground_without_tilting_or_sinking(cells: int) -> None:
    random = np.random.default_rng(3)
    triangles = grid(cells + 1, cells + 1)
    number = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)[1]
    triangles = triangles * [1.0, 1.0, 0.0]
    triangles[..., 2] = random.uniform(0.0, 0.002, number.max() + 1)[number].reshape(-1, 3)
    ground = shapes_of(model_of(triangles), np.eye(4), "trimesh", is_fixed=True)
    box = CollisionShape(kind="box", size=(0.8, 0.5, 0.3), body_from_shape=Pose.identity())
    model = compiled(ground, box, height=0.31)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 500)
    assert data.qpos[2] == pytest.approx(0.3, abs=0.004)
    assert abs(data.qpos[3]) > 0.99999
    assert np.abs(data.qvel).max() < 1e-2
