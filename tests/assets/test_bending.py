"""Models bent along lines, against cylinders and circles."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.assets import load_model
from uwsim.assets.bending import RAMP, BentLine, bend_model, compute_burial
from uwsim.base.numerics.polyline import round_corners
from uwsim.errors import AssetError

NOT_BURIED, DOWN = (0.0, 0.0, 1), np.array([0.0, 0.0, -1.0])
ROD = np.array([[0.2, 0, 0, 0], [0, 0, 0.1, 0], [0, -0.2, 0, 0], [0, 0, 0, 1.0]])
"""A cylinder of 0.2 m in diameter and 0.1 m in length along y."""


def test_a_straight_rod_is_a_cylinder_from_end_to_end() -> None:
    line = BentLine(np.array([[0.0, 1.0, 0.0], [0.0, 4.0, 0.0]]), NOT_BURIED, DOWN)
    piece = load_model("objects/cylinder.osg")
    model = bend_model(piece, ROD, line)
    assert model.box.lower == pytest.approx((-0.1, 1.0, -0.1), abs=1e-6)
    assert model.box.upper == pytest.approx((0.1, 4.0, 0.1), abs=1e-6)
    [mesh], [source] = model.meshes, piece.meshes
    assert len(mesh.triangles) == 30 * len(source.triangles)
    corners = mesh.vertices[mesh.triangles]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.sum(outward * mesh.normals[mesh.triangles[:, 0]], axis=1) > 0.0).all()


def test_a_bent_rod_keeps_its_radius_around_a_circle() -> None:
    corner = np.array([[0.0, -4.0, 0.0], [0.0, 0.0, 0.0], [4.0, 0.0, 0.0]])
    line = BentLine(round_corners(corner, 2.0, 0.01), NOT_BURIED, DOWN)
    vertices = bend_model(load_model("objects/cylinder.osg"), ROD, line).meshes[0].vertices
    inside = vertices[(vertices[:, 0] > 0.3) & (vertices[:, 1] < -0.3)]
    from_axis = np.hypot(np.hypot(inside[:, 0] - 2.0, inside[:, 1] + 2.0) - 2.0, inside[:, 2])
    assert from_axis.max() == pytest.approx(0.1, abs=2e-4)


def test_the_buried_share_of_a_line_is_at_the_depth_of_burial() -> None:
    lengths = np.linspace(0.0, 20.0, 20001)
    depths = compute_burial(lengths, 20.0, 0.4, 0.3, 2)
    assert np.mean(depths == 0.4) == pytest.approx(0.3, abs=1e-3)
    assert np.mean(depths > 0.0) == pytest.approx(0.3 + 4.0 * RAMP / 20.0, abs=1e-3)
    assert depths[5000] == depths[15000] == 0.4  # the middles of the halves
    assert not compute_burial(lengths, 20.0, 0.4, 0.0, 2).any()


def test_a_flat_piece_and_too_many_copies_are_errors() -> None:
    line = BentLine(np.array([[0.0, 0.0, 0.0], [0.0, 1000.0, 0.0]]), NOT_BURIED, DOWN)
    with pytest.raises(AssetError, match="extent along y"):
        bend_model(load_model("objects/cylinder.osg"), np.diag([1.0, 1e-6, 1.0, 1.0]), line)
    with pytest.raises(AssetError, match="copies along the line"):
        bend_model(load_model("objects/cylinder.osg"), np.diag([1.0, 0.01, 1.0, 1.0]), line)
