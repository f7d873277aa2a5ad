"""What a perfect tracker would score is measured by the run itself."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.support.short_benchmark import bench_of, write_benchmark
from uwsim.runs.executors.executor import run_all
from uwsim.runs.trial.error_floor import (
    crossing,
    homography,
    largest_error_floors,
    transform_points,
)

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
SEEN = np.array([[3.0, 4.0], [80.0, 9.0], [70.0, 66.0], [-5.0, 50.0]])


def test_a_homography_is_opencvs() -> None:
    found = homography(SQUARE.reshape(8), SEEN.reshape(8))
    theirs = cv2.getPerspectiveTransform(SQUARE.astype(np.float32), SEEN.astype(np.float32))
    assert found is not None
    assert found == pytest.approx(theirs, rel=1e-5)
    assert transform_points(found, SQUARE) == pytest.approx(SEEN)
    inner = np.array([[0.5, 0.25], [0.1, 0.9]])
    assert transform_points(found, inner) == pytest.approx(
        cv2.perspectiveTransform(inner[None], found)[0], rel=1e-9
    )


def test_points_on_a_line_have_no_homography() -> None:
    assert homography(np.array([0.0, 0, 1, 1, 2, 2, 3, 3]), SEEN.reshape(8)) is None


def test_the_diagonals_of_a_square_seen_askew_cross_where_its_centre_is() -> None:
    found = homography(SQUARE, SEEN)
    assert found is not None
    assert crossing(SEEN) == pytest.approx(transform_points(found, np.array([[0.5, 0.5]]))[0])


def test_of_several_units_the_largest_floor_counts() -> None:
    facts = [{"floor_a": [1.0, "px"], "S": [3.0, "1"]}, {"floor_a": [2.0, "px"]}, {}]
    assert largest_error_floors(facts) == {"floor_a": [2.0, "px"]}


@pytest.mark.parametrize(
    ("scene", "least", "most"),
    [("visibility-scene.xml", 0.0, 1e-6), ("visibility-moving-scene.xml", 0.2, 4.0)],
)
def test_a_tracker_in_clear_water_scores_about_the_floor(
    scene: str, least: float, most: float, tmp_path: Path
) -> None:
    file = write_benchmark(tmp_path, "1.0")
    file.write_text(file.read_text().replace("visibility-scene.xml", scene))
    [result] = run_all([bench_of(file, tmp_path / "o", levels=["fog=0"])])
    found = result.fact("floor_corners")
    assert found is not None
    assert least <= found[0] <= most
    assert found[1] == "px"
    scored = result.numbers("corners")[0]
    assert scored == pytest.approx(found[0], abs=0.5)
