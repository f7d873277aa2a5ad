"""Renaming and removing elements that others name."""

from __future__ import annotations

import pytest

from uwsim.editing import read_benchmark, read_scene
from uwsim.errors import BadSetting


def test_references_in_the_scene_and_its_benchmarks_follow_a_new_name() -> None:
    scene, benchmark = read_scene("visibility-scene"), read_benchmark("visibility")
    scene.rename("girona500/bowtech1", "front", benchmarks=[benchmark])
    scene.rename("blackbox", "recorder", benchmarks=[benchmark])
    assert scene.ros_interfaces[0].camera_name == "front"
    assert scene.camera.object_to_track == "recorder"
    truth = benchmark["corners"].ground_truth
    assert (truth.camera, truth.target) == ("front", "recorder")
    assert len(scene.check()) == len(read_scene("visibility-scene").check())
    assert not [item for item in benchmark.check(scene) if item.severity == "error"]


def test_routes_and_variations_follow_the_name_of_a_vehicle() -> None:
    scene = read_scene("grasp-scene")
    scene.add("uniform", path="vehicle[girona500].scaleFactor.x", low=0.5, high=1)
    benchmark = read_benchmark("grasp")
    scene.rename("girona500", "rov", benchmarks=[benchmark])
    assert "girona500" not in scene.to_xml().replace("/girona500/", "")
    assert scene.vary[-1].path == "vehicle[rov].scaleFactor.x"
    assert "<jaw>girona500" not in benchmark.to_xml()
    assert scene.checked_spec() == scene.spec


def test_a_part_that_two_vehicles_have_keeps_references_without_a_vehicle() -> None:
    scene = read_scene("visibility-scene")
    scene.copy("girona500", "second")
    scene.rename("second/bowtech1", "front")
    assert scene.ros_interfaces[0].camera_name == "bowtech1"
    assert scene["girona500/bowtech1"].spec == scene["second/front"].set(name="bowtech1").spec


def test_an_element_that_others_name_is_not_removed() -> None:
    scene = read_scene("visibility-scene")
    with pytest.raises(BadSetting, match=r"named by ros_interfaces\[1\]: camera_name"):
        scene.remove("girona500/bowtech1")
    scene.remove("girona500/bowtech1", with_references=True)
    assert len(scene.vehicle("girona500").parts) == len(scene.ros_interfaces) == 0
    with pytest.raises(BadSetting, match="named by camera: object_to_track"):
        scene.remove("blackbox", with_references=True)


def test_a_measure_is_renamed_in_the_score_and_nowhere_else() -> None:
    benchmark = read_benchmark("visibility")
    benchmark.rename("corners", "cornersTopic")
    assert benchmark.function.text == "cornersTopic+centroid"
    assert benchmark["cornersTopic"].target == "cornersTopic"
    with pytest.raises(BadSetting, match="named by function: text"):
        benchmark.remove("centroid")
    benchmark.remove("cornersFace")
    assert benchmark.measures.names == ["cornersTopic", "centroid", "centroidFace"]
    assert benchmark.checked_spec() == benchmark.spec
