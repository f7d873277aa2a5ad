"""The visual side of a scene: models, water, light, and the renderer."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ...assets.mesh import Model
from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import product
from ...base.record import Record
from ...devices.lamp import MAX_LAMPS, MountedLamp
from ...devices.led_array import Led
from ...devices.structured_light_projector import MountedProjector
from ...errors import UwsimError
from ...model.parts import Part
from ...model.scene_model import SceneModel
from ...physics.engine import Engine
from ...rendering.grey import grey_truncated
from ...rendering.lights.lamp import Lamp
from ...rendering.lights.projector import Projector
from ...rendering.noise import add_noise
from ...rendering.rendered_image import RenderedImage
from ...rendering.smoothing import mean_of_squares
from ...rendering.water import Light, Water
from ...scene.spec import SceneSpec
from ..unique_names import unique
from .part_poses import PartPoses
from .renderer_pool import RendererPool
from .sand import HeapState, heaps_of

if TYPE_CHECKING:
    from ...rendering.renderer import Renderer

MAX_SMOOTH = 8192
"""Larger images are not drawn larger still to be smoothed [px]."""
SAMPLES = 2
"""Of a pixel of a polished camera, in width and in height."""
ALL_TARGETS = frozenset({"colour", "range", "ids"})


@dataclass(slots=True)
class SceneryState(Record):
    """What changes of what is seen, besides the poses."""

    water: Water
    """The water; scene updaters change its fog."""
    light: Light
    """The sun; scene updaters change its rate."""
    heaps: list[HeapState]
    """The sand of each heap."""


class Scenery:
    """The models of a scene in its water; acquires a renderer for the first image.

    Args:
        model: of the scene.
        engine: where everything is.
        pool: lends the renderer; without one the scenery has a renderer of its own.
    """

    def __init__(self, model: SceneModel, engine: Engine, pool: RendererPool | None) -> None:
        scene = model.scene
        self._engine = engine
        self._own_pool = RendererPool()
        self._pool = pool or self._own_pool
        self._renderer: Renderer | None = None
        self._handles: list[int] = []  # of each part
        self._drawn_version = -1
        self._vehicle_names = tuple(vehicle.name for vehicle in scene.vehicles)
        self._vehicle_labels = unique(self._vehicle_names)
        self.parts = model.parts
        """The models of the scene and whose they are."""
        self._poses = PartPoses(self.parts, engine.poses)
        self._hidden = frozenset(part.id for part in self.parts if part.is_hidden)
        self.mounted_lamps: tuple[MountedLamp | Led, ...] = ()
        """The lamps and signal lamps of the scene."""
        self.mounted_projector: tuple[MountedProjector, npt.NDArray[np.uint8]] | None = None
        """The projector of the scene, and its pattern (h, w, 4)."""
        self._projector: Projector | None = None
        buried = {index for index, thing in enumerate(scene.objects) if thing.buried > 0.0}
        self.heaps = heaps_of(
            scene, [(p.object, self.corners(p)) for p in self.parts if p.object in buried]
        )
        """The sand over buried objects."""
        self.state = SceneryState(
            Water.of(scene.ocean_state, model.compatibility),
            Light(rate=scene.sim_params.light_rate, shadows=_has_sun_shadows(scene)),
            [heap.state for heap in self.heaps],
        )
        """What changes of it."""
        self._drawn_heaps: dict[int, tuple[int, int, Model]] = {}  # version, handle, model

    def set_lamps(self, lamps: Sequence[MountedLamp], leds: Sequence[Led] = ()) -> None:
        """Set the lamps of the scene, and its signal lamps.

        Raises:
            UwsimError: there are too many lamps; of signal lamps those shine for which there is
                room.
        """
        self.mounted_lamps = (*lamps, *leds)
        if (n_lamps := len(lamps)) > MAX_LAMPS:
            raise UwsimError(f"{n_lamps} lamps shine in the scene; at most {MAX_LAMPS} may.")

    def set_projector(self, projector: MountedProjector, pattern: npt.NDArray[np.uint8]) -> None:
        """Set the projector of the scene, and its pattern (h, w, 4)."""
        self.mounted_projector = projector, pattern

    def set_fog(self, density: float) -> None:
        """Set the fog density [1/m] of the water; its colour stays.

        The original sets the colour of its window's fog to (0, 0.05, 0.3) here, and leaves that of
        its cameras as the scene has it.
        """
        self.state.water = replace(self.state.water, fog=density)

    def set_light_rate(self, rate: float) -> None:
        """Scale the light of the scene; 1 is as usual."""
        self.state.light = replace(self.state.light, rate=rate)

    def world_from_mesh(self, part: Part) -> npt.NDArray[np.float64]:
        """The present pose of a part, with its scale, (4, 4) [m]."""
        return self._poses.world_from_mesh(part)

    def corners(self, part: Part) -> Array:
        """Return the corners of a part's box where it is now, in W, (8, 3) [m]."""
        world_from_mesh = self.world_from_mesh(part)
        return product(part.model.box.corners(), world_from_mesh[:3, :3].T) + world_from_mesh[:3, 3]

    def render(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        std: float,
        rng: np.random.Generator,
        grey: bool,
        is_polished: bool = False,
    ) -> npt.NDArray[np.uint8]:
        """Render a camera's image, with noise, (h, w, 3) or (h, w) when ``grey``.

        Polished: as `render_clean` has it.
        """
        rendered = self._draw_smooth(
            world_from_camera,
            intrinsics,
            self.state.water,
            light=self._light(is_polished=is_polished),
            colour="linear16" if std > 0.0 else "uint8",
            samples=SAMPLES if is_polished else 1,
        )
        assert rendered.colour is not None
        if rendered.colour.dtype == np.uint16:
            pixels = add_noise(rendered.colour.view(np.uint16), std, rng)
        else:
            pixels = rendered.colour.view(np.uint8)
        return grey_truncated(pixels) if grey else pixels

    def depth(self, world_from_camera: Pose, intrinsics: Intrinsics) -> npt.NDArray[np.float64]:
        """Render the distance along the optical axis, (h, w) [m]; +inf = nothing there."""
        wanted = frozenset({"range"})
        rendered = self._draw(world_from_camera, intrinsics, self.state.water, targets=wanted)
        return rendered.depth.astype(np.float64)

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Render the number of the body that each pixel sees, (h, w); 0: none."""
        wanted = frozenset({"ids"})
        rendered = self._draw(world_from_camera, intrinsics, self.state.water, targets=wanted)
        assert rendered.ids is not None
        return rendered.ids

    def render_clean(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        fog: float | None = None,
        targets: Collection[str] = ALL_TARGETS,
        is_polished: bool = False,
    ) -> RenderedImage:
        """Render a noise-free image with range and ids, optionally at another fog density.

        Polished: in the light of `Light.is_polished`; if colour alone is wanted, edges are smooth.
        A pixel has one range and one id, so that with these its colour is that of its centre.
        """
        return self._draw_smooth(
            world_from_camera,
            intrinsics,
            self.state.water if fog is None else replace(self.state.water, fog=fog),
            light=self._light(is_polished=is_polished),
            targets=frozenset(targets),
            samples=SAMPLES if is_polished and set(targets) == {"colour"} else 1,
        )

    def render_view(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        *,
        targets: Collection[str] = ALL_TARGETS,
        hidden: frozenset[int] = frozenset(),
        fog: float | None = None,
        samples: int = 1,
    ) -> RenderedImage:
        """Render the view of an observer: with ghosts, and with air above the water; polished.

        Args:
            world_from_camera: where the viewer is; OpenGL axes.
            intrinsics: the pinhole.
            targets: some of colour, range, ids.
            hidden: numbers of parts that are left out.
            fog: density of the fog instead of the scene's [1/m].
            samples: the colour of a pixel is the mean of so many in width and in height, so that
                edges are smooth; range and ids are not drawn then.
        """
        density = self.state.water.fog if fog is None else fog
        return self._draw_smooth(
            world_from_camera,
            intrinsics,
            replace(self.state.water, fog=density, has_air=True, fog_distance="ray"),
            light=self._light(is_polished=True),
            targets=frozenset(targets),
            hidden=hidden,
            samples=samples,
        )

    def _light(self, *, is_polished: bool) -> Light:
        """The scene's light, for an image that is polished or not."""
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
        hidden: frozenset[int] | None = None,
    ) -> RenderedImage:
        """Render an image of which each pixel is the mean of ``samples`` in width and in height.

        With several only the colour is drawn. Images that would be too large have one.
        """
        if samples == 1 or max(intrinsics.width, intrinsics.height) * samples > MAX_SMOOTH:
            return self._draw(
                world_from_camera,
                intrinsics,
                water,
                light=light,
                targets=targets,
                colour=colour,
                hidden=hidden,
            )
        drawn = self._draw(
            world_from_camera,
            intrinsics.with_size(intrinsics.width * samples, intrinsics.height * samples),
            water,
            light=light,
            targets=frozenset({"colour"}),
            colour=colour,
            hidden=hidden,
        ).colour
        assert drawn is not None
        return RenderedImage(intrinsics=intrinsics, colour=mean_of_squares(drawn, samples))

    def _draw(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        *,
        light: Light | None = None,
        targets: frozenset[str] = ALL_TARGETS,
        colour: str = "uint8",
        hidden: frozenset[int] | None = None,
    ) -> RenderedImage:
        """Render an image in the scene's light, unless in another; without the parts ``hidden``.

        ``hidden`` None: without ghosts.
        """
        renderer = self._open()
        if not self._handles:
            self._handles = [renderer.add(part.model, part.id) for part in self.parts]
        if self._drawn_version != self._engine.poses.version:
            renderer.place_all(self._handles, self._poses.of_all())
            if self.mounted_projector is not None:
                self._projector = _projecting(*self.mounted_projector)
            self._drawn_version = self._engine.poses.version
        self._draw_heaps(renderer)
        shining = [lamp for lamp in self.mounted_lamps if lamp.is_on]
        return renderer.draw(
            world_from_camera,
            intrinsics,
            water,
            self.state.light if light is None else light,
            targets=targets,
            colour=colour,
            hidden=self._hidden if hidden is None else hidden,
            lamps=tuple(map(_shining, shining[:MAX_LAMPS])),
            projector=self._projector,
        )

    def _draw_heaps(self, renderer: Renderer) -> None:
        """Give the renderer the heaps of sand that have changed."""
        for number, heap in enumerate(self.heaps):
            drawn = self._drawn_heaps.get(number)
            if drawn is not None and drawn[0] == heap.version:
                continue
            if drawn is not None:
                renderer.remove(drawn[1])
                renderer.discard(drawn[2])
            model = heap.model()
            handle = renderer.add(model, self.number_of_heap(number))
            self._drawn_heaps[number] = heap.version, handle, model

    def number_of_heap(self, number: int) -> int:
        """The number in segmentation images of a heap of sand."""
        return max((part.id for part in self.parts), default=0) + 1 + number

    @property
    def renderer_name(self) -> str:
        """Name of the renderer; makes the graphics context if there is none yet."""
        return self._open().description

    @property
    def part_names(self) -> dict[int, str]:
        """Number in segmentation images -> ``vehicle/link`` or object; the second gets ``#2``."""
        names = {}
        for part in self.parts:
            names[part.id] = part.name
            if part.vehicle is not None:
                own = self._vehicle_names[part.vehicle]
                names[part.id] = self._vehicle_labels[part.vehicle] + part.name.removeprefix(own)
        heaps = enumerate(self.heaps)
        names |= {self.number_of_heap(i): f"sand/{heap.name}" for i, heap in heaps}
        return dict(zip(names, unique(names.values()), strict=True))

    @property
    def made_hashes(self) -> dict[str, str]:
        """Name of each model that is of no file -> sha256 of its arrays, sorted by name.

        Boxes, cylinders and spheres have none: the file of their robot or scene has their sizes.
        """
        made = [part.model for part in self.parts if part.model.sha256 and not part.model.files]
        models = {model.name: model.sha256 for model in made}
        return {name: models[name] for name in sorted(models)}

    def redraw(self) -> None:
        """Update all poses before the next image."""
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
            self._drawn_heaps = {}
            self._drawn_version = -1
        self._own_pool.close()


def _shining(lamp: MountedLamp | Led) -> Lamp:
    """The lamp at its present pose."""
    spec = lamp.spec
    return Lamp(
        world_from_lamp=lamp.world_from_lamp,
        half_angle=math.radians(spec.fov / 2.0),
        softness=spec.softness,
        colour=spec.color,
        intensity=lamp.intensity,
        casts_shadow=spec.shadow,
    )


def _projecting(projector: MountedProjector, pattern: npt.NDArray[np.uint8]) -> Projector:
    """The projector at its present pose."""
    return Projector(
        world_from_projector=projector.world_from_projector,
        fovy=math.radians(projector.spec.fov),
        pattern=pattern,
        is_laser=projector.spec.laser,
    )


def _has_sun_shadows(scene: SceneSpec) -> bool:
    """Whether vehicles and objects cast the sun's shadow."""
    asked = scene.sim_params.sun_shadow
    return not scene.is_original if asked is None else asked
