"""The film of a recorded trial: image by image, from the motion that was kept."""

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
from .curves import CurvePanel, chosen
from .encoder import Chapter, Packing, encoder_of, packing_of
from .markers import draw_markers
from .overlay import Pixels
from .paths import CameraPath, ViewKind
from .puppets import Puppets, scene_of

MARGIN = 12
"""Between panels and the edge [px]."""
STRIP = 0.28
"""Height of the strip below the view, which has the curves and the inset, as part of the film's."""
BAR = 1 / 180
"""Height of the bar that shows how far the film is, as part of the film's."""


@dataclass(frozen=True, kw_only=True)
class FilmSpec:
    """What a film shows."""

    size: tuple[int, int] = (960, 720)
    """Width and height [px]; even."""
    rate: float = 30.0
    """Images a second [Hz]."""
    speed: float = 1.0
    """Simulation time in a second of the film [s]."""
    view: ViewKind = "orbit"
    """From where."""
    camera: str | None = None
    """The camera of the inset, or of the view ``camera``; None: the first of the scene."""
    inset: bool = True
    """Whether a camera's image is shown in a corner."""
    curves: tuple[str, ...] = ()
    """Measures whose curves are drawn; empty: the first ones."""
    has_curves: bool = True
    """Whether any curve is drawn."""
    start: float | None = None
    """Simulation time of the first image; None: the beginning [s]."""
    end: float | None = None
    """Simulation time of the last image; None: the end [s]."""
    samples: int = 1
    """Of a pixel of the view from outside, in width and in height: 2 has smooth edges."""
    fog: bool = False
    """Whether the view from outside has the water's fog; cameras always have it."""


class Film:
    """A film while it is drawn.

    Args:
        trial: what is seen.
        spec: how.
        simulation: the scene, opened before (`puppets.scene_of`); None: it is opened.

    Raises:
        BadSetting: nothing lies between start and end, or a measure has no curve.
        UnknownName: there is no such camera.
    """

    def __init__(
        self, trial: RecordedTrial, spec: FilmSpec, simulation: Simulation | None = None
    ) -> None:
        self._trial = trial
        self.spec = spec
        """What it shows."""
        start, self._end = span_of(trial, spec)
        self.start = start
        """Simulation time of the first image [s]."""
        self.n_frames = n_frames_of(trial, spec)
        """Number of images."""
        _check_curves(trial, spec)
        self._puppets = Puppets(trial, simulation)
        self._puppets.put(self.start)
        self._camera = self._chosen_camera()
        self._letters = max(11, round(spec.size[1] / 45))
        self._view_size = spec.size[0], self._strip_top - self._head_height
        self._path = CameraPath(self._puppets, spec.view, self._view_size, self.start)
        self._panels: dict[int, CurvePanel] = {}
        self._inset: tuple[float, Pixels] | None = None

    def time_of(self, frame: int) -> float:
        """Return the simulation time of an image [s]."""
        return self.start + frame * self.spec.speed / self.spec.rate

    def frames(self, pack: Packing) -> Iterator[bytes]:
        """Draw all images, each packed."""
        for number in range(self.n_frames):
            yield pack(self.draw(self.time_of(number)))

    def draw(self, time: float) -> Pixels:
        """Draw the image of a simulation time [s], (h, w, 3)."""
        self._puppets.put(time)
        frame = np.empty((self.spec.size[1], self.spec.size[0], 3), np.uint8)
        frame[: self._head_height] = frame[self._strip_top :] = overlay.PANEL
        frame[self._head_height : self._strip_top] = self._view(time)
        number, level = self._level(time)
        if self._inset_size is not None:
            self._draw_inset(frame, time)
        if level is not None and number is not None and self.spec.has_curves:
            self._panel(number, level).draw(frame, time)
        self._write(frame, time, level)
        return frame

    def chapters(self) -> list[Chapter]:
        """Return a chapter for each level, and one for what is before the first."""
        return chapters_of([self._trial], self.spec)

    def close(self) -> None:
        """Close the scene."""
        self._puppets.close()

    def _shown_levels(self) -> list[tuple[int, RecordedLevel]]:
        return shown_levels(self._trial, self.spec)

    def _level(self, time: float) -> tuple[int | None, RecordedLevel | None]:
        """The level measured at a time, if there is one."""
        for number, level in reversed(list(enumerate(self._trial.levels))):
            if level.began - 1e-9 <= time <= level.ended + 1e-9:
                return number, level
        return None, None

    def _chosen_camera(self) -> str | None:
        cameras = self._puppets.simulation.world.sensors.cameras
        wanted = self.spec.camera
        if wanted is not None and wanted not in cameras:
            raise UnknownName("virtual camera", wanted, cameras)
        if self.spec.view == "camera" and not cameras:
            raise BadSetting("--view camera: the scene has no virtual camera.")
        return wanted or next(iter(cameras), None)

    def _view(self, time: float) -> Pixels:
        if self.spec.view == "camera":
            assert self._camera is not None
            return self._seen(self._camera, self._view_size, time)
        scenery = self._puppets.simulation.world.scenery
        pose, lens = self._path.pose(time), self._path.intrinsics
        rendered = scenery.render_view(
            pose,
            lens,
            targets={"colour"},
            fog=None if self.spec.fog else 0.0,
            samples=self.spec.samples,
        )
        assert rendered.colour is not None
        markers = self._puppets.markers(time)
        return draw_markers(rendered.colour.view(np.uint8), markers, pose, lens, self._letters)

    def _seen(self, name: str, size: tuple[int, int], time: float) -> Pixels:
        """What a camera sees, without noise, with the corners of truth and estimate."""
        world = self._puppets.simulation.world
        camera = world.sensors.camera(name)
        lens = fitted(camera.intrinsics, size)
        rendered = world.scenery.render_clean(
            camera.world_from_camera, lens, targets={"colour"}, is_polished=camera.is_polished
        )
        assert rendered.colour is not None
        image = rendered.colour.view(np.uint8)
        if camera.is_grey:
            image = np.repeat(grey_truncated(image)[..., None], 3, axis=2)
        scale = lens.width / camera.intrinsics.width
        for kind, colour in (("truth", overlay.TRUTH), ("estimate", overlay.ESTIMATE)):
            corners = self._puppets.corners(kind, name, time)
            if corners is not None:
                image = overlay.quadrangle(image, (corners + 0.5) * scale - 0.5, colour)
        return image if (lens.width, lens.height) == size else centred(image, size)

    def _draw_inset(self, frame: Pixels, time: float) -> None:
        """Draw a camera's image at the right of the strip; it changes ten times a second.

        It shows the camera's view of the last tenth of a second, whatever was drawn before: films
        that several processes draw have the same bytes.
        """
        assert self._camera is not None
        assert self._inset_size is not None
        width, height = self._inset_size
        due = max(self.start, math.floor(time * 10.0 + 1e-6) / 10.0)
        if self._inset is None or self._inset[0] != due:
            self._puppets.put(due)
            self._inset = due, self._seen(self._camera, self._inset_size, due)
        x, y = self.spec.size[0] - width - MARGIN, self._strip_top + MARGIN
        overlay.paste(frame, self._inset[1], x, y)
        name = self._camera
        overlay.write(frame, name, (x, y + height + 3), self._small_letters, overlay.DIM)

    @property
    def _head_height(self) -> int:
        """Height of what is written above [px]."""
        return round(2.2 * self._letters)

    @property
    def _bar(self) -> int:
        """Height of the bar at the bottom [px]."""
        return max(2, round(BAR * self.spec.size[1]))

    @property
    def _small_letters(self) -> int:
        """Height of the letters of the inset's name [px]."""
        return max(10, round(0.8 * self._letters))

    @property
    def _strip_top(self) -> int:
        """The first row below the view [px]."""
        height = self.spec.size[1]
        levels = self._shown_levels()
        has_curves = self.spec.has_curves and any(chosen(i, self.spec.curves) for _, i in levels)
        is_needed = self._has_inset or has_curves
        return height - self._bar - (round(STRIP * height) if is_needed else 0)

    @property
    def _has_inset(self) -> bool:
        return self.spec.inset and self._camera is not None and self.spec.view != "camera"

    @property
    def _inset_size(self) -> tuple[int, int] | None:
        """Width and height of the camera's image in the strip [px]; None without one."""
        if not self._has_inset:
            return None
        assert self._camera is not None
        lens = self._puppets.simulation.world.sensors.camera(self._camera).intrinsics
        strip = self.spec.size[1] - self._bar - self._strip_top
        height = strip - 2 * MARGIN - round(1.2 * self._small_letters)
        width = min(round(height * lens.width / lens.height), self.spec.size[0] // 2)
        return width, min(height, round(width * lens.height / lens.width))

    def _panel(self, number: int, level: RecordedLevel) -> CurvePanel:
        if number not in self._panels:
            width, height = self.spec.size
            inset = 0 if self._inset_size is None else self._inset_size[0] + MARGIN
            top = self._strip_top + MARGIN
            box = MARGIN, top, width - 2 * MARGIN - inset, height - self._bar - MARGIN - top
            self._panels = {number: CurvePanel(level, self.spec.curves, box, self._letters)}
        return self._panels[number]

    def _write(self, frame: Pixels, time: float, level: RecordedLevel | None) -> None:
        """Write title, level and clock above, and draw below how far the film is."""
        width, height = self.spec.size
        size = self._letters
        top = round(0.4 * size)
        at = MARGIN + overlay.write(frame, self._trial.title, (MARGIN, top), size) + 2 * size
        if level is not None:
            at += overlay.write(frame, level.label, (at, top), size, overlay.DIM) + size
            colour = overlay.STATUS.get(level.status, overlay.FAILED)
            overlay.write(frame, level.status, (at, top), size, colour)
        overlay.write(frame, f"{time:.1f} s", (width - MARGIN, top), size, right=True)
        share = (time - self.start) / (self._end - self.start)
        frame[height - self._bar :] = overlay.PANEL
        frame[height - self._bar :, : round(share * width)] = overlay.COLOURS[0]
        for _, one in self._shown_levels():
            mark = round((one.began - self.start) / (self._end - self.start) * width)
            if 0 < mark < width:
                frame[height - self._bar :, mark] = overlay.INK


class Reel:
    """A film of several trials of one result and seed, one after the other.

    Args:
        trials: in order; one at least.
        spec: how each is shown.

    Raises:
        BadSetting: as of `Film`.
        UnknownName: as of `Film`.
    """

    def __init__(self, trials: Sequence[RecordedTrial], spec: FilmSpec) -> None:
        self._trials, self.spec = trials, spec
        """What it shows."""
        self._simulation = scene_of(trials[0])
        try:
            self._films = [Film(trial, spec, self._simulation) for trial in trials]
        except BaseException:
            self._simulation.close()
            raise
        self.n_frames = sum(film.n_frames for film in self._films)
        """Number of images."""

    def frames(self, pack: Packing) -> Iterator[bytes]:
        """Draw all images, each packed."""
        for number in range(self.n_frames):
            yield pack(self.draw(number))

    def draw(self, number: int) -> Pixels:
        """Draw an image by its number, 0 <= number < `n_frames`, (h, w, 3)."""
        for film in self._films:
            if number < film.n_frames:
                break
            number -= film.n_frames
        return film.draw(film.time_of(number))

    def chapters(self) -> list[Chapter]:
        """Return the chapters of all."""
        return chapters_of(self._trials, self.spec)

    def close(self) -> None:
        """Close the scene."""
        self._simulation.close()


def span_of(trial: RecordedTrial, spec: FilmSpec) -> tuple[float, float]:
    """Return the simulation times of the first image and of the end [s].

    Raises:
        BadSetting: nothing lies between them.
    """
    last = trial.track.duration
    start = 0.0 if spec.start is None else max(0.0, spec.start)
    end = last if spec.end is None else min(spec.end, last)
    if not start < end:
        raise BadSetting(
            f"Nothing to show from {start:g} s to {end:g} s: the trial is {last:g} s long."
        )
    return start, end


def n_frames_of(trial: RecordedTrial, spec: FilmSpec) -> int:
    """Return how many images a film of a trial has; raises BadSetting as `span_of`."""
    start, end = span_of(trial, spec)
    return max(1, math.ceil((end - start) * spec.rate / spec.speed - 1e-6))


def shown_levels(trial: RecordedTrial, spec: FilmSpec) -> list[tuple[int, RecordedLevel]]:
    """Return number and level of those of which a film shows something."""
    start, end = span_of(trial, spec)
    return [(i, one) for i, one in enumerate(trial.levels) if one.ended > start and one.began < end]


def chapters_of(trials: Sequence[RecordedTrial], spec: FilmSpec) -> list[Chapter]:
    """Return a chapter for each level of trials that are shown one after the other.

    What is before the first level of a trial is a chapter of its own.
    """
    found, before = [], 0.0
    for trial in trials:
        first, last = span_of(trial, spec)
        levels = shown_levels(trial, spec)
        starts = [(level.began, level.label or f"level {i}") for i, level in levels]
        if not starts or starts[0][0] > first:
            starts.insert(0, (first, "start"))
        ends = [began for began, _ in starts[1:]] + [last]
        scale = 1.0 / spec.speed
        found += [
            Chapter(
                title=title,
                start=(max(began, first) - first) * scale + before,
                end=(end - first) * scale + before,
            )
            for (began, title), end in zip(starts, ends, strict=True)
        ]
        before += n_frames_of(trial, spec) / spec.rate
    return found


class Recordable(Protocol):
    """What `record` writes: `Film`, `Reel`, `processes.DrawingProcesses`."""

    @property
    def spec(self) -> FilmSpec:
        """What it shows."""

    def frames(self, pack: Packing) -> Iterator[bytes]:
        """Draw all images, each packed."""

    def chapters(self) -> list[Chapter]:
        """Return its chapters."""


def record(film: Recordable, path: Path, on_frame: Callable[[], object] = lambda: None) -> None:
    """Draw a film and write it.

    After an interruption the file has the images that were drawn before it; after an error there is
    no file.

    Args:
        film: the film.
        path: of the file; its suffix is one of `encoder.SUFFIXES`.
        on_frame: called after each image.
    """
    encoder = encoder_of(path, film.spec.size, film.spec.rate, film.chapters())
    is_to_keep = False
    try:
        for packed in film.frames(packing_of(path)):
            encoder.add(packed)
            on_frame()
        is_to_keep = True
    except KeyboardInterrupt:
        is_to_keep = True
        raise
    finally:
        encoder.close(is_to_keep=is_to_keep)


def fitted(lens: Intrinsics, size: tuple[int, int]) -> Intrinsics:
    """Return a camera's pinhole with as many pixels as there is room for, in its own shape."""
    scale = min(size[0] / lens.width, size[1] / lens.height)
    return lens.with_size(max(1, round(scale * lens.width)), max(1, round(scale * lens.height)))


def centred(image: Pixels, size: tuple[int, int]) -> Pixels:
    """Put an image into the middle of a black one."""
    frame = np.zeros((size[1], size[0], 3), np.uint8)
    x, y = (size[0] - image.shape[1]) // 2, (size[1] - image.shape[0]) // 2
    frame[y : y + image.shape[0], x : x + image.shape[1]] = image
    return frame


def _check_curves(trial: RecordedTrial, spec: FilmSpec) -> None:
    """Refuse measures that have no log."""
    curves = [curve for level in trial.levels for curve in (*level.curves, *level.details)]
    known = dict.fromkeys(curve.measure for curve in curves)
    for name in spec.curves:
        if name not in known:
            raise UnknownName("measure with a log", name, tuple(known))
