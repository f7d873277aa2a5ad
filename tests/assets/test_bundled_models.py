"""The bundled GLB files: what the script writes, valid glTF, and the arrays that results name."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from scripts.models.build import FILES, build_file
from scripts.models.stand_ins.blackbox import face
from tests.support.gltf_structure import structure_errors
from uwsim.assets import BUNDLED_MODELS, STAND_INS, load_model
from uwsim.assets.bundled_models import FOLDER
from uwsim.assets.stand_ins import BundledModel

HASHES: dict[str, str] = json.loads(Path(__file__).with_name("stand_in_hashes.json").read_text())
"""The sha256 of each stand-in that results of earlier versions recorded."""
REBUILT = ("objects/amphora", "objects/fittings", "robot/ARM5E")
"""The files that are made anew in a quick test."""
MAX_MEGABYTES = 15.0


def tree_of(data: bytes) -> dict[str, Any]:
    tree: dict[str, Any] = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    return tree


def test_stand_ins_keep_the_arrays_that_old_results_name() -> None:
    assert {name: load_model(name).sha256 for name in STAND_INS} == HASHES


@pytest.mark.parametrize("file", REBUILT)
def test_the_script_writes_the_same_bytes(file: str) -> None:
    assert build_file(file) == (FOLDER / f"{file}.glb").read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("file", [file for file in FILES if file not in REBUILT])
def test_the_script_writes_the_same_bytes_of_large_files(file: str) -> None:
    assert build_file(file) == (FOLDER / f"{file}.glb").read_bytes()


def test_images_that_a_caller_made_before_have_the_same_bytes() -> None:
    face()  # without the deterministic mode of OpenCV
    assert build_file("objects/blackbox") == (FOLDER / "objects/blackbox.glb").read_bytes()


def test_every_file_is_made_by_the_script_and_is_named() -> None:
    files = sorted(path.relative_to(FOLDER).as_posix() for path in FOLDER.rglob("*.*"))
    assert files == sorted(f"{file}.glb" for file in FILES)
    entries = [entry for entry in BUNDLED_MODELS.values() if isinstance(entry, BundledModel)]
    assert {entry.file for entry in entries} == set(FILES)


@pytest.mark.parametrize("file", FILES)
def test_every_scene_of_a_file_is_a_model(file: str) -> None:
    scenes = {scene["name"] for scene in tree_of((FOLDER / f"{file}.glb").read_bytes())["scenes"]}
    models = {
        entry.scene or name
        for name, entry in BUNDLED_MODELS.items()
        if isinstance(entry, BundledModel) and entry.file == file
    }
    assert models == scenes


@pytest.mark.parametrize("file", FILES)
def test_files_are_valid_gltf(file: str) -> None:
    assert structure_errors((FOLDER / f"{file}.glb").read_bytes()) == []


@pytest.mark.parametrize("file", FILES)
def test_trimesh_reads_the_files_with_y_up(file: str) -> None:
    data = (FOLDER / f"{file}.glb").read_bytes()
    scene = trimesh.load_scene(io.BytesIO(data), file_type="glb")
    lower, upper = scene.bounds
    box = load_model(tree_of(data)["scenes"][0]["name"]).box  # it shows the first scene
    assert (lower[1], upper[1]) == pytest.approx((box.lower[2], box.upper[2]), abs=1e-4)


def test_the_package_has_at_most_15_megabytes_of_models() -> None:
    size = sum(path.stat().st_size for path in FOLDER.rglob("*.glb"))
    assert size / 1e6 <= MAX_MEGABYTES


def test_structural_errors_are_seen() -> None:
    data = (FOLDER / "objects/fittings.glb").read_bytes()
    tree = tree_of(data)
    n = int.from_bytes(data[12:16], "little")
    tree["accessors"][0]["max"][0] += 1.0
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + n :]
    changed = (
        b"glTF" + (2).to_bytes(4, "little") + (20 + len(text) + len(rest)).to_bytes(4, "little")
    )
    changed += len(text).to_bytes(4, "little") + b"JSON" + text + rest
    assert "max is" in structure_errors(changed)[0]
    assert structure_errors(data[:-4]) != []


def test_colours_are_the_written_ones() -> None:
    colours = [mesh.colour for mesh in load_model("robot/GIRONA500/g500_March11").meshes]
    assert colours == [(1.0, 1.0, 1.0), (0.16, 0.17, 0.19), (0.78, 0.80, 0.82)]


def test_parts_of_an_arm_share_their_texture() -> None:
    parts = [load_model(f"robot/ARM5E/ARM5E_part{i}") for i in range(5)]
    textures = [mesh.texture for part in parts for mesh in part.meshes]
    assert len({id(texture) for texture in textures}) == 1
    assert np.shares_memory(textures[0].pixels, textures[-1].pixels)  # type: ignore[union-attr]
