"""Messages about directories without a result: interrupted runs and how to resume them.

A run that was killed leaves its finished rows, its command (`save_beginning`), and no
``result.json``. A run that was started from Python has no command; it is derived from the first
line of a journal.
"""

from __future__ import annotations

import shlex
from pathlib import Path

from ..errors import ResultError
from .command import bench_words
from .directory import CONTROL_FOLDER
from .inputs import Inputs
from .journal import FOLDER, head_of
from .provenance import load_provenance
from .run_info import RunInfo
from .stored.stored_row import Record
from .stored.stored_shapes import HEAD

ENVELOPE = "envelope.json"
"""The file that `uwsim envelope` writes into its directory."""
RESULT = "result.json"


def describe_missing_result(path: Path) -> str:
    """Describe a path that is not a result, as a sentence without its full stop."""
    if not path.exists():
        return "no result here (there is no such file or directory)"
    if (path / ENVELOPE).exists():
        return "no result here but an envelope: its runs are in envelope.json"
    names = sorted(file.parent.name for file in path.glob(f"*/{RESULT}"))
    command = resume_command(path)
    if names and not (command and names == [CONTROL_FOLDER]):  # the control run may end first
        message = f"holds {len(names)} results ({', '.join(names)}); name one, as {path / names[0]}"
        return message if len(names) > 1 else f"no result here, but in {path / names[0]}"
    if command:
        description = "yet: its run"
        if command.startswith("uwsim envelope "):
            description = "but the runs of an envelope: its search"
        return f"no result here {description} was interrupted. Resume with: {command}"
    return "no result here (no result.json)"


def resume_command(directory: Path) -> str | None:
    """Return the command that resumes an interrupted run; None if there is no such run."""
    own_head = _head(directory)
    heads = {"": own_head} if own_head is not None else _heads_below(directory)
    if not heads:
        return None
    command = load_provenance(directory / next(iter(heads))).get("command")
    if isinstance(command, list) and command:
        words = [str(word) for word in command if word not in ("--overwrite", "--resume")]
        out = directory if own_head is None or words.count("--algorithm") < 2 else directory.parent
        return shlex.join(["uwsim", *_replace_output(words, out), "--resume"])
    try:
        for name, head in heads.items():
            HEAD(head, name)
    except ResultError:
        return None
    runs = [RunInfo.from_dict(_mapping(head.get("run"))) for head in heads.values()]
    inputs = Inputs.from_dict(_mapping(next(iter(heads.values())).get("inputs")))
    words = bench_words(
        runs[0],
        inputs,
        algorithms=[str(run.algorithm) for run in runs],
        repeats=1 if runs[0].repeats is None else runs[0].repeats,
    )
    return shlex.join([*words, "--out", str(directory), "--resume"])


def _replace_output(words: list[str], directory: Path) -> list[str]:
    """Return a command with the directory as its output."""
    for i, word in enumerate(words):
        if word == "--out" and i + 1 < len(words):
            return [*words[: i + 1], str(directory), *words[i + 2 :]]
        if word.startswith("--out="):
            return [*words[:i], f"--out={directory}", *words[i + 1 :]]
    return [*words, "--out", str(directory)]


def _heads_below(directory: Path) -> dict[str, Record]:
    names = sorted(folder.parent.name for folder in directory.glob(f"*/{FOLDER}"))
    heads = {name: _head(directory / name) for name in names if name != CONTROL_FOLDER}
    return {name: head for name, head in heads.items() if head is not None}


def _head(directory: Path) -> Record | None:
    for file in sorted((directory / FOLDER).glob("*.jsonl")):
        head = head_of(file)
        if isinstance(head.get("run"), dict):
            return head
    return None


def _mapping(value: object) -> Record:
    return value if isinstance(value, dict) else {}
