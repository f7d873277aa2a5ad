"""The image files of ``uwsim render``: colours, depth and segmentation."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from ...results.atomic_file import atomic_write

if TYPE_CHECKING:
    from ...rendering.renderer import RenderedImage

MILLIMETRES = 1000.0
MAX_DEPTH_MM = 65535
"""Largest value of a 16-bit depth image [mm]; what is farther has this value, nothing has 0."""


def save(path: Path, pixels: np.ndarray) -> Path:
    """Write an image, (h, w, 3) or (h, w); 8 or 16 bit as its array is."""
    with atomic_write(path) as draft:
        Image.fromarray(pixels).save(draft, format="PNG")
    return path


def save_depth(out: Path, image: RenderedImage) -> list[Path]:
    """Write the planar depth: millimetres for the eye, metres for programs."""
    metres = image.depth  # (h, w) [m]
    seen = np.isfinite(metres)
    rounded = np.rint(np.where(seen, metres, 0.0) * MILLIMETRES)
    exact = sibling(out, "-depth.npy")
    with atomic_write(exact) as draft, draft.open("wb") as stream:
        np.save(stream, metres)
    return [
        save(sibling(out, "-depth.png"), np.minimum(rounded, MAX_DEPTH_MM).astype(np.uint16)),
        exact,
    ]


def save_ids(out: Path, image: RenderedImage, names: dict[int, str]) -> list[Path]:
    """Write which thing each pixel shows, and what the numbers mean."""
    assert image.ids is not None
    numbers, counts = np.unique(image.ids, return_counts=True)
    legend = sibling(out, "-ids.csv")
    with atomic_write(legend) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["id", "name", "pixels"])
        for number, count in zip(numbers.tolist(), counts.tolist(), strict=True):
            table.writerow([number, names.get(number, ""), count])
    return [save(sibling(out, "-ids.png"), image.ids), legend]


def sibling(out: Path, ending: str) -> Path:
    """``view.png`` and ``-ids.csv`` -> ``view-ids.csv``."""
    return out.with_name(out.stem + ending)
