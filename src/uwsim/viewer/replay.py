"""A stored result as a page: one HTML file with its scene, its motion and its curves."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..base.deprecation import deprecated
from ..errors import ResultError
from ..physics.compile_scene import compile_scene
from ..results import journal
from ..results.atomic_file import write_text
from ..results.journal import recorded_trials, trials_without_motion
from ..simulation import Simulation
from ..verify.recorded_plan import FileOverrides
from .document import document
from .head import body_poses, scene_head
from .pack import Blob, packed
from .recorded import Curve, RecordedLevel, RecordedTrial, levels_without_motion

Json = dict[str, Any]
SUFFIXES = (".html", ".htm")
"""Of the files that `Replay.save` writes."""
NO_MOTION = "no motion"
"""Status of a level that cannot be seen."""
GAP = 1e-3
"""After the last sample of a level nothing was measured [s]."""
TICKS = 1e4
"""Of the times of curves, in a second."""
HEIGHT = 720
"""Of the page in a notebook [px]."""


class Replay:
    """Some trials of a result, to be seen again.

    Nothing is run again: the motion of every trial is in the result, and the page draws the scene
    from it with the shaders of the renderer. In a notebook it shows itself.

    Args:
        directory: of the result.
        trials: their numbers; without them all that are finished: of those whose motion is not
            there the levels are listed, with the status `NO_MOTION`.
        overrides: where the files of the scene are, if not where they were.

    Raises:
        ResultError: a trial's motion is not there.
        AssetNotFound: the scene is nowhere.
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
        """The numbers of the trials without a file of their motion."""
        if not self._trials:
            raise ResultError(f"{directory}: no trial was chosen.")
        self._seeds = sorted({trial.seed for trial in self._trials})
        self.title = self._trials[0].title
        """The benchmark, the algorithm and the seed, or the number of seeds, of the trials."""
        if (n_seeds := len(self._seeds)) > 1:
            self.title = f"{self.title.rpartition(', ')[0]}, {n_seeds} seeds"

    @property
    @deprecated("trials_without_motion")
    def unseen(self) -> tuple[int, ...]:
        """The old name of `trials_without_motion`."""
        return self.trials_without_motion

    def pack(self) -> bytes:
        """Return what the page shows (`head`)."""
        blob, first_trial = Blob(), self._trials[0]
        with _scene_of(first_trial) as simulation:
            head = scene_head(simulation, self.title, blob)
        descriptions = {trial.index: _trial(trial, blob) for trial in self._trials}
        if len(self._seeds) > 1:
            for trial in self._trials:
                for level in descriptions[trial.index]["levels"]:
                    level["label"] = f"seed {trial.seed}: {level['label']}"
        initial_poses = {body["name"]: body["pose"] for body in head["bodies"]}
        poses_by_seed = {
            seed: _moved(trial, initial_poses) for seed, trial in self._varied().items()
        }
        for trial in self._trials:
            descriptions[trial.index]["poses"] = poses_by_seed.get(trial.seed, {})
        names = list(first_trial.track.levels[0].values) if first_trial.track.levels else []
        descriptions |= {
            index: _unseen(self.directory, index, names, blob)
            for index in self.trials_without_motion
        }
        head["trials"] = [descriptions[index] for index in sorted(descriptions)]
        return packed(head, blob)

    def _varied(self) -> dict[int, RecordedTrial]:
        """Seeds of which the scene differs from that of the first trial, with a trial of each."""
        first = self._trials[0]
        if not first.scene.vary:
            return {}
        return {trial.seed: trial for trial in self._trials if trial.seed != first.seed}

    def html(self) -> str:
        """Return the page, which needs nothing else."""
        return document(self.title, self.pack())

    def save(self, path: str | Path) -> Path:
        """Write the page, whole or not at all; the same result gives the same bytes.

        Raises:
            ResultError: the name does not end in .html.
        """
        path = Path(path)
        if path.suffix.lower() not in SUFFIXES:
            raise ResultError(f"{path}: a replay is an .html file; films are `uwsim replay -o`.")
        write_text(path, self.html())
        return path

    def _repr_html_(self) -> str:
        page = html.escape(self.html(), quote=True)
        style = f"width: 100%; height: {HEIGHT}px; border: 0"
        return (
            f'<iframe srcdoc="{page}" style="{style}" title="{html.escape(self.title)}"></iframe>'
        )


def _scene_of(trial: RecordedTrial) -> Simulation:
    """Open the scene of a trial, at step 0."""
    model = compile_scene(
        trial.scene,
        seed=trial.seed,
        timestep=trial.timestep,
        data_path=trial.data_path,
        compatibility=trial.compatibility,
    )
    return Simulation(model, runs_code=False)


def _moved(trial: RecordedTrial, at_first: Mapping[str, list[float]]) -> Json:
    """Return the bodies that a trial's seed puts elsewhere, with their poses."""
    with _scene_of(trial) as simulation:
        poses = body_poses(simulation)
    return {name: pose for name, pose in poses.items() if pose != at_first.get(name)}


def _trial(trial: RecordedTrial, blob: Blob) -> Json:
    """Describe a trial as `head` says."""
    motion = journal.track_path(trial.directory, trial.index).read_bytes()
    return {
        "title": trial.title,
        "motion": blob.add_bytes(motion),
        "levels": [_level(level, trial) for level in trial.levels],
        "curves": [_curve(name, trial.levels, blob) for name in _measures(trial.levels)],
    }


def _unseen(directory: Path, index: int, names: Sequence[str], blob: Blob) -> Json:
    """Describe a trial whose motion is not there; ``names``: of what changes with the levels."""
    levels = levels_without_motion(directory, index, names)
    path = journal.track_path(directory, index)
    described = [
        {
            "label": level.label or f"level {number}",
            "status": NO_MOTION,
            "why": f"{path.parent.name}/{path.name} is missing; the level was {level.status}",
            "start": level.began,
            "end": level.ended,
            "values": dict(level.swept),
        }
        for number, level in enumerate(levels, start=1)
    ]
    curves = [_curve(name, levels, blob) for name in _measures(levels)]
    return {
        "title": f"trial {index}",
        "motion": None,
        "levels": described,
        "curves": curves,
        "poses": {},
    }


def _level(level: RecordedLevel, trial: RecordedTrial) -> Json:
    number = trial.levels.index(level)
    return {
        "label": level.label or f"level {number + 1}",
        "status": level.status,
        "why": level.why or None,
        "start": level.began,
        "end": level.ended,
        "values": dict(level.swept),
    }


def _measures(levels: Sequence[RecordedLevel]) -> list[str]:
    """Names of the curves: of measures with a log, then of the further columns of each log.

    Those that have no value in any level are left out.
    """
    return list(dict.fromkeys(curve.measure for curve in _seen(levels)))


def _seen(levels: Sequence[RecordedLevel]) -> Iterator[Curve]:
    """The curves with a value, those of a measure before the columns of its log."""
    for measure in dict.fromkeys(c.measure for level in levels for c in level.curves):
        for level in levels:
            for curve in (*level.curves, *level.details):
                is_of_measure = curve.measure == measure or curve.measure.startswith(f"{measure}.")
                if is_of_measure and np.isfinite(curve.values).any():
                    yield curve


def _curve(name: str, levels: Sequence[RecordedLevel], blob: Blob) -> Json:
    """The samples of a measure through all levels, with a gap where time passes between two."""
    found = [c for level in levels for c in (*level.curves, *level.details) if c.measure == name]
    times, values = [found[0].times], [found[0].values]
    for curve in found[1:]:
        gap = times[-1][-1] + GAP
        if curve.times[0] > gap:
            times.append(np.array([gap]))
            values.append(np.array([np.nan]))
        times.append(curve.times)
        values.append(curve.values)
    return {
        "name": name,
        "unit": found[0].unit,
        "names": list(next((c.names for c in found if c.names), ())),
        "is_share": all(c.is_share for c in found),
        "times": blob.add(np.rint(np.concatenate(times) * TICKS).astype("<u4")),
        "values": blob.add(np.concatenate(values).astype("<f4")),
    }
