"""<u:net>: the twines of a panel with holes, and the mesh that is made of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.support.short_trial import tank
from uwsim.assets import load_model
from uwsim.assets.netting import weave_net
from uwsim.errors import UnknownName
from uwsim.scene.object import NetSpec, ObjectSpec

NET = NetSpec(width=4.0, height=2.0, mesh_side=0.5)
"""A net of 5 level and 9 upright twines."""


def length_of(net: NetSpec) -> float:
    """Return the length of all twines [m]."""
    ends = net.twines
    return float(np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1]).sum())


def test_a_whole_panel_has_the_twines_of_its_meshes() -> None:
    assert len(NET.twines) == 5 + 9
    assert length_of(NET) == pytest.approx(5 * 4.0 + 9 * 2.0)
    assert np.abs(NET.twines[:, [0, 2]]).max() == 2.0
    assert np.abs(NET.twines[:, [1, 3]]).max() == 1.0


def test_a_hole_cuts_the_chords_of_its_circle() -> None:
    net = replace(NET, holes=(0.1, 0.2, 0.6))
    chords = [2.0 * math.sqrt(0.36 - (z - 0.2) ** 2) for z in (0.0, 0.5)]
    chords += [2.0 * math.sqrt(0.36 - (x - 0.1) ** 2) for x in (0.0, 0.5)]
    assert length_of(net) == pytest.approx(length_of(NET) - sum(chords))
    places = net.twines.reshape(-1, 2)
    assert np.hypot(places[:, 0] - 0.1, places[:, 1] - 0.2).min() >= 0.6 - 1e-9


def test_holes_that_overlap_or_reach_over_the_edge_leave_no_twine() -> None:
    net = replace(NET, holes=(0.0, 0.0, 0.6, 0.3, 0.0, 0.6, 2.0, 1.0, 0.4))
    for x, z, radius in net.circles.tolist():
        middles = 0.5 * (net.twines[:, :2] + net.twines[:, 2:])
        assert np.hypot(middles[:, 0] - x, middles[:, 1] - z).min() > radius


@pytest.mark.parametrize(
    ("holes", "message"),
    [
        ((1.0, 2.0), "has 2 numbers"),
        ((0.0, 0.0, 0.0), "radius of 0 or below"),
        ((0.0, 0.0, 9.0), "cuts away the whole net"),
    ],
)
def test_wrong_holes_are_an_error(holes: tuple[float, ...], message: str) -> None:
    (error,) = replace(NET, holes=holes).errors()
    assert message in error


def test_the_mesh_has_a_bar_for_each_twine() -> None:
    piece = load_model("objects/twine")
    model = weave_net(piece, np.eye(4), NET.twines)
    assert model.n_triangles == 14 * piece.n_triangles
    box = model.box
    assert box.upper == pytest.approx((2.005, 0.005, 1.005), abs=1e-3)
    for mesh in model.meshes:
        a, b, c = (mesh.vertices[mesh.triangles[:, k]].astype(np.float64) for k in range(3))
        face = np.cross(b - a, c - a)
        assert np.einsum("ij,ij->i", face, mesh.normals[mesh.triangles].sum(axis=1)).min() > 0.0


def test_measures_find_the_holes_in_the_world() -> None:
    panel = ObjectSpec(
        name="panel", file="objects/twine", position=(1.0, 2.0, 3.0), is_solid=False,
        orientation=(0.0, 0.0, math.pi / 2.0), net=replace(NET, holes=(0.5, 0.25, 0.1)),
    )  # fmt: skip
    scene = replace(tank(), objects=(panel,))
    world = open_scene(scene).world.measure_view.surroundings
    (hole,) = world.holes("panel").tolist()
    place = scene.world_from_localized.transform(np.array([[1.0, 2.5, 3.25]]))[0]
    assert hole == pytest.approx([*place.tolist(), 0.1])
    with pytest.raises(UnknownName, match="panel"):
        world.holes("pane")
