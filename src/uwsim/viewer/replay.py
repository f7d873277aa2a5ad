"""A stored result as a page: one HTML file with its scene, its motion and its curves."""

from __future__ import annotations

import html
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..base.deprecation import deprecated_name
from ..errors import ResultError
from ..optics import Medium
from ..results import journal
from ..results.atomic_file import write_text
from ..results.journal import recorded_trials, trials_without_motion
from ..simulation import Simulation
from ..simulation.scenery.recorded_water import restore_water
from ..simulation.tracked_state import BEAM_ATTENUATION
from ..verify.recorded_plan import FileOverrides
from .caustics import describe_focusing_waves
from .document import document
from .film.trial_scene import open_scene
from .head import changed_bodies, models_of, scene_head
from .models import Models
from .pack import Blob, make_pack
from .recorded import Curve, RecordedLevel, RecordedTrial, levels_without_motion
from .surface import describe_moving_surface

Json = dict[str, Any]
SceneKey = tuple[int, tuple[tuple[str, float], ...]]
"""The seed of a trial, and the numbers of the scene that its level sets."""
SUFFIXES = (".html", ".htm")
"""The suffixes of the files that `Replay.save` writes."""
NO_MOTION = "no motion"
"""The status of a level without recorded motion."""
MAX_MEDIA = 64
"""The greatest number of media of physical water in a page; more are thinned out."""
CURVE_GAP = 1e-3
"""The time between the last sample of a level and the gap in its curve [s]."""
TICKS_PER_SECOND = 1e4
"""The number of ticks in a second, the unit of the times of curves [Hz]."""
NOTEBOOK_HEIGHT = 720
"""The height of the page in a notebook [px]."""


class Replay:
    """Some trials of a result, for playback.

    No trial runs again: the motion of every trial is in the result, and the page draws the scene
    from it with the shaders of the renderer. A notebook displays the page.

    Args:
        directory: the result directory.
        trials: the numbers of the trials; by default all finished trials. The levels of trials
            without recorded motion are listed with the status `NO_MOTION`.
        overrides: the present paths of the scene's files, if they have moved.

    Raises:
        ResultError: a trial does not exist, is not finished or has no recorded motion; or the list
            of trials is empty.
        AssetNotFound: the scene is not found.
    """

    def __init__(
        self,
        directory: str | Path,
        trials: Sequence[int] | None = None,
        overrides: FileOverrides | None = None,
    ) -> None:
        self.directory = directory = Path(directory)
        """The directory of the result."""
        numbers = (recorded_trials(directory) or (0,)) if trials is None else tuple(trials)
        self._trials = [RecordedTrial.open(directory, number, overrides) for number in numbers]
        self.trials_without_motion = trials_without_motion(directory) if trials is None else ()
        """The numbers of the finished trials without recorded motion; empty if ``trials`` was
        given."""
        if not self._trials:
            raise ResultError(f"{directory}: the list of trials is empty.")
        self._seeds = sorted({trial.seed for trial in self._trials})
        self.title = self._trials[0].title
        """The benchmark, the algorithm and the seed, or the number of seeds, of the trials."""
        if (n_seeds := len(self._seeds)) > 1:
            self.title = f"{self.title.rpartition(', ')[0]}, {n_seeds} seeds"

    @property
    @deprecated_name("trials_without_motion")
    def unseen(self) -> tuple[int, ...]:
        """The old name of `trials_without_motion`."""
        return self.trials_without_motion

    def pack(self) -> bytes:
        """Return the pack of the page; `uwsim.viewer.head` documents its format."""
        blob, first_trial = Blob(), self._trials[0]
        with open_scene(first_trial) as simulation:
            models, media = models_of(simulation, blob), self._media(simulation)
            head = scene_head(simulation, self.title, blob, media=media, models=models)
        descriptions = {trial.index: _trial(trial, blob) for trial in self._trials}
        if len(self._seeds) > 1:
            for trial in self._trials:
                for level in descriptions[trial.index]["levels"]:
                    level["label"] = f"seed {trial.seed}: {level['label']}"
        scenes = self._other_scenes(head, models, blob)
        for trial in self._trials:
            descriptions[trial.index] |= scenes.get(_scene_key(trial), {"poses": {}, "visuals": {}})
        names = list(first_trial.track.levels[0].values) if first_trial.track.levels else []
        for index in self.trials_without_motion:
            descriptions[index] = _trial_without_motion(self.directory, index, names, blob)
        head["trials"] = [descriptions[index] for index in sorted(descriptions)]
        return make_pack(head, blob)

    def _media(self, simulation: Simulation) -> Iterator[Medium]:
        """Yield the media of physical water that the tracks of the trials contain."""
        water, medium = simulation.world.scenery.state.water, simulation.world.model.optical_water
        columns = [trial.track.signal(BEAM_ATTENUATION) for trial in self._trials]
        values = np.concatenate(
            [np.empty(0), *(column for column in columns if column is not None)]
        )
        attenuations = np.unique(values[np.isfinite(values)])
        step = max(1, math.ceil(len(attenuations) / MAX_MEDIA))
        for attenuation in attenuations[::step].tolist():
            if medium is not None:
                optics = restore_water(water, medium, attenuation, 0.0).physical_water
                assert optics is not None
                yield optics.medium

    def _other_scenes(self, head: Json, models: Models, blob: Blob) -> dict[SceneKey, Json]:
        """Describe the scenes that differ from that of the first trial by seed or level."""
        first_trial, scenes = self._trials[0], dict[SceneKey, Json]()
        surface, caustics = head["surface"], head["caustics"]
        has_waves = surface is not None and (surface["waves"] or surface["ripples"])
        depends_on_seed = bool(first_trial.scene.vary or has_waves or caustics is not None)
        for key, trial in {_scene_key(trial): trial for trial in self._trials}.items():
            is_other_seed = depends_on_seed and trial.seed != first_trial.seed
            if not is_other_seed and trial.level_settings == first_trial.level_settings:
                continue
            with open_scene(trial) as simulation:
                scenes[key] = changed_bodies(simulation, head, models)
                if has_waves and is_other_seed:
                    scenes[key]["surface"] = describe_moving_surface(simulation.world, blob)
                if caustics is not None and is_other_seed:
                    scenes[key]["caustics"] = describe_focusing_waves(simulation.world, blob)
        return scenes

    def html(self) -> str:
        """Return the page, which loads no other file."""
        return document(self.title, self.pack())

    def save(self, path: str | Path) -> Path:
        """Write the page atomically; the same result gives the same bytes.

        Raises:
            ResultError: the suffix is neither .html nor .htm.
        """
        path = Path(path)
        if path.suffix.lower() not in SUFFIXES:
            raise ResultError(f"{path}: a replay is an .html file; films are `uwsim replay -o`.")
        write_text(path, self.html())
        return path

    def _repr_html_(self) -> str:
        page = html.escape(self.html(), quote=True)
        style = f"width: 100%; height: {NOTEBOOK_HEIGHT}px; border: 0"
        return (
            f'<iframe srcdoc="{page}" style="{style}" title="{html.escape(self.title)}"></iframe>'
        )


def _scene_key(trial: RecordedTrial) -> SceneKey:
    return trial.seed, trial.level_settings


def _trial(trial: RecordedTrial, blob: Blob) -> Json:
    motion = journal.track_path(trial.directory, trial.index).read_bytes()
    return {
        "title": trial.title,
        "motion": blob.add_bytes(motion),
        "levels": [_level(level, trial) for level in trial.levels],
        "curves": [_curve(name, trial.levels, blob) for name in _curve_names(trial.levels)],
    }


def _trial_without_motion(directory: Path, index: int, names: Sequence[str], blob: Blob) -> Json:
    """Describe a trial without recorded motion; ``names`` are the swept parameters."""
    levels = levels_without_motion(directory, index, names)
    path = journal.track_path(directory, index)
    rows = [
        {
            "label": level.label or f"level {number}",
            "status": NO_MOTION,
            "why": f"{path.parent.name}/{path.name} is missing; the level was {level.status}",
            "start": level.start_time,
            "end": level.end_time,
            "values": dict(level.swept_values),
        }
        for number, level in enumerate(levels, start=1)
    ]
    curves = [_curve(name, levels, blob) for name in _curve_names(levels)]
    return {
        "title": f"trial {index}",
        "motion": None,
        "levels": rows,
        "curves": curves,
        "poses": {},
        "visuals": {},
    }


def _level(level: RecordedLevel, trial: RecordedTrial) -> Json:
    index = trial.levels.index(level)
    return {
        "label": level.label or f"level {index + 1}",
        "status": level.status,
        "why": level.reason or None,
        "start": level.start_time,
        "end": level.end_time,
        "values": dict(level.swept_values),
    }


def _curve_names(levels: Sequence[RecordedLevel]) -> list[str]:
    """Return the names of the curves: each measure, followed by the further columns of its log.

    A curve without a value in any level is left out.
    """
    return list(dict.fromkeys(curve.measure for curve in _curves_with_values(levels)))


def _curves_with_values(levels: Sequence[RecordedLevel]) -> Iterator[Curve]:
    """Yield the curves with a value, a measure's own curve before the other columns of its log."""
    for measure in dict.fromkeys(c.measure for level in levels for c in level.curves):
        for level in levels:
            for curve in (*level.curves, *level.details):
                is_of_measure = curve.measure == measure or curve.measure.startswith(f"{measure}.")
                if is_of_measure and np.isfinite(curve.values).any():
                    yield curve


def _curve(name: str, levels: Sequence[RecordedLevel], blob: Blob) -> Json:
    """Join the samples of a measure of all levels, with a gap where time passes between levels."""
    curves = [c for level in levels for c in (*level.curves, *level.details) if c.measure == name]
    times, values = [curves[0].times], [curves[0].values]
    for curve in curves[1:]:
        gap = times[-1][-1] + CURVE_GAP
        if curve.times[0] > gap:
            times.append(np.array([gap]))
            values.append(np.array([np.nan]))
        times.append(curve.times)
        values.append(curve.values)
    return {
        "name": name,
        "unit": curves[0].unit,
        "names": list(next((c.names for c in curves if c.names), ())),
        "is_share": all(c.is_share for c in curves),
        "times": blob.add(np.rint(np.concatenate(times) * TICKS_PER_SECOND).astype("<u4")),
        "values": blob.add(np.concatenate(values).astype("<f4")),
    }
