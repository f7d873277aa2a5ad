"""Journals: files with the finished rows of a trial, a line for each row.

A line is written and flushed before the next level begins, so a killed run loses at most the level
that it was running. The first line, the *head*, identifies the trial; the last line marks its end.
An incomplete last line is ignored.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ReplayDiffers, ResultError, name_file_in_errors
from .atomic_file import draft_of
from .code_paths import code_differences
from .inputs import Inputs, input_differences
from .provenance import codes_of, load_provenance
from .seal import SEALED_KEY, Seal
from .stored.stored_row import Record, StoredEnd, StoredRow
from .stored.stored_shapes import END, HEAD, ROW

FOLDER = "units"
TRACK = ".motion"
"""The suffix of the motion track of a trial, beside its journal."""
INPUTS = ".inputs"
"""The suffix of a pilot's inputs in a trial, beside its journal."""
REFUSED_KEY = "refused"
"""The key, in a row, of messages from programs that do not take part."""
KINDS = {"unit": HEAD, "row": ROW, "end": END}
"""The shape of the value for each key of a line."""
MAX_LINE_LENGTH = 200
"""The greatest number of characters printed of one difference."""
MAX_LINES = 6
"""The greatest number of differences printed."""


@dataclass(frozen=True)
class StoredTrial:
    """The content of a journal."""

    rows: tuple[StoredRow, ...]
    """The finished rows, in order."""
    end: StoredEnd | None
    """The end of a finished trial; None while it is not finished."""


EMPTY_JOURNAL = StoredTrial((), None)
"""The content for a trial that has no journal yet."""


def path_of(directory: Path, index: int) -> Path:
    """Return the path of the journal of the trial with this index."""
    return directory / FOLDER / f"{index:05d}.jsonl"


def track_path(directory: Path, index: int) -> Path:
    """Return the path of the motion track of the trial with this index."""
    return path_of(directory, index).with_suffix(TRACK)


def recorded_trials(directory: Path) -> tuple[int, ...]:
    """Return the indices of the trials that have a motion track in a result directory."""
    tracks = (directory / FOLDER).glob(f"*{TRACK}")
    return tuple(sorted(int(path.stem) for path in tracks if path.stem.isdecimal()))


def trials_without_motion(directory: Path) -> tuple[int, ...]:
    """Return the indices of the finished trials without a motion track."""
    recorded_indices = recorded_trials(directory)
    files = (directory / FOLDER).glob("*.jsonl")
    indices = sorted(int(path.stem) for path in files if path.stem.isdecimal())
    return tuple(
        index
        for index in indices
        if index not in recorded_indices and read_any(path_of(directory, index))[1].end is not None
    )


def read(directory: Path, index: int, head: Record, seal: Seal | None = None) -> StoredTrial:
    """Read a journal; a missing file has no rows.

    Args:
        directory: the result directory.
        index: the index of the trial.
        head: the expected head.
        seal: the seal of the rows; None if they are not sealed.

    Raises:
        ResultError: the head in the file differs: the file belongs to another run.
    """
    path = path_of(directory, index)
    stored_head, content = read_any(path, seal, head)
    if stored_head is not None and stored_head != head:
        raise ResultError(
            f"{path}: belongs to another run: {_other_run(stored_head, head)}. "
            "Start anew with --overwrite, or choose another --out."
        )
    return content


def level_difference(content: StoredTrial, levels: Sequence[Sequence[float]]) -> str | None:
    """Describe the first row that does not match its level; return None if all rows match.

    Args:
        content: the journal of the trial; an unfinished one may have fewer rows.
        levels: the values of each level of the trial, in order.
    """
    rows = [list(row.values) for row in content.rows]
    for number, (values, level) in enumerate(zip(rows, map(list, levels), strict=False)):
        if values != level:
            return f"row {number} is of the level {_values(values)}; expected {_values(level)}"
    if len(rows) > len(levels) or (content.end is not None and len(rows) < len(levels)):
        return f"{len(rows)} rows; expected {len(levels)}, one for each level of the trial"
    return None


def _values(level: Sequence[float]) -> str:
    return ", ".join(map(repr, level)) or "None"


def read_any(
    path: Path, seal: Seal | None = None, expected_head: Record | None = None
) -> tuple[Record | None, StoredTrial]:
    """Read a journal of any run: its head and its content, up to the first sealed line.

    Args:
        path: the path of the journal.
        seal: the seal of the rows; None if they are not sealed.
        expected_head: a valid head; one that is equal is not checked again.

    Raises:
        ResultError: a line is not a line of a journal.
    """
    if not path.exists():
        return None, EMPTY_JOURNAL
    lines = path.read_bytes().split(b"\n")[:-1]  # a line without a newline is incomplete
    records: dict[str, list[Record]] = {kind: [] for kind in KINDS}
    for number, line in enumerate(lines, start=1):
        try:
            record = json.loads(line, parse_constant=_reject_nan)
            if isinstance(record, dict) and SEALED_KEY in record:
                if seal is None:
                    break  # the run goes on, or its key was lost when the machine went down
                record = json.loads(_unseal(record[SEALED_KEY], seal), parse_constant=_reject_nan)
            kind = _kind(record, is_first=number == 1)
            if kind != "unit" or record[kind] != expected_head:
                KINDS[kind](record[kind], kind)
        except (ValueError, RecursionError):
            break  # the disk was full, or the machine went down
        except ResultError as error:
            raise ResultError(f"{path}:{number}: {error}") from None
        if records["end"]:
            raise ResultError(f"{path}:{number}: it follows the end of its trial; expected none.")
        records[kind].append(record[kind])
    if not records["unit"]:
        return None, EMPTY_JOURNAL
    ends = records["end"]
    rows = tuple(map(StoredRow.from_dict, records["row"]))
    return records["unit"][0], StoredTrial(rows, StoredEnd.from_dict(ends[0]) if ends else None)


def head_of(path: Path) -> Record:
    """Read the head of a journal, even if the rest is damaged; empty if it has none."""
    try:
        with path.open("rb") as stream:
            record = json.loads(stream.readline())
    except (OSError, ValueError, RecursionError):
        return {}
    head = record.get("unit") if isinstance(record, dict) else None
    return head if isinstance(head, dict) else {}


def _kind(record: object, *, is_first: bool) -> str:
    kinds = ("unit",) if is_first else ("row", "end")
    if isinstance(record, dict):
        for kind in kinds:
            if kind in record:
                return kind
    excerpt = repr(record)[:60]
    raise ResultError(f"found {excerpt}; expected an object with {' or '.join(map(repr, kinds))}.")


def _unseal(content: object, seal: Seal) -> str:
    try:
        return seal.text(content)
    except ValueError as error:
        raise ResultError(f"a sealed row cannot be read: {error}.") from None


def _reject_nan(text: str) -> object:
    raise ResultError(f"it contains {text}; a missing value is null.")


def truncate(directory: Path, index: int, n_rows: int) -> None:
    """Truncate a journal to its first ``n_rows`` rows."""
    path = path_of(directory, index)
    lines = path.read_bytes().split(b"\n")[: 1 + n_rows]
    draft = draft_of(path)
    draft.write_bytes(b"".join(line + b"\n" for line in lines))
    draft.replace(path)


class Journal:
    """A writer of a journal; rows that are stored already are compared.

    Args:
        directory: the result directory.
        index: the index of the trial.
        head: the head of the journal, which is never sealed.
        seal: the seal of the rows; None if they are not sealed.

    Raises:
        ReplayDiffers: a repeated row differs from the stored one.
    """

    def __init__(self, directory: Path, index: int, head: Record, seal: Seal | None = None) -> None:
        self._path, self._seal = path_of(directory, index), seal
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._content = read(directory, index, head, seal)
        self._n_rows, self._is_finished = 0, False
        self._stream = draft_of(self._path).open("w", encoding="utf-8", newline="\n")
        self._write({"unit": head})
        for row in self._content.rows:
            self._write({"row": row.record()})
        self._replace_file()

    def add(self, row: StoredRow) -> bool:
        """Add a row, or compare it with the stored one; return whether it is new."""
        new_record = _round_trip(row)
        is_new = self._n_rows >= len(self._content.rows)
        if not is_new:
            stored_record = _round_trip(self._content.rows[self._n_rows])
            if _text(_repeatable_part(stored_record)) != _text(_repeatable_part(new_record)):
                raise ReplayDiffers(
                    f"{self._path}: row {self._n_rows}, repeated, differs from the stored one "
                    f"in {_difference(stored_record, new_record)}. The run is not repeatable here: "
                    f"{self._possible_reason()} Start anew with --overwrite."
                )
        else:
            self._write({"row": new_record})
        self._n_rows += 1
        return is_new

    def finish(self, end: StoredEnd) -> None:
        """Write the end of the trial, and close the file."""
        self._write({"end": end.record()})
        self._is_finished = True
        self.close()

    def close(self) -> None:
        """Close the file; added rows are on disk, and a finished trial remains finished."""
        if self._content.end is not None and not self._is_finished:
            self.finish(self._content.end)
            return
        with name_file_in_errors(self._path):
            self._stream.close()

    def _write(self, record: Record) -> None:
        text = _text(record)
        if self._seal is not None and "unit" not in record:
            text = self._seal.line(text)
        with name_file_in_errors(self._path):
            self._stream.write(text + "\n")
            self._stream.flush()
            os.fsync(self._stream.fileno())

    def _possible_reason(self) -> str:
        codes = codes_of(load_provenance(self._path.parents[1]))
        if messages := [text for code in codes if (text := code_differences(code))]:
            return (
                f"libraries have chosen other code paths for the processor ({'; '.join(messages)})."
            )
        return "do the versions differ, or does the algorithm draw random numbers of its own?"

    def _replace_file(self) -> None:
        draft_of(self._path).replace(self._path)


def _other_run(*heads: Record) -> str:
    """Return the differences between the heads of another run and of this run, as text."""
    messages = input_differences(*(Inputs.from_dict(_part(head, "inputs")) for head in heads))
    old_run, new_run = (
        {**_part(head, "run"), **{k: v for k, v in head.items() if k not in ("inputs", "run")}}
        for head in heads
    )
    messages += [
        f"{name} is {new_run.get(name)!r} now, was {old_run.get(name)!r}"
        for name in dict.fromkeys([*old_run, *new_run])
        if old_run.get(name) != new_run.get(name)
    ]
    return "; ".join(line[:MAX_LINE_LENGTH] for line in messages[:MAX_LINES])


def _round_trip(row: StoredRow) -> Record:
    """Return the record of a row as it is read back from the file."""
    record: Record = json.loads(_text(row.record()))
    return record


def _repeatable_part(row: Record) -> Record:
    """Return a row without refused messages, whose number differs from run to run."""
    return {name: value for name, value in row.items() if name != REFUSED_KEY}


def _part(head: Record, name: str) -> Record:
    part = head.get(name)
    return part if isinstance(part, dict) else {}


def _text(record: Record) -> str:
    return json.dumps(record, allow_nan=False, ensure_ascii=False, separators=(",", ":"))


def _difference(stored_record: Record, new_record: Record) -> str:
    names = [name for name in new_record if stored_record.get(name) != new_record[name]]
    return ", ".join(names) or "its layout"
