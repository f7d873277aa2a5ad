"""JSON of peers is read within bounds, whatever carries it."""

from __future__ import annotations

import json

import pytest

from uwsim.base.peer_json import MAX_DEPTH, read_peer_json
from uwsim.errors import BadMessage
from uwsim.middleware.web.session import read_frame


def nested_text(depth: int) -> str:
    return "[" * depth + "]" * depth


@pytest.mark.parametrize("depth", [1, MAX_DEPTH])
def test_what_is_not_too_deep_is_read_as_json(depth: int) -> None:
    assert read_peer_json(nested_text(depth)) == json.loads(nested_text(depth))
    assert read_peer_json('{"a": [1, {"b": [null, true, "[[["]}]}') == {
        "a": [1, {"b": [None, True, "[[["]}]
    }


def test_many_brackets_beside_each_other_and_in_texts_are_no_depth() -> None:
    text = json.dumps([[i] for i in range(1000)])
    assert read_peer_json(text) == json.loads(text)
    text = json.dumps({"a": "[" * 1000 + '"\\' + "{" * 1000})
    assert read_peer_json(text) == json.loads(text)


@pytest.mark.parametrize("depth", [MAX_DEPTH + 1, 700, 965, 975, 990, 100_000])
@pytest.mark.parametrize("shape", ["{}", '{{"a": {}}}', '[1, {{"b": {}}}, "]]]]"]'])
def test_what_is_too_deep_is_refused(depth: int, shape: str) -> None:
    with pytest.raises(ValueError, match=f"nested more than {MAX_DEPTH} deep"):
        read_peer_json(shape.format(nested_text(depth)))


def test_half_of_a_character_is_refused() -> None:
    with pytest.raises(ValueError, match="half of a surrogate pair"):
        read_peer_json(r'{"secret": "\ud800"}')
    assert read_peer_json(r'"\ud83d\udc1f"') == "\N{FISH}"


def test_a_frame_whose_id_is_too_deep_is_refused() -> None:
    with pytest.raises(BadMessage, match=f"nested more than {MAX_DEPTH} deep"):
        read_frame(f'{{"op": "call_service", "service": "/x", "id": {nested_text(970)}}}')


@pytest.mark.parametrize("end", ["", "\\", '"'])
def test_a_text_without_an_end_is_read_once(end: str) -> None:
    """Not once for each of its quotes: this took a day."""
    text = "[" * (MAX_DEPTH + 1) + '"' + r"\"" * 2_000_000 + end
    with pytest.raises(ValueError, match="nested more than"):
        read_peer_json(text)
