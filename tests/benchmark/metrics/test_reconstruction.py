"""Points and a box: classes, error and coverage, against hand-made clouds and the plain rule."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.base.geometry import rotation_from_rpy, rotation_z
from uwsim.benchmark.metrics.coverage import Coverage, original_cells, whole_cells
from uwsim.benchmark.metrics.reconstruction import Reconstruction, rotate_box, upright_rotation
from uwsim.errors import BadSetting
from uwsim.world import Box

BOX = Box((-0.5, -0.3, 0.0), (0.5, 0.3, 0.4))
EXACT = 1e-9


def rebuilt(points: np.ndarray, box: Box = BOX, lod: float = 0.1) -> Reconstruction:
    made = Reconstruction(box, Coverage(box, lod))
    made.add(points, np.eye(3), np.zeros(3))
    return made


def plain_rule(points: np.ndarray, box: Box) -> tuple[list[float], int, int]:
    """Errors of the inliers, number of outliers, number on the ground: the rule, point by point."""
    errors, outliers, ground = [], 0, 0
    for p in points.tolist():
        beyond = [max(lo - c, c - hi, 0.0) for c, lo, hi in zip(p, box.lower, box.upper)]  # noqa: B905
        planes = [
            min(abs(c - lo), abs(c - hi))
            for c, lo, hi in zip(p, box.lower, box.upper)  # noqa: B905
        ]
        d = max(math.hypot(*beyond), min(planes))
        g = abs(p[2] - box.lower[2])
        if g < d and g <= 0.10:
            ground += 1
        elif d >= 0.15:
            outliers += 1
        else:
            errors.append(d)
    return errors, outliers, ground


def plain_coverage(points: np.ndarray, box: Box, lod: float) -> tuple[int, int]:
    """Nodes marked on five faces, and all of them: one by one."""
    sizes, counts = zip(
        *(whole_cells(hi - lo, lod) for lo, hi in zip(box.lower, box.upper)),  # noqa: B905
        strict=True,
    )

    def is_on_face(node: tuple[int, ...]) -> bool:
        x, y, z = node
        return x in (0, counts[0] - 1) or y in (0, counts[1] - 1) or z == counts[2] - 1

    nodes = {n for n in itertools.product(*(range(c) for c in counts)) if is_on_face(n)}
    marked = set()
    for p in points.tolist():
        grid = [(c - lo) / size for c, lo, size in zip(p, box.lower, sizes)]  # noqa: B905
        marked |= set(itertools.product(*({math.floor(c), math.ceil(c)} for c in grid)))
    return len(marked & nodes), len(nodes)


def test_each_kind_of_point_by_hand() -> None:
    points = np.array(
        [
            [0.52, 0.0, 0.2],  # 2 cm in front of a face
            [0.48, 0.0, 0.2],  # 2 cm behind it
            [0.0, 0.0, 0.45],  # 5 cm over the top
            [0.53, 0.34, 0.3],  # 5 cm from an edge
            [1.5, 0.0, 0.03],  # on the ground, far away
            [0.0, 0.0, 0.01],  # inside, 1 cm over the bottom face: part of that
            [0.65, 0.0, 0.2],  # 15 cm away: the first outlier
            [0.0, 0.0, 0.2],  # deep inside, 20 cm from every face
            [2.0, 2.0, 2.0],
        ]
    )
    made = rebuilt(points)
    assert (made.n_inliers, made.n_outliers, made.n_ground) == (5, 3, 1)
    errors = [0.02, 0.02, 0.05, 0.05, 0.01]
    assert made.mean == pytest.approx(np.mean(errors), abs=EXACT)
    assert made.variance == pytest.approx(np.var(errors, ddof=1), abs=EXACT)
    assert made.outlier_share == pytest.approx(3 / 8, abs=EXACT)


def test_points_on_the_surface_have_no_error() -> None:
    sides = np.array([[0.5, y, z] for y in (-0.3, 0.0, 0.3) for z in (0.1, 0.25, 0.4)])
    made = rebuilt(sides)
    assert (made.mean, made.variance, made.outlier_share) == (0.0, 0.0, 0.0)


def test_without_points_there_is_nothing_and_nothing_is_divided_by_minus_one() -> None:
    made = rebuilt(np.empty((0, 3)))
    assert (made.mean, made.variance, made.outlier_share) == (None, None, None)
    assert made.coverage == 0.0
    one = rebuilt(np.array([[0.5, 0.0, 0.2]]))
    assert (one.mean, one.variance) == (0.0, None)


def test_what_is_no_finite_number_is_skipped_whichever_coordinate_it_is() -> None:
    points = np.array(
        [
            [np.nan, 0.0, 0.2],
            [0.0, np.nan, 0.2],
            [0.0, 0.0, -np.inf],
            [0.0, 1e300, 0.0],
            [0.52, 0.0, 0.2],
        ]
    )
    made = rebuilt(points)
    assert (made.n_skipped, made.n_inliers) == (4, 1)
    assert made.mean == pytest.approx(0.02, abs=EXACT)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 60), st.floats(0.02, 0.5))
def test_all_at_once_is_as_one_by_one(seed: int, n: int, lod: float) -> None:
    random = np.random.default_rng(seed)
    points = random.uniform((-0.8, -0.6, -0.2), (0.8, 0.6, 0.7), (n, 3))
    made = rebuilt(points, lod=lod)
    errors, outliers, ground = plain_rule(points, BOX)
    assert (made.n_inliers, made.n_outliers, made.n_ground) == (len(errors), outliers, ground)
    if errors:
        assert made.mean == pytest.approx(np.mean(errors), abs=EXACT)
    if len(errors) > 1:
        assert made.variance == pytest.approx(np.var(errors, ddof=1), abs=EXACT)
    marked, nodes = plain_coverage(points, BOX, lod)
    assert made.coverage == pytest.approx(marked / nodes, abs=EXACT)


def test_clouds_add_up_as_if_they_were_one() -> None:
    points = np.random.default_rng(3).uniform(-0.6, 0.6, (100_000, 3))
    at_once, in_pieces = rebuilt(points), Reconstruction(BOX, Coverage(BOX, 0.1))
    for piece in np.array_split(points, 7):
        in_pieces.add(piece, np.eye(3), np.zeros(3))
    for name in ("n_inliers", "n_outliers", "n_ground", "coverage"):
        assert getattr(in_pieces, name) == getattr(at_once, name)
    assert in_pieces.mean == pytest.approx(at_once.mean, abs=EXACT)
    assert in_pieces.variance == pytest.approx(at_once.variance, abs=EXACT)


def test_a_box_whose_five_faces_were_all_seen_is_covered() -> None:
    sizes = [np.linspace(lo, hi, n) for lo, hi, n in zip(BOX.lower, BOX.upper, (11, 7, 5))]  # noqa: B905
    nodes = np.array(list(itertools.product(*sizes)))
    on_face = (
        (np.abs(np.abs(nodes[:, 0]) - 0.5) < 1e-12)
        | (np.abs(np.abs(nodes[:, 1]) - 0.3) < 1e-12)
        | (np.abs(nodes[:, 2] - 0.4) < 1e-12)
    )
    made = rebuilt(nodes[on_face])
    assert made.coverage == 1.0
    assert Coverage(BOX, 0.1).n_nodes == int(on_face.sum()) == 11 * 7 * 5 - 9 * 5 * 4
    # one face alone: nx ny nodes of the top
    top = rebuilt(nodes[np.abs(nodes[:, 2] - 0.4) < 1e-12])
    assert top.coverage == pytest.approx(77 / 205, abs=EXACT)


def test_the_bottom_face_counts_for_nothing_but_its_edges_do() -> None:
    inside = rebuilt(np.array([[0.03, 0.02, 0.0], [0.03, 0.02, 0.05]]))
    assert inside.coverage == 0.0
    edge = rebuilt(np.array([[0.5, 0.05, 0.0]]))
    assert edge.coverage == pytest.approx(2 / 205, abs=EXACT)


def test_the_original_counts_other_nodes() -> None:
    box, here = Box((0.0, 0.0, 0.0), (1.0, 0.5, 0.375)), np.array([[1.0], [0.0625], [0.0]])
    ours, original = Coverage(box, 0.125), Coverage(box, 0.125, is_original=True)
    assert ours.counts == original.counts == (9, 5, 4)
    assert ours.n_nodes == 9 * 5 + 2 * 9 * 4 + 2 * 5 * 4 - 2 * 9 - 2 * 5 - 4 * 4 + 4
    assert original.n_nodes == 2 * 9 * 5 + 9 * 4 + 2 * 5 * 4 - 2 * 9 - 4 * 5 - 2 * 4 + 4
    ours.mark(here)
    original.mark(here)
    assert (ours.share, original.share) == (pytest.approx(2 / 117), pytest.approx(2 / 124))


def test_a_cell_is_not_lost_in_rounding_except_in_the_original() -> None:
    assert whole_cells(0.3, 0.1) == (pytest.approx(0.1), 4)
    assert original_cells(0.3, 0.1) == (pytest.approx(0.15), 3)
    assert whole_cells(0.35, 0.1) == (pytest.approx(0.35 / 3), 4)
    assert original_cells(0.375, 0.125) == whole_cells(0.375, 0.125) == (0.125, 4)


def test_a_box_thinner_than_a_cell_has_one_cell_and_in_the_original_one_node() -> None:
    assert whole_cells(0.05, 0.1) == (0.05, 2)
    assert original_cells(0.05, 0.1) == (math.inf, 1)
    assert whole_cells(0.0, 0.1) == original_cells(0.0, 0.1) == (0.1, 1)
    sheet = Box((0.0, 0.0, 0.0), (0.0, 0.2, 0.2))
    assert Coverage(sheet, 0.1).n_nodes == 9
    assert rebuilt(np.array([[0.0, 0.1, 0.1]]), sheet).coverage == pytest.approx(1 / 9)
    flat = Box((0.0, 0.0, 0.0), (0.2, 0.2, 0.0))
    assert rebuilt(np.array([[0.1, 0.1, 0.0]]), flat).coverage == pytest.approx(1 / 9)


def test_too_fine_a_grid_is_refused_before_it_fills_the_memory() -> None:
    with pytest.raises(BadSetting, match=r"<levelOfDetail> 0.003 m .* 50 x 50 x 3 m; choose a"):
        Coverage(Box((0.0, 0.0, 0.0), (50.0, 50.0, 3.0)), 0.003)


def test_quarter_turns_are_followed_and_smaller_ones_rounded() -> None:
    for roll, pitch, yaw in itertools.product(range(4), repeat=3):
        quarter = rotation_from_rpy(*(np.pi / 2 * np.array([roll, pitch, yaw])))
        assert np.allclose(upright_rotation(quarter), quarter, atol=1e-12)
        tilted = quarter @ rotation_from_rpy(0.2, -0.3, 0.25)
        assert np.allclose(upright_rotation(tilted), quarter, atol=1e-12)


@settings(max_examples=40)
@given(*[st.floats(-np.pi, np.pi)] * 3)
def test_the_last_row_is_the_axis_that_points_most_upwards(r: float, p: float, y: float) -> None:
    rotation = rotation_from_rpy(r, p, y)
    turned = upright_rotation(rotation)
    assert np.array_equal(np.abs(turned).sum(axis=0), [1.0, 1.0, 1.0])
    assert np.array_equal(np.abs(turned).sum(axis=1), [1.0, 1.0, 1.0])
    up = rotation[2] @ turned[2]
    assert up == pytest.approx(np.abs(rotation[2]).max())


def test_the_corners_of_a_box_turned_by_45_degrees_make_no_box_around_it() -> None:
    turned = rotate_box(BOX, rotation_z(np.pi / 4))
    assert turned.upper[0] == pytest.approx(0.2 * math.sqrt(0.5))
    quarter = rotate_box(BOX, rotation_z(np.pi / 2))
    assert quarter.lower == pytest.approx((-0.3, -0.5, 0.0))
    assert quarter.upper == pytest.approx((0.3, 0.5, 0.4))
