"""u:waterUpdater: physical water that becomes more turbid, level by level."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.support.fakes import FakeBody, FakeStageWater, FakeWorld
from tests.support.short_trial import DATA, make_plan, rows_of, tank
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import (
    Level,
    SceneLightUpdaterSpec,
    WaterUpdaterSpec,
    apply_level,
    bind_updaters,
    blend,
    ramp_level,
)
from uwsim.bus import Node
from uwsim.checks.check import check_file
from uwsim.errors import BadSetting, UwsimError
from uwsim.optics import HenyeyGreenstein, Lamp, Medium, compute_full_field
from uwsim.optics.lamp_light import compute_lamp_veil, compute_target_radiance
from uwsim.runs.prepare import hash_inputs
from uwsim.scene.physical_water import PhysicalWaterSpec
from uwsim.scene.spec import SceneSpec
from uwsim.world import LineOfSight

MEDIUM = Medium(
    absorption=(0.4, 0.1, 0.05), scattering=(0.3, 0.3, 0.3), phase_function=HenyeyGreenstein(0.9)
)
SPEC = WaterUpdaterSpec(initial_value=0.5, final_value=2.0, step=0.5, interval=1.0)
UPDATER = """<u:waterUpdater {}> <initialValue>0.5</initialValue> <finalValue>1</finalValue>
<step>0.5</step> <interval>{}</interval> {} </u:waterUpdater>"""
SCENE = "visibility-physical-scene"


def water() -> SceneSpec:
    """Return a tank of physical water."""
    scene = tank()
    spec = PhysicalWaterSpec(law="physical", type="tank")
    return replace(scene, ocean_state=replace(scene.ocean_state, water=spec))


def stage_with(medium: Medium | None = MEDIUM, distance: float = 2.0) -> FakeWorld:
    """Return a stage with a vehicle at the origin and a box below it."""
    box = FakeBody((0.0, 0.0, -distance - 0.1), name="box")
    bodies = {"auv": FakeBody(name="auv"), "box": box}
    world = FakeWorld(bodies, vehicles=("auv",))
    world.water = FakeStageWater(medium)
    return world


def medium_at(spec: WaterUpdaterSpec, value: float, world: FakeWorld | None = None) -> Medium:
    """Return the medium that an updater sets for a value."""
    world = world or stage_with()
    spec.bind(world).apply(value)
    return world.water.settings[-1][0]


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def test_a_beam_attenuation_is_that_of_green_and_the_ratios_remain() -> None:
    medium = medium_at(SPEC, 1.2)
    assert medium.beam_attenuation[1] == pytest.approx(1.2)
    np.testing.assert_allclose(
        medium.single_scattering_albedo, MEDIUM.single_scattering_albedo, rtol=1e-12
    )
    np.testing.assert_allclose(medium.beam_attenuation / 3.0, MEDIUM.beam_attenuation)
    assert medium.phase_function == MEDIUM.phase_function


def test_attenuation_lengths_count_to_a_point_of_the_target() -> None:
    spec = replace(
        SPEC, quantity="attenuationLengths", from_="auv", target="box", point=(0.0, 0.0, 0.1)
    )
    assert medium_at(spec, 3.0).beam_attenuation[1] == pytest.approx(3.0 / 2.0)
    assert medium_at(spec, 3.0, stage_with(distance=6.0)).beam_attenuation[1] == pytest.approx(0.5)


def test_the_distance_is_that_at_the_beginning_of_the_level() -> None:
    spec = replace(SPEC, quantity="attenuationLengths", from_="auv", target="box")
    world = stage_with(distance=1.9)
    updater = spec.bind(world)
    updater.apply(1.0)
    box = world.bodies["box"]
    assert isinstance(box, FakeBody)
    box.move(0.0, 0.0, -4.0)
    updater.apply(1.0)
    media = [medium for medium, _ in world.water.settings[-2:]]
    assert [m.beam_attenuation[1] for m in media] == pytest.approx([1.0 / 2.0, 1.0 / 4.0])


def test_a_turbidity_is_scattering_by_a_stated_factor() -> None:
    spec = replace(SPEC, quantity="turbidity", scattering_per_ntu=0.6)
    medium = medium_at(spec, 2.0)
    assert medium.scattering[1] == pytest.approx(1.2)
    assert medium.beam_attenuation[1] == pytest.approx(1.2 * 4.0 / 3.0)


def test_a_scale_of_one_is_the_water_of_the_scene() -> None:
    spec = replace(SPEC, quantity="scale")
    assert medium_at(spec, 1.0) == MEDIUM
    assert medium_at(spec, 0.0).beam_attenuation.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("quantity", "column", "unit"),
    [
        ("beamAttenuation", "beamAttenuation", "1/m"),
        ("attenuationLengths", "attenuationLengths", "1"),
        ("turbidity", "turbidity", "NTU"),
        ("scale", "waterScale", "1"),
    ],
)
def test_the_column_states_quantity_and_unit(quantity: Any, column: str, unit: str) -> None:
    spec = replace(SPEC, quantity=quantity)
    assert (spec.parameter, spec.parameter_unit) == (column, unit)
    assert spec.values() == (0.5, 1.0, 1.5, 2.0)


def test_the_exposure_is_constant_or_set_for_the_target() -> None:
    world = stage_with()
    SPEC.bind(world)
    assert world.water.settings[-1][1] is None
    replace(SPEC, exposure="automatic", from_="auv", target="box").bind(world)
    sight = world.water.settings[-1][1]
    assert sight is not None
    assert sight.length == pytest.approx(2.1)


@pytest.mark.parametrize(
    ("medium", "quantity", "message"),
    [
        (None, "scale", "no physical water; expected <u:water"),
        (replace(MEDIUM, absorption=(1.0, 0.0, 0.0), scattering=(1.0, 0.0, 0.0)), "turbidity",
         "The scattering of the scene's water is 0 in green"),
        (replace(MEDIUM, absorption=(1.0, 0.0, 0.0), scattering=(1.0, 0.0, 0.0)),
         "beamAttenuation", "The beam attenuation of the scene's water is 0 in green"),
    ],
)  # fmt: skip
def test_water_that_cannot_be_scaled_is_an_error(
    medium: Medium | None, quantity: Any, message: str
) -> None:
    with pytest.raises(UwsimError, match=re.escape(message)):
        replace(SPEC, quantity=quantity).bind(stage_with(medium))


def test_a_target_at_the_camera_and_too_much_turbidity_are_errors() -> None:
    spec = replace(SPEC, quantity="attenuationLengths", from_="auv", target="box")
    with pytest.raises(BadSetting, match="'box' is 0 m from the camera"):
        spec.bind(stage_with(distance=-0.1))
    with pytest.raises(BadSetting) as error:
        replace(SPEC, quantity="scale", final_value=1000.0, step=999.5).bind(
            stage_with(replace(MEDIUM, absorption=(2.0, 0.1, 3.0), scattering=(1.5, 0.1, 0.1)))
        )
    assert str(error.value) == (
        "At waterScale 1000 the water has an absorption of 2000 1/m in red, 3000 1/m in blue, "
        "a scattering of 1500 1/m in red; expected at most 1000 1/m."
    )


@pytest.mark.parametrize(
    ("attributes", "children", "message"),
    [
        ('u:quantity="attenuationLengths"', "",
         "u:quantity='attenuationLengths' needs <target>, and one of <camera> and <from>"),
        ('u:exposure="automatic"', "<target>girona500</target>",
         "u:exposure='automatic' needs <target>, and one of <camera> and <from>"),
        ("", "<camera>bowtech1</camera>", "<camera> has no effect; expected"),
        ("", "<target>girona500</target>", "<target> has no effect; expected"),
        ('u:quantity="fog"', "", "expected one of 'beamAttenuation', 'attenuationLengths'"),
        ("", "<scatteringPerNtu>0</scatteringPerNtu>", "expected a number > 0"),
    ],
)  # fmt: skip
def test_an_element_that_does_not_make_sense_is_an_error(
    tmp_path: Path, attributes: str, children: str, message: str
) -> None:
    with pytest.raises(UwsimError) as error:
        make_plan(tmp_path, Idle, UPDATER.format(attributes, 1, children), scene=water())
    assert message in str(error.value).replace('"', "'")


def test_unknown_names_and_a_scene_with_fog_are_errors_before_the_run(tmp_path: Path) -> None:
    names = "<camera>bowtech</camera> <target>blackbax</target>"
    make_plan(tmp_path, Idle, UPDATER.format('u:quantity="attenuationLengths"', 1, names))
    found = check_file(tmp_path / "benchmark.xml", scene=DATA / "scenes" / f"{SCENE}.xml")
    text = "\n".join(str(each) for each in found)
    assert "bowtech1" in text
    assert "blackbox" in text
    plan = make_plan(tmp_path, Idle, UPDATER.format("", 1, ""))
    with pytest.raises(UwsimError, match=r"benchmark.xml:3: .*no physical water"):
        hash_inputs(plan)


def test_fog_in_physical_water_is_an_error_before_the_run(tmp_path: Path) -> None:
    fog = """<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>1</finalValue>
    <step>0.5</step> <interval>1</interval> </sceneFogUpdater>"""
    plan = make_plan(tmp_path, Idle, fog, scene=water())
    (found,) = check_file(tmp_path / "benchmark.xml", scene=DATA / "scenes" / f"{SCENE}.xml")
    message = "The scene has physical water, in which fog has no effect; expected <u:waterUpdater>"
    assert (found.severity, found.line) == ("error", 3)
    assert found.message.startswith(message)
    with pytest.raises(UwsimError, match=r"benchmark.xml:3: The scene has physical water"):
        hash_inputs(plan)


@pytest.mark.parametrize("mode", ["sequential", "independent"])
def test_rows_state_the_quantity(tmp_path: Path, mode: Any) -> None:
    plan = make_plan(tmp_path, Idle, UPDATER.format("", 0.1, ""), scene=water(), mode=mode)
    rows = rows_of(plan)
    assert [row.values for row in rows] == [
        (("beamAttenuation", 0.5),),
        (("beamAttenuation", 1.0),),
    ]
    assert {row.status for row in rows} == {"ok"}


def test_the_state_has_the_water_and_an_independent_level_approaches_it() -> None:
    with uwsim.load(SCENE) as simulation:
        scenery = simulation.world.scenery
        model_medium = simulation.world.model.optical_water
        updaters = bind_updaters(SPEC, simulation.world.stage_view)
        level = Level((("beamAttenuation", 2.0),))
        exposures = set()
        for fraction, attenuation in ((0.0, 0.5), (0.5, 1.25), (1.0, 2.0)):
            ramp_level(updaters, blend(SPEC, level, fraction))
            physical_water = scenery.state.water.physical_water
            assert physical_water is not None
            assert physical_water.beam_attenuation[1] == pytest.approx(attenuation)
            exposures.add(physical_water.exposure)
        assert len(exposures) == 1
        assert simulation.world.model.optical_water is model_medium


def test_nested_in_light_both_are_set() -> None:
    light = SceneLightUpdaterSpec(
        initial_value=0.5, final_value=1.0, step=0.5, interval=1.0, child=SPEC
    )
    with uwsim.load(SCENE) as simulation:
        updaters = bind_updaters(light, simulation.world.stage_view)
        apply_level(updaters, Level((("light", 0.5), ("beamAttenuation", 1.5))))
        state = simulation.world.scenery.state
        assert state.light.rate == 0.5
        assert state.water.physical_water is not None
        assert state.water.physical_water.beam_attenuation[1] == pytest.approx(1.5)


def bind_bundled(simulation: uwsim.Simulation) -> tuple[Any, LineOfSight]:
    """Bind the updater of the bundled benchmark; return it and its line of sight."""
    spec = read_benchmark(DATA / "benchmarks" / "visibility-physical.xml").scene_updater
    assert isinstance(spec, WaterUpdaterSpec)
    stage = simulation.world.stage_view
    box = stage.world.body("blackbox").world_from_body
    point = box.transform(np.array([spec.point]))[0]
    camera = stage.world.camera("bowtech1").world_from_camera.position
    return spec.bind(stage), LineOfSight(camera=camera, point=point)


def test_automatic_exposure_by_a_lamp_counts_signal_and_veil() -> None:
    with uwsim.load(SCENE, settings={"xacro.lamp": "0.5"}) as simulation:
        updater, sight = bind_bundled(simulation)
        updater.apply(2.0)
        physical_water = simulation.world.scenery.state.water.physical_water
        assert physical_water is not None
        mounted = simulation.world.scenery.mounted_lamps[0]
        spec, pose = mounted.spec, mounted.world_from_lamp
        axis = pose.rotation @ np.array([0.0, 0.0, -1.0])
        lamp = Lamp(
            position=tuple(pose.position.tolist()),
            direction=tuple(axis.tolist()),
            intensity=(spec.intensity,) * 3,
            half_angle=np.radians(spec.fov / 2.0),
            softness=spec.softness,
        )
        ray = (sight.point - sight.camera) / sight.length
        camera = sight.camera.tolist()
        signal = compute_target_radiance(
            physical_water.medium, lamp, sight.point[None], -ray[None], camera
        )
        veil = compute_lamp_veil(
            physical_water.medium, lamp, camera, ray[None], np.array([sight.length])
        )
        board = physical_water.exposure * np.pi * (signal + veil)
        assert board.max() == pytest.approx(0.7, rel=1e-6)
        assert (veil > 0.0).all()


def test_automatic_exposure_by_day_shows_a_board_at_070_in_clear_water() -> None:
    with uwsim.load(SCENE) as simulation:
        updater, sight = bind_bundled(simulation)
        updater.apply(1e-6)
        physical_water = simulation.world.scenery.state.water.physical_water
        assert physical_water is not None
        assert compute_full_field(physical_water.medium, sight.length) == pytest.approx(1.0)
        # A level board receives 1 - Fresnel of the irradiance 1; this one leans by 24 degrees.
        assert 0.7 <= physical_water.exposure < 1.0


def test_turbid_images_do_not_become_dark_with_automatic_exposure() -> None:
    with uwsim.load(SCENE) as simulation:
        updater, _ = bind_bundled(simulation)
        camera = simulation.world.sensors.camera("bowtech1")
        means, contrasts = [], []
        for n in (0.5, 2.0, 4.0):
            updater.apply(n)
            box = camera.capture()[150:175, 210:295].astype(float)
            means.append(box.mean())
            contrasts.append(np.diff(box, axis=1).std())
        assert 60.0 < min(means) < max(means) < 200.0
        assert contrasts[0] > contrasts[1] > contrasts[2]
