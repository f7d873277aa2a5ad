r"""The set-up of a calibration: camera, lights, board, waters and their pictures.

.. code-block:: xml

    <calibration>
      <camera> <focalLength>1000</focalLength> <fullScale>65535</fullScale> </camera>
      <channel> <name>red</name> <plane>0</plane> <wavelength>630</wavelength> </channel>
      <led> <name>white-led</name> <distance>1</distance> </led>
      <board>
        <name>board</name> <distance>1</distance>
        <lampPosition> <x>0.15</x> <y>0</y> <z>0</z> </lampPosition>
        <square>0.15</square> <square>0.04</square> <square>0.01</square>
      </board>
      <reference>
        <picture>
          <source>white-led</source>
          <exposure> <time>1</time> <frames>clear/led_*.png</frames> <dark>dark/*.png</dark>
          </exposure>
        </picture>
      </reference>
      <water> <name>two drops</name> <dose>2</dose> <picture> ... </picture> </water>
    </calibration>

Files are relative to the folder of the set-up; ``*`` and ``?`` stand for any characters. Lengths
are in metres and angles in radians. The camera's frame has x to the right, y down and z forward.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from ..errors import FileError, choices
from ..schema import Diagnostics, Numbers, Spec, check_head, element, parse, read

ROOT = "calibration"
"""The name of the root element."""
OPEN_WATER = "open-water"
"""The source of a picture of the lamp's veil in open water."""
MAX_FRAMES = 256
"""The greatest number of files of one exposure."""
MAX_HALF_ANGLE = 1.5708
"""The greatest half-angle of a lamp [rad]: pi/2, rounded up to what files have."""
CORNER_NUMBERS = 8


class SetupError(FileError):
    """An invalid set-up of a calibration."""


@dataclass(frozen=True, kw_only=True)
class CameraSpec(Spec):
    """The ``<camera>`` of a set-up."""

    focal_length: float = element(exclusive_minimum=0, maximum=1e6)
    """The focal length in the water, in pixels: 1.33 times that in air behind a flat port."""
    full_scale: float = element(default=65535.0, exclusive_minimum=0)
    """The number of a file at which the sensor is saturated."""
    encoding: Literal["linear", "srgb"] = "linear"
    """The encoding of the files: numbers linear in the light, or sRGB."""


@dataclass(frozen=True, kw_only=True)
class ChannelSpec(Spec):
    """A ``<channel>``: a colour plane of the pictures, with its reference water."""

    name: str
    """The name of the channel."""
    plane: int = element(default=0, minimum=0, maximum=3)
    """The index of the plane of the pictures, from 0."""
    wavelength: float = element(default=550.0, minimum=400, maximum=700)
    """The effective wavelength of light and filter [nm]; it gives pure water's coefficients."""
    reference_absorption: float | None = element(default=None, minimum=0, maximum=100)
    """The absorption of the reference water, if it is not pure [1/m]."""
    reference_scattering: float | None = element(default=None, minimum=0, maximum=100)
    """The scattering of the reference water, if it is not pure [1/m]."""


@dataclass(frozen=True, kw_only=True)
class LedSpec(Spec):
    """An ``<led>`` that faces the camera."""

    name: str
    """The name of the LED."""
    distance: float = element(default=1.0, minimum=0.05, maximum=100)
    """The distance from the camera to the LED [m]."""
    channels: str = ""
    """The names of the channels in which it is measured, separated by blanks; empty: all."""


@dataclass(frozen=True, kw_only=True)
class BoardSpec(Spec):
    """A ``<board>`` with checkers of two by two squares on a grey card, lit by a lamp."""

    name: str
    """The name of the board."""
    distance: float = element(default=1.0, minimum=0.05, maximum=100)
    """The distance from the camera to the board's plane, along the optical axis [m]."""
    lamp_position: tuple[float, float, float] = (0.15, 0.0, 0.0)
    """The position of the lamp in the camera's frame [m]."""
    lamp_half_angle: float = element(
        default=math.radians(30.0), minimum=0.05, maximum=MAX_HALF_ANGLE
    )
    """The angle between the axis of the lamp and the edge of its cone [rad]."""
    squares: tuple[float, ...] = element("square", default=(), minimum=0.001, maximum=2)
    """The side of a square of each checker [m]."""
    white: float = element(default=0.9, exclusive_minimum=0, maximum=1)
    """The reflectance of the white squares."""
    black: float = element(default=0.05, minimum=0, exclusive_maximum=1)
    """The reflectance of the black squares."""
    channels: str = ""
    """The names of the channels in which it is measured, separated by blanks; empty: all."""


@dataclass(frozen=True, kw_only=True)
class ExposureSpec(Spec):
    """An ``<exposure>`` of a picture."""

    time: float = element(default=1.0, exclusive_minimum=0)
    """The exposure time, of any unit that is the same in the whole set-up."""
    frames: str
    """The files of the frames, with ``*`` and ``?``."""
    dark: str = ""
    """The files of the frames without light; empty: the files have no black level."""


@dataclass(frozen=True, kw_only=True)
class CornersSpec(Spec):
    """The ``<corners>`` of a checker in a picture."""

    square: float
    """The side of a square of the checker [m]."""
    pixels: Numbers
    """The outer corners from top left clockwise: column and row of each [pixels]."""


@dataclass(frozen=True, kw_only=True)
class PictureSpec(Spec):
    """A ``<picture>`` of a source."""

    source: str
    """The name of an LED or a board, or open-water for the lamp's light in open water."""
    distance: float | None = element(default=None, minimum=0.05, maximum=100)
    """The distance of this picture, if it is not that of the source [m]."""
    exposures: tuple[ExposureSpec, ...] = element("exposure")
    """The exposures: a short one for the core of an LED, a long one for its halo."""
    corners: tuple[CornersSpec, ...] = element("corners", default=())
    """The corners of checkers; without them they are looked for."""


@dataclass(frozen=True, kw_only=True)
class ReferenceSpec(Spec):
    """The ``<reference>``: pictures through clear water."""

    pictures: tuple[PictureSpec, ...] = element("picture")
    """The pictures."""


@dataclass(frozen=True, kw_only=True)
class WaterSpec(Spec):
    """A ``<water>`` that is to be calibrated."""

    name: str
    """The name of the water, for files and tables."""
    dose: float | None = element(default=None, minimum=0)
    """The amount of dye or powder, of any unit; equal doses are repeats."""
    pictures: tuple[PictureSpec, ...] = element("picture", default=())
    """The pictures."""


@dataclass(frozen=True, kw_only=True)
class AccuracySpec(Spec):
    """The ``<accuracy>``: standard deviations that pictures do not show."""

    reference: float = element(default=0.01, minimum=0, maximum=1)
    """The standard deviation of the beam attenuation of the reference water [1/m]."""
    distance: float = element(default=0.005, minimum=0, maximum=0.5)
    """The standard deviation of a distance, relative."""
    drift: float = element(default=0.01, minimum=0, maximum=0.5)
    """The standard deviation of the light between the reference and a water, relative."""


@dataclass(frozen=True, kw_only=True)
class SetupSpec(Spec):
    """A set-up file."""

    camera: CameraSpec
    """The camera."""
    channels: tuple[ChannelSpec, ...] = element("channel")
    """The channels."""
    leds: tuple[LedSpec, ...] = element("led", default=())
    """The LEDs."""
    boards: tuple[BoardSpec, ...] = element("board", default=())
    """The boards."""
    reference: ReferenceSpec | None = None
    """The pictures through the reference water; absent: a board at three or more distances."""
    waters: tuple[WaterSpec, ...] = element("water", default=())
    """The waters."""
    accuracy: AccuracySpec = AccuracySpec()
    """The standard deviations of what pictures do not show."""

    def find_channel(self, name: str) -> ChannelSpec:
        """Return the channel of a name."""
        return next(channel for channel in self.channels if channel.name == name)

    def list_channels(self, source: LedSpec | BoardSpec) -> tuple[ChannelSpec, ...]:
        """Return the channels in which a source is measured."""
        names = source.channels.split() or [channel.name for channel in self.channels]
        return tuple(channel for channel in self.channels if channel.name in names)

    def find_source(self, name: str) -> LedSpec | BoardSpec | None:
        """Return the LED or board of a name; None if there is none."""
        return next((source for source in self.list_sources() if source.name == name), None)

    def list_sources(self) -> list[LedSpec | BoardSpec]:
        """Return the LEDs and boards."""
        return [*self.leds, *self.boards]


def read_setup(path: Path, *, needs_pictures: bool = True) -> SetupSpec:
    """Read a set-up file.

    Args:
        path: the file.
        needs_pictures: whether the pictures must exist; not so if readings replace them.

    Raises:
        SetupError: the file is invalid; the error has every mistake in it.
    """
    diagnostics = Diagnostics(path)
    document = parse(path, error=SetupError)
    check_head(document, ROOT, diagnostics)
    diagnostics.check(SetupError)
    setup = read(SetupSpec, document.root, diagnostics)
    if setup is not None:
        _check_names(setup, diagnostics)
        if needs_pictures:
            _check_pictures(setup, path.parent, diagnostics)
    diagnostics.check(SetupError)
    assert setup is not None
    return setup


def list_files(pattern: str, folder: Path) -> list[Path]:
    """Return the files of a pattern, sorted by name."""
    path = Path(pattern)
    if path.is_absolute():
        return sorted(path.parent.glob(path.name))
    return sorted(folder.glob(pattern))


def list_pictures(setup: SetupSpec) -> Iterator[PictureSpec]:
    """Yield all pictures."""
    if setup.reference is not None:
        yield from setup.reference.pictures
    for water in setup.waters:
        yield from water.pictures


def _check_names(setup: SetupSpec, diagnostics: Diagnostics) -> None:
    parts: list[tuple[str, str, Spec]] = [
        *(("channel", channel.name, channel) for channel in setup.channels),
        *(("source", source.name, source) for source in setup.list_sources()),
        *(("water", water.name, water) for water in setup.waters),
    ]
    names: set[tuple[str, str]] = set()
    for kind, name, part in parts:
        if (kind, name) in names:
            diagnostics.error(part, f"{kind} {name!r} is defined twice")
        names.add((kind, name))
    channel_names = [channel.name for channel in setup.channels]
    for source in setup.list_sources():
        for name in source.channels.split():
            if name not in channel_names:
                diagnostics.error(
                    source, f"no channel is called {name!r}.{choices(name, channel_names)}"
                )
    for board in setup.boards:
        if not board.squares:
            diagnostics.error(board, "<board> lacks <square>: the side of each checker's squares")
        if not board.white > board.black:
            diagnostics.error(board, "<white> of a board is not greater than <black>")
    source_names = [source.name for source in setup.list_sources()]
    for picture in list_pictures(setup):
        if picture.source == OPEN_WATER and not setup.boards:
            diagnostics.error(picture, f"a picture of {OPEN_WATER} needs a <board> with its lamp")
        elif picture.source not in (*source_names, OPEN_WATER):
            suggestion = choices(picture.source, [*source_names, OPEN_WATER])
            diagnostics.error(picture, f"no source is called {picture.source!r}.{suggestion}")
        for corners in picture.corners:
            if len(corners.pixels) != CORNER_NUMBERS:
                diagnostics.error(
                    corners,
                    f"<pixels> has {len(corners.pixels)} numbers; expected {CORNER_NUMBERS}",
                )


def _check_pictures(setup: SetupSpec, folder: Path, diagnostics: Diagnostics) -> None:
    if not setup.waters:
        diagnostics.error(None, "<calibration> lacks <water>: the water to calibrate")
    for water in setup.waters:
        if not water.pictures:
            diagnostics.error(water, f"<water> {water.name!r} lacks <picture>")
    for picture in list_pictures(setup):
        for exposure in picture.exposures:
            patterns = (("frames", exposure.frames), ("dark", exposure.dark))
            for name, pattern in patterns:
                if not pattern:
                    continue
                try:
                    n_files = len(list_files(pattern, folder))
                except (ValueError, NotImplementedError, OSError):
                    n_files = 0
                if n_files == 0:
                    diagnostics.error(exposure, f"<{name}>: no file matches {pattern!r}")
                elif n_files > MAX_FRAMES:
                    diagnostics.error(
                        exposure, f"<{name}>: {n_files} files; expected at most {MAX_FRAMES}"
                    )
