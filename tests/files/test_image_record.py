"""The record of the image model in PNG and JPEG files, read by another library."""

from __future__ import annotations

import io
import json
import struct

import cv2
import numpy as np
import pytest
from PIL import Image

from uwsim.base.files.image_record import ImageRecord, add_record, fill_sixteen_bits, remove_record

RECORD = ImageRecord(
    scene="tank.xml",
    time=12.5,
    camera="bow",
    image_model="physical",
    exposure=4.0,
    transfer="srgb",
)
PIXELS = np.arange(60, dtype=np.uint8).reshape(4, 5, 3)


def encode(ending: str, pixels: np.ndarray) -> bytes:
    """Return an image file."""
    return bytes(cv2.imencode(ending, pixels)[1].tobytes())


def decode(file: bytes) -> np.ndarray:
    """Return the pixels of an image file as OpenCV reads them."""
    return np.asarray(cv2.imdecode(np.frombuffer(file, np.uint8), cv2.IMREAD_UNCHANGED))


def test_a_png_has_its_record_as_text() -> None:
    file = add_record(encode(".png", PIXELS), RECORD)
    image = Image.open(io.BytesIO(file))
    assert json.loads(image.info["uwsim"]) == {
        "scene": "tank.xml",
        "time": 12.5,
        "camera": "bow",
        "image_model": "physical",
        "water": "scene",
        "exposure": 4.0,
        "transfer": "srgb",
    }
    np.testing.assert_array_equal(np.asarray(image)[..., ::-1], PIXELS)
    np.testing.assert_array_equal(decode(file), PIXELS)


def test_a_record_is_removed_without_a_trace() -> None:
    plain_file = encode(".png", PIXELS)
    assert remove_record(add_record(plain_file, RECORD)) == plain_file
    assert remove_record(plain_file) == plain_file
    assert remove_record(b"no image") == b"no image"


def test_a_jpeg_has_its_record_as_a_comment() -> None:
    plain_file = encode(".jpg", PIXELS)
    image = Image.open(io.BytesIO(add_record(plain_file, RECORD)))
    keyword, text = image.info["comment"].decode().split(" ", 1)
    assert keyword == "uwsim"
    assert json.loads(text)["image_model"] == "physical"
    np.testing.assert_array_equal(np.asarray(image), np.asarray(Image.open(io.BytesIO(plain_file))))


def test_other_files_are_unchanged() -> None:
    assert add_record(b"BM1234", RECORD) == b"BM1234"


@pytest.mark.parametrize("channels", [1, 3])
def test_numbers_of_12_bit_are_bright_and_come_back(channels: int) -> None:
    numbers = np.arange(4096, dtype=np.uint16).repeat(channels).reshape(64, 64, channels)
    pixels = fill_sixteen_bits(numbers)
    assert (pixels.min(), pixels.max()) == (0, 65535)
    linear_record = ImageRecord(
        scene="tank.xml", time=0.0, camera="bow", image_model="physical", transfer="linear"
    )
    file = add_record(encode(".png", pixels), linear_record, n_bits=12)
    np.testing.assert_array_equal(decode(file).reshape(numbers.shape) // 16, numbers)
    position = file.index(b"sBIT")
    assert file[position + 4 : position + 4 + channels] == bytes([12] * channels)
    assert struct.unpack(">I", file[position - 4 : position]) == (channels,)
    assert Image.open(io.BytesIO(file)).info["gamma"] == 1.0


def test_the_same_image_has_the_same_bytes() -> None:
    assert add_record(encode(".png", PIXELS), RECORD) == add_record(encode(".png", PIXELS), RECORD)
