"""u:mapError: the error of a published map, against surfaces whose heights are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from tests.support.opened import open_scene
from tests.support.short_trial import tank
from uwsim.base.geometry import Array, Pose
from uwsim.benchmark.measures import MapError, MapErrorSpec
from uwsim.benchmark.measures.reports.map_error import PlaceSpec
from uwsim.messages import PointCloud2, point_cloud
from uwsim.rays import Hits
from uwsim.scene.object import ObjectSpec

SPEC = MapErrorSpec(
    name="map", target="auv", topic="/map", low=PlaceSpec(x=0.0, y=0.0),
    high=PlaceSpec(x=4.0, y=2.0), cell=1.0, tolerance=0.25,
)  # fmt: skip
DOWN = np.diag([1.0, -1.0, -1.0])
"""The rotation from L, whose z points down, to W."""


class SlopeUnderVehicle:
    """The rays of a slope of the height 0.1 x - 10 m, and of a vehicle at the height -3 m."""

    vehicles = ("auv", "")

    def cast(self, world_from_sensor: Pose, directions: Array, reach: float, starts: Array) -> Hits:
        x, _, z = world_from_sensor.position.tolist()
        is_above = starts[0] < z + 3.0
        distance = z + 3.0 if is_above else z - (0.1 * x - 10.0)
        return Hits(np.array([distance]), np.zeros((1, 3)), np.array([0 if is_above else 1]))


def bound(spec: MapErrorSpec = SPEC) -> tuple[FakeWorld, MapError]:
    """Return a world with a vehicle at x = 5, y = -2 of L, and the measure after its start."""
    body = FakeBody((5.0, 2.0, -3.0))
    world = FakeWorld({"auv": body}, world_from_localized=Pose(np.zeros(3), DOWN))
    world.rays = SlopeUnderVehicle()  # type: ignore[assignment]
    measure = spec.bind(world)
    measure.start()
    return world, measure


def send(world: FakeWorld, measure: MapError, points: list[tuple[float, float, float]]) -> None:
    world.bus.publisher("/map", PointCloud2)(point_cloud(np.array(points)))
    world.advance()
    measure.update()


def true_depth(x: float) -> float:
    """Return the depth of the slope at a place of the navigation frame."""
    return 10.0 - 0.1 * (x + 5.0)


def test_an_exact_map_has_no_error_and_covers_its_cells() -> None:
    world, measure = bound()
    send(world, measure, [(x, 0.5, true_depth(x)) for x in (0.5, 1.5, 2.5, 3.5)])
    assert measure.value == pytest.approx(0.0, abs=1e-6)
    assert measure.details["coverage"] == measure.details["accurate"] == 0.5


def test_errors_are_heights_averaged_in_a_cell_before_their_squares() -> None:
    world, measure = bound()
    cell = [(0.2, 0.5, true_depth(0.2) - 0.5), (0.8, 0.5, true_depth(0.8) + 0.1)]  # 0.5, -0.1
    send(world, measure, [*cell, (1.5, 0.5, true_depth(1.5) + 0.4)])
    details = measure.details
    assert measure.value == pytest.approx(math.sqrt((0.2**2 + 0.4**2) / 2.0), abs=1e-6)
    assert details["bias"] == pytest.approx(-0.1, abs=1e-6)
    assert details["max"] == pytest.approx(0.4, abs=1e-6)
    assert (details["coverage"], details["accurate"]) == (2 / 8, 1 / 8)


def test_a_newer_map_replaces_the_one_before() -> None:
    world, measure = bound()
    send(world, measure, [(0.5, 0.5, 0.0)])
    send(world, measure, [(1.5, 1.5, true_depth(1.5))])
    assert measure.value == pytest.approx(0.0, abs=1e-6)
    assert measure.details["n_maps"] == 2.0


def test_points_outside_of_the_area_or_without_a_number_do_not_count() -> None:
    world, measure = bound()
    send(world, measure, [(-0.1, 0.5, 9.0), (4.1, 0.5, 9.0), (1.0, 2.1, 9.0), (1.0, 1.0, math.nan)])
    assert measure.value is None
    assert measure.missing_reason == "no point of the map on '/map' lies in the area"
    assert measure.details["coverage"] == 0.0


def test_without_a_map_nothing_is_covered() -> None:
    _, measure = bound()
    assert measure.missing_reason == "no map on '/map'"
    assert (measure.details["coverage"], measure.details["accurate"]) == (0.0, 0.0)
    assert measure.reasons == dict.fromkeys(("bias", "max"), "no map on '/map'")


def test_an_area_without_a_cell_is_an_error() -> None:
    assert list(replace(SPEC, high=PlaceSpec(x=0.5, y=2.0)).errors()) == [
        "<high> is not a cell of 1 m beyond <low>"
    ]
    assert "more than 1000000 cells" in replace(SPEC, cell=1e-4).errors()[0]


def test_the_surface_of_a_scene_is_that_below_the_vehicle() -> None:
    position = tank().vehicles[0].position
    box = ObjectSpec(
        name="box", file="objects/box", position=(position[0], position[1], position[2] + 2.0),
        scale_factor=(8.0, 8.0, 1.0), is_solid=False,
    )  # fmt: skip
    simulation = open_scene(replace(tank(), objects=(box,)))
    measure = replace(SPEC, target="girona500").bind(simulation.world.measure_view)
    measure.start()
    top = position[2] + 1.5  # the upper side of the box of 1 m
    simulation.bus.publisher("/map", PointCloud2)(point_cloud(np.array([[0.5, 0.5, top - 0.1]])))
    simulation.advance(0.01)
    measure.update()
    assert measure.value == pytest.approx(0.1, abs=0.02)  # its edges are round
