"""The generated message classes are what they were when they were written by hand.

``message_classes.json`` is what the classes of revision 0d3a8f9b had: fields with their types and
defaults, constants, and a hash of what a default and a filled message are on each wire.
"""

from __future__ import annotations

import copy
import dataclasses
import hashlib
import importlib
import itertools
import json
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scripts.reference.message_classes import main, modules
from uwsim import messages
from uwsim.base.message_fields import _class_in, _definition
from uwsim.errors import BadMessage
from uwsim.middleware.encodings import from_cdr, to_cdr, to_ros1
from uwsim.middleware.json_encoding import to_json

FOLDER = Path(messages.__file__).parent
CLASSES: dict[str, Any] = json.loads(Path(__file__).with_name("message_classes.json").read_text())


def class_of(name: str) -> type:
    module, _, base = name.partition(":")
    actual: type = getattr(importlib.import_module(f"uwsim.messages.{module}"), base)
    return actual


def make_message(cls: type, numbers: Iterator[int]) -> Any:
    """Return a message with another value in every field, and two entries in every list."""
    values: dict[str, Any] = {}
    default = cls()
    field_types = {field.name: str(field.type) for field in dataclasses.fields(cls)}
    for name, kind, content in _definition(cls):
        if kind == "array":
            length = len(getattr(default, name)) or 3
            values[name] = np.array([next(numbers) for _ in range(length)], dtype=content)
        elif kind == "list" and content == "str":
            values[name] = [f"{name} {next(numbers)}" for _ in range(2)]
        elif kind in ("list", "message"):
            part = _class_in(cls, field_types[name].removeprefix("list[").removesuffix("]"))
            assert part is not None
            values[name] = make_message(part, numbers)
            if kind == "list":
                values[name] = [values[name], make_message(part, numbers)]
        elif kind == "str":
            values[name] = f"{name} {next(numbers)}"
        else:
            values[name] = {"bool": True, "int": next(numbers), "float": next(numbers) + 0.5}[kind]
    return cls(**values)


def example(cls: type) -> Any:
    return make_message(cls, itertools.cycle(range(1, 100)))


def describe(cls: Any) -> dict[str, Any]:
    """What users see of a class."""
    default = cls()
    return {
        "msgtype": cls.__msgtype__,
        "fields": {
            field.name: f"{field.type} = {getattr(default, field.name)!r}"
            for field in dataclasses.fields(cls)
        },
        "constants": {name: value for name, value in vars(cls).items() if name.isupper()},
        "bytes": [on_the_wire(default), on_the_wire(example(cls))],
    }


def on_the_wire(message: Any) -> str:
    """Return a hash of a message in CDR, in the encoding of ROS 1 and in JSON."""
    try:
        ros1 = bytes(to_ros1(message, seq=7))
    except BadMessage:
        ros1 = b"none"
    text = json.dumps(to_json(message)).encode()
    return hashlib.sha256(b"|".join((bytes(to_cdr(message)), ros1, text))).hexdigest()[:16]


@pytest.mark.parametrize("name", CLASSES)
def test_a_generated_class_is_what_the_written_one_was(name: str) -> None:
    actual, expected = describe(class_of(name)), CLASSES[name]
    assert expected["constants"].items() <= actual.pop("constants").items()
    assert list(actual["fields"]) == list(expected["fields"])
    assert actual == {key: value for key, value in expected.items() if key != "constants"}


@pytest.mark.parametrize("name", CLASSES)
def test_a_message_survives_copies_pickles_and_a_wire(name: str) -> None:
    message = example(class_of(name))
    expected = bytes(to_cdr(message))
    for other in (copy.deepcopy(message), pickle.loads(pickle.dumps(message))):
        assert type(other) is type(message)
        assert bytes(to_cdr(other)) == expected
    assert bytes(to_cdr(from_cdr(type(message), expected))) == expected


def test_the_generated_modules_are_up_to_date() -> None:
    for module, text in modules(FOLDER).items():
        assert (FOLDER / f"{module}.py").read_text() == text, "run scripts/messages"


def put(folder: Path, text: str, name: str = "own_msgs/msg/Heading.msg") -> Path:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)
    return folder


def test_comments_of_a_text_are_docstrings_and_its_defaults_are_kept(tmp_path: Path) -> None:
    text = "# A heading.\nstd_msgs/Header header\nfloat64 heading 1.5  # Yaw [rad].\nbool[3] set\n"
    source = modules(put(tmp_path, text))["own_msgs"]
    assert 'class Heading:\n    """A heading."""\n' in source
    assert '    heading: float = 1.5\n    """Yaw [rad]."""\n' in source
    assert "_BOOL__3: Any = partial(np.zeros, 3, np.bool_)" in source
    compile(source, "own_msgs.py", "exec")


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("float64 heading\n", r"Heading\.msg:1: expected a comment"),
        (
            "# A heading.\nstd_msgs/Int8 turns\n",
            "own_msgs: uwsim.messages has no std_msgs/msg/Int8",
        ),
        ("# A heading.\nstring[2] names\n", "own_msgs/msg/Heading: an array of 2 texts"),
    ],
)
def test_a_text_that_no_class_can_have_is_an_error(text: str, error: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=error):
        modules(put(tmp_path, text))


def test_only_a_module_that_changes_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    put(tmp_path, "# A heading.\nfloat64 heading\n")
    monkeypatch.setattr("sys.argv", ["messages", str(tmp_path)])
    main()
    capsys.readouterr()
    put(tmp_path, "# A heading.\nfloat32 heading\nint8 turns\n")
    main()
    assert capsys.readouterr().out == f"{tmp_path / 'own_msgs.py'}\n"
