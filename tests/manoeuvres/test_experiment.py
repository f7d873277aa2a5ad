"""A vehicle in an experiment: alone, in still water, with steering from its hydrodynamics."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from uwsim.algorithms.manoeuvres import ZigZagNode
from uwsim.assets.bundled import bundled_files
from uwsim.errors import BadSetting, UnknownName
from uwsim.manoeuvres.experiment import make_experiment, trim_vehicle
from uwsim.manoeuvres.report.document import track_text
from uwsim.manoeuvres.run import run_manoeuvre
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec


def scene(name: str) -> SceneSpec:
    return read_scene(bundled_files("scenes")[name])


def test_the_fins_of_the_remus_are_found_as_rudders_and_elevators() -> None:
    experiment = make_experiment(scene("remus-scene"))
    parameters = experiment.parameters
    assert parameters["rudders"] == "-1 -1 0 0"
    assert parameters["elevators"] == "0 0 -1 -1"
    assert parameters["limit"] == pytest.approx(math.degrees(0.237))
    assert parameters["ahead"] == pytest.approx(3.86)
    assert experiment.is_steered_by_fins
    assert experiment.length == pytest.approx(1.33)


def test_thrusters_steer_a_vehicle_without_fins() -> None:
    experiment = make_experiment(scene("bluerov2-scene"))
    # four thrusters of 30.4 N at 45 degrees: half of the surge force; the rest turns. The curve
    # has its greatest thrust, 30.6 N, just below full command
    ahead = 0.5 * 4.0 * 30.4 * math.sqrt(0.5)
    assert experiment.parameters["ahead"] == pytest.approx(ahead, rel=0.01)
    moment = 0.5 * 4.0 * 30.4 * math.sqrt(0.5) * (0.156 + 0.111)
    hard_over = float(experiment.parameters["yaw_moment"]) * math.radians(35.0)
    assert hard_over == pytest.approx(moment, rel=0.02)
    assert not experiment.is_steered_by_fins


def test_objects_currents_and_sensors_are_left_out() -> None:
    source = scene("remus-scene")
    model = make_experiment(source).model
    assert source.objects
    assert model.scene.objects == ()
    assert model.scene.vehicles[0].parts == ()
    assert model.scene.ocean_state.density == source.ocean_state.density


def test_a_trimmed_vehicle_is_neutrally_buoyant() -> None:
    trimmed = trim_vehicle(make_experiment(scene("remus-scene")))
    body = trimmed.hydrodynamics.body("base_link")
    assert body is not None
    assert 1030.0 * body.volume == pytest.approx(30.479, rel=1e-9)


def test_a_manoeuvre_has_the_same_bytes_twice() -> None:
    experiment = make_experiment(scene("bluerov2-scene"))
    texts = [
        track_text(run_manoeuvre(experiment, ZigZagNode(), {}, time_limit=60.0).track)
        for _ in range(2)
    ]
    assert texts[0] == texts[1]


def test_a_vehicle_without_dynamics_is_refused() -> None:
    source = scene("remus-scene")
    kinematic = replace(source.vehicles[0], dynamics=None)
    with pytest.raises(BadSetting, match="no vehicle with <u:dynamics>"):
        make_experiment(replace(source, vehicles=(kinematic,)))


def test_an_unknown_vehicle_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(UnknownName, match="remus"):
        make_experiment(scene("remus-scene"), vehicle="remuss")
