"""What an image shows: where, how far, whose, and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import ball, block, placed, plate
from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Model, Texture
from uwsim.base.geometry import Intrinsics, Pose, rotation_from_rpy
from uwsim.errors import UnknownName
from uwsim.rendering.context import create_context
from uwsim.rendering.gpu_model import GpuModels
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import AMBIENT_SHARE, Light, Water

DRY = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0))
HERE = Pose.identity()
CAMERA = Intrinsics.from_fovy(160, 120, np.radians(50.0), near=0.1, far=100.0)
ODD = Intrinsics(
    width=320, height=240, fx=250.0, fy=270.0, cx=120.0, cy=160.0, skew=12.0, near=0.1, far=50.0
)
IDS = frozenset({"ids"})


@pytest.mark.parametrize("camera", [CAMERA, ODD], ids=["usual", "off-centre and skewed"])
@pytest.mark.parametrize("direction", [(-0.2, 0.15), (0.25, -0.2), (0.0, 0.0), (0.3, 0.2)])
def test_a_point_lands_where_the_pinhole_says(
    renderer: Renderer, camera: Intrinsics, direction: tuple[float, float]
) -> None:
    view = Pose.from_rpy((3.0, -2.0, 1.0), (1.0, 0.3, -2.0))
    point = np.array([direction[0] * 4.0, direction[1] * 4.0, -4.0])  # camera frame [m]
    dot = renderer.add(plate(0.06, 0.06), 7)
    world_from_dot = Pose(view.transform(point[None])[0], view.rotation)
    renderer.place(dot, world_from_dot.matrix)
    image = renderer.draw(view, camera, DRY, Light(), targets=IDS)
    assert image.ids is not None
    rows, columns = np.nonzero(image.ids == 7)
    seen = columns.mean(), rows.mean()
    assert seen == pytest.approx(tuple(camera.project(point[None])[0]), abs=0.5)


@pytest.mark.parametrize("camera", [CAMERA, ODD], ids=["usual", "off-centre and skewed"])
def test_range_is_the_distance_along_the_ray_to_a_slanted_plane(
    renderer: Renderer, camera: Intrinsics
) -> None:
    plane = Pose.from_rpy((0.3, -0.2, -5.0), (0.4, -0.3, 0.0))
    renderer.place(renderer.add(plate(60.0, 60.0), 1), plane.matrix)
    image = renderer.draw(HERE, camera, DRY, Light(), targets={"range"})
    normal, rays = plane.rotation[:, 2], camera.rays()
    depth = (normal @ plane.position) / (rays @ normal)  # (h, w) [m]
    assert image.range == pytest.approx(depth * np.linalg.norm(rays, axis=2), rel=1e-4, abs=1e-4)
    assert image.depth == pytest.approx(depth, rel=1e-4)


def test_the_lengths_of_rays_are_computed_once_for_a_pinhole_and_cannot_be_changed() -> None:
    lengths = ODD.ray_lengths
    assert lengths == pytest.approx(np.linalg.norm(ODD.rays(), axis=2), rel=1e-15)
    assert ODD.ray_lengths is lengths
    with pytest.raises(ValueError, match="read-only"):
        lengths[0, 0] = 0.0
    assert replace(ODD, width=ODD.width + 1).ray_lengths.shape == (ODD.height, ODD.width + 1)


def test_range_is_right_far_from_the_worlds_origin(renderer: Renderer) -> None:
    far_away = Pose.from_rpy((3000.0, -4000.0, -20.0), (0.0, 0.0, 0.7))
    renderer.place(renderer.add(plate(60.0, 60.0), 1), far_away.matrix @ placed(z=-3.0))
    image = renderer.draw(far_away, CAMERA, DRY, Light(), targets={"range"})
    assert image.depth == pytest.approx(3.0, rel=1e-4)


def test_only_what_is_asked_for_is_handed_over(renderer: Renderer) -> None:
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"ids"})
    assert image.colour is None
    assert image.range is None
    with pytest.raises(ValueError, match="without its range"):
        _ = image.depth


@pytest.mark.parametrize("targets", [{"colour"}, {"range"}, {"ids"}, {"colour", "ids"}])
def test_a_target_is_the_same_alone_and_in_company(renderer: Renderer, targets: set[str]) -> None:
    renderer.place(renderer.add(ball(0.5, (0.9, 0.4, 0.2)), 3), placed(x=0.2, z=-2.0))
    everything = renderer.draw(HERE, CAMERA, Water(), Light())
    some = renderer.draw(HERE, CAMERA, Water(), Light(), targets=targets)
    for name in targets:
        assert np.array_equal(getattr(some, name), getattr(everything, name))


def test_an_unknown_target_is_refused(renderer: Renderer) -> None:
    with pytest.raises(ValueError, match="cannot draw"):
        renderer.draw(HERE, CAMERA, DRY, Light(), targets={"color"})


def test_the_nearer_thing_hides_the_farther_whatever_their_order(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(0.5, 0.5), 1), placed(z=-2.0))
    renderer.place(renderer.add(plate(9.0, 9.0), 2), placed(z=-3.0))
    renderer.place(renderer.add(plate(0.1, 0.1), 3), placed(z=-3.5))
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS)
    assert image.ids is not None
    assert image.ids[60, 80] == 1
    assert image.ids[0, 0] == 2
    assert not (image.ids == 3).any()


def test_the_top_row_is_the_top_of_the_world(renderer: Renderer) -> None:
    renderer.place(renderer.add(block((0.2, 0.2, 0.2)), 1), placed(x=0.5, y=0.5, z=-2.0))
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS)
    assert image.ids is not None
    rows, columns = np.nonzero(image.ids)
    assert rows.max() < 60
    assert columns.min() > 80


def test_back_faces_are_not_drawn_unless_asked_for(renderer: Renderer) -> None:
    away = Pose.from_rpy((0.0, 0.0, -2.0), (np.pi, 0.0, 0.0)).matrix
    one = renderer.add(plate(0.5, 0.5), 1)
    renderer.place(one, away)
    assert not renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS).ids.any()  # type: ignore[union-attr]
    both = renderer.add(plate(0.5, 0.5, two_sided=True), 2)
    renderer.place(both, away)
    assert renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS).ids.any()  # type: ignore[union-attr]


def test_the_back_of_a_two_sided_plate_is_lit_as_a_front(renderer: Renderer) -> None:
    images = []
    for roll in (0.0, np.pi):
        handle = renderer.add(plate(9.0, 9.0, (0.6, 0.6, 0.6), two_sided=True), 1)
        renderer.place(handle, Pose.from_rpy((0.0, 0.0, -2.0), (roll, 0.0, 0.0)).matrix)
        image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"colour"})
        assert image.colour is not None
        images.append(image.colour.astype(int))
        renderer.remove(handle)
    assert np.abs(images[0] - images[1]).max() <= 1
    assert images[0].min() > 255.0 * AMBIENT_SHARE * 0.6 + 20.0  # the sun reaches it


def test_a_mirroring_matrix_does_not_turn_a_body_inside_out(renderer: Renderer) -> None:
    body = renderer.add(block((1.0, 1.0, 1.0)), 1)
    renderer.place(body, placed(z=-3.0) @ np.diag([-1.0, 1.0, 1.0, 1.0]))
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"range"})
    assert image.depth[60, 80] == pytest.approx(2.5, rel=1e-4)


def test_uneven_scale_turns_normals_the_right_way(renderer: Renderer) -> None:
    # A slanted plate, and the same plate as a squeezed steeper one, must be lit alike.
    slant = np.eye(4)
    slant[:3, :3] = rotation_from_rpy(0.0, np.arctan(0.5), 0.0)
    steep = np.eye(4)
    steep[:3, :3] = rotation_from_rpy(0.0, np.arctan(1.0), 0.0)
    squeezed = np.diag([1.0, 1.0, 0.5, 1.0]) @ steep
    images = []
    for matrix in (slant, squeezed):
        handle = renderer.add(plate(9.0, 9.0, (0.6, 0.6, 0.6)), 1)
        renderer.place(handle, placed(z=-3.0) @ matrix)
        image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"colour"})
        assert image.colour is not None
        images.append(image.colour[50:70, 70:90].astype(int))
        renderer.remove(handle)
    assert np.abs(images[0] - images[1]).max() <= 1


def test_a_texture_stands_upright(renderer: Renderer) -> None:
    pixels = np.zeros((64, 64, 3), np.uint8)
    pixels[:32, :, 0] = 255  # the upper half is red
    pixels[32:, :, 2] = 255  # the lower half is blue
    texture = Texture(name="flag", image=PixelImage(pixels), repeats=False)
    renderer.place(renderer.add(plate(1.0, 1.0, texture=texture), 1), placed(z=-2.0))
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"colour"})
    assert image.colour is not None
    above, below = image.colour[50, 80], image.colour[70, 80]
    assert above[0] > 100 > above[2]
    assert below[2] > 100 > below[0]


def test_a_texture_far_away_is_averaged_not_sampled(renderer: Renderer) -> None:
    checks = np.indices((256, 256)).sum(axis=0) % 2 * 255
    texture = Texture(
        name="checks", image=PixelImage(np.repeat(checks[..., None], 3, 2).astype(np.uint8))
    )
    renderer.place(renderer.add(plate(2.0, 2.0, texture=texture), 1), placed(z=-5.0))
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"colour"})
    assert image.colour is not None
    assert image.colour[55:65, 75:85].astype(float).std() < 2.0


def test_what_leaves_the_view_and_comes_back_is_drawn_again(renderer: Renderer) -> None:
    body = renderer.add(ball(0.3), 1)
    for x, is_seen in ((0.0, True), (9.0, False), (-1.4, True), (-1.9, False), (0.0, True)):
        renderer.place(body, placed(x=x, z=-2.0))
        image = renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS)
        assert image.ids is not None
        assert image.ids.any() == is_seen, x


def test_hidden_ids_are_not_seen_and_cast_no_shadow(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0), 1), placed(z=-4.0))
    alone = renderer.draw(HERE, CAMERA, Water(), Light())
    renderer.place(renderer.add(block((1.0, 1.0, 0.2)), 2), placed(z=-2.5))
    both = renderer.draw(HERE, CAMERA, Water(), Light())
    hidden = renderer.draw(HERE, CAMERA, Water(), Light(), hidden_ids=frozenset({2}))
    assert not np.array_equal(both.colour, alone.colour)  # type: ignore[arg-type]
    assert np.array_equal(hidden.colour, alone.colour)  # type: ignore[arg-type]
    assert np.array_equal(hidden.ids, alone.ids)  # type: ignore[arg-type]


def test_what_is_removed_is_gone_and_its_handle_is_no_use(renderer: Renderer) -> None:
    handle = renderer.add(ball(0.3), 1)
    renderer.place(handle, placed(z=-2.0))
    renderer.remove(handle)
    assert not renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS).ids.any()  # type: ignore[union-attr]
    with pytest.raises(UnknownName):
        renderer.place(handle, np.eye(4))


@pytest.mark.parametrize("id", [0, 65536])
def test_an_id_must_fit_the_id_image(renderer: Renderer, id: int) -> None:
    with pytest.raises(ValueError, match="is not in 1"):
        renderer.add(ball(0.3), id)


def test_the_largest_id_survives(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.3), 65535), placed(z=-2.0))
    image = renderer.draw(HERE, CAMERA, DRY, Light())
    assert image.ids is not None
    assert image.ids[60, 80] == 65535


def test_sixteen_bits_round_to_the_eight_bit_image(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.5, (0.9, 0.4, 0.2)), 3), placed(z=-2.0))
    eight = renderer.draw(HERE, CAMERA, Water(), Light()).colour
    sixteen = renderer.draw(HERE, CAMERA, Water(), Light(), colour="linear16").colour
    assert eight is not None
    assert sixteen is not None
    assert sixteen.dtype == np.uint16
    # Rounded to nearest, not truncated; one 16-bit step of doubt at the edges.
    assert np.abs(sixteen[..., :3] / 257.0 - eight).max() <= 0.5 + 1.0 / 257.0


def test_images_are_the_callers_own(renderer: Renderer) -> None:
    ball_ = renderer.add(ball(0.5), 3)
    renderer.place(ball_, placed(z=-2.0))
    first = renderer.draw(HERE, CAMERA, DRY, Light())
    assert first.range is not None
    kept = first.range.copy()
    renderer.place(ball_, placed(z=-3.0))
    renderer.draw(HERE, CAMERA, DRY, Light())
    assert np.array_equal(first.range, kept)


def test_the_same_scene_gives_the_same_bytes() -> None:
    images = []
    for _ in range(2):
        renderer = Renderer()
        renderer.place(renderer.add(ball(0.5, (0.9, 0.4, 0.2)), 3), placed(z=-2.0))
        renderer.place(renderer.add(plate(9.0, 9.0), 4), placed(z=-3.0))
        images.append(renderer.draw(HERE, CAMERA, Water(), Light(), colour="linear16"))
        renderer.close()
    assert np.array_equal(images[0].colour, images[1].colour)  # type: ignore[arg-type]
    assert np.array_equal(images[0].range, images[1].range)  # type: ignore[arg-type]


def test_a_mesh_without_normals_is_dark_but_drawn(renderer: Renderer) -> None:
    whole = plate(1.0, 1.0).meshes[0]
    bare = replace(whole, normals=np.zeros_like(whole.normals))
    model = Model(name="bare", meshes=(bare,), source="file")
    renderer.place(renderer.add(model, 1), placed(z=-2.0))
    image = renderer.draw(HERE, CAMERA, DRY, Light())
    assert image.colour is not None
    assert image.ids is not None
    assert image.ids[60, 80] == 1
    assert image.colour[60, 80] == pytest.approx(255.0 * AMBIENT_SHARE, abs=1.0)


def test_a_model_is_uploaded_once_however_often_it_is_added() -> None:
    model = ball(0.1)
    context = create_context()
    models = GpuModels(context)
    assert models.upload(model) is models.upload(model)
    assert models.upload(ball(0.1)) is not models.upload(model)
    context.release()


def test_two_renderers_live_side_by_side() -> None:
    first, second = Renderer(), Renderer()
    first.place(first.add(ball(0.5), 1), placed(z=-2.0))
    second.place(second.add(ball(0.5), 2), placed(z=-3.0))
    for _ in range(2):
        one = first.draw(HERE, CAMERA, DRY, Light())
        two = second.draw(HERE, CAMERA, DRY, Light())
        assert one.depth[60, 80] == pytest.approx(1.5, rel=1e-2)
        assert two.depth[60, 80] == pytest.approx(2.5, rel=1e-2)
    first.close()
    assert second.draw(HERE, CAMERA, DRY, Light()).ids.max() == 2  # type: ignore[union-attr]
    second.close()
    second.close()


def test_renderers_may_come_and_go() -> None:
    for _ in range(12):
        renderer = Renderer()
        renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS)
        renderer.close()


def test_a_scene_may_hold_hundreds_of_things(renderer: Renderer) -> None:
    model = ball(0.05)
    for n in range(300):
        renderer.place(
            renderer.add(model, n + 1), placed(x=(n % 20 - 9.5) / 5, y=(n // 20 - 7) / 5, z=-4)
        )
    image = renderer.draw(HERE, CAMERA, DRY, Light(), targets=IDS)
    assert image.ids is not None
    assert len(np.unique(image.ids)) == 301


def drawn_once(world_from_camera: Pose, water: Water, x: float) -> bytes:
    """What somebody sees who looks once."""
    renderer = Renderer()
    try:
        renderer.place(renderer.add(ball(0.5), 3), placed(x=x, z=-4.0))
        image = renderer.draw(world_from_camera, CAMERA, water, Light(), targets={"colour"})
        assert image.colour is not None
        return image.colour.tobytes()
    finally:
        renderer.close()


def test_a_view_that_is_kept_is_the_view_and_never_another(renderer: Renderer) -> None:
    """From the second equal view on the image is kept: nothing may be seen of that."""
    thing = renderer.add(ball(0.5), 3)
    aside = Pose.from_rpy((0.3, 0.0, 0.0), (0.0, 0.1, 0.0))
    fog = replace(DRY, fog=0.3)
    looks = [
        *[(HERE, DRY, 0.0)] * 4,  # kept ...
        (HERE, DRY, 0.4),  # ... and the thing has moved
        *[(HERE, DRY, 0.4)] * 2,
        (HERE, fog, 0.4),  # ... and the fog has come
        *[(HERE, fog, 0.4)] * 2,
        (aside, fog, 0.4),  # ... and the camera is elsewhere
        (HERE, fog, 0.4),
    ]
    expected = {(look[2], id(look[0]), look[1].fog): drawn_once(*look) for look in looks}
    for view, water, x in looks:
        renderer.place(thing, placed(x=x, z=-4.0))
        image = renderer.draw(view, CAMERA, water, Light(), targets={"colour"})
        assert image.colour is not None
        assert image.colour.tobytes() == expected[(x, id(view), water.fog)]
    assert len(set(expected.values())) == len(expected)


def test_another_image_between_does_not_disturb_one_that_is_kept(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.5), 3), placed(z=-4.0))
    aside = Pose.from_rpy((0.3, 0.0, 0.0), (0.0, 0.1, 0.0))
    colour = {"targets": {"colour"}}
    for _ in range(3):
        first = renderer.draw(HERE, CAMERA, DRY, Light(), **colour).colour
    renderer.draw(aside, CAMERA, DRY, Light(), **colour)
    again = renderer.draw(HERE, CAMERA, DRY, Light(), **colour).colour
    assert first is not None
    assert again is not None
    assert np.array_equal(first, again)


def test_an_image_of_what_stands_still_is_drawn_twice(
    renderer: Renderer, monkeypatch: pytest.MonkeyPatch
) -> None:
    thing = renderer.add(ball(0.5), 3)
    renderer.place(thing, placed(z=-4.0))
    aside = Pose.from_rpy((0.3, 0.0, 0.0), (0.0, 0.1, 0.0))
    drawn: list[object] = []
    draw = renderer._issue_draw_calls

    def counted(*view: object) -> object:
        drawn.append(view)
        return draw(*view)  # type: ignore[arg-type]

    monkeypatch.setattr(renderer, "_issue_draw_calls", counted)
    images = [renderer.draw(eye, CAMERA, DRY, Light()) for eye in (HERE, aside) * 4]
    assert len(drawn) == 4
    assert {image.n_bytes for image in images} == {160 * 120 * (3 + 4 + 2)}
    assert np.array_equal(images[0].colour, images[6].colour)  # type: ignore[arg-type]
    assert np.array_equal(images[1].range, images[7].range)  # type: ignore[arg-type]
    renderer.place(thing, placed(z=-4.1))
    renderer.draw(HERE, CAMERA, DRY, Light())
    assert len(drawn) == 5


def test_a_kept_image_is_the_callers_own(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.5), 3), placed(z=-4.0))
    colours = []
    for _ in range(4):
        colour = renderer.draw(HERE, CAMERA, DRY, Light(), targets={"colour"}).colour
        assert colour is not None
        colours.append(colour.copy())
        colour[...] = 7
    assert all(np.array_equal(colour, colours[0]) for colour in colours)
