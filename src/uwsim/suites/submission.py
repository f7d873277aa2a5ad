"""A submission: a folder with the results of an entry, and ``submission.json``, which lists them.

.. code-block:: text

    submission.json      names, hashes, seeds, track, compute, card (`Submission`)
    verification.json    the verdict of uwsim suite verify
    code/                the files of the user's algorithm
    station-v1/          the result of a task, as of uwsim bench
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ..base.files.input_files import compute_hash
from ..errors import ResultError
from ..results.atomic_file import write_text
from ..results.provenance import machine
from ..results.result import Result
from ..results.stored.shapes import Shape, array, integer, number, table, text
from ..results.stored.shapes import fields as shape
from ..runs.run import Run
from ..version import __version__
from .campaign import total_cpu_time
from .entry import Entry, Seeds, task_hash
from .entry_files import read_plain_file

FILE = "submission.json"
"""The name of the file."""
FORMAT = "uwsim-submission/1"
"""The format of the file."""
MAX_BYTES = 1_000_000
"""The greatest size of the file."""
MAX_NAME, MAX_TEXT = 80, 2000
"""The greatest length of the name of a submission, and of any other text in it [letters]."""
KINDS = ("entry", "baseline", "control", "expert")
"""The kinds of submissions."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """The statements of an author about an algorithm, which nobody checks."""

    author: str = ""
    """The name of the author."""
    description: str = ""
    """A description of the algorithm."""
    link: str = ""
    """The address of a page about it."""


@dataclass(frozen=True, kw_only=True)
class TaskEntry:
    """The result of one task in a submission."""

    algorithm: str
    """The name of the algorithm."""
    task_hash: str
    """The hash of the task's files (`task_hash`)."""
    result: str
    """The hash of ``result.json``."""
    n_trials: int
    """The number of rows."""
    n_ok: int
    """The number of rows that ended ``ok``."""


@dataclass(frozen=True, kw_only=True)
class Submission:
    """The content of ``submission.json``."""

    name: str
    """The name in tables."""
    kind: str = "entry"
    """One of `KINDS`."""
    suite: str
    """The name of the suite."""
    suite_hash: str
    """The hash of the suite file."""
    version: str
    """The version of uwsim."""
    track: str
    """The name of the track by sensors."""
    seeds: Seeds
    """The seeds."""
    is_short: bool = False
    """True if it has the middle level of each task alone."""
    is_human: bool = False
    """True if a human piloted."""
    settings: tuple[str, ...] = ()
    """The settings of the algorithm, ``algorithm.NAME=VALUE``."""
    tasks: Mapping[str, TaskEntry]
    """The results by the name of the task."""
    compute: Mapping[str, str | int]
    """The processor, the number of cores, and the class: cpu, or gpu if the author states one."""
    cpu_s: float
    """The CPU time of all trials [s]."""
    card: Card = Card()
    """The statements of the author."""

    @property
    def sha256(self) -> str:
        """The hash of the content, which has the hashes of all results."""
        return "sha256:" + hashlib.sha256(json_text(self).encode()).hexdigest()


def _boolean(value: Any, path: str) -> None:
    if not isinstance(value, bool):
        raise ResultError(f"{path} is {value!r:.60}; expected true or false.")


def _word_or_number(value: Any, path: str) -> None:
    (text if isinstance(value, str) else integer)(value, path)


_TASK = shape(
    {"algorithm": text, "task_hash": text, "result": text, "n_trials": integer, "n_ok": integer}, {}
)
_SEEDS = shape(
    {"split": text, "first": integer, "count": integer, "date": text, "beacon": text}, {}
)
_KEYS: dict[str, Shape] = {
    "format": text,
    "name": text,
    "kind": text,
    "suite": text,
    "suite_hash": text,
    "version": text,
    "track": text,
    "seeds": _SEEDS,
    "is_short": _boolean,
    "is_human": _boolean,
    "settings": array(text),
    "tasks": table(_TASK),
    "compute": table(_word_or_number),
    "cpu_s": number,
    "card": shape({"author": text, "description": text, "link": text}, {}),
}
SHAPE = shape(_KEYS, {})
"""The shape of ``submission.json``."""


def json_text(submission: Submission) -> str:
    """Return the text of ``submission.json``."""
    document = {"format": FORMAT, **asdict(submission)}
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def save_submission(submission: Submission, directory: Path) -> Path:
    """Write ``submission.json`` into the folder of an entry."""
    path = directory / FILE
    write_text(path, json_text(submission))
    return path


def load_submission(directory: Path) -> Submission:
    """Read ``submission.json``.

    Raises:
        ResultError: it does not exist, or is invalid; the message states what was expected.
    """
    path = directory / FILE
    try:
        document = json.loads(read_plain_file(path, MAX_BYTES))
    except (ValueError, RecursionError) as error:
        raise ResultError(f"{path}: is no JSON: {str(error).splitlines()[0]}.") from None
    try:
        return _read_document(document)
    except ResultError as error:
        raise ResultError(f"{path}: {error}") from None


def check_texts(document: object, path: str = "submission") -> None:
    """Raise ResultError for a text that does not suit a page: too long, or with control letters.

    Args:
        document: the content of a JSON file, or a part of it.
        path: the name of the part.
    """
    if isinstance(document, dict):
        for key, value in document.items():
            check_texts(key, f"a key of {path}")
            check_texts(value, f"{path}.{key}")
    elif isinstance(document, list):
        for value in document:
            check_texts(value, path)
    elif isinstance(document, str):
        limit = MAX_NAME if path.endswith(".name") else MAX_TEXT
        if len(document) > limit:
            raise ResultError(f"{path} has {len(document)} letters; at most {limit} are allowed.")
        if not document.isprintable():
            raise ResultError(
                f"{path} is {document!r:.60}; it has letters that cannot be printed, or that "
                "change the direction of writing."
            )


def _read_document(document: Any) -> Submission:
    SHAPE(document, "submission")
    if document["format"] != FORMAT:
        raise ResultError(f"format is {document['format']!r:.60}; expected {FORMAT!r}.")
    check_texts(document)
    if document["kind"] not in KINDS:
        raise ResultError(f"kind is {document['kind']!r:.60}; expected {', '.join(KINDS)}.")
    if unknown_keys := [key for key in document if key not in _KEYS]:
        raise ResultError(f"{unknown_keys[0]!r:.60} is not known.")
    values = {key: document[key] for key in _KEYS if key != "format"}
    return Submission(
        **{
            **values,
            "seeds": Seeds(**{key: document["seeds"][key] for key in Seeds.__dataclass_fields__}),
            "settings": tuple(document["settings"]),
            "tasks": {
                name: TaskEntry(**{key: task[key] for key in TaskEntry.__dataclass_fields__})
                for name, task in document["tasks"].items()
            },
            "card": Card(**{key: document["card"][key] for key in Card.__dataclass_fields__}),
        }
    )


def submission_of(
    entry: Entry,
    runs: Sequence[Run],
    results: Sequence[Result],
    *,
    name: str,
    kind: str = "entry",
    card: Card | None = None,
    gpu: str = "",
) -> Submission:
    """Return the submission of an entry whose trials are all finished.

    Args:
        entry: the entry.
        runs: the runs of the tasks.
        results: the result of each run.
        name: the name in tables.
        kind: one of `KINDS`.
        card: what the author states.
        gpu: the name of the GPU that the algorithm used; empty for none.
    """
    out = runs[0].out.parent
    tasks = {}
    for task, run, result in zip(entry.tasks, runs, results, strict=True):
        statuses = result.values("status")
        tasks[task.name] = TaskEntry(
            algorithm=result.run.algorithm or "",
            task_hash=task_hash(run.inputs),
            result=compute_hash(run.out / "result.json"),
            n_trials=len(statuses),
            n_ok=statuses.count("ok"),
        )
    facts = machine()
    return Submission(
        name=name,
        kind=kind,
        suite=entry.suite.spec.name,
        suite_hash=entry.suite.sha256,
        version=__version__,
        track=entry.track.name,
        seeds=entry.seeds,
        is_short=entry.is_short,
        is_human=any(run.plan.algorithm.facts.is_piloted for run in runs),
        settings=entry.settings,
        tasks=tasks,
        compute={
            "class": "gpu" if gpu else "cpu",
            "cpu": str(facts["cpu"]),
            "cores": int(str(facts["cores"] or 0)),
            "gpu": gpu or "none",
        },
        cpu_s=round(total_cpu_time(out), 1),
        card=card or Card(),
    )
