"""The contact sheet: some images of a data set, with their labels below each other."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from ..analysis.plots.save import save_plot
from ..analysis.plots.style import INK, PALETTE, styled_figure
from .image_files import read_colour, read_values
from .sensor_record import sensor_of

N_COLUMNS = 6
"""The number of images."""
COLUMN_WIDTH = 1.6
"""The width of a column [inch]."""
ROWS = ("image", "boxes", "instances", "depth")
"""The rows of the sheet."""
MIN_AREA, MAX_AREA = 0.004, 0.5
"""The visible share of an image [1] between which an instance is shown well."""
MIN_SONAR_AREA = 0.0008
"""The share of the bins of a sonar image [1] above which an instance is shown well."""
EDGES = [(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit]
"""The edges of a box, as pairs of corners."""

Colours = npt.NDArray[np.uint8]


def write_contact_sheet(
    directory: Path, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write ``contact-sheet.png``: colour, boxes, instances and depth of some images."""
    chosen_records = choose_records(records)
    if not chosen_records:
        return
    sensor = sensor_of(chosen_records[0])
    ratio = sensor["height"] / sensor["width"]
    rows = ROWS if "depth" in chosen_records[0]["files"] else ROWS[:-1]
    size = (COLUMN_WIDTH * len(chosen_records) + 0.3, COLUMN_WIDTH * ratio * len(rows) + 0.1)
    with styled_figure(size) as figure:
        engine: Any = figure.get_layout_engine()
        engine.set(rect=(0, 0, 1, 1), w_pad=0.015, h_pad=0.015, wspace=0.0, hspace=0.0)
        axes = figure.subplots(len(rows), len(chosen_records), squeeze=False)
        for column, record in enumerate(chosen_records):
            panels = _draw_panels(directory, record, classes)
            for row, panel in enumerate(panels):
                axis = axes[row][column]
                axis.imshow(panel, interpolation="antialiased")
                axis.set_xticks([])
                axis.set_yticks([])
                axis.grid(visible=False)
                for spine in axis.spines.values():
                    spine.set_visible(False)
                if column == 0:
                    axis.set_ylabel(rows[row], color=INK, fontsize=7.5)
        save_plot(figure, directory / "contact-sheet.png")


def choose_records(records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return records in which the target is neither tiny nor close, classes in turn."""
    by_class: dict[str, list[dict[str, Any]]] = {}
    for record in records:
        area = sensor_of(record)["width"] * sensor_of(record)["height"]
        least_area = MIN_AREA if "camera" in record else MIN_SONAR_AREA
        sizes = {
            instance["class"]: instance["visible_pixels"] / area
            for instance in record["instances"]
            if instance["name"] == record["target"] or not record["target"]
        }
        for name, share in sizes.items():
            if least_area <= share <= MAX_AREA:
                by_class.setdefault(name, []).append(record)
                break
    chosen_records: list[dict[str, Any]] = []
    queues = [by_class[name] for name in sorted(by_class)] or [list(records)]
    while len(chosen_records) < N_COLUMNS and any(queues):
        for queue in queues:
            if queue and len(chosen_records) < N_COLUMNS:
                chosen_records.append(queue.pop(0))
    return sorted(chosen_records, key=lambda record: int(record["index"]))


def _draw_panels(directory: Path, record: dict[str, Any], classes: Sequence[str]) -> list[Colours]:
    """Return the panels of an image, in the order of `ROWS`."""
    image = read_colour(directory / record["files"]["images"])
    if "sonar" in record:  # echoes of the floor are dark beside those of things
        image = np.rint(255.0 * np.sqrt(image / 255.0)).astype(np.uint8)
    mask = read_values(directory / record["files"]["instances"])
    panels = [
        image,
        draw_boxes(image, record, classes),
        _draw_instances(image, mask, record, classes),
    ]
    if "depth" in record["files"]:
        panels.append(colour_depth(read_values(directory / record["files"]["depth"])))
    return panels


def draw_boxes(image: Colours, record: dict[str, Any], classes: Sequence[str]) -> Colours:
    """Return an image with the visible boxes and the edges of the 3-D boxes."""
    picture = image.copy()
    width = max(1, round(image.shape[1] / 320))
    camera = record.get("camera")
    for instance in record["instances"]:
        if instance["box"] is None:
            continue
        colour = _colour_of(instance["class"], classes)
        corners = np.array(instance["box_3d"]["corners"])
        has_edges = camera is not None and not camera["distortion"]["coefficients"]
        if camera is not None and has_edges and corners[:, 2].min() > 0.0:
            x, y = corners[:, 0] / corners[:, 2], corners[:, 1] / corners[:, 2]
            u = camera["cx"] + camera["fx"] * x + camera["skew"] * y
            v = camera["cy"] + camera["fy"] * y
            points = np.clip(np.rint(np.stack([u, v], axis=1)), -20000, 20000).astype(int)
            for start, end in EDGES:
                ends = (tuple(map(int, points[start])), tuple(map(int, points[end])))
                cv2.line(picture, *ends, colour, width, cv2.LINE_AA)
        left, top, right, bottom = instance["box"]
        cv2.rectangle(picture, (left, top), (right - 1, bottom - 1), (255, 255, 255), width)
    return picture


def _draw_instances(
    image: Colours, mask: npt.NDArray[np.uint16], record: dict[str, Any], classes: Sequence[str]
) -> Colours:
    """Return a grey, faded image in which each labelled instance has the colour of its class."""
    grey = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)[..., None].repeat(3, axis=2)
    picture = (140 + 0.4 * grey).astype(np.uint8)
    for instance in record["instances"]:
        pixels = np.equal(mask, instance["number"])
        colour = np.array(_colour_of(instance["class"], classes))
        shade = 0.75 + 0.25 * grey[pixels] / max(1.0, float(grey[pixels].max(initial=1)))
        picture[pixels] = (colour * shade).astype(np.uint8)
    return picture


def colour_depth(depth: npt.NDArray[np.uint16]) -> Colours:
    """Return inverse depths [1/mm] in the colours of viridis, bright near the camera."""
    import matplotlib as mpl

    is_surface = depth > 0
    if not is_surface.any():
        return np.zeros((*depth.shape, 3), np.uint8)
    nearness = 1.0 / np.maximum(depth, 1)
    low, high = np.percentile(nearness[is_surface], [1.0, 99.0]).tolist()
    shares = np.clip((nearness - low) / max(high - low, 1e-9), 0.0, 1.0)
    colours = mpl.colormaps["viridis"](shares, bytes=True)[..., :3]
    colours[~is_surface] = 255
    return np.asarray(colours, dtype=np.uint8)


def _colour_of(name: str, classes: Sequence[str]) -> tuple[int, int, int]:
    code = PALETTE[(list(classes).index(name) + 4) % len(PALETTE)].lstrip("#")
    red, green, blue = (int(code[i : i + 2], 16) for i in (0, 2, 4))
    return red, green, blue
