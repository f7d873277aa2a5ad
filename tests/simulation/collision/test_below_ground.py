"""What has passed through fixed ground of any kind ends the run; what may be below it does not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from tests.simulation.collision.test_bounces import height, in_water, relief
from tests.simulation.collision.test_floor import BOX, grid, obj
from uwsim.base.geometry import Pose
from uwsim.errors import SimulationFailed
from uwsim.model.collision.solid_grounds import is_closed, is_level_sheet
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.simulation import Simulation

UNDER = -8.5  # below the relief and every plate


def thing(**changes: object) -> ObjectSpec:
    given = {"position": (0.3, 0.2, -4.0), "scale_factor": (2.5,) * 3, **changes}
    physics = PhysicsSpec(mass=20.1, volume=0.02, restitution=0.5)
    return ObjectSpec(name="thing", file=BOX, physics=physics, **given)  # type: ignore[arg-type]


def bed(file: str, name: str = "bed", **changes: object) -> ObjectSpec:
    return ObjectSpec(name=name, file=file, is_solid=True, **changes)  # type: ignore[arg-type]


def sheet(folder: Path, n: int = 40) -> ObjectSpec:
    return bed(grid(folder, relief, n=n))


def block(folder: Path, side: float = 8.0, *, with_hole: bool = False) -> ObjectSpec:
    mesh = trimesh.creation.box((2.0 * side, 2.0 * side, 6.0)).subdivide().subdivide()
    faces = mesh.faces[1:] if with_hole else mesh.faces
    return bed(obj(folder, "block.obj", mesh.vertices, faces), position=(0.0, 0.0, -9.0))


def put(simulation: Simulation, x: float, y: float, z: float) -> None:
    simulation.set_pose("thing", Pose(np.array([x, y, z]), np.eye(3)))


@pytest.mark.parametrize("make", [sheet, block, lambda folder: sheet(folder, 12)])
@pytest.mark.parametrize("timestep", [0.002, 0.02])
def test_what_has_passed_through_any_solid_ground_ends_the_run(
    make, timestep: float, tmp_path: Path
) -> None:  # type: ignore[no-untyped-def]
    simulation = in_water(thing(), make(tmp_path), timestep=timestep)
    simulation.advance(0.6)
    put(simulation, 0.3, 0.2, UNDER)
    with pytest.raises(SimulationFailed, match=r"'thing' has passed .* below 'bed'"):
        simulation.advance(1.6)


def test_a_body_that_swims_around_the_edge_of_a_sheet_may_be_below_it(tmp_path: Path) -> None:
    simulation = in_water(thing(), sheet(tmp_path), timestep=0.01)
    way = [(x, -4.0) for x in range(9)] + [(9.0, -6.0), (9.0, UNDER)]
    for x, z in (*way, *((x, UNDER) for x in range(9, 0, -1))):
        put(simulation, float(x), 0.2, z)
        simulation.advance(1.0)
    assert height(simulation) < -8.0


def test_a_fast_way_around_an_edge_that_is_near_is_none_through_it(tmp_path: Path) -> None:
    simulation = in_water(thing(), sheet(tmp_path), timestep=0.01)
    put(simulation, 7.5, 0.2, -4.0)
    simulation.advance(0.7)
    put(simulation, 7.5, 0.2, UNDER)  # 1 m around the edge in 0.5 s
    simulation.advance(2.0)


def test_the_inside_of_a_mesh_with_a_hole_may_be_swum_in(tmp_path: Path) -> None:
    simulation = in_water(thing(), block(tmp_path, with_hole=True), timestep=0.01)
    simulation.advance(0.6)
    put(simulation, 0.3, 0.2, UNDER)
    simulation.advance(2.0)


@pytest.mark.parametrize("make", [sheet, block])
def test_what_begins_below_any_ground_may_stay_there(make, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    below = thing(position=(0.3, 0.2, UNDER))
    in_water(below, make(tmp_path), timestep=0.01).advance(2.0)


def test_a_body_that_is_below_for_a_moment_does_not_end_the_run(tmp_path: Path) -> None:
    simulation = in_water(thing(), sheet(tmp_path), timestep=0.01)
    simulation.advance(0.4)
    put(simulation, 0.3, 0.2, UNDER)
    simulation.advance(0.2)
    put(simulation, 0.3, 0.2, -4.0)
    simulation.advance(2.0)


def test_a_long_body_that_lies_just_below_has_passed_through(tmp_path: Path) -> None:
    """Half of its diagonal is 3 m, its height 0.4 m: what counts is its highest point."""
    simulation = in_water(thing(scale_factor=(2.5, 14.0, 2.5)), block(tmp_path), timestep=0.01)
    simulation.advance(0.6)
    put(simulation, 0.3, 0.2, -6.7)
    simulation.advance(0.5)
    put(simulation, 0.3, 0.2, -6.7)
    with pytest.raises(SimulationFailed, match="'thing' has passed through the ground"):
        simulation.advance(0.5)


def test_a_saved_run_ends_where_the_first_did(tmp_path: Path) -> None:
    simulation = in_water(thing(), sheet(tmp_path), timestep=0.01)
    simulation.advance(0.4)
    put(simulation, 0.3, 0.2, UNDER)
    simulation.advance(0.3)
    kept, said = simulation.save(), []
    for _ in range(2):
        simulation.restore(kept)
        with pytest.raises(SimulationFailed) as error:
            simulation.advance(2.0)
        said.append(str(error.value))
    assert said[0] == said[1]


def faces_of(mesh: trimesh.Trimesh) -> np.ndarray:
    return mesh.vertices[mesh.faces]


def test_a_surface_is_closed_without_hole_and_from_outside_only() -> None:
    box = faces_of(trimesh.creation.icosphere(2))
    assert is_closed(box)
    assert not is_closed(box[:-1])
    assert not is_closed(box[:, ::-1])
    assert not is_closed(box[:0])
    assert is_closed(box[np.random.default_rng(0).permutation(len(box))])


def test_a_level_sheet_covers_a_rectangle_and_looks_up() -> None:
    square = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 1]], [[0, 0, 0], [1, 1, 1], [0, 1, 0]]], float)
    assert is_level_sheet(square)
    assert not is_level_sheet(square[:1])
    assert not is_level_sheet(square[:, ::-1])
    assert not is_level_sheet(np.concatenate([square, square]))
    wall = np.array([[[0, 0, 0], [1, 0, 0], [1, 0, 1]]], float)
    assert not is_level_sheet(np.concatenate([square, wall]))
    assert not is_level_sheet(square[:0])
