"""What is seen and touched of robots: every shape, in its colour, wherever its file says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import begin, joint, scene_of, shape, write_robot
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.cameras.exposure import PlainExposure
from uwsim.model.parts import visual_model
from uwsim.rendering.renderer import RenderedImage
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.urdf.robot import VisualSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.simulation import Simulation


@pytest.mark.parametrize(
    ("kind", "extent"),
    [("box", (1.0, 2.0, 3.0)), ("cylinder", (0.4, 0.4, 3.0)), ("sphere", (0.5, 0.5, 0.5))],
)
def test_a_shape_of_a_urdf_is_as_large_as_the_urdf_says(
    kind: str, extent: tuple[float, float, float]
) -> None:
    box = visual_model(VisualSpec(kind=kind, size=extent), Path(), ())[0].box
    assert np.subtract(box.upper, box.lower) == pytest.approx(extent, rel=0.02)


AHEAD = Pose.from_rpy((0.0, 0.0, 0.0), (np.pi / 2, 0.0, -np.pi / 2))  # looks along x, z up
LENS = Intrinsics.from_fovy(80, 60, 0.9)


def seen(folder: Path, inside: str) -> tuple[Simulation, RenderedImage]:
    """A robot 3 m ahead, and the image of it."""
    vehicle = VehicleSpec(name="r", file=str(write_robot(folder, inside)), position=(3.0, 0.0, 0.0))
    simulation = begin(scene_of(vehicle))
    image = simulation.world.scenery.render_clean(AHEAD, LENS)
    simulation.close()
    return simulation, image


def colour_at(image: RenderedImage, column: int) -> np.ndarray:
    assert image.colour is not None
    return image.colour[30, column].astype(float)


def test_every_visual_of_a_link_is_seen_under_the_links_number(tmp_path: Path) -> None:
    left = shape(xyz="0 0.8 0", size=(0.1, 0.8, 0.8), colour="1 0 0 1")
    right = shape(xyz="0 -0.8 0", size=(0.1, 0.8, 0.8), colour="0 0 1 1")
    simulation, image = seen(tmp_path, f'<link name="base">{left}{right}</link>')
    assert image.ids is not None
    assert (image.ids[30, [20, 60]] == 1).all()
    assert image.ids[30, 40] == 0
    assert simulation.world.scenery.part_names == {1: "r/base"}
    red, blue = colour_at(image, 20), colour_at(image, 60)
    assert red[0] > red[2] + 40
    assert blue[2] > blue[0] + 40


def test_every_collision_of_a_link_is_touched(tmp_path: Path) -> None:
    near = shape("collision", xyz="0 0 0")
    far = shape("collision", xyz="1 0 0", size=(0.2, 0.2, 0.2))
    file = write_robot(tmp_path, f'<link name="base">{near}{far}</link>')
    wall = ObjectSpec(
        name="wall",
        file="objects/blackbox",
        position=(1.0, 0.0, 0.0),
        physics=PhysicsSpec(mass=0.0),
    )
    simulation = begin(
        scene_of(VehicleSpec(name="r", file=str(file)), objects=(wall,)), is_blind=True
    )
    assert {contact.other for contact in simulation.world.contacts.find("r")} == {"wall"}


def test_the_box_of_a_links_visual_frame_holds_all_that_is_seen_of_it(tmp_path: Path) -> None:
    first = shape(xyz="1 0 0", rpy="0 0 1.5707963267948966", size=(0.2, 0.2, 0.2))
    second = shape(xyz="1 2 0", size=(0.2, 0.2, 0.2))
    simulation, _ = seen(tmp_path, f'<link name="base">{first}{second}</link>')
    box = simulation.world.bodies.find("base@visual").box
    assert box is not None
    assert box.lower == pytest.approx((-0.1, -0.1, -0.1))
    assert box.upper == pytest.approx((2.1, 0.1, 0.1))  # y of the link is x of the visual


def stl(folder: Path) -> str:
    """A cube of 1000 in a file without any colour; the name of the file."""
    import trimesh

    trimesh.creation.box((1000.0, 1000.0, 1000.0)).export(folder / "cube.stl")
    return "cube.stl"


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_the_material_of_a_robot_file_colours_a_mesh_without_colours(
    opacity: float, tmp_path: Path
) -> None:
    mesh = (
        f'<visual><geometry><mesh filename="{stl(tmp_path)}" scale="0.001 0.001 0.001"/>'
        '</geometry><material name="orange"/></visual>'
    )
    material = f'<material name="orange"><color rgba="1 0.5 0 {opacity}"/></material>'
    _, image = seen(tmp_path, f'{material}<link name="base">{mesh}</link>')
    red, green, blue = colour_at(image, 40)
    assert red > 60 * opacity  # it is lit from the side
    assert green == pytest.approx(0.5 * red, abs=15)
    assert blue < 30


def test_a_mesh_in_millimetres_that_is_nowhere_is_a_box_that_can_be_seen(tmp_path: Path) -> None:
    lost = (
        '<visual><geometry><mesh filename="package://gone/hull.dae" scale="0.001 0.001 0.001"/>'
        "</geometry></visual>"
    )
    _, image = seen(tmp_path, f'<link name="base">{lost}</link>')
    assert image.ids is not None
    assert np.count_nonzero(image.ids) > 20


def test_shapes_without_thickness_are_drawn_thin(tmp_path: Path) -> None:
    flat = shape(size=(0.0, 1.0, 1.0))
    point = '<visual><geometry><sphere radius="0"/></geometry></visual>'
    rod = '<visual><geometry><cylinder radius="0" length="1"/></geometry></visual>'
    _, image = seen(tmp_path, f'<link name="base">{flat}{point}{rod}</link>')
    assert image.ids is not None
    assert image.ids[30, 40] == 1


def test_two_vehicles_of_one_name_carry_their_own_cameras(tmp_path: Path) -> None:
    file = str(write_robot(tmp_path, '<link name="base"/>'))
    twins = tuple(
        VehicleSpec(
            name="twin",
            file=file,
            position=(x, 0.0, 0.0),
            parts=(VirtualCameraSpec(name=f"eye{x}", relative_to="base"),),
        )
        for x in (1.0, 5.0)
    )
    simulation = begin(scene_of(twins[0], vehicles=twins), is_blind=True)
    for x in (1.0, 5.0):
        assert simulation.world.sensors.camera(f"eye{x}").world_from_camera.position[0] == x


def test_a_camera_that_looks_at_an_object_has_it_in_the_middle_of_its_image(
    tmp_path: Path,
) -> None:
    file = str(write_robot(tmp_path, '<link name="base"/>'))
    eye = VirtualCameraSpec(
        name="eye", relative_to="base", position=(0.3, 0.1, 0.2), look_at=(4.0, 3.0, -2.0), std=0.0
    )
    vehicle = VehicleSpec(
        name="r", file=file, orientation=(0.4, 0.3, 0.2), scale_factor=(2.0,) * 3,
        parts=(eye,),
    )  # fmt: skip
    thing = ObjectSpec(name="thing", file="objects/blackbox", position=(4.0, 3.0, -2.0))
    simulation = begin(scene_of(vehicle, objects=(thing,)))
    camera = simulation.world.sensors.camera("eye")
    image = simulation.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics)
    simulation.close()
    assert image.ids is not None
    assert simulation.world.scenery.part_names[int(image.ids[60, 80])] == "thing"


@pytest.mark.parametrize(
    ("is_original", "sun_shadow", "is_shaded"),
    [(False, None, True), (True, None, False), (True, True, True), (False, False, False)],
)
def test_scenes_of_the_original_have_no_sun_shadows_unless_they_ask_for_them(
    is_original: bool, sun_shadow: bool | None, is_shaded: bool, tmp_path: Path
) -> None:
    lid = shape(size=(0.3, 0.3, 0.05), xyz="0 0 0.5")
    plate = shape(size=(20.0, 20.0, 0.05), xyz="0 0 -0.5")
    links = f'<link name="base">{plate}</link><link name="lid">{lid}</link>'
    file = str(write_robot(tmp_path, links + joint("j", "base lid")))
    scene = scene_of(VehicleSpec(name="r", file=file), is_original=is_original)
    asked = replace(scene.sim_params, sun_shadow=sun_shadow)
    simulation = begin(replace(scene, sim_params=asked))
    from_above = Pose.from_rpy((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    image = simulation.world.scenery.render_clean(from_above, Intrinsics.from_fovy(160, 120, 0.6))
    simulation.close()
    assert image.colour is not None
    brightness = image.colour.sum(axis=2).astype(int)
    assert bool((brightness < 0.7 * np.median(brightness)).sum() > 20) is is_shaded


def test_no_shape_of_a_urdf_is_an_input_without_a_hash(tmp_path: Path) -> None:
    simulation, _ = seen(tmp_path, f'<link name="base">{shape()}</link>')
    assert simulation.world.scenery.generated_hashes == {}


@pytest.mark.parametrize("std", [0.0, 0.02])
@pytest.mark.parametrize("is_polished", [False, True])
def test_labels_drawn_with_the_colours_are_those_drawn_alone(
    tmp_path: Path, std: float, is_polished: bool
) -> None:
    box = shape(xyz="0 0.3 0", size=(0.5, 0.8, 0.8), colour="1 0 0 1")
    robot = write_robot(tmp_path, f'<link name="base">{box}</link>')
    simulation = begin(scene_of(VehicleSpec(name="r", file=str(robot), position=(3.0, 0.0, 0.0))))
    scenery = simulation.world.scenery

    def exposure() -> PlainExposure:
        return PlainExposure(
            world_from_camera=AHEAD,
            intrinsics=LENS,
            std=std,
            rng=np.random.default_rng(1),
            is_grey=False,
            is_polished=is_polished,
        )

    pixels, image = scenery.render_labelled(exposure())
    alone = scenery.render_clean(AHEAD, LENS, targets={"ids", "range"})
    assert np.array_equal(pixels, scenery.render(exposure()))
    assert image.ids is not None
    assert set(np.unique(image.ids)) == {0, 1}
    assert np.array_equal(image.ids, alone.ids)
    assert np.array_equal(image.range, alone.range)
    simulation.close()
