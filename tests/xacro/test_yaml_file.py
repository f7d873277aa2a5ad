"""YAML files are read as PyYAML reads them for the xacro of ROS, within limits."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.errors import SceneError
from uwsim.scene.xacro import parse_expanded
from uwsim.scene.xacro.value import ExpressionError
from uwsim.scene.xacro.yaml_file import read_yaml


def value_of(folder: Path, content: str) -> object:
    path = folder / "a.yaml"
    path.write_text(content)
    return read_yaml(path, name="a.yaml")


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        *[(word, True) for word in ("yes", "Yes", "YES", "on", "true", "TRUE")],
        *[(word, False) for word in ("no", "No", "NO", "off", "Off", "False")],
        *[
            (word, word)
            for word in ("y", "n", "tRue", "'no'", '"010"', "08", "12:61", "2024-01-02")
        ],
        *[("010", 8), ("-017", -15), ("0", 0), ("0x1F", 31), ("0b101", 5), ("1_000", 1000)],
        *[("1:30", 90), ("-2:00:05", -7205), ("1:30.5", 90.5), (".inf", float("inf"))],
        *[("1.0e-1", 0.1), ("1e-3", 0.001), ("1.5e3", 1500.0), ("-.5", -0.5), ("7.", 7.0)],
        *[("~", None), ("", None), ("!!str 010", "010"), ("!!float 3", 3.0), ("!!int '11'", 11)],
    ],
)
def test_words_are_those_of_yaml_1_1(word: str, expected: object, tmp_path: Path) -> None:
    found = value_of(tmp_path, f"a: {word}")
    if isinstance(expected, str):
        expected = expected.strip("'\"")
    assert found == {"a": expected}
    assert isinstance(found, dict)
    assert type(found["a"]) is type(expected)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("a: 1\nb: 2\na: 3", {"a": 3, "b": 2}),
        ("p: {x: 4, y: 5, x: 6, x: 7}", {"p": {"x": 7, "y": 5}}),
        ("a: &n [1, 2]\nb: *n\nc: [*n, 3]", {"a": [1, 2], "b": [1, 2], "c": [[1, 2], 3]}),
        ("a: &n {x: 1}\nb: {y: 2, <<: *n}", {"a": {"x": 1}, "b": {"x": 1, "y": 2}}),
        (
            "- &p {x: 1, y: 2}\n- &q {x: 5, z: 6}\n- {<<: [*p, *q], y: 9}",
            [{"x": 1, "y": 2}, {"x": 5, "z": 6}, {"x": 1, "y": 9, "z": 6}],
        ),
        ("a: &k text\n*k : 3", {"a": "text", "text": 3}),
    ],
)
def test_repeated_keys_and_aliases(content: str, expected: object, tmp_path: Path) -> None:
    assert value_of(tmp_path, content) == expected


def laughs(width: int, levels: int) -> str:
    lines = ["a0: &a0 [" + "x, " * width + "]"]
    for level in range(1, levels):
        aliases = f"*a{level - 1}, " * width
        lines.append(f"a{level}: &a{level} [{aliases}]")
    return "\n".join(lines)


@pytest.mark.parametrize(
    "content",
    [
        laughs(10, 10),
        laughs(150, 3),
        laughs(2, 35),
        "[" + "a, " * 300_000 + "]",
        "m: &m {" + ", ".join(f"k{i}: 1" for i in range(2000)) + "}\n"
        "n: {<<: [" + "*m, " * 5000 + "]}",
    ],
    ids=["deep", "wide", "two", "long", "merged"],
)
def test_what_grows_large_is_one_short_error(content: str, tmp_path: Path) -> None:
    with pytest.raises(ExpressionError, match="more than 10000 values") as caught:
        value_of(tmp_path, content)
    assert len(str(caught.value)) < 300


def test_a_repeated_key_is_a_warning_at_its_line_once(tmp_path: Path) -> None:
    (tmp_path / "mass.yaml").write_text("hull: 1\narm: 2\n\nhull: 30\n")
    scene = tmp_path / "a.xml"
    each = "<b>${xacro.load_yaml('mass.yaml')['hull']}</b>"
    scene.write_text(f'<a xmlns:xacro="http://ros.org/wiki/xacro">{each}{each}</a>')
    document = parse_expanded(scene, error=SceneError)
    assert [node.text for node in document.root] == ["30", "30"]
    (warning,) = document.expansion.warnings
    assert (Path(str(warning.file)).name, warning.line) == ("mass.yaml", 4)
    assert "the key 'hull' occurs twice" in warning.message
