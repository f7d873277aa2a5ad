"""What `benchmarks/` measures can still be made; how fast it is, is measured there."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

import uwsim

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def benchmarks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(BENCHMARKS), *sys.path])


@pytest.mark.parametrize(
    "name", sorted(file.stem for file in BENCHMARKS.glob("*.py") if file.stem != "measure")
)
def test_a_benchmark_can_be_imported_and_has_something_to_run(benchmarks: None, name: str) -> None:
    assert callable(importlib.import_module(name).main)


def test_the_tank_of_the_physics_has_contacts_and_moves_on(benchmarks: None) -> None:
    _, water, data = importlib.import_module("physics").settle_tank_model()
    assert data.ncon >= 4
    before = data.qpos.copy()
    water.step(data, 10)
    assert np.isfinite(data.qpos).all()
    assert (data.qpos != before).any()


def test_rays_in_the_hull_meet_it_from_inside_in_a_mesh_of_mujoco_alone(benchmarks: None) -> None:
    module = importlib.import_module("rays")
    with uwsim.load("survey-scene", is_blind=True) as simulation:
        cast, scene = simulation.world.rays.cast, simulation.world.rays._scene
        found = {}
        for sensor, (mount, directions) in module.sensor_rays().items():
            pose = module.sensor_pose(simulation, mount)
            own = cast(pose, directions, module.MAX_RANGE).distance
            meshes = module.mesh_caster(module.triangles_by_body(scene))
            other = module.mujoco_cast(meshes, pose.position, directions @ pose.rotation.T)()
            assert np.isfinite(own).any()
            found[sensor] = module.compare_distances(own, other)["differ"]
        engine = module.engine_caster(simulation)
        assert engine[0].ngeom > 1000
        down = module.mujoco_cast(engine, pose.position, np.array([[0.0, 0.0, -1.0]]))()
        assert np.isfinite(down).all()
    assert found.pop("multibeam in the hull") == 1.0
    assert max(found.values()) < 1e-3


def test_distances_differ_by_miss_by_extra_hit_and_by_place(benchmarks: None) -> None:
    own, other = (
        np.array([1.0, 1.0, np.inf, 1.0, np.inf]),
        np.array([1.0, np.inf, 2.0, 1.5, np.inf]),
    )
    assert importlib.import_module("rays").compare_distances(own, other) == {
        "differ": 0.6,
        "missed": 0.2,
        "extra": 0.2,
        "moved": 0.2,
        "moved_by_m": 0.5,
        "same_within_um": 0.0,
    }
