from pathlib import Path

import pytest

from uwsim.assets import STAND_INS, load_model, primitive
from uwsim.errors import AssetError, AssetNotFound

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def test_a_file_comes_before_our_stand_in(tmp_path: Path) -> None:
    (tmp_path / "objects").mkdir()
    (tmp_path / "objects" / "torus.obj").write_text(TRIANGLE)
    model = load_model("objects/torus.osg", data_path=(tmp_path,))
    assert (model.source, model.n_triangles) == ("file", 1)


def test_a_readable_file_of_the_same_stem_is_taken_when_osgconv_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "thing.osg").write_text("Group {}")
    (tmp_path / "thing.obj").write_text(TRIANGLE)
    assert load_model("thing.osg", data_path=(tmp_path,)).n_triangles == 1


def test_an_openscenegraph_file_without_osgconv_names_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "thing.ive").write_bytes(b"\0")
    with pytest.raises(AssetError, match="apt-get install openscenegraph"):
        load_model("thing.ive", data_path=(tmp_path,))


def test_osgconv_is_asked_for_images_then_for_obj(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "osgconv"
    program.write_text(
        "#!/bin/sh\nfor last; do :; done\n"
        'case "$last" in *.obj) printf "v 0 0 0\\nv 2 0 0\\nv 0 2 0\\nf 1 2 3\\n" > "$last";;\n'
        '*) echo scene > "$last";; esac\n'
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    (tmp_path / "thing.osg").write_text("Group {}")
    (tmp_path / "thing.obj").write_text(TRIANGLE)  # the exact name wins when it can be read
    model = load_model("thing.osg", data_path=(tmp_path,))
    assert model.box.upper == (2.0, 2.0, 0.0)


@pytest.mark.parametrize(
    "name",
    [
        "objects/torus.osg",
        "data/objects/torus.ive",
        "objects/torus",
        " objects/torus.osg ",
        "package://uwsim/data/objects/torus.dae",
    ],
)
def test_a_stand_in_answers_to_its_relative_name_whatever_the_extension(name: str) -> None:
    assert load_model(name) is load_model("objects/torus.osg")


def test_a_name_that_nothing_has_is_refused_with_the_folders_searched(tmp_path: Path) -> None:
    with pytest.raises(AssetNotFound, match="objects/torsu") as caught:
        load_model("objects/torsu.osg", data_path=(tmp_path,))
    assert f"{tmp_path}, " in str(caught.value)
    assert "each also under data, data/scenes, data/vehicles, objects" in str(caught.value)
    assert "Did you mean 'objects/torus'" in str(caught.value)


def test_stand_ins_say_what_they_are() -> None:
    assert load_model("robot/PA10/pa10link3.osg").source == "labelled box"
    assert load_model("objects/amphora.osg").source == "stand-in"
    assert list(STAND_INS) == sorted(STAND_INS)


def test_primitives_are_centred_and_as_large_as_asked_for() -> None:
    assert primitive("box", (1.0, 2.0, 3.0)).box.upper == (0.5, 1.0, 1.5)
    assert primitive("cylinder", (0.5, 3.0)).box.upper == pytest.approx((0.5, 0.5, 1.5))
    assert primitive("sphere", (0.5,)).box.lower == pytest.approx((-0.5, -0.5, -0.5))
    assert primitive("box", (1.0, 1.0, 1.0), (1.0, 0.0, 0.0, 0.5)).meshes[0].colour == (1, 0, 0)


@pytest.mark.parametrize(
    ("kind", "size"),
    [("cone", (1.0,)), ("box", (1.0, 2.0)), ("sphere", (0.0,)), ("sphere", (float("nan"),))],
)
def test_a_primitive_that_cannot_be_is_refused(kind: str, size: tuple[float, ...]) -> None:
    with pytest.raises(AssetError):
        primitive(kind, size)
