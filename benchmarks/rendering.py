"""Images of the `visibility` scene: tank, Girona 500 with its arm, black box. JSON on stdout.

The scene stands still unless the name says otherwise; the camera moves by 1 nm from image to image,
so that every one is drawn and read back. ``colour`` is 8 bit; ``colour + noise`` goes through
16 bit as cameras do.
``ratio`` is the CPU time over the promise of DESIGN 9.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from measure import main, milliseconds

from uwsim.assets import load_model
from uwsim.base.geometry import Intrinsics, Pose, rotation_from_xyz
from uwsim.cameras import CameraResponse, FlatPort, Lens
from uwsim.cameras.lens_image import map_lens
from uwsim.cameras.vignetting import compute_falloff
from uwsim.optics import find_water
from uwsim.particles import Drift, MarineSnowSpec, SizeClass, View, find_particles
from uwsim.rendering.caustics.ripples import Ripples
from uwsim.rendering.grey import grey_truncated
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.noise import add_noise
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.physical.particle_pass import VisibleParticles
from uwsim.rendering.physical.physical_water import PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.targets import TARGETS
from uwsim.rendering.water import Light, Water
from uwsim.waves import JonswapSpec, SeaSettings, Waves

WORLD_FROM_LOCALIZED = Pose(np.zeros(3), rotation_from_xyz(np.pi, 0.0, -np.pi / 2))
WATER = Water(fog=0.4)
PHYSICAL_WATER = Water(physical_water=PhysicalWater(medium=find_water("jerlov-3C"), exposure=2.0))
COLOUR = frozenset({"colour"})
BOX = "objects/blackbox_uib_trimesh.osg"
ARM = "robot/ARM5E/ARM5E_part"


def pose_matrix(
    position: tuple[float, float, float], rpy: tuple[float, float, float]
) -> np.ndarray:
    return Pose.from_rpy(position, rpy).matrix


def fill_renderer(renderer: Renderer) -> tuple[list[tuple[int, np.ndarray]], Pose, int]:
    """Fill the renderer; return handles and poses of the vehicle, the camera, and all triangles."""
    world = WORLD_FROM_LOCALIZED.matrix
    vehicle = pose_matrix((2.0, 0.0, 2.515), (0.0, 0.0, 0.0))
    part0 = vehicle @ pose_matrix((0.0, 0.0, 0.95), (0.0, 0.0, np.pi))
    slew = part0 @ pose_matrix((0.0, 0.0, 0.13), (0.0, 0.0, 0.0))
    shoulder = slew @ pose_matrix((0.08052, 0.0, 0.0), (np.pi / 2, 0.0, 0.0))
    elbow = shoulder @ pose_matrix(
        (0.438492379, 0.061470007, 0.0), (0.0, 0.0, 0.139277274 + 2.15294)
    )
    wrist = elbow @ pose_matrix((0.349117258, 0.058023573, 0.0), (np.pi / 2, 0.0, 1.972222055))
    jaw1 = wrist @ pose_matrix((-0.04, 0.0, 0.045), (0.0, -0.8, 0.0))
    jaw2 = wrist @ pose_matrix((0.04, 0.0, 0.045), (0.0, 0.8, 0.0))
    upright_rpy = (0.0, -np.pi / 2, 0.0)
    links = (
        ("robot/GIRONA500/g500_March11.osg", vehicle, (-0.2, 0.0, 0.75), (-np.pi / 2, 0.0, np.pi)),
        (f"{ARM}0.osg", part0, (0.0, 0.0, 0.0), (np.pi, 0.0, 0.0)),
        (f"{ARM}1.osg", slew, (0.0, 0.0, -0.13), (np.pi, 0.0, 0.0)),
        (f"{ARM}2.osg", shoulder, (0.0, 0.0, 0.0), (np.pi / 2, 0.0, -0.087262726)),
        (f"{ARM}3.osg", elbow, (0.0, 0.0, 0.0), (np.pi / 2, 0.0, 0.4014)),
        (f"{ARM}4_base.osg", wrist, (0.0, 0.0, -0.028), upright_rpy),
        (f"{ARM}4_jaw1.osg", jaw1, (0.0, 0.0, 0.0), upright_rpy),
        (f"{ARM}4_jaw2.osg", jaw2, (0.0, 0.0, 0.0), upright_rpy),
    )
    n_triangles = 0
    vehicle_parts = []
    for number, (name, frame, position, rpy) in enumerate(links, start=3):
        model = load_model(name)
        n_triangles += model.n_triangles
        place = world @ frame @ pose_matrix(position, rpy)
        vehicle_parts.append((renderer.add(model, number), place))
        renderer.place(*vehicle_parts[-1])
    tank, box = load_model("terrain/CIRS/cirs_trident.osg"), load_model(BOX)
    tank_rotation = Pose(np.zeros(3), rotation_from_xyz(3.1415, 0.0, -1.57)).matrix
    renderer.place(
        renderer.add(tank, 1), world @ tank_rotation @ pose_matrix((1.5, 3.0, 0.0), (0.0, 0.0, 0.0))
    )
    renderer.place(renderer.add(box, 2), world @ pose_matrix((2.0, 0.35, 4.735), (0.0, np.pi, 0.0)))
    camera = Pose.from_rpy((-0.2, 0.1, 0.0), (0.0, np.pi, np.pi / 2))
    world_from_part0 = world @ part0
    on_part0 = Pose(world_from_part0[:3, 3], world_from_part0[:3, :3])
    n_triangles += tank.n_triangles + box.n_triangles
    return vehicle_parts, on_part0 @ camera, n_triangles


def view_pose(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Pose:
    """Return the pose of an upright camera in the tank, from two points in L [m]."""
    points = WORLD_FROM_LOCALIZED.transform(np.array([eye, target]))
    back = (points[0] - points[1]) / np.linalg.norm(points[0] - points[1])
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    return Pose(points[0], np.stack([right, np.cross(back, right), back], axis=1))


def divide_snow() -> tuple[SizeClass, ...]:
    """Return the classes of marine snow with some 2000 flocs in view."""
    return MarineSnowSpec(concentration=4200.0).divide(iter(range(100)).__next__)


def make_waves() -> Waves:
    """Return waves of 0.5 m and 5 s, of 200 components over 30 m of water."""
    spec = JonswapSpec(significant_height=0.5, peak_period=5.0, direction=0.4, spreading=10.0)
    sea = SeaSettings(
        depth=30.0, wind=(0.04, 0.04), wind_speed=12.0, reflection_damping=0.35, wave_scale=1e-7
    )
    components = spec.components(sea, np.random.Generator(np.random.Philox(3)))
    return Waves(components, sea.depth, Pose.identity(), 0.0, np.ones(1))


def measure() -> dict[str, object]:
    """Measure all images."""
    rng = np.random.Generator(np.random.Philox(0))
    add_noise(np.zeros((1, 1, 4), np.uint16), 0.01, rng)  # compiles it
    load_model(BOX)
    start_time = time.perf_counter()
    renderer = Renderer()
    context_s = time.perf_counter() - start_time
    vehicle_parts, down_view, n_triangles = fill_renderer(renderer)
    start_time = time.perf_counter()
    small_camera = Intrinsics.from_fovy(320, 240, np.radians(50.0))
    large_camera = Intrinsics.from_fovy(640, 480, np.radians(50.0))
    renderer.draw(down_view, small_camera, WATER, Light())
    first_s = time.perf_counter() - start_time
    side_view = view_pose((4.5, 2.5, 1.2), (1.9, 0.0, 3.3))
    rng = np.random.Generator(np.random.Philox(1))
    sway, n_drawn = 0.0, 0

    def move_camera(eye: Pose) -> Pose:
        nonlocal n_drawn
        n_drawn += 1
        return Pose(eye.position + np.array([1e-9 * n_drawn, 0.0, 0.0]), eye.rotation)

    def draw(
        camera: Intrinsics, targets: frozenset[str], eye: Pose = down_view, **options: object
    ) -> None:
        renderer.draw(move_camera(eye), camera, WATER, Light(), targets=targets, **options)

    def draw_with_noise(camera: Intrinsics, targets: frozenset[str]) -> None:
        image = renderer.draw(
            move_camera(down_view), camera, WATER, Light(), targets=targets, colour="linear16"
        )
        add_noise(image.colour, 0.02, rng)

    def draw_moving_vehicle() -> None:
        nonlocal sway
        sway += 0.01
        for handle, place in vehicle_parts:
            renderer.place(
                handle, pose_matrix((0.1 * np.sin(sway), 0.0, 0.0), (0.0, 0.0, 0.0)) @ place
            )
        draw(small_camera, COLOUR)

    image16 = renderer.draw(down_view, small_camera, WATER, Light(), colour="linear16").colour
    image8 = add_noise(image16, 0.02, rng)
    all_targets = frozenset(TARGETS)

    def draw_physical(camera: Intrinsics, targets: frozenset[str], n_lamps: int) -> None:
        pose = move_camera(down_view)
        offset = pose.rotation @ np.array([0.3, 0.0, 0.0])
        lamp = Lamp(world_from_lamp=Pose(pose.position + offset, pose.rotation), half_angle=0.6)
        renderer.draw(
            pose,
            camera,
            PHYSICAL_WATER,
            Light(),
            targets=targets,
            contents=ViewContents(lamps=(lamp,) * n_lamps),
        )

    time_of_image = 0.0

    def draw_focused(*, is_moving: bool, **settings: bool) -> None:
        nonlocal time_of_image
        time_of_image += 0.05 if is_moving else 0.0
        optics = replace(PHYSICAL_WATER.physical_water, ripples=Ripples(), **settings)
        renderer.draw(
            move_camera(down_view),
            large_camera,
            replace(PHYSICAL_WATER, physical_water=optics),
            Light(),
            targets=COLOUR,
            contents=ViewContents(surface=MovingSurface(time=time_of_image)),
        )

    response = CameraResponse()
    lens = Lens(distortion=(-0.1, 0.02, 0.0, 0.0, 0.0), port=FlatPort())
    scale = lens.magnification
    lens_camera = replace(
        large_camera, fx=scale * large_camera.fx, fy=scale * large_camera.fy, lens=lens
    )
    lens_image, falloff = map_lens(lens_camera), compute_falloff(lens_camera, None)
    wide_light = renderer.draw(
        down_view, lens_image.pinhole, PHYSICAL_WATER, Light(), targets=COLOUR, colour="light"
    ).colour
    light = lens_image.interpolate(wide_light)
    snow = divide_snow()

    def find_snow(pose: Pose) -> VisibleParticles:
        view = View(
            world_from_camera=pose,
            intrinsics=large_camera,
            surface_height=5.0,
            max_range=8.0,
            exposure_time=0.01,
        )
        parts = [find_particles(size_class, view, Drift()) for size_class in snow]
        return VisibleParticles(np.concatenate(parts), aperture=0.003, focus_distance=2.0)

    def draw_snow() -> None:
        pose = move_camera(down_view)
        offset = pose.rotation @ np.array([0.3, 0.0, 0.0])
        lamp = Lamp(world_from_lamp=Pose(pose.position + offset, pose.rotation), half_angle=0.6)
        renderer.draw(
            pose, large_camera, PHYSICAL_WATER, Light(), targets=COLOUR,
            contents=ViewContents(lamps=(lamp,), particles=find_snow(pose)),
        )  # fmt: skip

    surface_pose = view_pose((2.0, 1.5, 3.5), (2.0, -2.0, 0.5))

    dry_pose = view_pose((2.0, 1.5, -2.0), (2.0, -4.0, 0.0))
    waves = make_waves()

    def draw_surface(pose: Pose, *, has_snow: bool = False, **settings: bool) -> None:
        nonlocal time_of_image
        time_of_image += 0.05
        eye = move_camera(pose)
        optics = replace(
            PHYSICAL_WATER.physical_water, ripples=Ripples(), has_surface=True, **settings
        )
        renderer.draw(
            eye,
            large_camera,
            replace(PHYSICAL_WATER, physical_water=optics),
            Light(),
            targets=COLOUR,
            contents=ViewContents(
                surface=MovingSurface(time=time_of_image, waves=waves),
                particles=find_snow(eye) if has_snow else None,
            ),
        )

    figures: dict[str, object] = {
        "flocs in view": len(find_snow(down_view).records),
        "640x480 flocs found": milliseconds(lambda: find_snow(down_view), target=2.0),
        "640x480 physical, sun + lamp + snow": milliseconds(draw_snow, calls=15),
        "renderer": renderer.description,
        "triangles_in_scene": n_triangles,
        "context_s": round(context_s, 4),
        "first_image_s": round(first_s, 4),
        "320x240 colour": milliseconds(lambda: draw(small_camera, COLOUR), target=3.0),
        "320x240 colour + range + ids": milliseconds(
            lambda: draw(small_camera, all_targets), target=5.0
        ),
        "320x240 colour + noise": milliseconds(lambda: draw_with_noise(small_camera, COLOUR)),
        "320x240 colour, vehicle moving": milliseconds(draw_moving_vehicle),
        "320x240 colour, vehicle in view": milliseconds(
            lambda: draw(small_camera, COLOUR, side_view)
        ),
        "640x480 colour": milliseconds(lambda: draw(large_camera, COLOUR), target=9.0, calls=15),
        "640x480 colour + range + ids": milliseconds(
            lambda: draw(large_camera, all_targets), target=15.0, calls=15
        ),
        "640x480 colour, vehicle in view": milliseconds(
            lambda: draw(large_camera, COLOUR, side_view), calls=15
        ),
        "320x240 physical, sun": milliseconds(lambda: draw_physical(small_camera, COLOUR, 0)),
        "320x240 physical, sun + lamp": milliseconds(
            lambda: draw_physical(small_camera, COLOUR, 1), target=8.0
        ),
        "640x480 physical, sun": milliseconds(
            lambda: draw_physical(large_camera, COLOUR, 0), calls=15
        ),
        "640x480 physical, sun + lamp": milliseconds(
            lambda: draw_physical(large_camera, COLOUR, 1), target=25.0, calls=15
        ),
        "640x480 physical, sun + lamp, range + ids": milliseconds(
            lambda: draw_physical(large_camera, all_targets, 1), calls=15
        ),
        "640x480 physical, sun, caustics, still surface": milliseconds(
            lambda: draw_focused(is_moving=False, has_light_shafts=False), calls=15
        ),
        "640x480 physical, sun, caustics + shafts, still surface": milliseconds(
            lambda: draw_focused(is_moving=False), calls=15
        ),
        "640x480 physical, sun, caustics + shafts, moving surface": milliseconds(
            lambda: draw_focused(is_moving=True), calls=15
        ),
        "640x480 physical, sun, surface from below": milliseconds(
            lambda: draw_surface(surface_pose, has_caustics=False, has_light_shafts=False),
            calls=15,
        ),
        "640x480 physical, sun, surface from below, caustics": milliseconds(
            lambda: draw_surface(surface_pose, has_light_shafts=False), calls=15
        ),
        "640x480 physical, sun, surface from below, caustics + shafts, snow": milliseconds(
            lambda: draw_surface(surface_pose, has_snow=True), target=40.0, calls=15
        ),
        "640x480 physical, sun, surface from above": milliseconds(
            lambda: draw_surface(dry_pose, has_caustics=False, has_light_shafts=False), calls=15
        ),
        "320x240 range": milliseconds(lambda: draw(small_camera, frozenset({"range"}))),
        "640x480 lens": milliseconds(lambda: lens_image.interpolate(wide_light)),
        "640x480 response": milliseconds(lambda: response.expose(light, falloff, 1)),
        "640x480 lens + response": milliseconds(
            lambda: response.expose(lens_image.interpolate(wide_light), falloff, 1), target=3.0
        ),
        "320x240 noise": milliseconds(lambda: add_noise(image16, 0.02, rng), target=0.4),
        "320x240 grey": milliseconds(lambda: grey_truncated(image8)),
    }
    renderer.close()
    return figures


if __name__ == "__main__":
    main(measure)
