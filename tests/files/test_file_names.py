import random
import re

import pytest

from uwsim.base.files.file_names import MAX_NAME_LENGTH, file_name, file_names

FIT = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("corners", "corners"),
        ("taskTime", "taskTime"),
        ("left/front", "left_front"),
        ("own:Tracker", "own.Tracker"),
        ("..", "_"),
        ("", "_"),
        ("../../etc/passwd", "_.._etc_passwd"),
        ("-rf", "rf"),
        ("end.", "end"),
        ("NUL", "_NUL"),
        ("com1.txt", "_com1.txt"),
        ("a\0b\n", "a_b_"),
    ],
)
def test_a_name_becomes_one_that_every_file_system_takes(name: str, file: str) -> None:
    assert file_name(name) == file


@pytest.mark.parametrize(
    "names",
    [
        ("left/front", "left_front", "left\\front"),
        ("Total", "total", "TOTAL"),
        ("a" * 80 + "b", "a" * 80 + "c", "a" * 80),
        ("..", ".", "", "_"),
        ("nul", "NUL", "_nul"),
        ("测量", "测试", "__"),
        ("own:Tracker", "own.Tracker"),
    ],
)
def test_different_names_are_different_files_also_where_case_does_not_count(
    names: tuple[str, ...],
) -> None:
    found = file_names(names)
    assert len({file.casefold() for file in found.values()}) == len(names)
    assert all(FIT.fullmatch(file) and len(file) <= MAX_NAME_LENGTH for file in found.values())
    assert file_names(names[::-1]) == found


def test_a_file_that_is_there_already_is_not_taken() -> None:
    assert file_names(["Plots", "esm"], existing_names=["plots"]) == {
        "Plots": "Plots-3dea533b",
        "esm": "esm",
    }


def test_a_name_that_looks_like_one_with_a_hash_is_another_file() -> None:
    alike = file_names(["a/b", "a_b"])
    names = ["a/b", "a_b", *alike.values()]
    assert len(set(file_names(names).values())) == 4


def test_names_made_by_chance_are_never_one_file() -> None:
    chance = random.Random(1)
    letters = "aA./\\:_- \0é漢"
    names = {"".join(chance.choices(letters, k=chance.randrange(6))) for _ in range(500)}
    assert len({file.casefold() for file in file_names(names).values()}) == len(names)
