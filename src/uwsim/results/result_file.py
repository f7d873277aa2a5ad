r"""Reading and writing ``result.json``.

The format's history, newest first:

``uwsim-result/1`` (uwsim 0.1.0)
    ``inputs``, ``run``, ``columns``, ``rows``, ``missing``; and, read as empty if they are absent,
    ``facts``, ``variations``, ``image_streams``, ``pictures``, ``refused``, ``remarks``.
    ``docs/result-format.md`` describes them.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import TypeVar, cast

from ..base.files.json_text import read_json
from ..errors import ResultError, did_you_mean
from .atomic_file import write_text
from .inputs import Inputs
from .interrupted import describe_missing_result
from .result import (
    Column,
    ImageStream,
    MissingValue,
    RefusedMessages,
    Remark,
    Result,
    SavedImage,
    Variation,
)
from .run_info import RunInfo
from .stored.stored_shapes import RESULT

FORMAT = "uwsim-result/1"
FILE_KEYS = {"images": "pictures", "missing_values": "missing", "refused_messages": "refused"}
"""The key of the file for each attribute of `Result` with another name."""
ENTRY_KEYS = {"reason": "why", "sender": "by", "topic_or_service": "what"}
"""The key for each attribute of `MissingValue` and `RefusedMessages` with another name."""
T = TypeVar("T")


def file_of(path: Path) -> Path:
    """Return the path of ``result.json``, given that path or its directory."""
    return path / "result.json" if path.is_dir() else path


def save(result: Result, path: Path) -> Path:
    """Write a result atomically into ``path`` (a directory or ``.../result.json``)."""
    path = file_of(path) if path.suffix == ".json" or path.is_dir() else path / "result.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, dumps(result))
    return path


def load(path: Path | str) -> Result:
    """Read a result directory or its ``result.json``.

    Raises:
        ResultError: the file does not exist, is incomplete, or has another format.
    """
    path = Path(path)
    file = file_of(path)
    try:
        text = file.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ResultError(f"{path}: {describe_missing_result(path)}.") from None
    except UnicodeDecodeError as error:
        raise ResultError(f"{file}: not a result: not UTF-8 at byte {error.start}.") from None
    except OSError as error:
        raise ResultError(f"{file}: cannot be read: {error.strerror}.") from None
    try:
        return loads(text)
    except ResultError as error:
        raise ResultError(f"{file}: {error}") from None


def dumps(result: Result) -> str:
    """Return the text of ``result.json``: a line for each column, row and reason; floats exact."""
    parts = {
        "format": _json(FORMAT),
        "inputs": _object(result.inputs.as_dict()),
        "run": _object(result.run.as_dict()),
        "facts": _object(result.facts),
        **_optional_block("variations", result.variations),
        "columns": _block("[]", [_json(_column_fields(column)) for column in result.columns]),
        "rows": _block("[]", [_json(row) for row in result.rows]),
        "missing": _block("[]", [_entry(note) for note in result.missing_values]),
        "image_streams": _block("[]", [_entry(stream) for stream in result.image_streams]),
        "pictures": _block("[]", [_entry(image) for image in result.images]),
        **_optional_block("refused", result.refused_messages),
        **_optional_block("remarks", result.remarks),
    }
    return "{\n" + ",\n".join(f"  {_json(k)}: {text}" for k, text in parts.items()) + "\n}\n"


def loads(text: str) -> Result:
    """Read the text of a ``result.json``; raise ResultError if it is invalid."""
    try:
        document = read_json(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        is_cut_off = not text.strip() or error.pos >= len(text.rstrip()) - 1
        hint = " It ends in the middle: was it cut off?" if is_cut_off else ""
        raise ResultError(
            f"not JSON at line {error.lineno}, column {error.colno}: {error.msg}.{hint}"
        ) from None
    except ValueError as error:
        raise ResultError(f"not a result: {error}.") from None
    if not isinstance(document, dict):
        raise ResultError(f"not a result: expected an object, found {repr(document)[:60]}.")
    file_format = document.pop("format", None)
    if file_format != FORMAT:
        raise ResultError(f"its format is {repr(file_format)[:60]}; this uwsim reads {FORMAT!r}.")
    RESULT({name: part for name, part in document.items() if part is not None}, "")
    result = Result(
        inputs=Inputs.from_dict(_take(document, "inputs", dict)),
        run=RunInfo.from_dict(_take(document, "run", dict)),
        columns=tuple(_take_each(document, "columns", Column)),
        rows=tuple(_take(document, "rows", list)),
        missing_values=tuple(_take_each(document, "missing", MissingValue)),
        facts=_take(document, "facts", dict, {}),
        variations=tuple(_take_each(document, "variations", Variation, [])),
        image_streams=tuple(_take_each(document, "image_streams", ImageStream, [])),
        images=tuple(_take_each(document, "pictures", SavedImage, [])),
        refused_messages=tuple(_take_each(document, "refused", RefusedMessages, [])),
        remarks=tuple(_take_each(document, "remarks", Remark, [])),
    )
    for name in document:
        known_keys = [FILE_KEYS.get(f.name, f.name) for f in fields(Result)]
        raise ResultError(f"unknown key {name!r}.{did_you_mean(name, known_keys)}")
    return result


# ---------------------------------------------------------------------------- values -> text


def _json(value: object) -> str:
    return json.dumps(value, allow_nan=False, ensure_ascii=False)


def _block(brackets: str, lines: Iterable[str]) -> str:
    text = ",\n    ".join(lines)
    return f"{brackets[0]}\n    {text}\n  {brackets[1]}" if text else brackets


def _object(values: Mapping[str, object]) -> str:
    return _block("{}", [f"{_json(key)}: {_json(value)}" for key, value in values.items()])


def _optional_block(
    key: str, entries: Iterable[Variation | RefusedMessages | Remark]
) -> dict[str, str]:
    """Return the key and its entries; an empty dict if there are no entries."""
    lines = [_entry(entry) for entry in entries]
    return {key: _block("[]", lines)} if lines else {}


def _entry(
    entry: MissingValue | ImageStream | SavedImage | Variation | RefusedMessages | Remark,
) -> str:
    return _json({ENTRY_KEYS.get(name, name): value for name, value in asdict(entry).items()})


def _column_fields(column: Column) -> dict[str, object]:
    return {key: value for key, value in asdict(column).items() if value is not None}


# ---------------------------------------------------------------------------- text -> values


def _refuse_constant(text: str) -> object:
    raise ResultError(f"it contains {text}; a missing value is null.")


def _take(document: dict[str, object], name: str, kind: type[T], default: T | None = None) -> T:
    value = document.pop(name, default)
    if not isinstance(value, kind):
        expected = "an object" if kind is dict else "a list"
        found_text = "nothing" if value is None else repr(value)[:60]
        raise ResultError(f'"{name}" should be {expected}, found {found_text}.')
    return value


def _take_each(
    document: dict[str, object], name: str, kind: type[T], default: list[object] | None = None
) -> Iterator[T]:
    names = {ENTRY_KEYS.get(f.name, f.name): f.name for f in fields(cast("type[Column]", kind))}
    for i, node in enumerate(_take(document, name, list, default)):
        if not isinstance(node, dict):
            raise ResultError(f"{name}[{i}] should be an object, found {repr(node)[:60]}.")
        for key in node:
            if key not in names:
                hint = did_you_mean(key, names)
                raise ResultError(f"{name}[{i}]: unknown key {key!r}.{hint}.")
        try:
            values = {k: tuple(v) if isinstance(v, list) else v for k, v in node.items()}
            yield kind(**{names[key]: value for key, value in values.items()})
        except TypeError:
            absent_keys = ", ".join(repr(key) for key in names if key not in node)
            raise ResultError(f"{name}[{i}] is incomplete; it has no {absent_keys}.") from None
