"""The rendering of a scene: its models, water, light and the renderer."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import product
from ...base.record import Record
from ...cameras.exposure import Displacement, Exposure, PlainExposure
from ...cameras.lens_image import map_lens
from ...cameras.response import Pixels
from ...devices.lamp import MAX_LAMPS, MountedLamp
from ...devices.led_array import Led
from ...devices.structured_light_projector import MountedProjector
from ...errors import UwsimError
from ...model.parts import Part
from ...model.scene_model import SceneModel
from ...physics.engine import Engine
from ...rendering.lights.projector import Projector
from ...rendering.physical.moving_surface import MovingSurface
from ...rendering.physical.view import ViewContents
from ...rendering.rendered_image import ImageModel, RenderedImage
from ...rendering.smoothing import find_means
from ...rendering.water import Light, Water
from ..terrain.terrain_tiles import TerrainTiles
from .camera_image import map_image, take_pixels
from .heap_models import HeapModels
from .light_sources import has_sun_shadows, make_lamp, make_projector
from .part_names import find_generated_hashes, name_parts
from .part_poses import PartPoses
from .renderer_pool import RendererPool
from .sand import HeapState, make_heaps
from .scene_particles import ParticlesState, SceneParticles
from .scene_water import choose_water, make_water, set_exposure

if TYPE_CHECKING:
    from ...rendering.renderer import Renderer

MAX_SMOOTHED_SIZE = 8192
"""The greatest width and height, in samples, of an image with several samples a pixel."""
POLISHED_SAMPLES = 2
"""The number of samples in a pixel of a polished camera, in width and in height."""
ALL_TARGETS = frozenset({"colour", "range", "ids"})
"""The names of the images that can be rendered at once: colour, range, part number."""


@dataclass(slots=True)
class SceneryState(Record):
    """The state of the scenery; the poses of its parts are in the state of the engine."""

    water: Water
    """The optical properties of the water; scene updaters change the fog."""
    light: Light
    """The light of the scene; scene updaters change its ``rate``."""
    heaps: list[HeapState]
    """The state of each heap of sand."""
    particles: ParticlesState | None = None
    """The state of the particles in the water; None without any."""


class Scenery:
    """The visible parts of a scene in water; a renderer is acquired for the first image.

    Args:
        model: the compiled scene.
        engine: the engine, which stores the poses.
        pool: the pool of renderers; None: the scenery has a renderer of its own.
        particles: the particles in the water; None without any.
    """

    def __init__(
        self,
        model: SceneModel,
        engine: Engine,
        pool: RendererPool | None,
        particles: SceneParticles | None = None,
    ) -> None:
        scene = model.scene
        self.particles = particles
        """The particles in the water; None without any."""
        self._model = model
        self._engine = engine
        self._own_pool = RendererPool()
        self._pool = pool or self._own_pool
        self._renderer: Renderer | None = None
        self._handles: list[int] = []  # the renderer's handle of each part that is a mesh
        self._drawn_version = -1
        self._vehicle_names = tuple(vehicle.name for vehicle in scene.vehicles)
        self.parts = model.parts
        """The visible parts of the scene: models of links and objects."""
        self._tiles = TerrainTiles(self.parts)
        self._poses = PartPoses(self.parts, engine.poses)
        self._hidden_ids = frozenset(part.id for part in self.parts if part.is_hidden)
        self.mounted_lamps: tuple[MountedLamp | Led, ...] = ()
        """The lamps, and the signal lamps (``LedArray``), of the scene."""
        self.mounted_projector: tuple[MountedProjector, npt.NDArray[np.uint8]] | None = None
        """The structured-light projector of the scene, and its pattern (h, w, 4); None: none."""
        self._projector: Projector | None = None
        buried_objects = {index for index, spec in enumerate(scene.objects) if spec.buried > 0.0}
        self.heaps = make_heaps(
            scene, [(p.object, self.corners(p)) for p in self.parts if p.object in buried_objects]
        )
        """The heaps of sand over buried objects."""
        self.state = SceneryState(
            make_water(model),
            Light(rate=scene.sim_params.light_rate, shadows=has_sun_shadows(scene)),
            [heap.state for heap in self.heaps],
            None if particles is None else particles.state,
        )
        """The state: water, light and sand."""
        first_heap_id = max((part.id for part in self.parts), default=0) + 1
        self._heap_models = HeapModels(self.heaps, first_heap_id)
        self._find_surface: Callable[[], MovingSurface] | None = None

    def set_surface(self, find_surface: Callable[[], MovingSurface]) -> None:
        """Set the function that returns the moving surface at the present time."""
        self._find_surface = find_surface

    def set_lamps(self, lamps: Sequence[MountedLamp], leds: Sequence[Led] = ()) -> None:
        """Set the lamps and the signal lamps of the scene.

        Raises:
            UwsimError: there are too many lamps. Signal lamps beyond the limit are not drawn.
        """
        self.mounted_lamps = (*lamps, *leds)
        if (n_lamps := len(lamps)) > MAX_LAMPS:
            raise UwsimError(f"{n_lamps} lamps are in the scene; expected at most {MAX_LAMPS}.")
        self.state.water = set_exposure(self.state.water, self._model, self)

    def set_projector(self, projector: MountedProjector, pattern: npt.NDArray[np.uint8]) -> None:
        """Set the projector of the scene, and its pattern (h, w, 4)."""
        self.mounted_projector = projector, pattern
        self.state.water = set_exposure(self.state.water, self._model, self)

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m] of the water, not the colour of the fog.

        The original UWSim also sets the fog colour of its window to (0, 0.05, 0.3), and does not
        change the fog colour of its cameras.

        Raises:
            UwsimError: the water is physical; it has no fog.
        """
        if self.state.water.physical_water is not None:
            raise UwsimError(
                "The fog density has no effect in physical water; expected a scene without "
                "<u:water>."
            )
        self.state.water = replace(self.state.water, fog=density)

    def set_light_rate(self, rate: float) -> None:
        """Set the factor by which the light of the scene is scaled [1]; 1 by default."""
        self.state.light = replace(self.state.light, rate=rate)

    def world_from_mesh(self, part: Part) -> npt.NDArray[np.float64]:
        """Return the present pose of a part in W, with its scale, (4, 4) [m]."""
        return self._poses.world_from_mesh(part)

    def corners(self, part: Part) -> Array:
        """Return the corners of a part's bounding box at its present pose, in W, (8, 3) [m]."""
        world_from_mesh = self.world_from_mesh(part)
        return product(part.model.box.corners(), world_from_mesh[:3, :3].T) + world_from_mesh[:3, 3]

    def render(self, exposure: Exposure | PlainExposure) -> Pixels:
        """Take the image of a camera, (h, w, 3), or (h, w) if it is grey."""
        return self.render_labelled(exposure, frozenset())[0]

    def render_labelled(
        self,
        exposure: Exposure | PlainExposure,
        labels: frozenset[str] = ALL_TARGETS - {"colour"},
    ) -> tuple[Pixels, RenderedImage]:
        """Take the image of a camera, and the range and part number of each pixel.

        They are drawn with the colours where these have one sample a pixel. They are those of the
        last time of the shutter: use it for cameras at rest.
        """
        samples = POLISHED_SAMPLES if exposure.is_polished else 1
        targets = labels | {"colour"} if samples == 1 else frozenset({"colour"})
        images: list[RenderedImage] = []

        def draw(
            pose: Pose, colour: str, displacement: Displacement | None = None
        ) -> npt.NDArray[np.generic]:
            image = self._draw_smooth(
                pose,
                exposure.intrinsics,
                self.state.water,
                light=self._light(is_polished=exposure.is_polished),
                samples=samples,
                targets=targets,
                colour=colour,
                displacement=displacement,
            )
            images.append(image)
            assert image.colour is not None
            return image.colour

        pixels = take_pixels(exposure, draw, self.depth, self.state.water.physical_water)
        if labels <= targets:
            return pixels, images[-1]
        return pixels, self.render_clean(
            exposure.world_from_camera, exposure.intrinsics, targets=labels
        )

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Render the distance along the optical axis, (h, w) [m]; +inf where no surface is."""
        targets = frozenset({"range"})
        image = self._draw(world_from_camera, intrinsics, self.state.water, targets=targets)
        return image.depth.astype(np.float64)

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Render the number of the part that is visible at each pixel, (h, w); 0: none."""
        targets = frozenset({"ids"})
        image = self._draw(world_from_camera, intrinsics, self.state.water, targets=targets)
        assert image.ids is not None
        return image.ids

    def render_clean(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        fog: float | None = None,
        targets: Collection[str] = ALL_TARGETS,
        is_polished: bool = False,
        hidden_ids: frozenset[int] = frozenset(),
    ) -> RenderedImage:
        """Render a noise-free image with range and part numbers.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole model of the camera.
            fog: the fog density instead of the scene's [1/m]; None: the density of the scene.
            targets: the images to render, some of `ALL_TARGETS`.
            is_polished: render for presentation (`Light.is_polished`). Edges are smooth if colour
                is the only target: a pixel has one range and one number, those of its centre.
            hidden_ids: the segmentation IDs of the parts that are left out, besides the ghosts.
        """
        return self._draw_smooth(
            world_from_camera,
            intrinsics,
            choose_water(self.state.water, fog, self._model),
            light=self._light(is_polished=is_polished),
            targets=frozenset(targets),
            samples=POLISHED_SAMPLES if is_polished and set(targets) == {"colour"} else 1,
            hidden_ids=self._hidden_ids | hidden_ids if hidden_ids else None,
        )

    def render_view(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        targets: Collection[str] = ALL_TARGETS,
        hidden_ids: frozenset[int] = frozenset(),
        fog: float | None = None,
        samples: int = 1,
    ) -> RenderedImage:
        """Render the view of an observer, for presentation: with ghosts, and air above the water.

        Args:
            world_from_camera: the pose of the observer's camera; OpenGL axes.
            intrinsics: the pinhole model of the camera.
            targets: the images to render, some of `ALL_TARGETS`.
            hidden_ids: the segmentation IDs of the parts that are left out.
            fog: the fog density instead of the scene's [1/m]; None: the density of the scene.
            samples: the number of samples in a pixel, in width and in height; with more than one
                edges are smooth, and only colour is rendered.
        """
        return self._draw_smooth(
            world_from_camera,
            intrinsics,
            replace(
                choose_water(self.state.water, fog, self._model), has_air=True, fog_distance="ray"
            ),
            light=self._light(is_polished=True),
            targets=frozenset(targets),
            hidden_ids=hidden_ids,
            samples=samples,
        )

    def _light(self, *, is_polished: bool) -> Light:
        return replace(self.state.light, is_polished=True) if is_polished else self.state.light

    def _draw_smooth(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        *,
        light: Light,
        samples: int,
        targets: frozenset[str] = frozenset({"colour"}),
        colour: str = "uint8",
        hidden_ids: frozenset[int] | None = None,
        displacement: Displacement | None = None,
    ) -> RenderedImage:
        """Render an image in which each pixel is the mean of ``samples`` x ``samples`` samples.

        With more than one, only colour is rendered. Too large images have one sample a pixel.
        """
        if samples == 1 or max(intrinsics.width, intrinsics.height) * samples > MAX_SMOOTHED_SIZE:
            return self._draw(
                world_from_camera,
                intrinsics,
                water,
                light=light,
                targets=targets,
                colour=colour,
                hidden_ids=hidden_ids,
                displacement=displacement,
            )
        image = self._draw(
            world_from_camera,
            intrinsics.with_size(intrinsics.width * samples, intrinsics.height * samples),
            water,
            light=light,
            targets=frozenset({"colour"}),
            colour=colour,
            hidden_ids=hidden_ids,
            displacement=displacement,
        )
        assert image.colour is not None
        return replace(image, intrinsics=intrinsics, colour=find_means(image.colour, samples))

    def _draw(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        *,
        light: Light | None = None,
        targets: frozenset[str] = ALL_TARGETS,
        colour: str = "uint8",
        hidden_ids: frozenset[int] | None = None,
        displacement: Displacement | None = None,
    ) -> RenderedImage:
        """Render an image at the present poses of all parts.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole model of the camera.
            water: the water.
            light: the light; None: the light of the scene.
            targets: the images to render, some of `ALL_TARGETS`.
            colour: the number format of the colour image, ``uint8``, ``linear16`` or ``light``.
            hidden_ids: the segmentation IDs of the parts that are left out; None: the ghosts.
            displacement: the motion of a vehicle from its present pose; None: none moves.
        """
        renderer = self._open()
        if not self._handles:
            parts = [self.parts[i] for i in self._tiles.mesh_parts]
            self._handles = [renderer.add(part.model, part.id) for part in parts]
        if self._drawn_version != self._engine.poses.version:
            renderer.place_all(self._handles, self._poses.compute_all()[self._tiles.mesh_parts])
            if self.mounted_projector is not None:
                self._projector = make_projector(*self.mounted_projector)
            self._drawn_version = self._engine.poses.version
        if displacement is not None:
            poses = self._poses.compute_displaced(displacement, self._vehicle_names)
            renderer.place_all(self._handles, poses[self._tiles.mesh_parts])
            self._drawn_version = -1  # the next image resets them
        self._heap_models.update(renderer)
        lens_image = None if intrinsics.lens is None else map_lens(intrinsics)
        lit_lamps = [lamp for lamp in self.mounted_lamps if lamp.is_on]
        pinhole = intrinsics if lens_image is None else lens_image.pinhole
        self._tiles.update(renderer, world_from_camera, pinhole.far)
        particles = None
        if (
            self.particles is not None
            and "colour" in targets
            and water.physical_water == self.state.water.physical_water  # not the purest water
        ):
            particles = self.particles.find_visible(world_from_camera, pinhole, displacement)
        image = renderer.draw(
            world_from_camera,
            pinhole,
            water,
            self.state.light if light is None else light,
            targets=targets,
            colour=colour,
            hidden_ids=self._hidden_ids if hidden_ids is None else hidden_ids,
            contents=ViewContents(
                lamps=tuple(make_lamp(lamp, displacement) for lamp in lit_lamps[:MAX_LAMPS]),
                projector=self._projector,
                surface=None if self._find_surface is None else self._find_surface(),
                particles=particles,
            ),
        )
        return image if lens_image is None else map_image(image, intrinsics, lens_image)

    @property
    def renderer_name(self) -> str:
        """The name of the renderer, and of the image model unless it is UWSim's fog law.

        Reading it creates the graphics context if there is none.
        """
        description = self._open().description
        return description if self.image_model == "uwsim" else f"{description}, physical water"

    @property
    def image_model(self) -> ImageModel:
        """The model of the water in colour images: ``uwsim``, its fog law, or ``physical``."""
        return "uwsim" if self.state.water.physical_water is None else "physical"

    @property
    def part_names(self) -> dict[int, str]:
        """The unique names of parts, ``vehicle/link`` or object, by segmentation ID."""
        return name_parts(self.parts, self._vehicle_names, self._heap_models.names)

    @property
    def generated_hashes(self) -> dict[str, str]:
        """The sha256 of the arrays of each generated model, by name, sorted by name.

        Boxes, cylinders and spheres are left out: the robot or scene file contains their sizes.
        """
        return find_generated_hashes(self.parts)

    def redraw(self) -> None:
        """Mark all poses as changed, so that the next image updates them."""
        self._drawn_version = -1

    def _open(self) -> Renderer:
        if self._renderer is None:
            self._renderer = self._pool.acquire()
        return self._renderer

    def close(self) -> None:
        """Release the renderer."""
        if self._renderer is not None:
            self._pool.release(self._renderer)
            self._renderer = None
            self._handles = []
            self._heap_models.forget()
            self._tiles.forget()
            self._drawn_version = -1
        self._own_pool.close()
