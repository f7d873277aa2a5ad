"""Rates of interfaces that are no whole numbers, and the original's reading of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from tests.topics.test_every_interface import SCENE
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.middleware.recording.topic_rates import TopicRate, TopicRates
from uwsim.scene.reader import read_scene


def rates(
    folder: Path, rate: str, *, seconds: float, compatibility: frozenset[str] = frozenset()
) -> dict[str, TopicRate]:
    """What comes on every topic of a scene with all interfaces at a rate."""
    path = folder / "scene.xml"
    path.write_text(SCENE.replace("<rate>20</rate>", f"<rate>{rate}</rate>"))
    simulation = open_scene(read_scene(path), is_blind=True, compatibility=compatibility)
    with simulation:
        counted = TopicRates(simulation.bus, lambda: simulation.time)
        simulation.advance(seconds)
        found = {each.topic: each for each in counted.rates() if each.is_published}
    assert len(found) > 20
    return {topic: each for topic, each in found.items() if topic.startswith("/t/")}


def test_every_interface_keeps_a_rate_that_is_no_whole_number(tmp_path: Path) -> None:
    for topic, each in rates(tmp_path, "12.5", seconds=0.5).items():
        assert (topic, each.n_messages, each.rate) == (topic, 7, pytest.approx(12.5))
    assert not [each for each in check_file(tmp_path / "scene.xml") if "12.5" in each.message]


def test_a_period_between_two_steps_is_kept_in_the_mean(tmp_path: Path) -> None:
    for each in rates(tmp_path, "33.3", seconds=3.0).values():
        assert each.n_messages == 100  # at 0, 1/33.3 ... 99/33.3 = 2.973 s
        assert each.rate == pytest.approx(33.3, rel=1e-3)
        assert (each.min_gap, each.max_gap) == (pytest.approx(0.030), pytest.approx(0.032))


def test_a_sensor_may_be_slower_than_once_a_second(tmp_path: Path) -> None:
    assert {each.n_messages for each in rates(tmp_path, "0.5", seconds=2.0).values()} == {2}


@pytest.mark.parametrize(("rate", "n_messages"), [("33.3", 17), ("0.5", 1)])
def test_the_original_reads_whole_numbers(tmp_path: Path, rate: str, n_messages: int) -> None:
    found = rates(tmp_path, rate, seconds=0.5, compatibility=frozenset({"whole-rates"}))
    assert {each.n_messages for each in found.values()} == {n_messages}


@pytest.mark.parametrize("rate", ["0", "-5", "nan", "1e99", "33,3", "0.0001"])
def test_what_is_no_rate_is_an_error_that_says_what_is(tmp_path: Path, rate: str) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE.replace("<rate>20</rate>", f"<rate>{rate}</rate>"))
    with pytest.raises(SceneError, match=r"<rate> is .*; expected a number >= 0.001 and <= 10000"):
        read_scene(path)
