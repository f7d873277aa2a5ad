"""Collision: the original's score, what it is made of, and compatibility quirks."""

from __future__ import annotations

import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.benchmark.measures.collision import Collision, CollisionSpec
from uwsim.benchmark.triggers import NeverSpec
from uwsim.errors import UnknownName
from uwsim.runs.trial.triggered_measure import TriggeredMeasure
from uwsim.world import Contact

SPEC = CollisionSpec(name="hits", target="girona500")


def tank(**other: object) -> FakeWorld:
    return FakeWorld({"girona500": FakeBody()}, **other)  # type: ignore[arg-type]


def hit(speed: float, *, own: float = 0.0, is_first: bool = True) -> Contact:
    return Contact(approach_speed=speed, own_speed=own, is_first=is_first, other="blackbox")


def play(world: FakeWorld, *steps: list[Contact]) -> Collision:
    """Measure over steps with these contacts."""
    collision = SPEC.bind(world)
    for i, contacts in enumerate(steps):
        world.contacts_by_body["girona500"] = contacts
        if i == 0:
            collision.start()
        else:
            collision.update()
    return collision


def test_who_never_hits_anything_has_the_full_score() -> None:
    collision = play(tank(), [], [], [])
    assert collision.value == 1.0
    assert collision.details == {"max_speed": 0.0, "mean_speed": 0.0, "contact_share": 0.0}


def test_the_highest_and_the_mean_speed_both_cost() -> None:
    collision = play(tank(), [], [hit(0.2)], [hit(0.1)], [])
    assert collision.value == pytest.approx(1.0 - (0.3 / 4) / 0.5 - 0.2 / 0.5)
    assert collision.details == {
        "max_speed": pytest.approx(0.2),
        "mean_speed": pytest.approx(0.15),
        "contact_share": pytest.approx(0.5),
    }


def test_a_body_that_rests_on_another_is_in_contact_and_loses_nothing() -> None:
    collision = play(tank(), [hit(0.0), hit(-0.01)], [hit(0.0)])
    assert collision.value == 1.0
    assert collision.details["contact_share"] == 1.0


def test_of_several_contacts_the_mean_of_those_that_close_counts() -> None:
    collision = play(tank(), [hit(0.1), hit(0.3), hit(-2.0)])
    assert collision.details["max_speed"] == pytest.approx(0.2)


def test_the_score_never_falls_below_0() -> None:
    assert play(tank(), [hit(3.0)]).value == 0.0


def test_who_is_hit_while_standing_still_is_hit() -> None:
    assert play(tank(), [hit(0.2, own=0.0, is_first=False)]).details["max_speed"] == 0.2


def test_the_original_looks_at_the_first_body_and_its_own_velocity_only() -> None:
    original = {"compatibility": frozenset({"collision"})}
    assert play(tank(**original), [hit(0.2, own=0.1, is_first=False)]).value == 1.0
    collision = play(tank(**original), [hit(0.2, own=0.1), hit(0.3, own=-0.1)])
    assert collision.details["max_speed"] == pytest.approx(0.1)
    assert collision.value == pytest.approx(1.0 - 0.1 / 0.5 - 0.1 / 0.5)


def test_the_original_looks_at_one_thing_at_a_time() -> None:
    both = [
        Contact(approach_speed=-0.1, own_speed=-0.1, is_first=True, other="floor"),
        Contact(approach_speed=0.2, own_speed=0.2, is_first=True, other="wall"),
        Contact(approach_speed=0.4, own_speed=0.4, is_first=True, other="pipe"),
        Contact(approach_speed=0.3, own_speed=0.3, is_first=True, other="wall"),
    ]
    assert play(tank(), both).details["max_speed"] == pytest.approx(0.3)
    original = tank(compatibility=frozenset({"collision"}))
    assert play(original, both).details["max_speed"] == pytest.approx(0.25)


def test_what_was_never_on_has_no_score() -> None:
    collision = SPEC.bind(tank())
    assert collision.value is None
    assert collision.missing_reason == "it was never on"
    assert set(collision.details.values()) == {None}


def test_its_speeds_are_in_metres_per_second_though_its_score_is_a_number() -> None:
    collision = SPEC.bind(tank())
    units = {name: collision.detail_units.get(name, collision.unit) for name in collision.details}
    assert units == {"max_speed": "m/s", "mean_speed": "m/s", "contact_share": "1"}


def test_its_log_has_a_name_for_every_number() -> None:
    collision = play(tank(), [hit(0.2)])
    assert len(collision.log_header) == len(collision.log_values) == 4


def test_a_collision_that_goes_on_again_begins_anew_in_the_original() -> None:
    for quirks, highest in ((frozenset[str](), 0.4), (frozenset({"restart"}), 0.1)):
        collision = play(tank(compatibility=quirks), [hit(0.4)], [])
        collision._world.contacts_by_body["girona500"] = []  # type: ignore[attr-defined]
        collision.start()
        collision._world.contacts_by_body["girona500"] = [hit(0.1)]  # type: ignore[attr-defined]
        collision.update()
        assert collision.details["max_speed"] == highest
    assert collision.value == pytest.approx(1.0 - (0.1 / 2) / 0.5 - 0.1 / 0.5)


def test_a_collision_that_never_started_has_the_full_score_in_the_original() -> None:
    triggered = TriggeredMeasure(
        CollisionSpec(name="hits", target="girona500", start_on=NeverSpec()),
        tank(compatibility=frozenset({"never-started"})),
    )
    assert triggered.value == 1.0


def test_a_body_that_is_not_there_is_an_error() -> None:
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        CollisionSpec(name="c", target="girona50").bind(tank())


def test_only_a_file_that_asks_for_it_ends_a_level_at_the_first_contact() -> None:
    assert play(tank(), [], [hit(0.2)]).ends_level is None
    world = tank(timestep=0.5)
    collision = CollisionSpec(name="hits", target="girona500", stop_on_contact=True).bind(world)
    collision.start()
    assert collision.ends_level is None
    world.advance()
    world.contacts_by_body["girona500"] = [hit(0.2)]
    collision.update()
    world.advance()
    world.contacts_by_body["girona500"] = []
    collision.update()
    assert collision.ends_level == "'girona500' touched 'blackbox' at 0.5 s"
