"""Functions that write the files of ``uwsim render``: colour, depth and segmentation."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from ...base.files.image_record import N_BITS, ImageRecord, add_record, fill_sixteen_bits
from ...messages.compressed import encode_png
from ...results.atomic_file import atomic_write

if TYPE_CHECKING:
    from ...rendering.renderer import RenderedImage

MILLIMETRES_PER_METRE = 1000.0
MAX_DEPTH_MM = 65535
"""The largest value of a 16-bit depth image [mm]; greater depths are clipped to it. Pixels without
a surface are 0."""


def save_image(path: Path, pixels: np.ndarray, record: ImageRecord) -> Path:
    """Write a PNG image of colours (h, w, 3) or greys (h, w) with its record.

    Numbers of 12 bit (uint16) fill the 16 bit of the file.
    """
    if pixels.dtype == np.uint16:
        file = add_record(encode_png(fill_sixteen_bits(pixels)), record, n_bits=N_BITS)
    else:
        stream = io.BytesIO()
        Image.fromarray(pixels).save(stream, format="PNG")
        file = add_record(stream.getvalue(), record)
    with atomic_write(path) as draft:
        draft.write_bytes(file)
    return path


def save_values(path: Path, values: np.ndarray) -> Path:
    """Write a PNG image of values (h, w), uint16."""
    with atomic_write(path) as draft:
        Image.fromarray(values).save(draft, format="PNG")
    return path


def save_depth(out: Path, image: RenderedImage) -> list[Path]:
    """Write the depth along the optical axis: millimetres in an image, metres in an array."""
    metres = image.depth  # (h, w) [m]
    is_visible = np.isfinite(metres)
    millimetres = np.rint(np.where(is_visible, metres, 0.0) * MILLIMETRES_PER_METRE)
    array_path = sibling_path(out, "-depth.npy")
    with atomic_write(array_path) as draft, draft.open("wb") as stream:
        np.save(stream, metres)
    clipped_depth = np.minimum(millimetres, MAX_DEPTH_MM).astype(np.uint16)
    return [save_values(sibling_path(out, "-depth.png"), clipped_depth), array_path]


def save_ids(out: Path, image: RenderedImage, names: dict[int, str]) -> list[Path]:
    """Write an image with the segmentation ID of the body in each pixel, and a table of names."""
    assert image.ids is not None
    ids, counts = np.unique(image.ids, return_counts=True)
    legend = sibling_path(out, "-ids.csv")
    with atomic_write(legend) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["id", "name", "pixels"])
        for body, count in zip(ids.tolist(), counts.tolist(), strict=True):
            table.writerow([body, names.get(body, ""), count])
    return [save_values(sibling_path(out, "-ids.png"), image.ids), legend]


def sibling_path(out: Path, ending: str) -> Path:
    """Return a path beside another: ``view.png`` and ``-ids.csv`` give ``view-ids.csv``."""
    return out.with_name(out.stem + ending)
