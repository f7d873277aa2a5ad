"""Elements: values are checked when they are set, and errors name the nearest valid name."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from uwsim.editing import Benchmark, Scene, read_benchmark, read_scene
from uwsim.errors import BadSetting, UnknownName
from uwsim.scene import ObjectSpec, VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec

CAMERA = "girona500/bowtech1"


@pytest.fixture
def scene() -> Scene:
    return read_scene("visibility-scene")


def test_a_value_is_read_and_set_by_attribute(scene: Scene) -> None:
    scene[CAMERA].resw = 640
    assert scene.find(CAMERA, VirtualCameraSpec).spec.resw == 640
    assert scene.vehicle("girona500").spec.parts[0].resw == 640  # type: ignore[attr-defined]


def test_a_spec_that_was_read_does_not_change(scene: Scene) -> None:
    before = scene.spec
    scene[CAMERA].resw = 640
    scene.remove("terrain")
    assert before == read_scene("visibility-scene").spec


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("resw", -3, "resw is -3; expected a whole number >= 1"),
        ("resw", 640.5, "expected a whole number"),
        ("resw", True, "resw is True; expected a whole number"),
        ("fovy", "50", "fovy is '50'; expected a number > 0 and < 180 [deg]"),
        ("std", float("nan"), "std is 'nan'; expected a number"),
        ("position", (1, 2), "expected three numbers"),
        ("position", 5, "expected three numbers"),
        ("name", 5, "name is 5; expected text"),
        ("name", "a\0b", "expected text"),
        ("relative_to", None, "relative_to is None; expected text"),
        ("reswidth", 1, "has no 'reswidth'"),
        ("relativeTo", "part1", "Did you mean 'relative_to'?"),
    ],
)
def test_an_invalid_value_is_one_line_with_the_path_and_the_expectation(
    scene: Scene, name: str, value: Any, message: str
) -> None:
    before = scene.spec
    with pytest.raises(BadSetting) as caught:
        setattr(scene[CAMERA], name, value)
    assert str(caught.value).startswith(CAMERA)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
    assert scene.spec == before


def test_none_of_several_values_is_set_if_one_is_invalid(scene: Scene) -> None:
    with pytest.raises(BadSetting):
        scene[CAMERA].set(resw=100, resh=0)
    assert scene[CAMERA].resw == 320


def test_numbers_of_numpy_are_values(scene: Scene) -> None:
    scene[CAMERA].set(position=np.array([1, 2, 3]), resw=np.int64(64), fovy=np.float32(60))
    assert scene[CAMERA].position == (1.0, 2.0, 3.0)
    assert type(scene[CAMERA].resw) is int
    assert type(scene[CAMERA].fovy) is float


def test_an_unknown_path_names_the_nearest(scene: Scene) -> None:
    with pytest.raises(UnknownName, match="Did you mean 'bowtech1'"):
        scene["girona500/bowtech"]
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        scene["girona50"]


def test_an_element_of_another_kind_is_refused(scene: Scene) -> None:
    with pytest.raises(BadSetting, match="blackbox is a ObjectSpec, not a VehicleSpec"):
        scene.vehicle("blackbox")


def test_a_scene_from_nothing() -> None:
    scene = Scene()
    vehicle = scene.add("vehicle", name="rov", file="bluerov2_heavy.urdf")
    camera = vehicle.add("virtualCamera", name="front", relative_to="base_link", resw=64)
    box = scene.add(ObjectSpec(name="box", file="box.obj"))
    scene.ocean_state.fog.density = 0.3
    assert [camera.label, box.label] == ["rov/front", "box"]
    assert scene.checked_spec() == scene.spec
    assert scene.spec.ocean_state.fog.density == 0.3


def test_added_elements_need_their_values() -> None:
    with pytest.raises(BadSetting, match=r"vehicle lacks file\."):
        Scene().add("vehicle", name="rov")
    with pytest.raises(BadSetting, match="Did you mean 'file'"):
        Scene().add("vehicle", name="rov", fil="x")
    with pytest.raises(UnknownName, match="Did you mean 'vehicle'"):
        Scene().add("vehicel", name="rov")


def test_names_are_unique(scene: Scene) -> None:
    with pytest.raises(BadSetting, match="'blackbox' already"):
        scene.add("object", name="blackbox", file="box.obj")
    with pytest.raises(BadSetting, match="'terrain' already"):
        scene.rename("blackbox", "terrain")


def test_an_object_does_not_have_the_name_of_a_vehicle(scene: Scene) -> None:
    with pytest.raises(BadSetting, match="'girona500' already; names are unique"):
        scene.add("object", name="girona500", file="box.obj")


def test_a_removed_element_is_not_changed(scene: Scene) -> None:
    camera = scene[CAMERA]
    box = scene["blackbox"]
    scene.objects.remove("blackbox")
    with pytest.raises(BadSetting, match="The Object 'blackbox' was removed from the scene"):
        box.position = (0, 0, 1)
    scene.vehicles.remove("girona500")
    with pytest.raises(BadSetting, match="'girona500' was removed from the scene"):
        camera.resw = 640


def test_an_attribute_is_not_deleted(scene: Scene) -> None:
    with pytest.raises(BadSetting, match="blackbox: name cannot be deleted"):
        del scene["blackbox"].name
    with pytest.raises(AttributeError, match="Did you mean 'name'"):
        del scene["blackbox"].nam


def test_a_text_in_place_of_an_element_names_its_attribute() -> None:
    with pytest.raises(BadSetting, match=r"A text is set as function\.text"):
        Benchmark().function = "offset"  # type: ignore[assignment]


def test_an_element_stays_valid_when_others_are_removed(scene: Scene) -> None:
    box = scene["blackbox"]
    scene.remove("terrain")
    box.position = (0, 0, 1)
    assert scene.spec.objects[0].position == (0.0, 0.0, 1.0)
    assert box.label == "blackbox"


def test_parts_are_in_the_order_of_a_file(scene: Scene) -> None:
    vehicle = scene.vehicle("girona500")
    vehicle.add("imu", name="imu", relative_to="part0")
    vehicle.add("virtualCamera", name="second", relative_to="part0")
    kinds = [type(part).__name__ for part in vehicle.spec.parts]
    assert kinds == ["VirtualCameraSpec", "VirtualCameraSpec", "ImuSpec"]
    assert scene.checked_spec() == scene.spec


def test_a_spec_can_be_replaced_as_a_whole(scene: Scene) -> None:
    vehicle = scene.vehicle("girona500")
    vehicle.spec = replace(vehicle.spec, position=(0.0, 1.0, 2.0))
    scene.objects = (ObjectSpec(name="box", file="box.obj"),)
    assert scene.spec.vehicles[0].position == (0.0, 1.0, 2.0)
    assert scene.objects.names == ["box"]
    with pytest.raises(BadSetting, match="expected a VehicleSpec"):
        vehicle.spec = scene.spec.objects[0]  # type: ignore[assignment]
    with pytest.raises(BadSetting, match="vehicles is 5; expected a list of specs"):
        scene.vehicles = 5


def test_attributes_are_listed_for_completion(scene: Scene) -> None:
    assert {"resw", "fovy", "response", "set", "spec"} <= set(dir(scene[CAMERA]))
    assert not hasattr(scene[CAMERA], "resolution")


def test_equal_contents_are_equal(scene: Scene) -> None:
    other = read_scene("visibility-scene")
    assert scene == other
    other[CAMERA].std = 0.5
    assert scene != other


def test_updaters_are_nested_in_the_order_of_their_addition() -> None:
    benchmark = Benchmark()
    benchmark.add("sceneFogUpdater", initial_value=0, final_value=1, step=1, interval=1)
    benchmark.add("sceneLightUpdater", initial_value=0, final_value=1, step=1, interval=1)
    benchmark.add("time", name="duration")
    benchmark.function.text = "duration"
    outer = benchmark.spec.scene_updater
    assert [outer.parameter, outer.child and outer.child.parameter] == ["fog", "light"]
    assert benchmark.checked_spec() == benchmark.spec


def test_a_trigger_is_set_by_attribute() -> None:
    benchmark = read_benchmark("visibility")
    benchmark["corners"].start_on = benchmark.start_on
    assert benchmark["corners"].start_on.target == "startBench"
    with pytest.raises(BadSetting, match="may be start_on or stop_on"):
        benchmark["corners"].add("onInit")
    with pytest.raises(BadSetting, match="expected one of"):
        benchmark.start_on = VehicleSpec(name="a", file="b")
