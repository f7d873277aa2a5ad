import numpy as np

from uwsim.base.rng import stream


def test_a_name_gives_the_same_numbers_whatever_else_was_drawn() -> None:
    first = stream(1, "girona500/bowtech1/noise").integers(2**63, size=4)
    stream(1, "current").random(100)
    again = stream(1, "girona500/bowtech1/noise").integers(2**63, size=4)
    assert np.array_equal(first, again)


def test_another_name_or_seed_gives_other_numbers() -> None:
    draws = {
        tuple(stream(seed, name).integers(2**63, size=2).tolist())
        for seed in (0, 1)
        for name in ("a", "b")
    }
    assert len(draws) == 4


def test_the_numbers_are_those_of_this_version_for_ever() -> None:
    assert stream(0, "current").integers(2**32, size=3).tolist() == [
        1362698929,
        3656783667,
        149969512,
    ]
