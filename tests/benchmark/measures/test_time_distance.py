"""Time and distance: what counts while the measure is on."""

from __future__ import annotations

import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.benchmark.measures import Distance, DistanceSpec, TimeSpec
from uwsim.benchmark.triggers import NeverSpec, ServiceSpec, TopicSpec
from uwsim.errors import UnknownName
from uwsim.messages import Bool, Empty
from uwsim.runs.trial.triggered_measure import TriggeredMeasure


def walk(distance: Distance, body: FakeBody, *places: tuple[float, float, float]) -> None:
    for place in places:
        body.move(*place)
        distance.update()


def test_sides_of_a_square_add_up() -> None:
    body = FakeBody()
    distance = Distance(body)
    distance.start()
    walk(distance, body, (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 0))
    assert distance.value == pytest.approx(8.0)


def test_travel_during_a_pause_does_not_count() -> None:
    body = FakeBody()
    distance = Distance(body)
    distance.start()
    walk(distance, body, (1, 0, 0))
    body.move(100, 0, 0)
    distance.start()
    walk(distance, body, (102, 0, 0))
    assert distance.value == pytest.approx(3.0)


def test_a_distance_that_was_never_on_is_no_value() -> None:
    distance = Distance(FakeBody())
    assert (distance.value, distance.missing_reason) == (None, "it was never on")


def test_standing_still_is_a_distance_of_0() -> None:
    distance = Distance(FakeBody())
    distance.start()
    assert (distance.value, distance.missing_reason) == (0.0, None)


def test_a_misspelt_target_is_an_error_that_names_the_right_one() -> None:
    world = FakeWorld({"girona500": FakeBody()})
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        DistanceSpec(name="d", target="girona50").bind(world)


def test_time_is_simulation_time_to_the_step() -> None:
    world = FakeWorld(timestep=0.002)
    world.advance(7)
    time = TimeSpec(name="t").bind(world)
    assert (time.value, time.missing_reason) == (None, "it was never on")
    time.start()
    for _ in range(1500):
        world.advance()
        time.update()
    assert time.value == 3.0


def test_time_during_a_pause_does_not_count() -> None:
    world = FakeWorld(timestep=0.5)
    time = TimeSpec(name="t").bind(world)
    for _ in range(2):
        world.advance(10)
        time.start()
        world.advance()
        time.update()
    assert time.value == 1.0


def test_a_time_runs_except_in_the_original_which_knows_it_when_it_stops() -> None:
    for quirks, running in ((frozenset[str](), 1.5), (frozenset({"time-log"}), 0.0)):
        world = FakeWorld(timestep=0.5, compatibility=quirks)
        triggered = TriggeredMeasure(TimeSpec(name="t", log=0.5), world)
        triggered.tick()
        for _ in range(3):
            world.advance()
            triggered.tick()
        assert triggered.log[-1] == (1.5, running)
        assert triggered.value == running  # what is published of it meanwhile
        triggered.end()
        assert triggered.value == 1.5


def test_a_time_that_goes_on_again_begins_anew_in_the_original() -> None:
    world = FakeWorld(timestep=0.5, compatibility=frozenset({"restart"}))
    time = TimeSpec(name="t").bind(world)
    for n in (4, 3):
        time.start()
        for _ in range(n):
            world.advance()
            time.update()
        time.stop()
    assert time.value == 1.5


@pytest.mark.parametrize(("quirks", "value"), [((), None), (("never-started",), 0.0)])
def test_what_never_started_is_0_in_the_original(
    quirks: tuple[str, ...], value: float | None
) -> None:
    world = FakeWorld({"v": FakeBody()}, compatibility=frozenset(quirks))
    for spec in (
        TimeSpec(name="t", start_on=NeverSpec()),
        DistanceSpec(name="d", target="v", start_on=NeverSpec()),
    ):
        triggered = TriggeredMeasure(spec, world)
        triggered.tick()
        assert triggered.value == value


def test_a_distance_that_started_and_stands_still_is_no_start_value() -> None:
    world = FakeWorld({"v": FakeBody()}, compatibility=frozenset({"never-started"}))
    triggered = TriggeredMeasure(DistanceSpec(name="d", target="v"), world)
    triggered.tick()
    assert (triggered.never_started, triggered.value) == (False, 0.0)


def test_time_counts_from_the_start_to_the_stop_and_what_follows_adds_up() -> None:
    world = FakeWorld(timestep=0.002)
    start, stop = ServiceSpec(target="begin"), TopicSpec(target="end")
    end = world.bus.publisher("end", Bool)
    triggered = TriggeredMeasure(TimeSpec(name="t", start_on=start, stop_on=stop), world)

    def let_pass(n: int) -> None:
        for _ in range(n):
            world.advance()
            triggered.tick()

    let_pass(10)
    world.bus.services.call("begin", Empty())
    let_pass(200)
    for is_off in (True, False):
        end(Bool(data=is_off))
        let_pass(50)
    triggered.close()
    # on from step 11 to 211, and from 261 to the end at 310
    assert triggered.measure.value == pytest.approx((200 + 49) * 0.002)
