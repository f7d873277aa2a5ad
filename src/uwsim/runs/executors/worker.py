"""The execution of a trial by a worker, and the writing of the trial's journal.

The execution and the writing may be on different machines, which exchange numbers, text and the
bytes of images, but no paths.
"""

from __future__ import annotations

import pickle
import traceback
from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from ...base.files.file_names import file_names
from ...base.files.image_record import ImageRecord, add_record
from ...errors import RunFailed
from ...results import journal
from ...results.atomic_file import atomic_write
from ...results.stored.stored_row import StoredEnd, StoredImage, StoredRow
from ...simulation import Calls
from ..input_watch import InputWatch
from ..planning.plan import Plan, Trial
from ..planning.trial_cache import TrialCache
from ..run import Run
from ..trial.level_row import LevelRow, TrialEnd
from ..trial.trial import execute
from ..trial.trial_observer import TrialObserver
from ..trial.trial_recorder import TrialRecorder

IMAGES = "pictures"
"""The folder of the images in the result directory."""


@dataclass(frozen=True, kw_only=True)
class LevelEnded:
    """The end of a level, with its row to store and its images."""

    row: StoredRow
    """The row to store."""
    images: tuple[tuple[str, bytes], ...]
    """The path in the result directory, and the bytes of the PNG file, of each image."""


@dataclass(frozen=True, kw_only=True)
class TrialEnded:
    """The end of a trial."""

    end: StoredEnd
    """The end to store."""
    motion: bytes = b""
    """The bytes of the file with the motion track."""
    inputs: bytes = b""
    """The bytes of the file with a pilot's inputs; empty without a pilot."""


@dataclass(frozen=True)
class TrialFailed:
    """The failure of a trial."""

    error: Exception
    """The error, as the worker raised it."""


Event = LevelEnded | TrialEnded


def run_trial(
    plan: Plan,
    trial: Trial,
    cache: TrialCache,
    calls: Calls | None = None,
    observer: TrialObserver | None = None,
    recorder: TrialRecorder | None = None,
) -> Iterator[Event]:
    """Run a trial; yield each level as it ends, and finally the end of the trial.

    Args:
        plan: the plan of the run.
        trial: a trial of the plan.
        cache: the cache of scene models and renderers.
        calls: the counter of calls into the algorithm.
        observer: the observer, which is called between the steps.
        recorder: the recorder of the messages.

    Raises:
        NeverStarted: the start trigger did not go on within `Plan.start_timeout`.
    """
    outcomes = execute(plan, trial, cache=cache, calls=calls, observer=observer, recorder=recorder)
    for n, outcome in enumerate(outcomes):
        if isinstance(outcome, TrialEnd):
            yield TrialEnded(end=_end(outcome), motion=outcome.motion, inputs=outcome.inputs)
        else:
            row = trial.index * len(trial.levels) + n
            files = file_names(snapshot.camera for snapshot in outcome.snapshots)
            images = {camera: f"{IMAGES}/{row:05d}-{file}.png" for camera, file in files.items()}
            yield LevelEnded(
                row=_row(outcome, images),
                images=tuple(
                    (images[snapshot.camera], _png(snapshot.pixels, snapshot.record))
                    for snapshot in outcome.snapshots
                ),
            )


class JournalWriter:
    """A writer of the events of a trial to its journal; rows that are stored already are compared.

    Raises:
        ReplayDiffers: a repeated row differs from the stored one.
        RunFailed: an input file of the run was changed.
    """

    def __init__(self, run: Run, trial: Trial) -> None:
        self._out = run.out
        self._watch = InputWatch(run.files)
        self._track = journal.track_path(run.out, trial.index)
        self._seal = run.seal
        self._file = journal.Journal(run.out, trial.index, run.head(trial), run.seal)

    def write(self, event: Event) -> bool:
        """Write an event; return whether it is a level that was not on disk before."""
        self._watch.check()
        if isinstance(event, TrialEnded):
            with atomic_write(self._track) as draft:
                draft.write_bytes(self._seal_data(event.motion))
            if event.inputs:
                with atomic_write(self._track.with_suffix(journal.INPUTS)) as draft:
                    draft.write_bytes(self._seal_data(event.inputs))
            self._file.finish(event.end)
            return False
        for name, png in event.images:
            (self._out / IMAGES).mkdir(exist_ok=True)
            with atomic_write(self._out / name) as draft:
                draft.write_bytes(png)
        return self._file.add(event.row)

    def close(self) -> None:
        """Close the journal; all written events are on disk."""
        self._file.close()

    def _seal_data(self, data: bytes) -> bytes:
        return data if self._seal is None else self._seal.file(data)


def make_picklable(error: BaseException) -> Exception:
    """Return the error, or a `RunFailed` if it cannot be pickled, with its traceback as a note."""
    error.add_note("".join(traceback.format_exception(error)).rstrip())
    try:
        copy = pickle.loads(pickle.dumps(error))
        is_same = type(copy) is type(error) and str(copy) == str(error)
        if is_same and isinstance(error, Exception):
            return error
    except Exception:
        pass
    substitute = RunFailed(f"{type(error).__name__}: {error}")
    substitute.add_note(error.__notes__[-1])
    return substitute


def _png(pixels: npt.NDArray[np.uint8], record: ImageRecord) -> bytes:
    _, png = cv2.imencode(".png", np.ascontiguousarray(pixels[..., ::-1]))
    return add_record(bytes(png.tobytes()), record)


def _row(row: LevelRow, images: dict[str, str]) -> StoredRow:
    return StoredRow(
        values=tuple(value for _, value in row.values),
        measures=row.measures,
        details=row.details,
        total=row.total,
        status=row.status,
        missing=row.missing_reasons,
        ended_at=row.ended_at,
        duration=row.duration,
        logs=row.logs,
        log_headers=row.log_headers,
        pictures=tuple(
            StoredImage(
                camera=snapshot.camera,
                file=images[snapshot.camera],
                truth=snapshot.truth,
                estimate=snapshot.estimate,
            )
            for snapshot in row.snapshots
        ),
        fingerprint=row.fingerprint,
        refused=row.refused_messages,
        remarks=row.remarks,
    )


def _end(end: TrialEnd) -> StoredEnd:
    return StoredEnd(
        facts=end.facts,
        parameters=end.parameters,
        streams=end.streams,
        notes=end.notes,
        trace=end.checkpoints.as_dict(),
    )
