"""Surfaces with normal maps and holes in the page, against the renderer."""

from __future__ import annotations

import base64
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.assets.gltf_plates import Plates, colour_image
from uwsim.assets import load_model
from uwsim.assets.bundled import scene_file
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.models import Models
from uwsim.viewer.pack import Blob, make_pack

OBJECT = """<object>
    <name>{name}</name> <file>{file}</file>
    <position> <x>{x}</x> <y>{y}</y> <z>4.2</z> </position>
    <orientation> <r>M_PI</r> <p>0</p> <y>0.3</y> </orientation>
    <scaleFactor> <x>2</x> <y>2</y> <z>2</z> </scaleFactor>
  </object>
"""


def write_plate(folder: Path) -> Path:
    """Write a plate with a normal map, and holes in half of it."""
    plates = Plates()
    base = colour_image(200, 180, 150, 255, size=(16, 16))
    base.paste((0, 0, 0, 0), (0, 0, 8, 16))
    plates.plate(
        {
            "pbrMetallicRoughness": {
                "baseColorTexture": plates.texture(base),
                "roughnessFactor": 0.5,
                "metallicFactor": 0.0,
            },
            "normalTexture": plates.texture(colour_image(170, 100, 225)),
            "alphaMode": "MASK",
            "doubleSided": True,
        }
    )
    return plates.write(folder / "plate.glb")


WATER = "<u:water law='physical'> <u:type>jerlov-IB</u:type> </u:water>"


@pytest.mark.slow
@pytest.mark.parametrize("is_physical", [False, True])
def test_the_page_draws_materials_as_the_renderer_does(
    tab: Any, tmp_path: Path, is_physical: bool
) -> None:
    objects = OBJECT.format(name="rock", file="objects/rock1.glb", x=1.4, y=0.3)
    objects += OBJECT.format(name="net", file=write_plate(tmp_path), x=0.2, y=1.6)
    text = scene_file("shapes-scene").read_text(encoding="utf-8")
    text = re.sub("<u:water.*</u:water>", WATER if is_physical else "", text, flags=re.DOTALL)
    scene = tmp_path / "scene.xml"
    scene.write_text(text.replace("<object>", objects + "<object>", 1), encoding="utf-8")
    blob = Blob()
    with uwsim.load(str(scene), data_path=[tmp_path]) as simulation:
        head = scene_head(simulation, "maps", blob)
        assert sum("tangents" in mesh for mesh in head["meshes"]) > 2  # with those of the robot
        path = tmp_path / "page.html"
        path.write_text(document("maps", make_pack(head, blob)), encoding="utf-8")
        tab.goto(path.as_uri())
        tab.wait_for_function("window.uwsim !== undefined")
        camera = head["cameras"][0]
        view = simulation.world.sensors.camera(camera["name"])
        drawn = simulation.world.scenery.render_clean(
            view.world_from_camera, view.intrinsics, targets={"colour"}
        ).colour
    script = "([name, water]) => uwsim.image(name, water)"
    data = base64.b64decode(tab.evaluate(script, [camera["name"], {}]))
    pixels = np.frombuffer(data, np.uint8).reshape(camera["height"], camera["width"], 4)
    assert drawn is not None
    assert drawn.mean() > 20.0
    off = np.abs(pixels[..., :3].astype(np.int16) - drawn)
    assert off.mean() <= 1.0
    assert (off.max(axis=2) > 8).mean() <= 0.01


@pytest.mark.parametrize("has_finish", [False, True])
def test_a_pack_has_the_maps_that_its_water_needs(tmp_path: Path, has_finish: bool) -> None:
    models = Models(Blob(), has_finish=has_finish)
    model = load_model(str(write_plate(tmp_path)))
    (visual,) = models.visuals(model)
    assert set(visual["material"]["maps"]) == {"normal_map"}
    assert visual["material"]["cutoff"] == 0.5
    assert set(models.meshes[0]) >= {"tangents", "finish", "emissions"}
    assert ("reflectance" in models.reflectance()) == has_finish


def test_a_pack_without_materials_has_no_further_entries() -> None:
    models = Models(Blob())
    (visual, *_) = models.visuals(load_model("objects/box.osg"))
    assert "material" not in visual
    assert "tangents" not in models.meshes[0]
    assert models.reflectance() == {}
