"""The film of a recorded trial: its images are drawn from the recorded motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from ...base.geometry import Intrinsics
from ...errors import BadSetting, UnknownName
from ...rendering.grey import grey_truncated
from ...simulation import Simulation
from ..recorded import RecordedLevel, RecordedTrial
from . import overlay
from .curves import CurvePanel, select_curves
from .encoder import Chapter, ImageConversion, conversion_for, encoder_of
from .markers import draw_markers
from .overlay import Pixels
from .paths import CameraPath, ViewKind
from .trial_scene import TrialScene, open_scene

MARGIN = 12
"""The space between panels and the edge [px]."""
STRIP_SHARE = 0.28
"""The height of the strip with the curves and the inset, as a fraction of the film's height."""
BAR_SHARE = 1 / 180
"""The height of the progress bar, as a fraction of the film's height."""


@dataclass(frozen=True, kw_only=True)
class FilmSpec:
    """The settings of a film."""

    size: tuple[int, int] = (960, 720)
    """The width and height [px]; even."""
    rate: float = 30.0
    """The rate of images in the film [Hz]."""
    speed: float = 1.0
    """The playback speed: simulation time per time of the film [1]."""
    view: ViewKind = "orbit"
    """The kind of the view."""
    camera: str | None = None
    """The camera of the inset, or of the view ``camera``; None: the first of the scene."""
    inset: bool = True
    """True if an inset shows the image of a camera."""
    curves: tuple[str, ...] = ()
    """The names of the curves that are drawn; empty: those of the first four recorded measures, or
    all columns of the only one (`curves.select_curves`)."""
    has_curves: bool = True
    """True if curves are drawn."""
    start: float | None = None
    """The simulation time of the first image [s]; None: the beginning of the trial."""
    end: float | None = None
    """The simulation time at which the film ends [s]; None: the end of the trial."""
    samples: int = 1
    """The samples of a pixel of an external view along each axis; 2 gives smooth edges. All kinds
    of view but ``camera`` are external."""
    fog: bool = False
    """True if an external view has the water's fog; images of cameras always have it."""


class Film:
    """A film of one trial.

    Args:
        trial: the trial.
        spec: the settings of the film.
        simulation: the scene, if it is open (`trial_scene.open_scene`); None: it is opened here.

    Raises:
        BadSetting: the span from start to end is empty, or the view is ``camera`` and the scene has
            no virtual camera.
        UnknownName: there is no such camera or curve.
    """

    def __init__(
        self, trial: RecordedTrial, spec: FilmSpec, simulation: Simulation | None = None
    ) -> None:
        self._trial = trial
        self.spec = spec
        """The settings of the film."""
        start, self._end = span_of(trial, spec)
        self.start = start
        """The simulation time of the first image [s]."""
        self.n_frames = n_frames_of(trial, spec)
        """The number of images."""
        _check_curves(trial, spec)
        self._scene = TrialScene(trial, simulation)
        self._scene.show_time(self.start)
        self._camera = self._find_camera()
        self._letter_height = max(11, round(spec.size[1] / 45))
        self._view_size = spec.size[0], self._strip_top - self._head_height
        self._path = CameraPath(self._scene, spec.view, self._view_size, self.start)
        self._panels: dict[int, CurvePanel] = {}
        self._inset: tuple[float, Pixels] | None = None  # simulation time [s], and image

    def time_of(self, index: int) -> float:
        """Return the simulation time of an image [s] by its index, 0 <= index < `n_frames`."""
        return self.start + index * self.spec.speed / self.spec.rate

    def frames(self, to_bytes: ImageConversion) -> Iterator[bytes]:
        """Draw all images, each converted to the bytes that the encoder expects."""
        for index in range(self.n_frames):
            yield to_bytes(self.draw(self.time_of(index)))

    def draw(self, time: float) -> Pixels:
        """Draw the image at a simulation time [s], (h, w, 3)."""
        self._scene.show_time(time)
        frame = np.empty((self.spec.size[1], self.spec.size[0], 3), np.uint8)
        frame[: self._head_height] = frame[self._strip_top :] = overlay.PANEL
        frame[self._head_height : self._strip_top] = self._view_image(time)
        level_index, level = self._level(time)
        if self._inset_size is not None:
            self._draw_inset(frame, time)
        if level is not None and level_index is not None and self.spec.has_curves:
            self._panel(level_index, level).draw(frame, time)
        self._draw_status(frame, time, level)
        return frame

    def chapters(self) -> list[Chapter]:
        """Return a chapter for each level, and one for the time before the first."""
        return chapters_of([self._trial], self.spec)

    def close(self) -> None:
        """Close the scene."""
        self._scene.close()

    def _shown_levels(self) -> list[tuple[int, RecordedLevel]]:
        return shown_levels(self._trial, self.spec)

    def _level(self, time: float) -> tuple[int | None, RecordedLevel | None]:
        """Return the level that is measured at a time, with its index, if there is one."""
        for index, level in reversed(list(enumerate(self._trial.levels))):
            if level.start_time - 1e-9 <= time <= level.end_time + 1e-9:
                return index, level
        return None, None

    def _find_camera(self) -> str | None:
        cameras = self._scene.simulation.world.sensors.cameras
        name = self.spec.camera
        if name is not None and name not in cameras:
            raise UnknownName("virtual camera", name, cameras)
        if self.spec.view == "camera" and not cameras:
            raise BadSetting("--view camera: the scene has no virtual camera.")
        return name or next(iter(cameras), None)

    def _view_image(self, time: float) -> Pixels:
        if self.spec.view == "camera":
            assert self._camera is not None
            return self._camera_image(self._camera, self._view_size, time)
        scenery = self._scene.simulation.world.scenery
        pose, intrinsics = self._path.pose(time), self._path.intrinsics
        output = scenery.render_view(
            pose,
            intrinsics,
            targets={"colour"},
            fog=None if self.spec.fog else 0.0,
            samples=self.spec.samples,
        )
        assert output.colour is not None
        markers = self._scene.markers(time)
        image = output.colour.view(np.uint8)
        return draw_markers(image, markers, pose, intrinsics, self._letter_height)

    def _camera_image(self, name: str, size: tuple[int, int], time: float) -> Pixels:
        """Return a camera's image without noise, with the true and the estimated quadrangle."""
        scene = self._scene.simulation.world
        camera = scene.sensors.camera(name)
        intrinsics = fit_intrinsics(camera.intrinsics, size)
        output = scene.scenery.render_clean(
            camera.world_from_camera, intrinsics, targets={"colour"}, is_polished=camera.is_polished
        )
        assert output.colour is not None
        image = output.colour.view(np.uint8)
        if camera.is_grey:
            image = np.repeat(grey_truncated(image)[..., None], 3, axis=2)
        scale = intrinsics.width / camera.intrinsics.width
        for kind, colour in (("truth", overlay.TRUTH), ("estimate", overlay.ESTIMATE)):
            corners = self._scene.corners(kind, name, time)
            if corners is not None:
                image = overlay.draw_quadrangle(image, (corners + 0.5) * scale - 0.5, colour)
        has_size = (intrinsics.width, intrinsics.height) == size
        return image if has_size else centre_image(image, size)

    def _draw_inset(self, frame: Pixels, time: float) -> None:
        """Draw a camera's image at the right of the strip; it changes ten times a second.

        It shows the time rounded down to a tenth of a second, not the time of an image that was
        drawn before: so the bytes do not depend on the number of drawing processes.
        """
        assert self._camera is not None
        assert self._inset_size is not None
        width, height = self._inset_size
        inset_time = max(self.start, math.floor(time * 10.0 + 1e-6) / 10.0)
        if self._inset is None or self._inset[0] != inset_time:
            self._scene.show_time(inset_time)
            image = self._camera_image(self._camera, self._inset_size, inset_time)
            self._inset = inset_time, image
        x, y = self.spec.size[0] - width - MARGIN, self._strip_top + MARGIN
        overlay.paste(frame, self._inset[1], x, y)
        name = self._camera
        overlay.write_text(
            frame, name, (x, y + height + 3), self._small_letter_height, overlay.GREY
        )

    @property
    def _head_height(self) -> int:
        """The height of the title row [px]."""
        return round(2.2 * self._letter_height)

    @property
    def _bar_height(self) -> int:
        """The height of the progress bar at the bottom [px]."""
        return max(2, round(BAR_SHARE * self.spec.size[1]))

    @property
    def _small_letter_height(self) -> int:
        """The height of the letters of the inset's name [px]."""
        return max(10, round(0.8 * self._letter_height))

    @property
    def _strip_top(self) -> int:
        """The first row of the strip, below the view [px]."""
        height = self.spec.size[1]
        levels = self._shown_levels()
        names = self.spec.curves
        has_curves = self.spec.has_curves and any(select_curves(i, names) for _, i in levels)
        is_needed = self._has_inset or has_curves
        return height - self._bar_height - (round(STRIP_SHARE * height) if is_needed else 0)

    @property
    def _has_inset(self) -> bool:
        return self.spec.inset and self._camera is not None and self.spec.view != "camera"

    @property
    def _inset_size(self) -> tuple[int, int] | None:
        """The width and height of the camera's image in the strip [px]; None without one."""
        if not self._has_inset:
            return None
        assert self._camera is not None
        intrinsics = self._scene.simulation.world.sensors.camera(self._camera).intrinsics
        strip = self.spec.size[1] - self._bar_height - self._strip_top
        height = strip - 2 * MARGIN - round(1.2 * self._small_letter_height)
        width = min(round(height * intrinsics.width / intrinsics.height), self.spec.size[0] // 2)
        return width, min(height, round(width * intrinsics.height / intrinsics.width))

    def _panel(self, index: int, level: RecordedLevel) -> CurvePanel:
        if index not in self._panels:
            width, height = self.spec.size
            inset = 0 if self._inset_size is None else self._inset_size[0] + MARGIN
            top = self._strip_top + MARGIN
            box = MARGIN, top, width - 2 * MARGIN - inset, height - self._bar_height - MARGIN - top
            self._panels = {index: CurvePanel(level, self.spec.curves, box, self._letter_height)}
        return self._panels[index]

    def _draw_status(self, frame: Pixels, time: float, level: RecordedLevel | None) -> None:
        """Draw title, level and clock at the top, and the progress bar at the bottom."""
        width, height = self.spec.size
        size = self._letter_height
        top = round(0.4 * size)
        x = MARGIN + overlay.write_text(frame, self._trial.title, (MARGIN, top), size) + 2 * size
        if level is not None:
            x += overlay.write_text(frame, level.label, (x, top), size, overlay.GREY) + size
            colour = overlay.STATUS.get(level.status, overlay.FAILURE)
            overlay.write_text(frame, level.status, (x, top), size, colour)
        overlay.write_text(frame, f"{time:.1f} s", (width - MARGIN, top), size, right=True)
        fraction = (time - self.start) / (self._end - self.start)
        frame[height - self._bar_height :] = overlay.PANEL
        frame[height - self._bar_height :, : round(fraction * width)] = overlay.COLOURS[0]
        for _, shown_level in self._shown_levels():
            mark = round((shown_level.start_time - self.start) / (self._end - self.start) * width)
            if 0 < mark < width:
                frame[height - self._bar_height :, mark] = overlay.INK


class TrialSequenceFilm:
    """A film of several trials of one result and seed, one after the other.

    Args:
        trials: the trials in order; one at least.
        spec: the settings of the film.

    Raises:
        BadSetting: the settings are invalid for a trial (`Film`).
        UnknownName: there is no such camera or curve (`Film`).
    """

    def __init__(self, trials: Sequence[RecordedTrial], spec: FilmSpec) -> None:
        self._trials, self.spec = trials, spec
        """The settings of the film."""
        self._n_frames = [n_frames_of(trial, spec) for trial in trials]
        for trial in trials:
            _check_curves(trial, spec)
        self._trial_number, self._simulation = 0, open_scene(trials[0])
        try:
            self._film = Film(trials[0], spec, self._simulation)
        except BaseException:
            self._simulation.close()
            raise
        self.n_frames = sum(self._n_frames)
        """The number of images."""

    def frames(self, to_bytes: ImageConversion) -> Iterator[bytes]:
        """Draw all images, each converted to the bytes that the encoder expects."""
        for index in range(self.n_frames):
            yield to_bytes(self.draw(index))

    def draw(self, index: int) -> Pixels:
        """Draw an image by its index, 0 <= index < `n_frames`, (h, w, 3)."""
        number = 0
        while index >= self._n_frames[number]:
            index -= self._n_frames[number]
            number += 1
        film = self._film_of(number)
        return film.draw(film.time_of(index))

    def _film_of(self, number: int) -> Film:
        """Return the film of a trial; only one scene is open at a time."""
        if number != self._trial_number:
            previous_trial, trial = self._trials[self._trial_number], self._trials[number]
            if trial.level_settings != previous_trial.level_settings:
                self._simulation.close()
                self._simulation = open_scene(trial)
            self._trial_number, self._film = number, Film(trial, self.spec, self._simulation)
        return self._film

    def chapters(self) -> list[Chapter]:
        """Return the chapters of all trials."""
        return chapters_of(self._trials, self.spec)

    def close(self) -> None:
        """Close the scene."""
        self._simulation.close()


def span_of(trial: RecordedTrial, spec: FilmSpec) -> tuple[float, float]:
    """Return the simulation times of the first image and of the end [s].

    Raises:
        BadSetting: the span is empty.
    """
    duration = trial.track.duration
    start = 0.0 if spec.start is None else max(0.0, spec.start)
    end = duration if spec.end is None else min(spec.end, duration)
    if not start < end:
        raise BadSetting(
            f"The trial has no image from {start:g} s to {end:g} s: it is {duration:g} s long."
        )
    return start, end


def n_frames_of(trial: RecordedTrial, spec: FilmSpec) -> int:
    """Return the number of images of a trial's film; raise BadSetting if the span is empty."""
    start, end = span_of(trial, spec)
    return max(1, math.ceil((end - start) * spec.rate / spec.speed - 1e-6))


def shown_levels(trial: RecordedTrial, spec: FilmSpec) -> list[tuple[int, RecordedLevel]]:
    """Return the levels that a film shows, each with its index."""
    start, end = span_of(trial, spec)
    levels = enumerate(trial.levels)
    return [(i, level) for i, level in levels if level.end_time > start and level.start_time < end]


def chapters_of(trials: Sequence[RecordedTrial], spec: FilmSpec) -> list[Chapter]:
    """Return a chapter for each level of trials that are shown one after the other.

    The time before the first level of a trial is a separate chapter.
    """
    chapters, film_time = [], 0.0
    for trial in trials:
        start, stop = span_of(trial, spec)
        levels = shown_levels(trial, spec)
        starts = [(level.start_time, level.label or f"level {i}") for i, level in levels]
        if not starts or starts[0][0] > start:
            starts.insert(0, (start, "start"))
        ends = [level_start for level_start, _ in starts[1:]] + [stop]
        scale = 1.0 / spec.speed
        chapters += [
            Chapter(
                title=title,
                start=(max(level_start, start) - start) * scale + film_time,
                end=(end - start) * scale + film_time,
            )
            for (level_start, title), end in zip(starts, ends, strict=True)
        ]
        film_time += n_frames_of(trial, spec) / spec.rate
    return chapters


class FrameSource(Protocol):
    """A source of a film's images: `Film`, `TrialSequenceFilm` or `processes.DrawingProcesses`."""

    @property
    def spec(self) -> FilmSpec:
        """The settings of the film."""

    def frames(self, to_bytes: ImageConversion) -> Iterator[bytes]:
        """Draw all images, each converted to the bytes that the encoder expects."""

    def chapters(self) -> list[Chapter]:
        """Return the chapters of the film."""


def save_film(film: FrameSource, path: Path, on_frame: Callable[[], object] = lambda: None) -> None:
    """Draw a film and write it.

    After an interruption the file has the images drawn before; after an error there is no file.

    Args:
        film: the film.
        path: the path of the file; its suffix is one of `encoder.SUFFIXES`.
        on_frame: the callback after each image.
    """
    encoder = encoder_of(path, film.spec.size, film.spec.rate, film.chapters())
    keeps_file = False
    try:
        for frame in film.frames(conversion_for(path)):
            encoder.add(frame)
            on_frame()
        keeps_file = True
    except KeyboardInterrupt:
        keeps_file = True
        raise
    finally:
        encoder.close(keeps_file=keeps_file)


def fit_intrinsics(intrinsics: Intrinsics, size: tuple[int, int]) -> Intrinsics:
    """Return a camera's intrinsics, scaled to the largest image of its aspect ratio in a size."""
    scale = min(size[0] / intrinsics.width, size[1] / intrinsics.height)
    width, height = round(scale * intrinsics.width), round(scale * intrinsics.height)
    return intrinsics.with_size(max(1, width), max(1, height))


def centre_image(image: Pixels, size: tuple[int, int]) -> Pixels:
    """Return an image in the middle of a black one of a given size."""
    frame = np.zeros((size[1], size[0], 3), np.uint8)
    x, y = (size[0] - image.shape[1]) // 2, (size[1] - image.shape[0]) // 2
    frame[y : y + image.shape[0], x : x + image.shape[1]] = image
    return frame


def _check_curves(trial: RecordedTrial, spec: FilmSpec) -> None:
    curves = [curve for level in trial.levels for curve in (*level.curves, *level.details)]
    measures = dict.fromkeys(curve.measure for curve in curves)
    for name in spec.curves:
        if name not in measures:
            raise UnknownName("recorded measure", name, tuple(measures))
