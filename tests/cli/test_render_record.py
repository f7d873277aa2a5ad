"""The record in the images of ``uwsim render``, and images of linear cameras."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from PIL import Image

from uwsim.cli import main

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> {water} </oceanState>
  <camera> <fov>50</fov> <position> <x>2</x> <y>2</y> <z>-1</z> </position> </camera>
  <vehicle> <name>girona500</name> <file>g500ARM5.urdf</file>
    <jointValues>
      <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint>
    </jointValues>
    <position> <x>0</x> <y>0</y> <z>-4</z> </position>
    <virtualCamera>
      <name>bow</name> <relativeTo>base_link</relativeTo> <resw>32</resw> <resh>24</resh>
      <u:response> <u:output>linear12</u:output> </u:response>
    </virtualCamera>
  </vehicle>
</UWSimScene>
"""
PHYSICAL = '<u:water law="physical"> <u:type>pool</u:type> <u:exposure>3</u:exposure> </u:water>'


def render(folder: Path, water: str, *options: str) -> Path:
    """Render a scene and return the image."""
    (folder / "lake.xml").write_text(SCENE.format(water=water))
    path = folder / "image.png"
    size = [] if "--camera" in options else ["--size", "32x24"]
    assert main(["render", str(folder / "lake.xml"), *options, *size, "-o", str(path)]) == 0
    return path


def read_record(path: Path) -> dict[str, Any]:
    """Return the record of an image."""
    with Image.open(path) as image:
        record = json.loads(image.info["uwsim"])
    assert isinstance(record, dict)
    return record


@pytest.mark.parametrize(
    ("view", "water", "exposure"), [("viewer", "scene", 3.0), ("orbit", "purest", None)]
)
def test_an_image_of_physical_water_says_so(
    tmp_path: Path, view: str, water: str, exposure: float | None
) -> None:
    record = read_record(render(tmp_path, PHYSICAL, "--view", view))
    assert record["image_model"] == "physical"
    assert (record["scene"], record["time"]) == ("lake.xml", 0.0)
    assert record["water"] == water
    assert record["transfer"] == "srgb"
    assert exposure is None or record["exposure"] == exposure


def test_an_image_of_the_fog_law_says_so(tmp_path: Path) -> None:
    record = read_record(render(tmp_path, "", "--view", "viewer"))
    assert (record["image_model"], record["exposure"]) == ("uwsim", None)


def test_an_image_of_a_linear_camera_is_not_black_in_a_viewer(tmp_path: Path) -> None:
    path = render(tmp_path, PHYSICAL, "--camera", "bow")
    record = read_record(path)
    assert (record["camera"], record["transfer"]) == ("bow", "linear")
    pixels = np.asarray(cv2.imread(str(path), cv2.IMREAD_UNCHANGED)).astype(np.int64)
    numbers = pixels // 16
    np.testing.assert_array_equal(16 * numbers + numbers // 256, pixels)
    assert pixels.max() > 4095
