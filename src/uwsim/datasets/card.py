"""The card of a data set, ``README.md``: contents, command, statistics, models."""

from __future__ import annotations

import importlib.resources
import shlex
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..model.scene_model import SceneModel
from ..version import __version__
from .keypoints import KEYPOINTS_FILE
from .request import DatasetRequest, Range
from .splits import SPLITS

LICENCE = "Apache-2.0, with uwsim"
"""The licence of bundled models."""
OPTIONS = {
    "camera": "--camera",
    "sonar": "--sonar",
    "distance": "--distance",
    "elevation": "--elevation",
    "roll": "--roll",
    "clearance": "--clearance",
    "min_visibility": "--min-visibility",
    "field_of_view": "--field-of-view",
    "fog": "--fog",
    "light": "--light",
    "min_pixels": "--min-pixels",
    "views_per_scene": "--views-per-scene",
    "encoding": "--encoding",
    "seed": "--seed",
}
"""The option of each value of a request that has one value or range."""


def write_card(
    request: DatasetRequest,
    records: Sequence[dict[str, Any]],
    classes: Sequence[str],
    model: SceneModel,
) -> None:
    """Write the card."""
    from ..results.atomic_file import write_text

    is_sonar = request.sonar is not None
    lines = [
        f"# {len(records)} labelled {'sonar ' * is_sonar}images of {Path(model.source.path).stem}",
        "",
        f"![Images, boxes{' and instances' if is_sonar else ', instances and depth'}]"
        "(contact-sheet.png)",
        "",
        "## How it was made",
        "",
        "```console",
        f"$ {shlex.join(command_of(request))}",
        "```",
        "",
        f"uwsim {__version__}, seed {request.seed}. The same command makes the same labels.",
        "",
        *_contents(request),
        *_statistics(records, classes),
        *_models(model),
    ]
    write_text(request.out / "README.md", "\n".join(lines) + "\n")


def command_of(request: DatasetRequest) -> list[str]:
    """Return the command that makes a data set, without its directory and its processes."""
    default = DatasetRequest(scene=request.scene, out=request.out)
    width, height = request.size
    command = ["uwsim", "dataset", request.scene, "-n", str(request.n_images)]
    command += ["--size", f"{width}x{height}"] if request.sonar is None else []
    for name, option in OPTIONS.items():
        value = getattr(request, name)
        if value != getattr(default, name):
            command += [option, _text(value)]
    command += ["--mounted"] if request.is_mounted else []
    for target in request.targets:
        command += ["--target", target]
    for path, bounds in request.variations:
        command += ["--vary", f"{path}={_text(bounds)}"]
    for path, value in request.settings:
        command += ["--set", f"{path}={value}"]
    for pattern, label in request.classes:
        command += ["--class", f"{pattern}={label}"]
    command += ["--keypoints", KEYPOINTS_FILE] if request.keypoints else []
    if request.split != default.split:
        command += ["--split", ",".join(f"{share:g}" for share in request.split)]
    formats = [name for name in request.formats if name != "plain"]
    return [*command, "--format", ",".join(formats)] if formats else command


def _text(value: object) -> str:
    if isinstance(value, Range):
        return f"{value.low:g}..{value.high:g}"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _contents(request: DatasetRequest) -> list[str]:
    rows = [
        ("labels.jsonl", "one line of JSON for each image: camera, water, levels, instances"),
        ("images", "colour, 8 bit"),
        ("depth", "distance along the optical axis, 16 bit [mm]; 0: no surface, 65535: farther"),
        ("instances", "number of the instance in each pixel, 16 bit; 0: no surface"),
        ("classes", "number of the class in each pixel, 8 bit, from 1 as below; 0: no surface"),
        ("train.txt, val.txt, test.txt", "the images of each split"),
        ("dataset.json", "the request, the classes, the version"),
    ]
    if request.sonar is not None:
        rows[1] = ("images", "polar sonar images, 8 bit: range downwards, port left")
        del rows[2]
    formats = {
        "coco": ("coco", "instances_train.json and more: boxes, masks, keypoints"),
        "kitti": ("kitti", "training/label_2, calib, image_2, and ImageSets"),
        "yolo": ("labels, data.yaml", "boxes for YOLO"),
    }
    rows += [row for name, row in formats.items() if name in request.formats]
    table = [f"| {name} | {text} |" for name, text in rows]
    return ["## Contents", "", "| file | content |", "|---|---|", *table, ""]


def _statistics(records: Sequence[dict[str, Any]], classes: Sequence[str]) -> list[str]:
    splits = Counter(record["split"] for record in records)
    lines = ["## Statistics", "", "![Histograms](statistics.png)", ""]
    lines += ["| split | images |", "|---|---|", *(f"| {s} | {splits[s]} |" for s in SPLITS), ""]
    lines += [
        "| number | class | visible instances | median box [px] | median visible share "
        "| median distance [m] |",
        "|---|---|---|---|---|---|",
    ]
    for number, name in enumerate(classes, start=1):
        instances = [
            instance
            for record in records
            for instance in record["instances"]
            if instance["class"] == name and instance["box"] is not None
        ]
        if not instances:
            lines.append(f"| {number} | {name} | 0 (masks only) | | | |")
            continue
        width = np.median([i["box"][2] - i["box"][0] for i in instances])
        height = np.median([i["box"][3] - i["box"][1] for i in instances])
        share = np.median([i["visibility"] for i in instances])
        distance = np.median([i["distance"] for i in instances])
        lines.append(
            f"| {number} | {name} | {len(instances)} | {width:.0f} x {height:.0f} | {share:.2f} "
            f"| {distance:.2f} |"
        )
    return [*lines, ""]


def _models(model: SceneModel) -> list[str]:
    """Return the table of the models with their licence; models without files are bundled."""
    package = Path(str(importlib.resources.files("uwsim")))
    licences: dict[str, str] = {}
    for part in model.parts:
        if not part.model.files:
            licences[part.model.name] = LICENCE
        for file in part.model.files:
            is_bundled = file.path.is_relative_to(package)
            licences[file.name] = LICENCE if is_bundled else "that of your file: add it here"
    rows = [f"| {name} | {licences[name]} |" for name in sorted(licences)]
    return ["## Models", "", "| model | licence |", "|---|---|", *rows]
