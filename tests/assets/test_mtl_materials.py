"""The materials of .mtl files besides their colours."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.assets.gltf_plates import colour_image, encode
from uwsim.assets import load_model
from uwsim.assets.mesh import Model
from uwsim.errors import AssetError

OBJ = """mtllib plate.mtl
v 0 0 0
v 1 0 0
v 1 1 0
vt 0 0
vt 1 0
vt 1 1
usemtl steel
f 1/1 2/2 3/3
"""


def read(folder: Path, entries: str) -> Model:
    (folder / "plate.obj").write_text(OBJ)
    (folder / "plate.mtl").write_text(f"newmtl steel\nKd 0.5 0.4 0.3\n{entries}")
    (folder / "normals.png").write_bytes(encode(colour_image(100, 150, 240)))
    return load_model(str(folder / "plate.obj"))


def test_normal_map_roughness_metal_and_emission_are_read(tmp_path: Path) -> None:
    (mesh,) = read(tmp_path, "norm -bm 1.0 normals.png\nPr 0.3\nPm 0.8\nKe 1 2 3\n").meshes
    assert mesh.material is not None
    assert (mesh.material.roughness, mesh.material.metallic) == (0.3, 0.8)
    assert mesh.material.emission == (1.0, 2.0, 3.0)
    assert mesh.material.normal_map is not None
    assert mesh.material.normal_map.pixels[0, 0].tolist() == [100, 150, 240]
    assert mesh.colour == pytest.approx((0.5, 0.4, 0.3), abs=0.005)


@pytest.mark.parametrize("entries", ["", "Ke 0 0 0\nNs 20\n"])
def test_a_plain_material_is_matte(tmp_path: Path, entries: str) -> None:
    (mesh,) = read(tmp_path, entries).meshes
    assert mesh.material is None


def test_invalid_numbers_are_reported_at_once(tmp_path: Path) -> None:
    with pytest.raises(AssetError) as error:
        read(tmp_path, "Pr rough\nPm 1.5\n")
    assert "its material 'steel' has Pr 'rough'; expected a number from 0 to 1" in str(error.value)
    assert "its material 'steel' has Pm '1.5'; expected a number from 0 to 1" in str(error.value)


def test_a_map_outside_the_folder_is_an_error(tmp_path: Path) -> None:
    folder = tmp_path / "meshes"
    folder.mkdir()
    (tmp_path / "secret.png").write_bytes(encode(colour_image(1, 2, 3)))
    with pytest.raises(AssetError, match="outside its folder"):
        read(folder, "norm ../secret.png\n")
