"""Polygons are cut into triangles that cover them, and nothing besides."""

from __future__ import annotations

import itertools
import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from uwsim.assets import load_model
from uwsim.assets.loaders.obj_rewriting import rewrite
from uwsim.assets.loaders.polygons import MAX_CORNERS, cut_ears, triangulate
from uwsim.errors import AssetError

L = [(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)]
DART = [(0, 0), (2, 1), (0, 2), (0.5, 1)]
COMB = [
    (0, 0),
    (5, 0),
    (5, 2),
    (4, 2),
    (4, 1),
    (3, 1),
    (3, 2),
    (2, 2),
    (2, 1),
    (1, 1),
    (1, 2),
    (0, 2),
]
FRAME = [(0, 0), (3, 0), (3, 3), (0, 3), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
"""A square with a hole, which an edge connects with the outline."""
SHAPES = {"L": (L, 3.0), "dart": (DART, 1.5), "comb": (COMB, 8.0), "frame": (FRAME, 8.0)}


def area_of(points: Any, triangles: Any) -> float:
    a, b, c = np.moveaxis(np.asarray(points, np.float64)[np.asarray(triangles)], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=-1).sum() / 2)


def in_space(points: Any, turn: int = 0) -> np.ndarray[Any, Any]:
    """A polygon in a plane that is no coordinate plane, from another corner on."""
    flat = np.roll(np.asarray(points, np.float64), turn, axis=0)
    u, v = np.array([2, 1, 2]) / 3, np.array([-2, 2, 1]) / 3
    return flat[:, :1] * u + flat[:, 1:] * v + [1, 2, 3]


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("is_reversed", [False, True])
def test_the_triangles_cover_the_polygon_from_any_corner(name: str, is_reversed: bool) -> None:
    shape, area = SHAPES[name]
    for turn in range(len(shape)):
        points = in_space(shape[::-1] if is_reversed else shape, turn)
        triangles = cut_ears(points)
        assert len(triangles) == len(shape) - 2
        assert area_of(points, triangles) == pytest.approx(area)
        a, b, c = np.moveaxis(points[triangles], 1, 0)
        normals = np.cross(b - a, c - a)
        assert (normals @ normals.sum(axis=0) >= -1e-12).all()  # none is turned over


def test_random_stars_are_covered() -> None:
    random = np.random.default_rng(5)
    for n in (4, 7, 30, 200):
        angles = np.sort(random.uniform(0.0, 2 * math.pi, n))
        radii = random.uniform(0.2, 1.0, n)
        flat = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=-1)
        x, y = flat.T
        area = abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2
        points = in_space(flat)
        assert area_of(points, triangulate(points, np.array([n]))) == pytest.approx(area)


def test_convex_polygons_are_fans_in_their_order() -> None:
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    points = np.array([*square, *in_space(L), *square, *square[:3]], np.float64)
    triangles = triangulate(points, np.array([4, 6, 4, 3])).tolist()
    assert triangles[:2] == [[0, 1, 2], [0, 2, 3]]
    assert triangles[6:] == [[10, 11, 12], [10, 12, 13], [14, 15, 16]]
    assert set(itertools.chain(*triangles[2:6])) == set(range(4, 10))


@pytest.mark.parametrize("counts", [[0], [1], [2], [0, 3, 2]])
def test_what_is_no_polygon_has_no_triangle(counts: list[int]) -> None:
    points = np.zeros((sum(counts), 3))
    assert len(triangulate(points, np.array(counts))) == counts.count(3)


def test_a_polygon_that_crosses_itself_or_is_flat_ends() -> None:
    bow = np.array([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)], np.float64)
    assert len(cut_ears(bow)) == 2
    assert len(cut_ears(np.zeros((9, 3)))) == 7
    assert len(cut_ears(np.array([(i, 0, 0) for i in range(9)], np.float64))) == 7


def test_very_many_corners_do_not_cost_their_square() -> None:
    n = 2 * MAX_CORNERS
    angles = np.linspace(0.0, 2 * math.pi, n, endpoint=False)
    radii = np.where(np.arange(n) % 2, 1.0, 0.5)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles), 0 * angles], axis=-1)
    assert len(triangulate(points, np.array([n]))) == n - 2


DAE = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="{n3}">{numbers}</float_array><technique_common>
<accessor source="#a" count="{n}" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<{kind} count="1"><input semantic="VERTEX" source="#v" offset="0"/>{vcount}<p>{order}</p></{kind}>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def written(folder: Path, kind: str, points: np.ndarray[Any, Any]) -> Path:
    n, order = len(points), " ".join(map(str, range(len(points))))
    if kind == "obj":
        lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in points]
        text = "\n".join([*lines, "f " + " ".join(str(i + 1) for i in range(n))]) + "\n"
    elif kind == "obj, relative":
        lines = [f"v {x:.17g} {y:.17g} {z:.17g} # {x}" for x, y, z in points]
        corners = " ".join(f"{i - n}/{i + 1}/1" for i in range(n))
        texture = [f"vt {i} 0" for i in range(n)]
        text = "\n".join([*lines, *texture, "vn 0 0 1", f"  f\t{corners}", "v 9 9 9"]) + "\n"
    else:
        text = DAE.format(
            n=n,
            n3=3 * n,
            numbers=" ".join(f"{each:.17g}" for each in points.ravel()),
            kind=kind,
            vcount=f"<vcount>{n}</vcount>" if kind == "polylist" else "",
            order=order,
        )
    path = folder / f"polygon.{'obj' if kind.startswith('obj') else 'dae'}"
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("kind", ["obj", "obj, relative", "polylist", "polygons"])
def test_the_polygons_of_files_are_covered(name: str, kind: str, tmp_path: Path) -> None:
    """A fan covered the notches: an L had the area 4 instead of 3."""
    shape, area = SHAPES[name]
    (mesh,) = load_model(str(written(tmp_path, kind, in_space(shape)))).meshes
    assert area_of(mesh.vertices, mesh.triangles) == pytest.approx(area, rel=1e-6)


def test_numbers_of_an_obj_file_count_from_the_vertices_before_the_face(tmp_path: Path) -> None:
    path, triangle = tmp_path / "m.obj", "v {0} 0 0\nv {1} 0 0\nv {0} 1 0\nf -3 -2 -1\n"
    path.write_text(triangle.format(0, 1) + triangle.format(5, 7))
    (mesh,) = load_model(str(path)).meshes
    assert area_of(mesh.vertices, mesh.triangles) == pytest.approx(1.5)


@pytest.mark.parametrize(
    "face", ["f -3 -2 -4", "f 1 2 3 4 5 9", "f 1 2 x 4", "f 1 2 3 99999999999999999999"]
)
def test_a_corner_that_is_not_there_is_named(face: str, tmp_path: Path) -> None:
    path = tmp_path / "m.obj"
    path.write_text(f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}\n")
    with pytest.raises(AssetError, match=r"m\.obj:4: "):
        load_model(str(path))


def test_an_obj_file_with_the_line_ends_of_old_computers_is_read(tmp_path: Path) -> None:
    path = tmp_path / "m.obj"
    path.write_bytes(b"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r")
    assert load_model(str(path)).n_triangles == 1


@pytest.mark.parametrize(
    "line", [b"f" + b" " * 10**6, b"f " + b"1 " * 10**6 + b"x", b"v" + b" " * 10**6, b" " * 10**6]
)
def test_a_long_line_does_not_cost_its_square(line: bytes) -> None:
    began = time.thread_time()
    rewrite(b"v 0 0 0\n" + line + b"\nv 0 0 0 # -\n")
    assert time.thread_time() - began < 5.0
