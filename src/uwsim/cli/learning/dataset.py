"""``uwsim dataset``: labelled images of a scene, for learning."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting, ErrorCollector
from ...runs.planning.option_values import pairs_of, split
from ..options.help_texts import INPUT, OUTPUT, RUN, option
from ..options.options import DataPathOption, NoCodeOption, SettingOptions
from ..output.progress import progress

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from ...datasets import Range
    from ...datasets.keypoints import Keypoints

SourceArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENE|BENCHMARK",
        help="A scene or benchmark file, or a bundled name; images of a benchmark have its levels.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class CameraOptions:
    """The options of the camera and of its poses."""

    camera: Annotated[
        str | None,
        option(
            INPUT,
            "--camera",
            metavar="NAME",
            help="The camera of the scene whose lens, noise and response the images have "
            "[a pinhole].",
        ),
    ] = None
    sonar: Annotated[
        str | None,
        option(
            INPUT,
            "--sonar",
            metavar="NAME",
            help="The imaging sonar of the scene whose pings are the images, instead of a camera.",
        ),
    ] = None
    is_mounted: Annotated[
        bool,
        option(INPUT, "--mounted", help="Images from the sensor's place on its vehicle."),
    ] = False
    size: Annotated[
        str, option(OUTPUT, "--size", metavar="WxH", help="Size of the images [px].")
    ] = "640x480"
    field_of_view: Annotated[
        float,
        option(
            INPUT, "--field-of-view", metavar="DEG", help="Vertical field of view of the pinhole."
        ),
    ] = 50.0
    target: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--target",
            metavar="NAME",
            help="A vehicle or object that the camera views; may be repeated [all but landscape].",
        ),
    ] = None
    distance: Annotated[
        str | None,
        option(
            INPUT,
            "--distance",
            metavar="LOW..HIGH",
            help="Distance to the target's centre [m; by its size].",
        ),
    ] = None
    elevation: Annotated[
        str,
        option(INPUT, "--elevation", metavar="LOW..HIGH", help="Elevation above the target [deg]."),
    ] = "-20..60"
    roll: Annotated[
        str, option(INPUT, "--roll", metavar="LOW..HIGH", help="Roll of the camera [deg].")
    ] = "-10..10"
    clearance: Annotated[
        float,
        option(INPUT, "--clearance", metavar="METRES", help="Least distance to any surface."),
    ] = 0.15
    min_visibility: Annotated[
        float,
        option(
            INPUT,
            "--min-visibility",
            metavar="SHARE",
            help="Least visible share of the target, by rays to points of its surface.",
        ),
    ] = 0.3


@dataclass(frozen=True, kw_only=True)
class VariationOptions:
    """The options of what differs between images."""

    fog: Annotated[
        str | None,
        option(INPUT, "--fog", metavar="LOW..HIGH", help="Density of the fog [1/m]."),
    ] = None
    light: Annotated[
        str | None,
        option(INPUT, "--light", metavar="LOW..HIGH", help="Factor on the light [1]."),
    ] = None
    vary: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--vary",
            metavar="PATH=LOW..HIGH",
            help="Draw a number of the scene, beside its u:vary, as object[blackbox].position.x; "
            "may be repeated.",
        ),
    ] = None
    views_per_scene: Annotated[
        int,
        option(RUN, "--views-per-scene", metavar="N", help="Images of one draw of the variations."),
    ] = 25


@dataclass(frozen=True, kw_only=True)
class LabelOptions:
    """The options of labels and files."""

    format: Annotated[
        list[str] | None,
        option(
            OUTPUT,
            "--format",
            metavar="FORMAT",
            help="plain, coco, kitti or yolo; may be repeated, or separated by commas. Plain is "
            "always written.",
        ),
    ] = None
    label: Annotated[
        list[str] | None,
        option(
            OUTPUT,
            "--class",
            metavar="PATTERN=CLASS",
            help="Class of objects by their names, as rock*=rock; may be repeated [their names].",
        ),
    ] = None
    keypoints: Annotated[
        Path | None,
        option(
            INPUT,
            "--keypoints",
            metavar="FILE",
            help="JSON file of named points of classes [corners of the boxes].",
        ),
    ] = None
    min_pixels: Annotated[
        int,
        option(
            OUTPUT,
            "--min-pixels",
            metavar="N",
            help="Least visible pixels of an instance in COCO, KITTI and YOLO.",
        ),
    ] = 1
    splits: Annotated[
        str,
        option(OUTPUT, "--split", metavar="A,B,C", help="Shares of train, val and test."),
    ] = "0.8,0.1,0.1"
    encoding: Annotated[
        str, option(OUTPUT, "--encoding", metavar="png|jpeg", help="Encoding of colour images.")
    ] = "png"


def dataset(
    source: SourceArgument,
    *,
    n: Annotated[
        int, option(RUN, "-n", metavar="N", help="Number of images; more continue a data set.")
    ] = 100,
    cameras: CameraOptions,
    variations: VariationOptions,
    labels: LabelOptions,
    changes: SettingOptions,
    seed: Annotated[int, option(RUN, "--seed", metavar="N", help="Seed of all that is drawn.")] = 0,
    workers: Annotated[
        int, option(RUN, "--workers", metavar="N", help="Number of processes on this machine.")
    ] = 1,
    out: Annotated[
        Path, option(OUTPUT, "--out", "-o", metavar="DIR", help="Directory of the data set.")
    ] = Path("dataset"),
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Make labelled images of a scene: masks, boxes, depth, keypoints, poses and water.

    The camera is drawn around the targets, in the water and with a free view. Values of u:vary
    and --vary are drawn for every --views-per-scene images, levels, fog and light for each image.
    The same command continues after an interruption, or adds images with a greater -n; the bytes
    depend neither on that nor on --workers.
    """
    from ...datasets import DatasetRequest, Range, make_dataset
    from ...datasets.keypoints import read_keypoints
    from ..views import read_size

    errors = ErrorCollector()
    ranges: dict[str, tuple[str, str | None]] = {
        "distance": ("--distance", cameras.distance),
        "elevation": ("--elevation", cameras.elevation),
        "roll": ("--roll", cameras.roll),
        "fog": ("--fog", variations.fog),
        "light": ("--light", variations.light),
    }
    bounds: dict[str, Range | None] = {}
    for name, (option_name, text) in ranges.items():
        bounds[name] = None
        with errors.collect():
            bounds[name] = None if text is None else Range.parse(text, option_name)
    size = (640, 480)
    with errors.collect():
        size = read_size(cameras.size)
    shares = (0.8, 0.1, 0.1)
    with errors.collect():
        shares = read_shares(labels.splits)
    paths = []
    for text in variations.vary or ():
        with errors.collect():
            path, value = split(text, "--vary")
            paths.append((path, Range.parse(value, f"--vary {path}")))
    classes = []
    for text in labels.label or ():
        with errors.collect():
            classes.append(split(text, "--class"))
    keypoints: Keypoints = ()
    with errors.collect():
        keypoints = () if labels.keypoints is None else read_keypoints(labels.keypoints)
    settings = pairs_of(changes.all_settings, errors)
    request = DatasetRequest(
        scene=source,
        out=out,
        n_images=n,
        seed=seed,
        formats=read_formats(labels.format or ()),
        size=size,
        camera=cameras.camera,
        sonar=cameras.sonar,
        is_mounted=cameras.is_mounted,
        field_of_view=cameras.field_of_view,
        targets=tuple(cameras.target or ()),
        distance=bounds["distance"],
        elevation=bounds["elevation"] or Range(-20.0, 60.0),
        roll=bounds["roll"] or Range(-10.0, 10.0),
        clearance=cameras.clearance,
        min_visibility=cameras.min_visibility,
        fog=bounds["fog"],
        light=bounds["light"],
        variations=tuple(paths),
        settings=tuple(settings),
        classes=tuple(classes),
        keypoints=keypoints,
        min_pixels=labels.min_pixels,
        views_per_scene=variations.views_per_scene,
        split=shares,
        encoding=labels.encoding,
        data_path=tuple(data_path or ()),
        runs_code=not no_code,
        workers=workers,
    )
    with errors.collect():
        request.check()
    errors.raise_errors()
    result = make_dataset(request, show_progress)
    parts = ", ".join(f"{count} {name}" for name, count in result.splits.items())
    print(
        f"{result.n_images} images ({parts}) with {result.n_instances} labelled instances; "
        f"{result.n_rendered} rendered now; written: {result.directory}"
    )
    if result.n_unlisted:
        print(
            f"{result.directory}/images has {result.n_unlisted} more, from a greater -n. No file "
            f"of labels lists them; give -n {result.n_images + result.n_unlisted} to have them."
        )


def show_progress(
    n_images: int, n_done: int, n_workers: int
) -> AbstractContextManager[Callable[[], None]]:
    """Show the number of images that are on disk."""
    return progress("dataset", n_images, n_done=n_done, unit="images", n_parallel=n_workers)


def read_formats(texts: list[str] | tuple[str, ...]) -> tuple[str, ...]:
    """Return the formats of ``--format``, each once, with ``plain`` first."""
    names = [name.strip() for text in texts for name in text.split(",")]
    return tuple(dict.fromkeys(["plain", *names]))


def read_shares(text: str) -> tuple[float, float, float]:
    """Return the shares of ``--split``; raise BadSetting if they are not three numbers."""
    try:
        train, val, test = (float(word) for word in text.split(","))
    except ValueError:
        raise BadSetting(
            f"--split is {text!r}; expected three shares, as in 0.8,0.1,0.1."
        ) from None
    return train, val, test
