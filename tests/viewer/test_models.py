"""The textures of a pack, against those of the renderer."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from tests.assets.gltf_plates import Plates
from tests.support.packs import read_array
from uwsim.assets import load_model
from uwsim.assets.weathering import weather_model
from uwsim.viewer.models import MAX_LOSS, Models
from uwsim.viewer.pack import Blob

ROCK = "objects/rock1.glb"


def decode(models: Models, blob: Blob, index: int) -> npt.NDArray[np.uint8]:
    """Return the pixels of a texture of a pack, and check its format."""
    entry = models.textures[index]
    image = Image.open(io.BytesIO(read_array(entry["bytes"], blob.data).tobytes()))
    assert entry["type"] == f"image/{str(image.format).lower()}"
    return np.asarray(image.convert("RGB"))


def test_images_of_bundled_models_are_not_encoded_a_second_time() -> None:
    blob = Blob()
    models = Models(blob, has_finish=True)
    model = load_model(ROCK)
    (visual,) = models.visuals(model)
    material, texture = model.meshes[0].material, model.meshes[0].texture
    assert texture is not None
    assert material is not None
    assert material.normal_map is not None
    assert material.finish_map is not None
    maps = visual["material"]["maps"]
    for index, wanted in (
        (visual["texture"], texture),
        (maps["normal_map"], material.normal_map),
        (maps["finish_map"], material.finish_map),
    ):
        assert np.array_equal(decode(models, blob, index), wanted.pixels)


def test_a_texture_with_changed_pixels_has_no_file() -> None:
    blob = Blob()
    models = Models(blob)
    model = weather_model(load_model(ROCK), 3, 0.3)
    (visual,) = models.visuals(model)
    texture = model.meshes[0].texture
    assert texture is not None
    error = np.abs(decode(models, blob, visual["texture"]) - texture.pixels.astype(np.int16))
    assert error.mean() <= 2.0


def test_directions_in_normal_maps_of_files_stay_sharp(tmp_path: Path) -> None:
    """Waves of 6 to 9 texels, which lossy WebP changes by 29 levels in one value of 100."""
    u, v = np.meshgrid(np.arange(256.0), np.arange(256.0))
    slopes = np.stack([np.sin(u / 0.9 + np.sin(v / 9.0)), np.sin(v / 1.4 + np.sin(u / 7.0))])
    normals = np.stack([0.6 * slopes[0], 0.6 * slopes[1], np.ones_like(u)], axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    image = Image.fromarray(np.rint(127.5 + 127.5 * normals).astype(np.uint8))
    plates = Plates()
    plates.plate({"normalTexture": plates.texture(image)})
    model = load_model(str(plates.write(tmp_path / "plate.glb")))
    blob = Blob()
    models = Models(blob)
    (visual,) = models.visuals(model)
    pixels = decode(models, blob, visual["material"]["maps"]["normal_map"])
    material = model.meshes[0].material
    assert material is not None
    assert material.normal_map is not None
    error = np.abs(pixels - material.normal_map.pixels.astype(np.int16))
    assert np.percentile(error, 99) <= MAX_LOSS
