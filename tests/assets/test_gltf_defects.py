"""Images and numbers of glTF files that cannot be used are named; none is dropped silently."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from tests.assets.gltf_plates import Plates, colour_image
from uwsim.assets import load_model
from uwsim.errors import AssetError


def write_png(width: int, height: int) -> bytes:
    """Return a PNG that states a size, and has hardly any data."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(9))) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + parts


def textured_plates(entry: str = "baseColorTexture") -> Plates:
    """Return a plate whose material has one image, as its base colour or as another map."""
    plates = Plates()
    reference = plates.texture(colour_image(200, 100, 50))
    is_base = entry == "baseColorTexture"
    plates.plate({"pbrMetallicRoughness": {entry: reference}} if is_base else {entry: reference})
    return plates


def remarks_on(plates: Plates, folder: Path) -> list[str]:
    """Return the remarks on a file, without its path."""
    path = plates.write(folder / "plates.glb")
    remarks = load_model(str(path)).remarks
    assert all(remark.startswith(f"{path}: ") for remark in remarks)
    return [remark.removeprefix(f"{path}: ") for remark in remarks]


END = ": the materials are drawn without it"


@pytest.mark.parametrize("entry", ["baseColorTexture", "normalTexture"])
@pytest.mark.parametrize(
    ("uri", "defect"),
    [
        ("gone.png", "is 'gone.png', which is missing"),
        (
            "http://127.0.0.1/a.png",
            "is 'http://127.0.0.1/a.png', which is a link, and nothing is downloaded",
        ),
        ("data:image/png;base64,AAAA", "is not an image that can be read"),
        ("data:image/png;base64,A", "has data that cannot be read"),
    ],
)
def test_an_image_that_cannot_be_opened_is_a_remark(
    uri: str, defect: str, entry: str, tmp_path: Path
) -> None:
    plates = textured_plates(entry)
    plates.tree["images"][0] = {"uri": uri}
    assert remarks_on(plates, tmp_path) == [f"its images[0] {defect}{END}"]


def test_an_image_in_a_view_that_is_no_image_is_a_remark(tmp_path: Path) -> None:
    plates = textured_plates()
    plates.tree["images"][0] = {"bufferView": 0, "mimeType": "image/png"}
    assert remarks_on(plates, tmp_path) == [f"its images[0] is not an image that can be read{END}"]


def test_an_image_without_pixels_is_a_remark(tmp_path: Path) -> None:
    plates = Plates()
    plates.plate({"normalTexture": plates.texture(write_png(0, 0))})
    (remark,) = remarks_on(plates, tmp_path)
    assert remark.startswith("its images[0] ")
    assert remark.endswith(END)


@pytest.mark.parametrize("side", [20_000, 100_000, 2**31 - 1])
def test_an_image_of_too_many_pixels_is_an_error(side: int, tmp_path: Path) -> None:
    plates = Plates()
    plates.plate({"normalTexture": plates.texture(write_png(side, side))})
    with pytest.raises(AssetError, match=r"its images\[0\]: an image of too many pixels"):
        remarks_on(plates, tmp_path)


def test_an_image_that_no_texture_uses_is_no_remark(tmp_path: Path) -> None:
    plates = textured_plates()
    plates.tree["images"].append({"uri": "gone.png"})
    assert remarks_on(plates, tmp_path) == []


@pytest.mark.parametrize(
    ("attribute", "consequence"),
    [
        ("NORMAL", "normals are computed from the faces"),
        ("TEXCOORD_0", "0 is used for them"),
    ],
)
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_a_remark(
    value: float, attribute: str, consequence: str, tmp_path: Path
) -> None:
    plates = textured_plates("normalTexture")
    n = {"NORMAL": 3, "TEXCOORD_0": 2}[attribute]
    values = np.ones((4, n), np.float32)
    values[2, 1] = value
    plates.plate({}, **{attribute: plates.add(values)})
    place = f"its meshes[0].primitives[1].attributes.{attribute}"
    text = "has numbers that are infinite or not numbers"
    assert remarks_on(plates, tmp_path) == [f"{place} {text}: {consequence}"]


def test_infinite_texture_coordinates_are_zero(tmp_path: Path) -> None:
    plates = Plates()
    uvs = plates.add(np.array([[np.inf, 0], [1, -np.inf], [1, 1], [np.nan, 0]], np.float32))
    plates.plate({"normalTexture": plates.texture(colour_image(128, 128, 255))}, TEXCOORD_0=uvs)
    (mesh,) = load_model(str(plates.write(tmp_path / "plates.glb"))).meshes
    assert np.abs(mesh.uvs).max() <= 1.0


def test_a_few_remarks_stand_for_many(tmp_path: Path) -> None:
    plates = Plates()
    for _ in range(9):
        plates.plate({"normalTexture": plates.texture(b"no image")})
    remarks = remarks_on(plates, tmp_path)
    assert len(remarks) == 6
    assert remarks[-1] == "4 more of its parts are left out"
