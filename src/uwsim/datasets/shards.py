"""Shards: the records of the images of one scene draw, in one file.

A shard is written when all images of its draw are on disk, so that a shard with all its lines is
finished. An interrupted data set repeats at most one draw for each worker. A draw of which an image
is missing or incomplete is rendered again.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..errors import ResultError
from ..results.atomic_file import write_text
from .image_files import FOLDERS, SONAR_FOLDERS, file_paths, is_complete
from .request import DatasetRequest

FOLDER = "records"
"""The folder of shards."""


def draw_numbers(request: DatasetRequest) -> range:
    """Return the numbers of all scene draws of a request."""
    return range(-(-request.n_images // request.views_per_scene))


def draw_indices(request: DatasetRequest, number: int) -> range:
    """Return the indices of the images of a scene draw."""
    start = number * request.views_per_scene
    return range(start, min(start + request.views_per_scene, request.n_images))


def image_folders(request: DatasetRequest) -> tuple[str, ...]:
    """Return the folders of images and masks of a request."""
    return FOLDERS if request.sonar is None else SONAR_FOLDERS


def shard_path(directory: Path, number: int) -> Path:
    """Return the path of a shard."""
    return directory / FOLDER / f"{number:05d}.jsonl"


def write_shard(directory: Path, number: int, lines: list[str]) -> None:
    """Write a shard."""
    write_text(shard_path(directory, number), "".join(line + "\n" for line in lines))


def is_finished(request: DatasetRequest, number: int) -> bool:
    """Return whether the shard of a scene draw has all its records, and they have their images."""
    try:
        lines = shard_path(request.out, number).read_bytes().count(b"\n")
    except OSError:
        return False
    indices = draw_indices(request, number)
    return lines >= len(indices) and all(
        is_complete(request.out / path)
        for index in indices
        for path in file_paths(index, request.encoding, image_folders(request)).values()
    )


def read_records(request: DatasetRequest) -> Iterator[dict[str, Any]]:
    """Yield the records of all images in order, without those beyond their number.

    Raises:
        ResultError: a shard is damaged.
    """
    for number in draw_numbers(request):
        path = shard_path(request.out, number)
        n_images = len(draw_indices(request, number))
        try:
            lines = path.read_text(encoding="utf-8").splitlines()[:n_images]
            records = [json.loads(line) for line in lines]
        except (OSError, ValueError) as error:
            raise ResultError(
                f"{path}: {error}. Remove the file, and make the data set again."
            ) from None
        yield from records
