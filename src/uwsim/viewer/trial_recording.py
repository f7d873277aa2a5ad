"""Recordings of a benchmark: the messages of each trial in a separate file.

The times in a file are simulation times of its trial, from 0 s. If there are several trials, the
name of a file ends in the number of its trial in the result: ``dive-00003.mcap``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ..base.terminal import warn
from ..errors import BadSetting
from ..middleware.recording import ImageStorage, Recorder, check_path
from ..runs.planning.plan import Plan, Trial
from ..runs.run import Run
from ..simulation import Simulation
from .scene_topics import SceneTopics


@dataclass(frozen=True, kw_only=True)
class TrialRecording:
    """The settings of the recordings of one run's trials; they change no byte of the result.

    Images and point clouds are recorded only if the algorithm or a measure subscribes to them:
    nothing is rendered for the recording alone.
    """

    path: Path
    """The path of the file; for several trials, `path_of` derives each file's path from it."""
    images: ImageStorage
    """The format in which images are stored."""
    is_single: bool
    """True if there is only one trial, whose file is `path` itself."""

    def path_of(self, trial: Trial) -> Path:
        """Return the file of a trial."""
        if self.is_single:
            return self.path
        return self.path.with_name(f"{self.path.stem}-{trial.index:05d}{self.path.suffix}")

    def missing_files(self, run: Run) -> list[Path]:
        """Return the files of finished trials that do not exist."""
        to_run = {trial.index for trial in run.unfinished_trials()}
        files = [self.path_of(t) for t in run.plan.trials() if t.index not in to_run]
        return [file for file in files if not file.exists()]

    @contextmanager
    def recording(self, simulation: Simulation, trial: Trial) -> Iterator[None]:
        """Record a trial until its end."""
        topics = SceneTopics(simulation, is_on_bus=False)
        path = self.path_of(trial).absolute()  # an algorithm may change the folder
        with Recorder(simulation.bus, path, images=self.images) as recorder:
            recorder.start(lambda: simulation.time, is_passive=True)
            topics.record(recorder)
            yield
        if trial.index == 0:
            for topic, type_name in recorder.left_out.items():
                warn(f"/{topic} is not recorded: {type_name} has no message definition")


def trial_recordings(
    plans: Sequence[Plan], path: Path, images: ImageStorage, folders: Sequence[str]
) -> list[TrialRecording]:
    """Return the recordings of plans that are run together, one for each plan.

    Args:
        plans: the plans, one for each algorithm.
        path: the path that the user gave.
        images: the format in which images are stored.
        folders: the names of the algorithms' folders; empty for one algorithm.
    """
    return [
        TrialRecording(
            path=path.with_name(f"{path.stem}-{folder}{path.suffix}") if folder else path,
            images=images,
            is_single=len(plan.trials()) == 1,
        )
        for plan, folder in zip(plans, folders or [""], strict=True)
    ]


def check_recordings(
    plans: Sequence[Plan],
    recordings: Sequence[TrialRecording],
    out: Path,
    *,
    resume: bool,
    overwrite: bool,
) -> None:
    """Reject recordings that cannot be written, before anything changes.

    Args:
        plans: the plans, one for each algorithm.
        recordings: the recording of each plan.
        out: the result directory.
        resume: True if a run is resumed: recordings of its trials may exist.
        overwrite: True if earlier recordings are replaced.

    Raises:
        BadSetting: a recording cannot be written.
    """
    for plan, recording in zip(plans, recordings, strict=True):
        if recording.path.resolve().is_relative_to(out.resolve()):
            raise BadSetting(
                f"--record {recording.path}: the path is in the result directory; expected another."
            )
        for trial in plan.trials():
            check_path(recording.path_of(trial), overwrite=overwrite or resume)
