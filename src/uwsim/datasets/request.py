"""The request of a data set: what is drawn, how it is labelled, where it is written."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ..errors import BadSetting, ErrorCollector, did_you_mean, short_repr
from .keypoints import Keypoints

FORMATS = ("plain", "coco", "kitti", "yolo")
"""The formats of labels; ``plain`` is always written."""
ENCODINGS = ("png", "jpeg")
"""The encodings of colour images."""
DEFAULT_SIZE = (640, 480)
"""The default width and height of images [px]."""
MAX_IMAGES = 1_000_000
"""The greatest number of images of a data set."""
MAX_VIEWS = 10_000
"""The greatest number of images of one scene draw."""
MAX_DISTANCE = 1000.0
"""The greatest distance from the camera to its target [m]."""


@dataclass(frozen=True)
class Range:
    """The bounds between which a number is drawn, with equal probability."""

    low: float
    """The lower bound."""
    high: float
    """The upper bound."""

    @staticmethod
    def parse(text: str, option: str) -> Range:
        """Return the range of a text such as ``0.5..3``, or of one number; raise BadSetting."""
        match = re.fullmatch(r"\s*([-+.\deE]+?)\s*(?:\.\.\s*([-+.\deE]+)\s*)?", text)
        try:
            low = float(match[1]) if match else math.nan
            high = float(match[2]) if match and match[2] is not None else low
        except ValueError:
            low = high = math.nan
        if not (math.isfinite(low) and math.isfinite(high) and low <= high):
            raise BadSetting(
                f"{option} is {text[:60]!r}; expected LOW..HIGH, such as 0.5..3, or one number."
            )
        return Range(low, high)

    def value(self, share: float) -> float:
        """Return the number at a share of the range, 0 to 1, with 9 digits."""
        return float(f"{self.low + share * (self.high - self.low):.9g}")


@dataclass(frozen=True, kw_only=True)
class DatasetRequest:
    """The request of a data set; equal requests give equal bytes."""

    scene: str
    """The scene or benchmark: a file, or a bundled name."""
    out: Path
    """The directory of the data set."""
    n_images: int = 100
    """The number of images."""
    seed: int = 0
    """The seed of all that is drawn."""
    formats: tuple[str, ...] = ("plain",)
    """The formats of labels, some of `FORMATS`."""
    size: tuple[int, int] = DEFAULT_SIZE
    """The width and height of images [px]; cameras of the scene keep their field of view."""
    camera: str | None = None
    """The camera of the scene whose lens, noise and response the images have; None: a pinhole."""
    sonar: str | None = None
    """The imaging sonar of the scene whose pings the images are; None: images of a camera."""
    is_mounted: bool = False
    """True if images are from the place of the camera or the sonar on its vehicle, not from around
    the targets."""
    field_of_view: float = 50.0
    """The vertical field of view of the pinhole [deg]."""
    targets: tuple[str, ...] = ()
    """The vehicles and objects that the camera views; empty: all that are not landscape."""
    distance: Range | None = None
    """The distance from the camera to the target's centre [m]; None: by the target's size."""
    elevation: Range = Range(-20.0, 60.0)
    """The elevation of the camera above the target [deg]."""
    roll: Range = Range(-10.0, 10.0)
    """The roll of the camera about its axis [deg]."""
    clearance: float = 0.15
    """The least distance between the camera and any surface [m]."""
    min_visibility: float = 0.3
    """The least visible share of the target, by rays to points of its surface [1]."""
    fog: Range | None = None
    """The density of the fog [1/m]; None: that of the scene."""
    light: Range | None = None
    """The factor on the light; None: that of the scene."""
    variations: tuple[tuple[str, Range], ...] = ()
    """The additional variations of the scene: the path of a number as in ``--set``, and its
    range."""
    settings: tuple[tuple[str, str], ...] = ()
    """The values of the scene to change, as ``--set`` names them."""
    classes: tuple[tuple[str, str], ...] = ()
    """The class of objects: a pattern of names such as ``rock*``, and the class."""
    keypoints: Keypoints = ()
    """The declared keypoints of classes; a class without any has the corners of its boxes."""
    min_pixels: int = 1
    """The least number of visible pixels of an instance in other formats than the plain one."""
    views_per_scene: int = 25
    """The number of images of one scene draw."""
    split: tuple[float, float, float] = (0.8, 0.1, 0.1)
    """The shares of the splits train, val and test [1]."""
    encoding: str = "png"
    """The encoding of colour images, one of `ENCODINGS`."""
    data_path: tuple[Path, ...] = ()
    """The additional folders in which files are searched."""
    runs_code: bool = True
    """True if Python code that the scene names is run; False: such a scene is an error."""
    workers: int = 1
    """The number of processes."""

    def check(self) -> None:
        """Raise the errors of all values at once."""
        errors = ErrorCollector()
        for message in self._find_errors():
            with errors.collect():
                raise BadSetting(message)
        errors.raise_errors()

    def _find_errors(self) -> Iterator[str]:
        limits: tuple[tuple[str, float, float, float], ...] = (
            ("-n", self.n_images, 1, MAX_IMAGES),
            ("--seed", self.seed, 0, 2**63 - 1),
            ("--views-per-scene", self.views_per_scene, 1, MAX_VIEWS),
            ("--min-pixels", self.min_pixels, 1, 2**31),
            ("--workers", self.workers, 1, 1024),
            ("--field-of-view", self.field_of_view, 1.0, 170.0),
            ("--clearance", self.clearance, 0.0, MAX_DISTANCE),
            ("--min-visibility", self.min_visibility, 0.0, 1.0),
        )
        for option, value, low, high in limits:
            if not low <= value <= high:
                yield f"{option} is {value:g}; expected {low:g} to {high:g}."
        ranges: tuple[tuple[str, Range | None, float, float], ...] = (
            ("--distance", self.distance, 0.0, MAX_DISTANCE),
            ("--elevation", self.elevation, -90.0, 90.0),
            ("--roll", self.roll, -180.0, 180.0),
            ("--fog", self.fog, 0.0, 100.0),
            ("--light", self.light, 0.0, 100.0),
        )
        for option, bounds, low, high in ranges:
            if bounds is not None and not low <= bounds.low <= bounds.high <= high:
                yield (
                    f"{option} is {bounds.low:g}..{bounds.high:g}; expected bounds from {low:g} "
                    f"to {high:g}."
                )
        for option, names, known_names in (
            ("--format", self.formats, FORMATS),
            ("--encoding", (self.encoding,), ENCODINGS),
        ):
            for name in names:
                if name not in known_names:
                    yield (
                        f"{option} {short_repr(name)}: expected one of {', '.join(known_names)}."
                        f"{did_you_mean(name, known_names)}"
                    )
        if not (min(self.split) >= 0.0 and abs(sum(self.split) - 1.0) <= 1e-6):  # also NaN
            yield f"--split is {self.split}; expected three shares with the sum 1, as 0.8,0.1,0.1."
        if self.is_mounted and self.camera is None and self.sonar is None:
            yield "--mounted needs --camera NAME or --sonar NAME, which is on its vehicle."
        if self.sonar is not None:
            yield from self._find_sonar_errors()
        if self.is_mounted and (self.targets or self.distance is not None):
            yield "--mounted excludes --target and --distance: the vehicle carries the sensor."

    def _find_sonar_errors(self) -> Iterator[str]:
        if self.camera is not None:
            yield "--sonar excludes --camera: make two data sets."
        if self.size != DEFAULT_SIZE:
            yield "--sonar excludes --size: an image has the range bins and beams of the sonar."
        if "kitti" in self.formats:
            yield "--sonar: KITTI has no sonar images; expected plain, coco or yolo."

    @property
    def identity(self) -> dict[str, Any]:
        """The values that determine the bytes of an image, for JSON."""
        names = {field.name for field in fields(self)}
        names -= {"out", "n_images", "formats", "min_pixels", "workers", "data_path", "runs_code"}
        return {name: _to_json(getattr(self, name)) for name in sorted(names)}


def _to_json(value: Any) -> Any:
    if isinstance(value, Range):
        return [value.low, value.high]
    return [_to_json(item) for item in value] if isinstance(value, tuple) else value
