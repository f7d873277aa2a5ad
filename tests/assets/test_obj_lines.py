"""Broken OBJ files: the line that is wrong, and what was expected there."""

from pathlib import Path

import pytest

from tests.support.fuzzed_obj import trial
from uwsim.assets import model_read_error
from uwsim.assets.loaders import read_model
from uwsim.errors import AssetError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n", "m.obj:1: 'v 0 0': has 2 of the 3 numbers expected"),
        (f"{TRIANGLE}f 1 2 9\n", "m.obj:4: 'f 1 2 9': there is no v 9; there are 3 v"),
        (f"{TRIANGLE}f -1 -2 -4\n", "m.obj:4: 'f -1 -2 -4': there is no v -4"),
        (f"{TRIANGLE}f 1/x 2 3\n", "m.obj:4: .*'1/x'; expected numbers of vertex"),
        ("v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", "m.obj:2: .*'zero'; expected a number"),
    ],
)
def test_the_line_is_named_and_what_was_expected(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "m.obj"
    file.write_text(text)
    with pytest.raises(AssetError, match=said):
        read_model(file, name="m")


def test_a_face_may_come_before_its_vertices(tmp_path: Path) -> None:
    (tmp_path / "m.obj").write_text(f"f 1 2 3\n{TRIANGLE}f 1 2 9\n")
    with pytest.raises(AssetError, match=r"m.obj:5: .*there is no v 9"):
        read_model(tmp_path / "m.obj", name="m")


def test_damaged_files_are_one_clean_line(tmp_path: Path) -> None:
    wrong = {seed: said for seed in range(100) if (said := trial(tmp_path, seed)) is not None}
    assert wrong == {}


def test_what_is_in_a_mesh_is_looked_at_before_it_is_needed(tmp_path: Path) -> None:
    (tmp_path / "m.obj").write_text("v 0 0\nf 1 1 1\n")
    said = model_read_error("m.obj", named_by=tmp_path)
    assert said == f"{tmp_path / 'm.obj'}:1: 'v 0 0': has 2 of the 3 numbers expected"
    (tmp_path / "m.obj").write_text(f"{TRIANGLE}f 1 2 3\n")
    assert model_read_error("m.obj", named_by=tmp_path) == ""
    assert model_read_error("nowhere.obj", named_by=tmp_path) == ""
