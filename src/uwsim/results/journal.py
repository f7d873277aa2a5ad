"""Journals: a file for each trial, with a line for each finished row.

A line is written whole and flushed before the next level begins, so a killed run loses at most the
level it was in. The first line identifies the trial, the last says that it is finished. A line
that was cut off does not count.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ReplayDiffers, ResultError, name_file_in_errors
from .chosen_code import other_code
from .inputs import Inputs, differing
from .provenance import codes_of, load_provenance
from .seal import SEALED, Seal
from .stored.stored_row import Record, StoredEnd, StoredRow
from .stored.stored_shapes import END, HEAD, ROW

FOLDER = "units"
TRACK = ".motion"
"""Suffix of the motion track of a trial, beside its journal."""
INPUTS = ".inputs"
"""Suffix of what a pilot did in a trial, beside its journal."""
REFUSED = "refused"
"""Key of a row -> what came from programs that do not take part."""
KINDS = {"unit": HEAD, "row": ROW, "end": END}
"""Key of a line -> shape of its value."""
MAX_LINE_LENGTH = 200
"""Greatest number of letters printed of one difference."""
MAX_LINES = 6
"""Greatest number of differences printed."""


@dataclass(frozen=True)
class Stored:
    """The content of a journal."""

    rows: tuple[StoredRow, ...]
    """Rows finished, in order."""
    end: StoredEnd | None
    """The end of a finished trial; None while it is not finished."""


NOTHING = Stored((), None)
"""What is stored of a trial that was not begun."""


def path_of(directory: Path, index: int) -> Path:
    """Return where the trial number ``index`` is kept."""
    return directory / FOLDER / f"{index:05d}.jsonl"


def track_path(directory: Path, index: int) -> Path:
    """Return where the motion track of the trial number ``index`` is kept."""
    return path_of(directory, index).with_suffix(TRACK)


def recorded_trials(directory: Path) -> tuple[int, ...]:
    """Return the numbers of the trials whose motion is in a result directory."""
    tracks = (directory / FOLDER).glob(f"*{TRACK}")
    return tuple(sorted(int(path.stem) for path in tracks if path.stem.isdecimal()))


def trials_without_motion(directory: Path) -> tuple[int, ...]:
    """Return the numbers of the finished trials whose motion is not there."""
    there = recorded_trials(directory)
    files = (directory / FOLDER).glob("*.jsonl")
    numbers = sorted(int(path.stem) for path in files if path.stem.isdecimal())
    return tuple(
        index
        for index in numbers
        if index not in there and read_any(path_of(directory, index))[1].end is not None
    )


def read(directory: Path, index: int, head: Record, seal: Seal | None = None) -> Stored:
    """Read a journal; a missing file has no rows.

    Args:
        directory: of the result.
        index: number of the trial.
        head: identity of the trial.
        seal: with which rows are sealed while the run goes on.

    Raises:
        ResultError: the file belongs to another run.
    """
    path = path_of(directory, index)
    found, stored = read_any(path, seal)
    if found is not None and found != head:
        raise ResultError(
            f"{path}: belongs to another run: {_other_run(found, head)}. "
            "Start anew with --overwrite, or choose another --out."
        )
    return stored


def level_difference(stored: Stored, levels: Sequence[Sequence[float]]) -> str | None:
    """Return where the rows of a trial are not its levels, in their order; None if they are.

    Args:
        stored: its journal; one that is not finished may have fewer rows.
        levels: its levels, the values of each.
    """
    rows = [list(row.values) for row in stored.rows]
    for number, (there, level) in enumerate(zip(rows, map(list, levels), strict=False)):
        if there != level:
            return f"row {number} is of the level {_values(there)}; expected {_values(level)}"
    if len(rows) > len(levels) or (stored.end is not None and len(rows) < len(levels)):
        return f"{len(rows)} rows; expected {len(levels)}, one for each level of the trial"
    return None


def _values(level: Sequence[float]) -> str:
    return ", ".join(map(repr, level)) or "None"


def read_any(path: Path, seal: Seal | None = None) -> tuple[Record | None, Stored]:
    """Read a journal of any run: its head and its content, up to what is sealed.

    Raises:
        ResultError: a line is not that of a journal.
    """
    if not path.exists():
        return None, NOTHING
    lines = path.read_bytes().split(b"\n")[:-1]  # what follows the last newline was cut off
    found: dict[str, list[Record]] = {kind: [] for kind in KINDS}
    for number, line in enumerate(lines, start=1):
        try:
            record = json.loads(line, parse_constant=_refuse_constant)
            if isinstance(record, dict) and SEALED in record:
                if seal is None:
                    break  # of a run that goes on, or was lost when the machine went down
                record = json.loads(_opened(record[SEALED], seal), parse_constant=_refuse_constant)
            kind = _kind(record, is_first=number == 1)
            KINDS[kind](record[kind], kind)
        except (ValueError, RecursionError):
            break  # the disk was full, or the machine went down
        except ResultError as error:
            raise ResultError(f"{path}:{number}: {error}") from None
        if found["end"]:
            raise ResultError(f"{path}:{number}: it is behind the end of its trial; expected none.")
        found[kind].append(record[kind])
    if not found["unit"]:
        return None, NOTHING
    ends = found["end"]
    rows = tuple(map(StoredRow.of, found["row"]))
    return found["unit"][0], Stored(rows, StoredEnd.of(ends[0]) if ends else None)


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
    """Return the kind of a line; raises ResultError."""
    wanted = ("unit",) if is_first else ("row", "end")
    if isinstance(record, dict):
        for kind in wanted:
            if kind in record:
                return kind
    shown = repr(record)[:60]
    raise ResultError(f"found {shown}; expected an object with {' or '.join(map(repr, wanted))}.")


def _opened(content: object, seal: Seal) -> str:
    """Return a line that is sealed; raises ResultError."""
    try:
        return seal.text(content)
    except ValueError as error:
        raise ResultError(f"a sealed row cannot be read: {error}.") from None


def _refuse_constant(text: str) -> object:
    raise ResultError(f"it contains {text}; a missing value is null.")


def cut_back(directory: Path, index: int, n_rows: int) -> None:
    """Truncate a journal to its first rows."""
    path = path_of(directory, index)
    lines = path.read_bytes().split(b"\n")[: 1 + n_rows]
    draft = path.with_suffix(".part")
    draft.write_bytes(b"".join(line + b"\n" for line in lines))
    draft.replace(path)


class Journal:
    """Writes a journal; rows that exist already are compared.

    Args:
        directory: of the result.
        index: number of the trial.
        head: identity of the trial, which is never sealed.
        seal: with which rows are sealed, if they are.

    Raises:
        ReplayDiffers: a repeated row differs from the stored one.
    """

    def __init__(self, directory: Path, index: int, head: Record, seal: Seal | None = None) -> None:
        self._path, self._seal = path_of(directory, index), seal
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._stored = read(directory, index, head, seal)
        self._n_rows, self._is_finished = 0, False
        self._stream = self._path.with_suffix(".part").open("w", encoding="utf-8", newline="\n")
        self._write({"unit": head})
        for row in self._stored.rows:
            self._write({"row": row.record()})
        self._publish()

    def add(self, row: StoredRow) -> bool:
        """Add a row, or compare it with the stored one; returns whether it is new."""
        again = _as_read(row)
        is_new = self._n_rows >= len(self._stored.rows)
        if not is_new:
            before = _as_read(self._stored.rows[self._n_rows])
            if _text(_own(before)) != _text(_own(again)):
                raise ReplayDiffers(
                    f"{self._path}: row {self._n_rows}, repeated, differs from the stored one "
                    f"in {_difference(before, again)}. The run is not repeatable here: "
                    f"{self._why_not()} Start anew with --overwrite."
                )
        else:
            self._write({"row": again})
        self._n_rows += 1
        return is_new

    def finish(self, end: StoredEnd) -> None:
        """Write the end of the trial."""
        self._write({"end": end.record()})
        self._is_finished = True
        self.close()

    def close(self) -> None:
        """Close the file; what was added is on disk, and a trial that was finished stays so."""
        if self._stored.end is not None and not self._is_finished:
            self.finish(self._stored.end)
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

    def _why_not(self) -> str:
        """Return a possible reason for a differing row."""
        codes = codes_of(load_provenance(self._path.parents[1]))
        if messages := [text for code in codes if (text := other_code(code))]:
            return (
                f"libraries have chosen other code paths for the processor ({'; '.join(messages)})."
            )
        return "was it made with other versions, or does the algorithm have chance of its own?"

    def _publish(self) -> None:
        self._path.with_suffix(".part").replace(self._path)


def _other_run(found: Record, head: Record) -> str:
    """Return the differences between a head and that of this run."""
    messages = differing(*(Inputs.of(_part(each, "inputs")) for each in (found, head)))
    before, now = (
        {**_part(each, "run"), **{k: v for k, v in each.items() if k not in ("inputs", "run")}}
        for each in (found, head)
    )
    messages += [
        f"{name} is {now.get(name)!r} now, was {before.get(name)!r}"
        for name in dict.fromkeys([*before, *now])
        if before.get(name) != now.get(name)
    ]
    return "; ".join(line[:MAX_LINE_LENGTH] for line in messages[:MAX_LINES])


def _as_read(row: StoredRow) -> Record:
    """Return the record of a row as it would be read again."""
    record: Record = json.loads(_text(row.record()))
    return record


def _own(row: Record) -> Record:
    """Return a row without what other programs have sent, which is chance."""
    return {name: value for name, value in row.items() if name != REFUSED}


def _part(head: Record, name: str) -> Record:
    part = head.get(name)
    return part if isinstance(part, dict) else {}


def _text(record: Record) -> str:
    return json.dumps(record, allow_nan=False, ensure_ascii=False, separators=(",", ":"))


def _difference(before: Record, after: Record) -> str:
    names = [name for name in after if before.get(name) != after[name]]
    return ", ".join(names) or "its layout"
