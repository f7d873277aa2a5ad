"""CSV: one table for each topic of a recording, with the time and the numbers of its messages."""

from __future__ import annotations

import csv
from collections.abc import Collection
from pathlib import Path

from ...base.files.file_names import file_names
from ...errors import BadSetting, UnknownName
from ...middleware.recording import BagReader
from ...results.atomic_file import atomic_write
from .message_numbers import read_numbers


def check_topics(reader: BagReader, topics: Collection[str]) -> None:
    """Raise UnknownName for a topic that is not in a recording."""
    for topic in topics:
        if topic not in reader.topics:
            raise UnknownName("topic", topic, reader.topics)


def check_folder(out: Path) -> None:
    """Raise BadSetting unless a path is a new or an empty folder."""
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise BadSetting(f"--out {out}: exists; expected a new or an empty folder.")


def export_csv(recording: Path, out: Path, topics: Collection[str] = ()) -> dict[str, int]:
    """Write a table for each topic; return the number of rows of each topic.

    The columns are those of the first message with numbers; later messages with others leave cells
    empty, or leave values out. Topics without numbers have no table.

    Raises:
        AssetError: the recording cannot be read.
        UnknownName: a topic is not in the recording.
        BadSetting: the folder is not empty.
    """
    check_folder(out)
    with BagReader(recording) as reader:
        check_topics(reader, topics)
        chosen_topics = sorted(topics or reader.topics)
        names = file_names([topic.strip("/").replace("/", ".") for topic in chosen_topics])
        out.mkdir(parents=True, exist_ok=True)
        n_rows: dict[str, int] = {}
        for topic in chosen_topics:  # one pass each, so that few rows are in memory
            path = out / f"{names[topic.strip('/').replace('/', '.')]}.csv"
            count = _write_table(reader, topic, path)
            if count:
                n_rows[topic] = count
    return n_rows


def _write_table(reader: BagReader, topic: str, path: Path) -> int:
    columns: list[str] | None = None
    count = 0
    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        for time, _, message in reader.messages([topic]):
            numbers = read_numbers(message)
            if columns is None:
                columns = list(numbers)
                table.writerow(["time", *columns])
            table.writerow(
                [repr(time), *(repr(numbers[c]) if c in numbers else "" for c in columns)]
            )
            count += 1
    if not columns:
        path.unlink()
        return 0
    return count
