"""The readings of all pictures of a set-up."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import AssetError, BadSetting, MissingExtra
from ...optics.phase_function import FloatArray
from ...schema import Diagnostics
from ..measurements import OpenWaterReading, WaterReadings
from ..readings import BoardReading, LedReading, Reading, average_geometry
from ..setup import (
    BoardSpec,
    ChannelSpec,
    LedSpec,
    PictureSpec,
    SetupError,
    SetupSpec,
    WaterSpec,
    list_files,
)
from .board_squares import Checker, find_checkers, read_difference
from .frames import average_frames
from .led_discs import HALF_ANGLES, Sum, find_led, sum_discs
from .linear_picture import Exposure, LinearPicture, combine_exposures

MAX_NOISE = 0.2
"""The relative noise above which a signal is not read."""
OPEN_WATER_ANGLE = math.radians(2.0)
"""The half-angle of the disc at the centre whose mean is the veil of open water [rad]."""

SignalKey = tuple[str, str, float, float]
"""The source, channel, distance [m], and half-angle [rad] or side [m]."""
CheckerTable = dict[tuple[str, float], dict[float, Checker]]
"""The checkers by source and distance, then by side."""


@dataclass
class _Signals:
    """The signals of the pictures of one water."""

    sums: dict[SignalKey, Sum] = field(default_factory=dict)
    centres: dict[str, Sum] = field(default_factory=dict)
    """The radiance at the centre of the picture of open water, by channel."""
    checkers: CheckerTable = field(default_factory=dict)
    is_reference: bool = False
    shape: tuple[int, ...] = (0, 0)
    remarks: list[str] = field(default_factory=list)


def read_pictures(setup: SetupSpec, folder: Path) -> tuple[WaterReadings, ...]:
    """Read the pictures of a set-up.

    Args:
        setup: the set-up.
        folder: the folder of its files.

    Raises:
        SetupError: pictures are invalid; the error has all of them, with their lines.
    """
    diagnostics = Diagnostics(setup.source_line.file if setup.source_line else "set-up")
    pictures = _PictureReader(setup, folder, diagnostics)
    reference = None
    if setup.reference is not None:
        reference = pictures.read_all(setup.reference.pictures, {}, is_reference=True)
    checkers = reference.checkers if reference else {}
    signals = [pictures.read_all(water.pictures, checkers) for water in setup.waters]
    diagnostics.check(SetupError)
    return tuple(
        _make_readings(setup, water, water_signals, reference)
        for water, water_signals in zip(setup.waters, signals, strict=True)
    )


class _PictureReader:
    """A reader of pictures, which collects errors."""

    def __init__(self, setup: SetupSpec, folder: Path, diagnostics: Diagnostics) -> None:
        self._setup = setup
        self._folder = folder
        self._diagnostics = diagnostics

    def read_all(
        self,
        pictures: Sequence[PictureSpec],
        checkers: CheckerTable,
        *,
        is_reference: bool = False,
    ) -> _Signals:
        signals = _Signals(checkers=dict(checkers), is_reference=is_reference)
        for picture in pictures:
            try:
                self._read_picture(picture, signals)
            except (BadSetting, AssetError, MissingExtra) as error:
                text = f"the picture of {picture.source!r}: {error}"
                self._diagnostics.error(picture, text)
        return signals

    def _read_picture(self, picture: PictureSpec, signals: _Signals) -> None:
        exposures = [
            Exposure(
                exposure.time,
                average_frames(list_files(exposure.frames, self._folder)),
                average_frames(list_files(exposure.dark, self._folder)) if exposure.dark else None,
            )
            for exposure in picture.exposures
        ]
        signals.shape = exposures[0].frames.values.shape
        source = self._setup.find_source(picture.source)
        channels = self._setup.list_channels(source) if source else self._setup.channels
        linear = {channel.name: self._combine(exposures, channel) for channel in channels}
        if isinstance(source, LedSpec):
            self._read_led(picture, source, linear, signals)
        elif isinstance(source, BoardSpec):
            self._read_board(picture, source, linear, signals)
        else:
            for name, values in linear.items():
                signals.centres[name] = self._read_centre(values)

    def _combine(self, exposures: Sequence[Exposure], channel: ChannelSpec) -> LinearPicture:
        camera = self._setup.camera
        return combine_exposures(
            exposures,
            plane=channel.plane,
            full_scale=camera.full_scale,
            encoding=camera.encoding,
        )

    def _read_led(
        self,
        picture: PictureSpec,
        source: LedSpec,
        linear: dict[str, LinearPicture],
        signals: _Signals,
    ) -> None:
        distance = picture.distance or source.distance
        for name, values in linear.items():
            centre = find_led(values)
            sums = sum_discs(values, centre, self._setup.camera.focal_length)
            for half_angle, total in zip(HALF_ANGLES, sums, strict=True):
                words = f"{source.name}, {name}, {math.degrees(half_angle):g}°"
                if total is None:
                    signals.remarks.append(f"{words}: saturated, or outside of the picture")
                elif _is_clear(total, words, signals):
                    signals.sums[source.name, name, distance, half_angle] = total

    def _read_board(
        self,
        picture: PictureSpec,
        source: BoardSpec,
        linear: dict[str, LinearPicture],
        signals: _Signals,
    ) -> None:
        distance = picture.distance or source.distance
        key = (source.name, distance)
        if picture.corners:
            first = next(iter(linear.values()))
            signals.checkers[key] = {
                spec.square: _orient(first, np.array(spec.pixels).reshape(4, 2))
                for spec in picture.corners
            }
        elif key not in signals.checkers:
            scale = self._setup.camera.focal_length / distance
            brightest_channel = max(linear.values(), key=lambda values: float(values.values.mean()))
            signals.checkers[key] = find_checkers(
                brightest_channel, source.squares, scale, is_clear=signals.is_reference
            )
        for name, values in linear.items():
            for side, checker in signals.checkers[key].items():
                words = f"{source.name}, {name}, squares of {side * 100:g} cm"
                total = read_difference(values, checker)
                if _is_clear(total, words, signals):
                    signals.sums[source.name, name, distance, side] = total

    def _read_centre(self, picture: LinearPicture) -> Sum:
        rows, columns = picture.values.shape
        y, x = np.indices(picture.values.shape)
        radii = np.hypot(x - (columns - 1) / 2.0, y - (rows - 1) / 2.0)
        is_near = radii <= self._setup.camera.focal_length * math.tan(OPEN_WATER_ANGLE)
        if not is_near.any():
            raise BadSetting(
                f"the disc of {math.degrees(OPEN_WATER_ANGLE):g}° at the centre has no pixel; "
                f"<focalLength> is {self._setup.camera.focal_length:g} pixels."
            )
        if not picture.is_valid[is_near].all():
            raise BadSetting("the centre is saturated; use a shorter exposure.")
        variance = float(picture.variances[is_near].sum()) / is_near.sum() ** 2
        black_error = float(picture.black_errors[is_near].mean())
        error = math.hypot(math.sqrt(variance), black_error)
        return Sum(float(picture.values[is_near].mean()), error)


def _is_clear(total: Sum, words: str, signals: _Signals) -> bool:
    """Return whether a signal is above its noise; else add a remark."""
    if total.value > 0.0 and total.error <= MAX_NOISE * total.value:
        return True
    signals.remarks.append(f"{words}: below the noise")
    return False


def _orient(picture: LinearPicture, corners: FloatArray) -> Checker:
    """Return a checker whose white squares are the brighter ones."""
    checker = Checker(corners, 1.0)
    return checker if read_difference(picture, checker).value >= 0.0 else Checker(corners, -1.0)


def _make_readings(
    setup: SetupSpec, water: WaterSpec, signals: _Signals, reference: _Signals | None
) -> WaterReadings:
    readings: list[Reading] = []
    remarks = list(signals.remarks)
    reference_sums = reference.sums if reference else {}
    sources_with_reference = {key[0] for key in reference_sums}
    for key, total in signals.sums.items():
        source = setup.find_source(key[0])
        reference_total = reference_sums.get(key)
        if source is None:
            continue
        if reference_total is None and key[0] in sources_with_reference:
            remarks.append(f"{key[0]}, {key[1]}: no reference at {key[2]:g} m, size {key[3]:.3g}")
            continue
        noise = total.error / total.value
        if reference_total is not None:
            noise = math.hypot(noise, reference_total.error / reference_total.value)
        shared_fields: dict[str, Any] = {
            "channel": key[1],
            "source": key[0],
            "signal": total.value,
            "reference": reference_total.value if reference_total else None,
            "noise": noise,
        }
        if isinstance(source, LedSpec):
            readings.append(LedReading(distance=key[2], half_angle=key[3], **shared_fields))
        else:
            checker = signals.checkers[key[0], key[2]][key[3]]
            geometry = find_geometry(setup, source, checker, key[2], signals.shape)
            readings.append(
                BoardReading(
                    side=key[3],
                    lamp_half_angle=source.lamp_half_angle,
                    distance=geometry[0],
                    lamp_distance=geometry[1],
                    incidence=geometry[2],
                    **shared_fields,
                )
            )
    return WaterReadings(
        name=water.name,
        dose=water.dose,
        readings=tuple(readings),
        open_water=_make_open_water(setup, signals, reference, readings),
        remarks=tuple(remarks),
    )


def find_geometry(
    setup: SetupSpec,
    board: BoardSpec,
    checker: Checker,
    distance: float,
    shape: tuple[int, ...],
) -> tuple[float, float, float]:
    """Find the distances of a checker from camera and lamp [m], and the mean incidence.

    The board is across the optical axis, which meets the middle of the picture.

    Args:
        setup: the set-up.
        board: the board.
        checker: the checker.
        distance: the distance of the board's plane [m].
        shape: the rows and columns of the picture.
    """
    middle = np.array([(shape[1] - 1) / 2.0, (shape[0] - 1) / 2.0])
    places = (checker.square_centres - middle) / setup.camera.focal_length * distance
    points = np.column_stack([places, np.full(4, distance)])
    return average_geometry(points, board.lamp_position)


def _make_open_water(
    setup: SetupSpec, signals: _Signals, reference: _Signals | None, readings: Sequence[Reading]
) -> tuple[OpenWaterReading, ...]:
    """Relate the veil to the board in the reference water, whose light the lamp's intensity sets.

    The ratio is V over the radiance of a white surface in 1 W/m^2, 1 / pi, for a lamp of 1 W/sr;
    the loss of the reference water on the board is removed with the estimate (`backscatter`).
    """
    if reference is None:
        return ()
    open_readings = []
    for channel, centre in signals.centres.items():
        boards = {
            reading: reading.reference
            for reading in readings
            if isinstance(reading, BoardReading)
            and reading.channel == channel
            and reading.reference is not None
        }
        if not boards or centre.value <= 0.0:
            continue
        board = max(boards, key=lambda reading: reading.side)
        spec = setup.find_source(board.source)
        assert isinstance(spec, BoardSpec)
        board_light = boards[board] / (spec.white - spec.black) / board.geometry
        open_readings.append(
            OpenWaterReading(
                channel=channel,
                ratio=centre.value / board_light,
                lamp_position=spec.lamp_position,
                lamp_half_angle=spec.lamp_half_angle,
            )
        )
    return tuple(open_readings)
