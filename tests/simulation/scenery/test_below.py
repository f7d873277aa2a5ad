"""What lies below a vehicle, against scipy's interpolation."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

from tests.support.opened import open_scene
from uwsim.assets.bundled import scene_file
from uwsim.scene.reader import read_scene
from uwsim.simulation.scenery.below import _highest_crossing, surfaces_below, surfaces_below_vehicle


def test_a_plumb_line_meets_a_triangulated_surface_where_scipy_says() -> None:
    random = np.random.Generator(np.random.Philox(5))
    places, heights = random.uniform(-1.0, 1.0, (200, 2)), random.uniform(-1.0, 0.0, 200)
    mesh = Delaunay(places)
    triangles = np.column_stack([places, heights])[mesh.simplices]
    expected = LinearNDInterpolator(mesh, heights)
    for x, y in random.uniform(-1.1, 1.1, (200, 2)):
        found, truth = _highest_crossing(np.array([x, y, 3.0]), triangles), float(expected(x, y))
        assert (found is None) == math.isnan(truth)
        assert found is None or found == pytest.approx(truth, abs=1e-9)


def test_from_inside_only_what_is_lower_is_met() -> None:
    shape = trimesh.creation.box((2.0, 2.0, 2.0))
    triangles = np.asarray(shape.vertices)[np.asarray(shape.faces)]
    assert _highest_crossing(np.array([0.1, 0.2, 0.0]), triangles) == pytest.approx(-1.0)
    assert _highest_crossing(np.array([0.1, 0.2, -2.0]), triangles) is None
    assert _highest_crossing(np.array([5.0, 0.0, 9.0]), triangles) is None


def test_below_a_vehicle_lie_the_box_and_then_the_tank_and_not_itself() -> None:
    simulation = open_scene(read_scene(scene_file("currents-scene")), is_blind=True)
    try:
        found = surfaces_below_vehicle(simulation.world, "girona500")
        assert [each.name for each in found] == ["blackbox", "terrain"]
        box = simulation.world.bodies.find("blackbox").box
        assert box is not None
        origin = simulation.world.bodies.find("blackbox").world_from_body.position[2]
        assert found[0].height == pytest.approx(origin + box.upper[2], abs=0.15)
        assert found[1].height < found[0].height
        assert (
            surfaces_below(
                np.array([900.0, 0.0, 0.0]),
                simulation.world.scenery,
                simulation.world.scenery.parts,
            )
            == ()
        )
    finally:
        simulation.close()
