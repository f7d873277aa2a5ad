"""Messages about directories without a result: interrupted runs and how to resume them.

A run that was killed leaves the rows it had finished, how it was begun (`save_beginning`), and no
``result.json``. Where the run was started from Python, no command is known, and it is derived
from the first line of a journal.
"""

from __future__ import annotations

import shlex
from pathlib import Path

from ..errors import ResultError
from .command import bench_words
from .directory import CONTROL
from .inputs import Inputs
from .journal import FOLDER, head_of
from .provenance import load_provenance
from .run_info import RunInfo
from .stored.stored_row import Record
from .stored.stored_shapes import HEAD

ENVELOPE = "envelope.json"
"""What `uwsim envelope` writes in its own directory."""
RESULT = "result.json"


def instead_of_a_result(path: Path) -> str:
    """Describe a path that is not a result, as a sentence without its full stop."""
    if not path.exists():
        return "no result here (there is no such file or directory)"
    if (path / ENVELOPE).exists():
        return "no result here but an envelope: its runs are in envelope.json"
    names = sorted(file.parent.name for file in path.glob(f"*/{RESULT}"))
    command = resuming(path)
    if names and not (command and names == [CONTROL]):  # the control may be over long before
        message = f"holds {len(names)} results ({', '.join(names)}); name one, as {path / names[0]}"
        return message if len(names) > 1 else f"no result here, but in {path / names[0]}"
    if command:
        what = "yet: its run"
        if command.startswith("uwsim envelope "):
            what = "but the runs of an envelope: its search"
        return f"no result here {what} was interrupted. Resume with: {command}"
    return "no result here (no result.json)"


def resuming(directory: Path) -> str | None:
    """Return the command that resumes an interrupted run; None where there is none."""
    alone = _head(directory)
    heads = {"": alone} if alone is not None else _heads_below(directory)
    if not heads:
        return None
    typed = load_provenance(directory / next(iter(heads))).get("command")
    if isinstance(typed, list) and typed:
        words = [str(word) for word in typed if word not in ("--overwrite", "--resume")]
        place = directory if alone is None or words.count("--algorithm") < 2 else directory.parent
        return shlex.join(["uwsim", *_with_out(words, place), "--resume"])
    try:
        for name, head in heads.items():
            HEAD(head, name)
    except ResultError:
        return None
    runs = [RunInfo.of(_mapping(head.get("run"))) for head in heads.values()]
    inputs = Inputs.of(_mapping(next(iter(heads.values())).get("inputs")))
    words = bench_words(
        runs[0],
        inputs,
        algorithms=[str(run.algorithm) for run in runs],
        repeats=1 if runs[0].repeats is None else runs[0].repeats,
    )
    return shlex.join([*words, "--out", str(directory), "--resume"])


def _with_out(words: list[str], directory: Path) -> list[str]:
    """Return a command whose result goes to the directory as it is called here."""
    for i, word in enumerate(words):
        if word == "--out" and i + 1 < len(words):
            return [*words[: i + 1], str(directory), *words[i + 2 :]]
        if word.startswith("--out="):
            return [*words[:i], f"--out={directory}", *words[i + 1 :]]
    return [*words, "--out", str(directory)]


def _heads_below(directory: Path) -> dict[str, Record]:
    """The heads of the journals of algorithms that ran together."""
    below = sorted(folder.parent.name for folder in directory.glob(f"*/{FOLDER}"))
    heads = {name: _head(directory / name) for name in below if name != CONTROL}
    return {name: head for name, head in heads.items() if head is not None}


def _head(directory: Path) -> Record | None:
    """The head of the first readable journal."""
    for file in sorted((directory / FOLDER).glob("*.jsonl")):
        head = head_of(file)
        if isinstance(head.get("run"), dict):
            return head
    return None


def _mapping(value: object) -> Record:
    return value if isinstance(value, dict) else {}
