"""u:detections: reported places of holes, paired with the true ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import Pose
from uwsim.benchmark.measures import Detections, DetectionsSpec
from uwsim.errors import UnknownName
from uwsim.messages import PointCloud2, point_cloud

SPEC = DetectionsSpec(name="holes", target="auv", topic="/holes", net="net", tolerance=0.3)
HOLES = [(3.0, -1.0, -3.0, 0.2), (3.0, 1.0, -3.0, 0.1), (3.0, 1.4, -3.0, 0.1)]
"""The holes in W: centre and radius."""


def started(holes: list[tuple[float, ...]] | None = None) -> tuple[FakeWorld, Detections]:
    """Return a world with a vehicle at x = 1, y = -0.5 of L, and the measure after its start."""
    down = Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))
    world = FakeWorld({"auv": FakeBody((1.0, 0.5, -2.0))}, world_from_localized=down)
    world.net_holes["net"] = np.array(HOLES if holes is None else holes).reshape(-1, 4)
    measure = SPEC.bind(world)
    measure.start()
    return world, measure


def report(world: FakeWorld, measure: Detections, places: list[tuple[float, ...]]) -> None:
    """Report places in the navigation frame."""
    cloud = point_cloud(np.array(places).reshape(-1, 3))
    world.bus.publisher("/holes", PointCloud2)(cloud)
    world.advance()
    measure.update()


TRUE_PLACES = [(2.0, 1.5, 3.0), (2.0, -0.5, 3.0), (2.0, -0.9, 3.0)]
"""The holes in the navigation frame."""


def test_an_exact_report_finds_all_holes() -> None:
    world, measure = started()
    report(world, measure, TRUE_PLACES)
    details = measure.details
    assert (measure.value, details["precision"], details["recall"]) == (1.0, 1.0, 1.0)
    assert details["error"] == pytest.approx(0.0, abs=1e-6)


def test_a_place_beyond_the_tolerance_is_false_and_its_hole_missed() -> None:
    world, measure = started()
    report(world, measure, [(2.0, 1.5, 3.31), TRUE_PLACES[1]])
    details = measure.details
    assert (details["n_found"], details["n_missed"], details["n_false"]) == (1.0, 2.0, 1.0)
    assert (details["precision"], details["recall"]) == (0.5, 1 / 3)
    assert measure.value == pytest.approx(2.0 * 0.5 / 3.0 / (0.5 + 1.0 / 3.0))


def test_a_hole_is_found_once_and_the_nearest_pairs_are_formed_first() -> None:
    world, measure = started()
    report(world, measure, [(2.0, -0.6, 3.0), (2.0, -0.52, 3.0)])  # both within both tolerances
    details = measure.details
    assert (details["n_found"], details["n_false"]) == (2.0, 0.0)
    assert details["error"] == pytest.approx((0.02 + 0.3) / 2.0, abs=1e-6)
    report(world, measure, [(2.0, 1.5, 3.0), (2.0, 1.5, 3.1)])
    assert (measure.details["n_found"], measure.details["n_false"]) == (1.0, 1.0)


def test_without_a_report_nothing_is_found() -> None:
    _, measure = started()
    assert (measure.value, measure.details["recall"], measure.details["n_false"]) == (0.0, 0.0, 0.0)
    assert measure.reasons == {
        "precision": "nothing was reported", "error": "no hole was found",
    }  # fmt: skip


def test_an_empty_report_and_places_that_are_no_numbers() -> None:
    world, measure = started()
    report(world, measure, [])
    assert measure.details["n_false"] == 0.0
    report(world, measure, [(float("nan"), 0.0, 0.0)])
    assert (measure.details["n_found"], measure.details["n_false"]) == (0.0, 1.0)


def test_a_net_without_holes_has_no_score() -> None:
    _, measure = started(holes=[])
    assert (measure.value, measure.missing_reason) == (None, "the net has no holes")


def test_an_object_is_sought_where_it_is_at_the_start() -> None:
    world, _ = started()
    recorder = FakeBody((3.0, -1.0, -3.0))
    world.bodies["recorder"] = recorder
    measure = replace(SPEC, net=None, object_="recorder").bind(world)
    measure.start()
    assert (measure.value, measure.details["n_missed"]) == (0.0, 1.0)
    report(world, measure, [(2.0, 1.5, 3.2)])
    assert measure.value == 1.0
    assert measure.details["error"] == pytest.approx(0.2, abs=1e-6)
    report(world, measure, [(2.0, 1.5, 3.4)])
    assert (measure.value, measure.details["n_false"]) == (0.0, 1.0)


@pytest.mark.parametrize(("net", "sought"), [(None, None), ("net", "recorder")])
def test_either_a_net_or_an_object_is_sought(net: str | None, sought: str | None) -> None:
    (error,) = replace(SPEC, net=net, object_=sought).errors()
    assert error == "<u:detections> has one of <net> and <object>"


def test_an_object_that_is_no_net_is_unknown() -> None:
    with pytest.raises(UnknownName, match="u:net"):
        SPEC.bind(FakeWorld({"auv": FakeBody()}))
