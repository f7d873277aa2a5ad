"""The first numbers of named streams in compiled code, held against numpy's generators."""

from __future__ import annotations

from typing import Any

import pytest

from uwsim.base.numerics.named_draws import (
    first_words,
    integers_of,
    name_words,
    seed_array,
    uniforms_of,
)
from uwsim.base.rng import stream
from uwsim.errors import BadSetting

NAMES = ("vary/vehicle[bluerov2].position.x", "environment/level/current", "")
SEEDS = (0, 1, 7, 2**31 - 2, 2**32 - 1, 2**32, 2**53 + 1, 2**63 - 1)


def test_uniform_numbers_are_those_of_numpy() -> None:
    words = first_words(seed_array(SEEDS), name_words(NAMES))
    for j, name in enumerate(NAMES):
        numbers = uniforms_of(words[:, j]).tolist()
        assert numbers == [float(stream(seed, name).uniform()) for seed in SEEDS]


def test_words_are_those_of_numpy() -> None:
    words = first_words(seed_array(SEEDS), name_words(NAMES))
    for i, seed in enumerate(SEEDS):
        raw: Any = stream(seed, NAMES[0]).bit_generator
        assert words[i, 0].tolist() == raw.random_raw(4).tolist()


@pytest.mark.parametrize("n", [1, 2, 8, 1000, 2**31 - 1, 2**31 + 5, 3 * 2**30])
def test_integers_are_those_of_numpy(n: int) -> None:
    seeds = range(100)  # for the greatest n, many draws are rejected
    words = first_words(seed_array(seeds), name_words(NAMES[:1]))
    values = integers_of(words[:, 0], n).tolist()
    assert values == [int(stream(seed, NAMES[0]).integers(n)) for seed in seeds]


def test_an_invalid_seed_is_refused() -> None:
    with pytest.raises(BadSetting, match="expected 0 to"):
        seed_array([-1])
