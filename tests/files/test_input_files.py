import ast
import os
from pathlib import Path

import pytest

from uwsim.base.files.input_files import (
    InputFile,
    compute_hash,
    hashes_by_name,
    portable_name,
    read_bytes,
    record_inputs,
)
from uwsim.errors import AssetError

PACKAGE = Path(__file__).parents[2] / "src" / "uwsim"
READERS = ("assets/loaders", "currents", "dialect", "physics", "scene", "simulation")
"""What reads the files that a scene or a benchmark names."""
OTHERWISE = {
    "assets/loaders/by_trimesh.py: read_bytes",  # what osgconv made of a file that is recorded
    "assets/loaders/materials.py: open",  # an image, of bytes that were read and recorded
    "assets/loaders/mesh_cache.py: read_bytes",  # sources of uwsim, for its cache's key
    "scene/hydrodynamics/vehicle_sets.py: open",  # only lists names for an error message
}


def test_what_is_read_inside_is_recorded_with_its_hash(tmp_path: Path) -> None:
    file = tmp_path / "sea.csv"
    file.write_bytes(b"x,u\n0,1\n")
    read_bytes(file)
    with record_inputs() as outer, record_inputs() as inner:
        assert read_bytes(file, name="data/sea.csv") == b"x,u\n0,1\n"
        read_bytes(file, name="data/sea.csv")
    read_bytes(file)
    assert inner == outer == [InputFile("data/sea.csv", compute_hash(file))]


def test_a_file_above_the_limit_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "large"
    file.write_bytes(b"12345")
    assert read_bytes(file, at_most=5) == b"12345"
    with pytest.raises(AssetError, match="is larger than"):
        read_bytes(file, at_most=4)


def test_only_regular_files_are_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (Path("/dev/zero"), tmp_path / "pipe", tmp_path):
        with pytest.raises(AssetError, match="is not a regular file"):
            read_bytes(path)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("objects/box.obj", "objects/box.obj"),
        ("./objects//box.obj", "objects/box.obj"),
        ("objects\\box.obj", "objects/box.obj"),
        ("/home/me/box.obj", "box.obj"),
        ("~/box.obj", "box.obj"),
        ("C:\\models\\box.obj", "box.obj"),
        (Path("/home/me/box.obj"), "box.obj"),
    ],
)
def test_no_folder_of_this_machine_is_in_a_recorded_name(name: str | Path, said: str) -> None:
    assert portable_name(name) == said


def test_two_files_of_one_name_are_both_kept() -> None:
    files = [InputFile("a.obj", "sha256:2"), InputFile("a.obj", "sha256:1")]
    assert (
        hashes_by_name(files)
        == hashes_by_name(files[::-1])
        == {"a.obj": "sha256:1", "a.obj (2)": "sha256:2"}
    )


def test_nothing_else_opens_input_files() -> None:
    found = set()
    for room in READERS:
        for path in sorted((PACKAGE / room).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text())):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                    called = node.func.attr
                elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                    called = "open" if node.func.id == "open" else ""
                else:
                    continue
                is_own = ast.unparse(node.func).startswith(("self.", "simulation."))
                if called in ("open", "read_bytes", "read_text") and not is_own:
                    found.add(f"{path.relative_to(PACKAGE).as_posix()}: {called}")
    assert found == OTHERWISE
