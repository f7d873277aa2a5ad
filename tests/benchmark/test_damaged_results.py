"""Results that were damaged by chance: whatever reads them says so in one line, or reads them."""

from __future__ import annotations

import json
import random
import shutil
from pathlib import Path

import pytest

from tests.support.fuzzed_results import (
    FILES,
    TARGETS,
    IntactResult,
    damage_json,
    make_intact_result,
    trial,
)
from uwsim.errors import ResultError
from uwsim.results.result_file import load, loads

TRIALS = 20
"""Of each reader; scripts/fuzz does as many as one likes."""


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> IntactResult:
    return make_intact_result(tmp_path_factory.mktemp("sound"))


@pytest.mark.parametrize("target", TARGETS)
def test_a_sound_result_is_read(sound: IntactResult, target: str, tmp_path: Path) -> None:
    shutil.copytree(sound.folder / "out", tmp_path / "copy")
    TARGETS[target](sound, tmp_path / "copy")


@pytest.mark.parametrize("target", TARGETS)
def test_a_damaged_result_is_one_clean_line(sound: IntactResult, target: str) -> None:
    wrong = {seed: said for seed in range(TRIALS) if (said := trial(sound, target, seed))}
    assert wrong == {}


def test_trials_do_damage_and_the_same_seed_does_the_same(sound: IntactResult) -> None:
    for name in FILES:
        data = (sound.folder / "out" / name).read_bytes()
        once, again = (
            [damage_json(data, random.Random(seed)) for seed in range(30)] for _ in range(2)
        )
        assert once == again
        assert sum(each != data for each in once) > 25


@pytest.mark.parametrize("value", [7, "x", [], [[]], [None], True], ids=repr)
@pytest.mark.parametrize(
    ("part", "key"),
    [("inputs", "assets"), ("inputs", "scene"), ("run", "timestep"), ("run", "units")],
)
def test_a_value_of_another_shape_is_named(
    sound: IntactResult, part: str, key: str, value: object
) -> None:
    document = json.loads((sound.folder / "out" / "result.json").read_text())
    document[part][key] = value
    with pytest.raises(ResultError, match=rf"{part}.{key} is .*; expected "):
        loads(json.dumps(document))


def test_what_is_nested_deeper_than_any_result_is_refused(
    sound: IntactResult, tmp_path: Path
) -> None:
    text = (sound.folder / "out" / "result.json").read_text()
    file = tmp_path / "result.json"
    file.write_text(text.replace('"seed": 1', f'"extra": {"[" * 400}{"]" * 400}, "seed": 1', 1))
    with pytest.raises(ResultError, match=r"run.extra.* expected"):
        load(file)
