"""Images of bundled models, which are decoded when their pixels are read."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from scripts.models.glb import encode_jpeg
from scripts.models.png import encode_png
from uwsim.assets.images import EncodedImage
from uwsim.assets.mesh import Texture

PIXELS = np.arange(192, dtype=np.uint8).reshape(8, 8, 3)


def test_the_pixels_of_an_encoded_image_are_those_of_its_file() -> None:
    image = EncodedImage(encode_png(PIXELS), is_jpeg=False)
    assert np.array_equal(image.pixels, PIXELS)
    assert image.pixels is image.pixels  # decoded once
    assert image.jpeg is None


def test_a_jpeg_file_stays_at_hand_for_the_page() -> None:
    data = encode_jpeg(PIXELS, 75)
    texture = Texture(name="grey", image=EncodedImage(data, is_jpeg=True))
    assert texture.jpeg == data
    assert np.array_equal(texture.pixels, np.array(Image.open(io.BytesIO(data))))
