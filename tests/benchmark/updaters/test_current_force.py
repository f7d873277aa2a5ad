"""currentForceUpdater: each level begins alike, and what is said on currentForce."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.support.fakes import FakeWorld
from uwsim.benchmark.updaters import (
    CurrentForceUpdaterSpec,
    Level,
    RepeatSpec,
    SceneFogUpdaterSpec,
    SphericalSpec,
    apply_level,
    bind_updaters,
    levels,
    ramp_level,
    settling_time,
)
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import Empty, EmptyResponse, WrenchStamped

ORIGIN = np.zeros((1, 3))


def tracking(**other: object) -> CurrentForceUpdaterSpec:
    """Return the updater of the original's trackingBenchmarkauto."""
    spec = CurrentForceUpdaterSpec(
        initial_value=0.0,
        final_value=0.2,
        spherical_direction=SphericalSpec(theta=1.57, phi=0.0),
        force_variation=0.005,
        force_period=4.0,
        direction_variation=SphericalSpec(theta=0.0, phi=0.7),
        direction_period=SphericalSpec(theta=4.0, phi=30.0),
        random=0.01,
        step=0.01,
        interval=120.0,
        target="girona500",
    )
    return dataclasses.replace(spec, **other)  # type: ignore[arg-type]


def ship(**other: object) -> FakeWorld:
    return FakeWorld(vehicles=("girona500",), **other)  # type: ignore[arg-type]


def waters(world: FakeWorld, seconds: float) -> list[list[float]]:
    """Return what the water does at every step from now on [m/s]."""
    found = []
    for _ in range(round(seconds / world.timestep)):
        assert world.current is not None
        found.append(world.current.velocity(ORIGIN, world.time)[0].tolist())
        world.advance()
    return found


def test_its_levels_are_those_the_original_plays() -> None:
    values = tracking().values()
    assert len(values) == 20
    assert (values[0], values[-1]) == (0.0, pytest.approx(0.19))
    assert (tracking().name, tracking().unit) == ("current", "m/s")


def test_the_first_level_of_a_sequence_is_no_step_and_has_no_still_water() -> None:
    world = ship()
    updater = tracking().bind(world)
    world.bus.services.serve("dynamics/reset", Empty, lambda request: pytest.fail("it was reset"))
    updater.ramp(0.2)
    assert (world.current, len(world.put_backs)) == (None, 1)  # held before it begins
    updater.begin(0.2)
    assert len(world.put_backs) == 1
    assert (np.linalg.norm(waters(world, 0.1), axis=1) > 0.19).all()


def test_with_the_originals_target_the_current_moves_nothing_else() -> None:
    world = ship(compatibility=frozenset({"current-target"}))
    tracking().bind(world).begin(0.2)
    assert world.current is not None
    points, names = np.zeros((3, 3)), ("girona500", "", "bluerov2")
    for moved in (
        world.current.velocity(points, 1.0, names),
        world.current.acceleration(points, 1.0, names),
    ):
        assert np.linalg.norm(moved[0]) > 0.0
        assert not moved[1:].any()
    assert not world.current.velocity(points, 1.0).any()


def test_a_level_puts_the_vehicle_back_and_begins_with_2_s_of_still_water() -> None:
    world = ship()
    updater = tracking().bind(world)
    world.advance(1000)
    updater.apply(0.2)
    assert world.put_backs == [("girona500", 2.0)]
    speeds = np.linalg.norm(waters(world, 4.0), axis=1)
    assert (speeds[:1000] == 0.0).all()
    assert (speeds[1000:] > 0.19).all()


def test_a_level_is_the_same_alone_and_in_a_sweep() -> None:
    alone, sweep = ship(seed=3), ship(seed=3)
    tracking().bind(alone).apply(0.1)
    updater = tracking().bind(sweep)
    for value in (0.0, 0.05):
        updater.apply(value)
        waters(sweep, 3.1)
    updater.apply(0.1)
    assert waters(alone, 5.0) == waters(sweep, 5.0)


def test_the_reset_service_is_called_if_somebody_offers_it() -> None:
    world = ship()
    asked: list[Empty] = []

    def reset(request: Empty) -> EmptyResponse:
        asked.append(request)
        return EmptyResponse()

    updater = tracking().bind(world)
    updater.apply(0.0)
    world.bus.services.serve("dynamics/reset", Empty, reset)
    updater.apply(0.1)
    assert asked == [Empty()]


def test_on_the_way_to_a_level_the_vehicle_is_held_in_its_place_in_still_water() -> None:
    world = ship()
    updaters = bind_updaters(tracking(), world)
    for _ in range(3):
        ramp_level(updaters, Level((("current", 0.1),)))
    assert [name for name, _ in world.put_backs] == ["girona500"] * 3
    assert world.current is None


def test_the_vehicle_is_put_back_once_for_all_fogs_within_a_current() -> None:
    fog = SceneFogUpdaterSpec(initial_value=0.0, final_value=0.1, step=0.05, interval=5.0)
    spec = tracking(final_value=0.01, child=fog, settling_time=3.0)
    world = ship()
    updaters = bind_updaters(spec, world)
    before = None
    waits = []
    for level in levels(spec):
        apply_level(updaters, level, last_level=before)
        waits.append(settling_time(spec, level, last_level=before))
        before = level
    assert len(world.put_backs) == 2
    assert waits == [3.0, 0.0, 0.0, 3.0, 0.0, 0.0]


def test_a_current_that_is_repeated_begins_anew_each_time() -> None:
    spec = RepeatSpec(iterations=2, interval=9.0, child=tracking(final_value=0.0))
    world = ship()
    updaters = bind_updaters(spec, world)
    first, second = levels(spec)
    apply_level(updaters, first)
    apply_level(updaters, second, last_level=first)
    assert len(world.put_backs) == 2


def forces(spec: CurrentForceUpdaterSpec, **other: object) -> list[WrenchStamped]:
    world = ship(**other)
    inbox = world.bus.inbox("currentForce", WrenchStamped)
    spec.bind(world).apply(0.2)
    world.advance(round(30.0 / world.timestep))
    assert world.current is None
    return inbox.take()


def test_as_a_force_it_is_published_100_times_a_second_and_moves_no_water() -> None:
    said = forces(tracking(publish_as_force=True))
    assert len(said) == 3000
    assert {message.header.frame_id for message in said} == {"Currents"}
    assert said[0].wrench.force.y == 0.0


def test_the_force_has_the_sign_of_the_current() -> None:
    spec = tracking(publish_as_force=True, random=0.0, force_variation=0.0)
    at_7_5_s = forces(spec)[749].wrench  # phi = +0.7
    v = 0.2 * np.sin(1.57) * np.array([-np.sin(0.7), np.cos(0.7)])
    assert at_7_5_s.force.x == pytest.approx(-410.0 * v[0] ** 2)
    assert at_7_5_s.force.y == pytest.approx(410.0 * v[1] ** 2)
    assert (at_7_5_s.torque.x, at_7_5_s.torque.y, at_7_5_s.torque.z) == (0.0, 0.0, 0.0)


def test_the_force_of_the_original_has_lost_its_sign() -> None:
    spec = tracking(publish_as_force=True)
    said = forces(spec, compatibility=frozenset({"current-force"}))
    assert min(message.wrench.force.x for message in said) == 0.0
    assert max(message.wrench.force.x for message in said) > 6.0


def test_one_second_of_levels_does_not_say_it_twice() -> None:
    world = ship()
    inbox = world.bus.inbox("currentForce", WrenchStamped)
    updater = tracking(publish_as_force=True).bind(world)
    updater.apply(0.1)
    updater.apply(0.2)
    world.advance(500)
    assert len(inbox.take()) == 100


def test_a_vehicle_that_is_not_there_is_an_error() -> None:
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        tracking(target="girona50").bind(ship())


def test_a_direction_cannot_turn_with_a_period_of_0() -> None:
    still = SphericalSpec(theta=0.0, phi=0.0)
    tracking(direction_variation=still, direction_period=still).bind(ship()).apply(0.1)
    with pytest.raises(BadSetting, match=r"<directionPeriod> has phi 0; expected .* >= 0\.01"):
        tracking(direction_period=still).bind(ship())
