"""Scene updaters: how many levels, which values, in which order."""

from __future__ import annotations

import pytest

from tests.support.fakes import FakeWorld
from uwsim.benchmark.updaters import (
    ArmMoveUpdaterSpec,
    BagFogUpdaterSpec,
    CameraNoiseUpdaterSpec,
    CurrentForceUpdaterSpec,
    NoneSpec,
    RepeatSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SphericalSpec,
    apply_level,
    bind_updaters,
    blend,
    initial_level,
    interval,
    levels,
    n_levels,
    sweep_values,
    swept_parameters,
)
from uwsim.errors import BadSetting, UnknownName


def fog(first: float, last: float, step: float, **other: object) -> SceneFogUpdaterSpec:
    return SceneFogUpdaterSpec(
        initial_value=first, final_value=last, step=step, interval=2.0, **other
    )  # type: ignore[arg-type]


def light(first: float, last: float, step: float, **other: object) -> SceneLightUpdaterSpec:
    return SceneLightUpdaterSpec(
        initial_value=first, final_value=last, step=step, interval=20.0, **other
    )  # type: ignore[arg-type]


def current(first: float, last: float, step: float) -> CurrentForceUpdaterSpec:
    return CurrentForceUpdaterSpec(
        initial_value=first,
        final_value=last,
        spherical_direction=SphericalSpec(theta=1.57, phi=0.0),
        force_variation=0.0,
        force_period=4.0,
        direction_variation=SphericalSpec(theta=0.0, phi=0.0),
        direction_period=SphericalSpec(theta=4.0, phi=30.0),
        random=0.0,
        step=step,
        interval=120.0,
        target="girona500",
    )


def test_the_files_of_the_original_have_as_many_levels_as_it_plays() -> None:
    assert n_levels(fog(0.0, 1.3, 0.05)) == 27
    assert n_levels(fog(0.0, 2.0, 0.05)) == 41
    assert n_levels(current(0.0, 0.2, 0.01)) == 20
    assert n_levels(current(0.0, 0.4, 0.025)) == 16
    assert n_levels(light(0.0, 1.02, 0.05)) == 21
    assert n_levels(current(0.05, 0.05, 0.02)) == 1


def test_fog_over_a_recording_is_counted_like_fog() -> None:
    bag = BagFogUpdaterSpec(
        initial_value=0.0, final_value=1.3, step=0.05, interval=2.0,
        bag="a.bag", image_topic="i", info_topic="c", image_depth=2.0,
    )  # fmt: skip
    assert bag.values() == fog(0.0, 1.3, 0.05).values()


def test_counting_in_single_precision_is_what_plays_the_last_fog() -> None:
    assert len(sweep_values(0.0, 1.3, 0.05, uses_float32=True)) == 27
    assert len(sweep_values(0.0, 1.3, 0.05)) == 26


def test_values_are_multiples_of_the_step_and_not_a_drifting_sum() -> None:
    values = fog(0.0, 1.3, 0.05).values()
    assert values == tuple(0.05 * i for i in range(27))
    assert values[26] == 1.3


@pytest.mark.parametrize("step", [0.0, -0.1, 1e-12])
def test_a_sweep_that_never_ends_is_refused(step: float) -> None:
    with pytest.raises(BadSetting, match="more than 100000 levels"):
        sweep_values(0.0, 1.3, step, uses_float32=True)


def test_none_is_one_level_called_1_that_lasts_until_stop_on() -> None:
    assert [level.values for level in levels(NoneSpec())] == [(("none", 1.0),)]
    assert interval(NoneSpec()) is None


def test_repeat_counts_its_iterations_from_0() -> None:
    spec = RepeatSpec(iterations=3, interval=60.0)
    assert spec.values() == (0.0, 1.0, 2.0)
    assert swept_parameters(spec) == ("iteration",)


def test_nested_updaters_give_all_pairs_and_the_inner_one_steps_first() -> None:
    spec = light(0.0, 0.4, 0.3, child=fog(0.0, 0.2, 0.1))
    pairs = [level.values for level in levels(spec)]
    assert [(a, b) for (_, a), (_, b) in pairs] == [
        (0.0, 0.0), (0.0, 0.1), (0.0, 0.2), (0.3, 0.0), (0.3, 0.1), (0.3, 0.2),
    ]  # fmt: skip
    assert swept_parameters(spec) == ("light", "fog")


def test_the_deepest_updater_decides_how_long_a_level_lasts() -> None:
    assert interval(light(0.0, 0.4, 0.3, child=fog(0.0, 0.2, 0.1))) == 2.0
    assert interval(fog(0.0, 0.2, 0.1, child=light(0.0, 0.4, 0.3))) == 20.0


def test_none_nested_in_another_updater_changes_nothing() -> None:
    spec = fog(0.0, 0.2, 0.1, child=NoneSpec())
    assert interval(spec) == 2.0
    assert swept_parameters(spec) == ("fog",)


def test_two_updaters_of_one_kind_have_two_columns() -> None:
    spec = RepeatSpec(iterations=2, interval=1.0, child=RepeatSpec(iterations=2, interval=1.0))
    assert swept_parameters(spec) == ("iteration", "iteration_2")


def test_an_arm_takes_its_positions_with_evenly_spaced_ones_between() -> None:
    spec = ArmMoveUpdaterSpec(
        arm_position=((0.0, 1.0), (3.0, 1.0), (3.0, 4.0)), step=2, interval=1.0, target="g500"
    )
    assert spec.values() == tuple(float(i) for i in range(7))
    assert [spec.joints(i).tolist() for i in range(7)] == [
        pytest.approx(v) for v in ([0, 1], [1, 1], [2, 1], [3, 1], [3, 2], [3, 3], [3, 4])
    ]


def test_applying_a_level_calls_every_setter() -> None:
    world = FakeWorld(vehicles=("g500",))
    spec = ArmMoveUpdaterSpec(
        arm_position=((0.0, 0.5), (1.0, 0.7)), step=0, interval=1.0, target="g500",
        child=light(0.5, 0.5, 0.1, child=CameraNoiseUpdaterSpec(
            initial_value=0.02, final_value=0.02, step=1.0, interval=1.0,
            child=fog(0.3, 0.3, 0.1),
        )),
    )  # fmt: skip
    apply_level(bind_updaters(spec, world), levels(spec)[1])
    assert world.joints == {"g500": {0: 1.0, 1: 0.7}}
    assert (world.light_rate, world.camera_noise, world.fog) == (0.5, 0.02, 0.3)


def test_a_ramp_leads_from_the_initial_values_to_those_of_the_level() -> None:
    spec = fog(0.1, 0.5, 0.2)
    level = levels(spec)[2]
    assert blend(spec, level, 0.0) == initial_level(spec)
    assert blend(spec, level, 0.25).values == (("fog", pytest.approx(0.2)),)
    assert blend(spec, level, 1.0) == level


def test_there_is_no_ramp_between_iterations() -> None:
    spec = RepeatSpec(iterations=3, interval=1.0)
    assert blend(spec, levels(spec)[2], 0.0) == levels(spec)[2]


def test_an_arm_of_a_vehicle_that_is_not_there_is_an_error() -> None:
    spec = ArmMoveUpdaterSpec(arm_position=((0.0,),), step=0, interval=1.0, target="g50")
    with pytest.raises(UnknownName, match="Did you mean 'g500'"):
        spec.bind(FakeWorld(vehicles=("g500",)))
