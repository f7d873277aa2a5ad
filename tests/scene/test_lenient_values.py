"""Values that the original accepted: of its window, beyond a limit, in another spelling."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.checks import check_file
from uwsim.errors import Diagnostic, SceneError
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.urdf.reader import read_urdf

OBJECT = (
    "<object><name>o</name><file>objects/box.osg</file><position><x>0</x><y>0</y><z>0</z></position>"
    "<orientation><r>0</r><p>0</p><y>0</y></orientation>{}</object>"
)


def checked(folder: Path, body: str, *, strict: bool = False) -> list[Diagnostic]:
    file = folder / "scene.xml"
    file.write_text(f"<UWSimScene>\n{body}\n</UWSimScene>")
    return check_file(file, is_strict=strict)


@pytest.mark.parametrize(
    "body",
    [
        "<simParams><disableShaders>yes</disableShaders></simParams>",
        "<simParams><resw>0</resw><resh>-3</resh></simParams>",
        "<simParams><resw>wide</resw></simParams>",
        "<simParams><resh>1000000</resh></simParams>",
        "<simParams><physicsSolver>Bullet</physicsSolver></simParams>",
        "<simParams><physicsFrequency>0</physicsFrequency></simParams>",
        "<simParams><showTrajectory><lineStyle>2</lineStyle></showTrajectory></simParams>",
        "<camera><fov>200</fov></camera>",
        "<camera><fov>wide</fov><near>-</near></camera>",
        "<camera><aspectRatio>0</aspectRatio><position><x>1</x></position></camera>",
        "<camera><zoom>2</zoom></camera>",
        "<oceanState><windSpeed>strong</windSpeed><waveScale></waveScale></oceanState>",
        "<oceanState><choppyFactor>2,5</choppyFactor></oceanState>",
    ],
)
def test_what_concerns_the_window_alone_is_a_warning(body: str, tmp_path: Path) -> None:
    found = checked(tmp_path, body)
    assert {each.severity for each in found} == {"warning"}
    assert {each.line for each in found} == {2}
    scene = read_scene(tmp_path / "scene.xml")
    assert scene.sim_params.resw == SimParamsSpec().resw
    assert scene.camera is None or scene.camera.fov == 60.0


def test_with_strict_it_stays_an_error(tmp_path: Path) -> None:
    (error,) = checked(tmp_path, "<camera><fov>wide</fov></camera>", strict=True)
    assert error.severity == "error"


def test_what_concerns_the_water_is_an_error_as_before(tmp_path: Path) -> None:
    (error,) = checked(tmp_path, "<oceanState><fog><density>x</density></fog></oceanState>")[:1]
    assert error.severity == "error"


@pytest.mark.parametrize(
    ("inside", "read", "shown"),
    [
        ("<physics><mass>-2</mass></physics>", ("mass", 0.0), "<mass> is -2"),
        ("<physics><mass>7e12</mass></physics>", ("mass", 1e9), "<mass> is 7e+12"),
        (
            "<physics><mass>2</mass><inertia><x>1</x><y>3e9</y><z>2</z></inertia></physics>",
            ("inertia", (1, 1e9, 2)),
            "<y> of <inertia> is 3e+09; no quantity is beyond 1e+09",
        ),
        (
            "<physics><inertia><x>-4e11</x><y>0</y><z>0</z></inertia></physics>",
            ("inertia", (-1e9, 0, 0)),
            "<x> of <inertia> is -4e+11",
        ),
        ("<scaleFactor><x>1</x><y>2</y><z>0</z></scaleFactor>", ("scale", (1, 2, 1e-6)), "is 0"),
        (
            "<scaleFactor><x>5e7</x><y>1</y><z>1</z></scaleFactor>",
            ("scale", (1e6, 1, 1)),
            "<x> of <scaleFactor> is 5e+07",
        ),
    ],
)
def test_a_mass_or_a_size_beyond_a_limit_is_clamped(
    inside: str, read: tuple[str, object], shown: str, tmp_path: Path
) -> None:
    found = [each for each in checked(tmp_path, OBJECT.format(inside)) if shown in each.message]
    (thing,) = read_scene(tmp_path / "scene.xml").objects
    assert [each.severity for each in found] == ["warning"]
    assert "clamped to" in found[0].message
    values = {
        "scale": thing.scale_factor,
        "mass": thing.solid.mass,
        "inertia": thing.solid.inertia,
    }
    assert values[read[0]] == read[1]


def test_a_mirrored_object_stays_an_error(tmp_path: Path) -> None:
    mirrored = OBJECT.format("<scaleFactor><x>-1</x><y>1</y><z>1</z></scaleFactor>")
    checked(tmp_path, mirrored)
    with pytest.raises(SceneError, match="<x> of <scaleFactor> is '-1'"):
        read_scene(tmp_path / "scene.xml")


@pytest.mark.parametrize(
    ("link", "number", "limited"),
    [
        ('<inertial><mass value="5e9"/></inertial>', "mass", 1e6),
        ('<inertial><mass value="-4"/></inertial>', "mass", 0.0),
        ('<visual><geometry><box size="1 2e7 1"/></geometry></visual>', "size", (1, 1e6, 1)),
        ('<visual><geometry><sphere radius="3e6"/></geometry></visual>', "size", (2e6,) * 3),
    ],
)
def test_so_is_that_of_a_robots_link(
    link: str, number: str, limited: object, tmp_path: Path
) -> None:
    file = tmp_path / "r.urdf"
    file.write_text(f'<robot name="r">\n<link name="a">{link}</link></robot>')
    (found,) = [each for each in check_file(file) if "clamped" in each.message]
    assert (found.severity, found.line) == ("warning", 2)
    (read,) = read_urdf(file).links
    value = read.mass if number == "mass" else read.visuals[0].size
    assert value == limited


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("compoundtrimesh", "compound trimesh"),
        ("CompoundTriMesh", "compound trimesh"),
        ("compound_box", "compound box"),
        ("Compound-Cylinder", "compound cylinder"),
        ("SPHERE", "sphere"),
        ("tri mesh", "trimesh"),
        ("trimesh", "trimesh"),
    ],
)
def test_another_spelling_of_a_shape_keeps_its_meaning(
    written: str, meant: str, tmp_path: Path
) -> None:
    shape = f"<physics><collisionShapeType>{written}</collisionShapeType></physics>"
    told = [each.message for each in checked(tmp_path, OBJECT.format(shape))]
    (thing,) = read_scene(tmp_path / "scene.xml").objects
    assert thing.solid.collision_shape_type == meant
    assert any(f"read as {meant!r}" in each for each in told) is (written != meant)


@pytest.mark.parametrize(
    ("shape", "near"), [("shpere", " Did you mean 'sphere'?"), ("convex hull", "")]
)
def test_an_unknown_shape_is_an_error_with_the_words_and_never_a_box(
    shape: str, near: str, tmp_path: Path
) -> None:
    body = OBJECT.format(f"<physics><collisionShapeType>{shape}</collisionShapeType></physics>")
    (error,) = [each for each in checked(tmp_path, body) if each.severity == "error"]
    assert f"is {shape!r}; expected one of 'box', 'sphere', 'compound box'" in error.message
    assert near.rstrip("?") in error.message


def test_a_solver_in_another_spelling_is_that_solver(tmp_path: Path) -> None:
    checked(tmp_path, "<simParams><physicsSolver>sequential_impulse</physicsSolver></simParams>")
    assert read_scene(tmp_path / "scene.xml").sim_params.physics_solver == "SequentialImpulse"
