"""The renderer: instances of models in, images out.

One forward pass draws colour, range and ids, whichever are requested, through UWSim's water
(`rendering.water`). What is seen through is blended over the rest, the farthest first. Not
modelled: the water's surface, caustics, reflections, refraction.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model
from ..base.geometry import Array, Intrinsics, Pose
from ..devices.lamp import MAX_LAMPS
from .backdrop import Backdrop, Colours
from .context import create_context
from .frame import Frame
from .gpu_model import GpuModels
from .instance import Instances, Numbers, Slots, in_view
from .lights.lamp import Lamp
from .lights.lamps import Lamps
from .lights.projector import Projector
from .lights.projector_light import ProjectorLight
from .lights.shadow_region import Region, shaded_region, tiles_of
from .lights.sun_shadow import MARGIN, MAX_CASTER_RADIUS, SunShadow, reached
from .passes import SAMPLERS, Passes, Switches
from .projection import Projection, projection
from .rendered_image import RenderedImage
from .targets import STORES, TARGETS, Targets
from .water import Light, Water, sun_direction

__all__ = ["RenderedImage", "Renderer"]

N_VIEWS = 4
"""So many of the last views are remembered."""
MAX_REGION = 0.75
"""A backdrop of which more may lie in shadow is not used: to shade all takes less time."""
MAX_KEPT = 2**24
"""The largest image that is kept for a view that stays as it is [bytes]."""


@dataclass(frozen=True, kw_only=True)
class View:
    """Everything an image depends on: equal views give equal images."""

    place: bytes
    """World from camera, as it lies in memory."""
    intrinsics: Intrinsics
    """The camera's pinhole."""
    water: Water
    """The water between surfaces and camera."""
    light: Light
    """What lights the scene."""
    wanted: frozenset[str]
    """The targets."""
    hidden: frozenset[int]
    """Ids that are not seen."""
    store: str
    """How colour is stored."""
    version: int
    """Of the instances and their places."""
    lamps: tuple[Lamp, ...]
    """What shines besides the sun."""
    projector: Projector | None
    """What projects a pattern."""


class Renderer:
    """Renders instances of models from any camera pose.

    Use it from one thread; several may live in one process. `close` gives everything back.

    Raises:
        NoGraphics: no OpenGL context could be made.
    """

    def __init__(self) -> None:
        self._context = create_context()
        facts = self._context.info
        self.description = f"{facts['GL_RENDERER']}, {facts['GL_VERSION']}"
        """What draws: ``llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6``."""
        self._models = GpuModels(self._context)
        self._instances = Instances()
        self._targets: dict[tuple[object, ...], Targets] = {}
        self._frame = Frame(self._context)
        self._slots = Slots(self._context)
        self._shadow = SunShadow(self._context)
        self._backdrops: dict[object, Backdrop] = {}  # of the last stages, the newest last
        self._passes = Passes(
            self._context, self._models, self._instances, self._slots, self._shadow
        )
        self._lamps: Lamps | None = None
        self._projector: ProjectorLight | None = None
        self._seen: dict[View, RenderedImage | None] = {}  # the last views, the newest last

    def add(self, model: Model, id: int) -> int:
        """Put a model at the origin of W; returns the handle for `place` and `remove`.

        Args:
            model: Uploaded once, however often it is added.
            id: Its number in the id image, 1..65535; several may share one.
        """
        if not 1 <= id <= 65535:
            raise ValueError(f"the id {id} is not in 1..65535")
        with self._context:
            batches = self._models.upload(model)
        return self._instances.add(batches, id)

    def place(self, handle: int, world_from_model: Array) -> None:
        """Move an instance; the matrix (4, 4) may carry scale."""
        self.place_all((handle,), np.asarray(world_from_model, dtype=np.float64)[None])

    def place_all(self, handles: Sequence[int], world_from_model: Array) -> None:
        """Move several instances; the matrices (n, 4, 4) may carry scale."""
        self._instances.place(handles, world_from_model)

    def remove(self, handle: int) -> None:
        """Take an instance out of the scene."""
        self._instances.remove(handle)

    def discard(self, model: Model) -> None:
        """Free the memory of a model, all of whose instances were removed."""
        with self._context:
            self._models.discard(model)

    def clear(self) -> None:
        """Remove every instance; uploaded models stay on the GPU for the next scenes."""
        self._seen.clear()
        self._backdrops.clear()
        self._instances.clear()
        with self._context:
            self._models.end_scene()

    def draw(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        light: Light,
        *,
        targets: Iterable[str] = TARGETS,
        hidden: frozenset[int] = frozenset(),
        colour: str = "uint8",
        lamps: Sequence[Lamp] = (),
        projector: Projector | None = None,
    ) -> RenderedImage:
        """Draw one image.

        Args:
            world_from_camera: Where the camera is; OpenGL axes.
            intrinsics: Its pinhole.
            water: The water between surfaces and camera.
            light: What lights the scene.
            targets: Some of ``colour``, ``range``, ``ids``; nothing else is computed.
            hidden: Ids of instances that this camera does not see, nor their shadows.
            colour: ``uint8``, or ``linear16`` for noise to be added before the 8-bit store.
            lamps: What shines besides the sun, at most four.
            projector: What projects a pattern.
        """
        wanted = frozenset(targets)
        if not wanted or not wanted <= set(TARGETS) or colour not in STORES:
            raise ValueError(f"cannot draw {sorted(wanted)} as {colour!r}: {TARGETS}, {STORES}")
        if len(lamps) > MAX_LAMPS:
            raise ValueError(f"{len(lamps)} lamps are more than {MAX_LAMPS}")
        view = View(
            place=world_from_camera.matrix.tobytes(),
            intrinsics=intrinsics,
            water=water,
            light=light,
            wanted=wanted,
            hidden=hidden,
            store=colour,
            version=self._instances.version,
            lamps=tuple(lamps),
            projector=projector,
        )
        if lamps or projector is not None:
            return self._drawn(view, world_from_camera)
        kept = self._seen.get(view)
        return kept.copy() if kept is not None else self._drawn_once(view, world_from_camera)

    def close(self) -> None:
        """Release the graphics context; the renderer cannot be used afterwards."""
        self._context.release()

    def _drawn_once(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image; that of a view which was drawn lately will be asked for again: keep it."""
        image = self._drawn(view, world_from_camera)
        was_seen = view in self._seen
        self._seen[view] = image.copy() if was_seen and image.n_bytes <= MAX_KEPT else None
        if len(self._seen) > N_VIEWS:
            del self._seen[next(iter(self._seen))]
        return image

    def _drawn(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image and read it back."""
        with self._context:
            behind = self._begin(view, world_from_camera)
            return self._target(view).image(view.intrinsics, behind)

    def _begin(self, view: View, world_from_camera: Pose) -> Colours | None:
        """Issue the draw calls without waiting for them; returns the backdrop, if there is one."""
        water, light, hidden, lamps = view.water, view.light, view.hidden, view.lamps
        shown = self._instances.without(hidden)
        pinhole = projection(view.intrinsics)
        seen = in_view(self._instances, shown, world_from_camera, pinhole.planes)
        switches: Switches = water.switches + light.switches
        casters, may = shown[:0], np.zeros((len(seen), 0), dtype=bool)
        if "colour" in view.wanted and light.shadows:
            casters, may = self._cast(shown, seen, view, world_from_camera, pinhole)
        if lamps and "colour" in view.wanted:
            switches += (("LAMPS", len(lamps)),)
            self._shine(lamps, shown, world_from_camera, hidden)
        if view.projector is not None and "colour" in view.wanted:
            switches += (("PROJECTOR", 1),)
            self._project(view.projector, shown, world_from_camera, hidden)
        self._frame.fill(
            world_from_camera,
            view.intrinsics,
            pinhole.clip_from_camera,
            water,
            light,
            self._shadow,
        )
        self._slots.fill(self._instances, world_from_camera.inverse().matrix)
        is_close = self._instances.needs_no_copies(seen, world_from_camera, view.intrinsics)
        in_shadow = np.any(may, axis=1)
        drawn = [(int(n), bool(s), c) for n, s, c in zip(seen, in_shadow, is_close, strict=True)]
        target, backdrop = self._target(view), self._backdrop(view)
        behind = seen[:0] if backdrop is None else backdrop.find(self._instances, seen)
        # Without terrain there is little to be gained.
        if len(self._instances.casting(behind, MAX_CASTER_RADIUS)) < len(behind):
            assert backdrop is not None
            front, back = drawn[: len(seen) - len(behind)], drawn[len(seen) - len(behind) :]
            if backdrop.colours is None:
                lit = [(number, False, close) for number, _, close in back]
                self._passes.draw(target, lit, switches)
                lens, sun = view.intrinsics, sun_direction(light.sun)
                tiles = tiles_of(target.depths(), world_from_camera, lens, sun)
                backdrop.keep(target.colours(), tiles, behind)
            region = self._shaded(view, backdrop, casters)
            if region is not None:
                self._passes.draw_before(target, front, back, region, switches)
                return backdrop.colours
        self._passes.draw(target, drawn, switches)
        return None

    def _shaded(self, view: View, backdrop: Backdrop, casters: Numbers) -> Region | None:
        """Return where shadows may fall on a backdrop; None where it is too much."""
        lens, margin = view.intrinsics, MARGIN + 8.0 * self._shadow.lift
        sun = sun_direction(view.light.sun)
        region = shaded_region(backdrop.tiles, self._instances, casters, sun, margin)
        return region if region[2] * region[3] <= MAX_REGION * lens.width * lens.height else None

    def _backdrop(self, view: View) -> Backdrop | None:
        """Return the backdrop of a view; None if it can have none."""
        lens, bytes_per_pixel = view.intrinsics, 4 if view.store == "uint8" else 8
        is_small = bytes_per_pixel * lens.width * lens.height <= MAX_KEPT
        if not is_small or view.wanted != {"colour"} or view.lamps or view.projector is not None:
            return None
        stage = view.place, lens, view.water, view.light, view.hidden, view.store
        backdrop = self._backdrops.pop(stage, None) or Backdrop()
        self._backdrops[stage] = backdrop
        if len(self._backdrops) > N_VIEWS:
            del self._backdrops[next(iter(self._backdrops))]
        return backdrop

    def _cast(
        self,
        shown: Numbers,
        seen: Numbers,
        view: View,
        world_from_camera: Pose,
        pinhole: Projection,
    ) -> tuple[Numbers, npt.NDArray[np.bool_]]:
        """Update the shadow map; returns k casters, and on which batches each may cast, (n, k)."""
        instances, sun = self._instances, sun_direction(view.light.sun)
        casters = instances.casting(shown, MAX_CASTER_RADIUS)
        may = reached(instances, casters, seen, sun, world_from_camera, pinhole.corner_rays)
        is_needed = may.any(axis=0)
        if is_needed.any():
            self._shadow.update(instances, casters[is_needed], sun)
        return casters[is_needed], may[:, is_needed]

    def _shine(
        self,
        lamps: Sequence[Lamp],
        shown: Numbers,
        world_from_camera: Pose,
        hidden: frozenset[int],
    ) -> None:
        """Update the lamps and their shadow maps."""
        if self._lamps is None:
            self._lamps = Lamps(self._context)
        self._lamps.update(lamps, self._instances, shown, (self._instances.version, hidden))
        self._lamps.fill(lamps, world_from_camera)
        self._lamps.texture.use(SAMPLERS["lamp_maps"])

    def _project(
        self,
        projector: Projector,
        shown: Numbers,
        world_from_camera: Pose,
        hidden: frozenset[int],
    ) -> None:
        """Update the projector and its shadow map."""
        if self._projector is None:
            self._projector = ProjectorLight(self._context)
        version = self._instances.version, hidden
        self._projector.update(projector, self._instances, shown, version)
        self._projector.fill(projector, world_from_camera)
        self._projector.use(
            shadow_map=SAMPLERS["projector_map"], pattern=SAMPLERS["projector_pattern"]
        )

    def _target(self, view: View) -> Targets:
        size = view.intrinsics.width, view.intrinsics.height
        key = size, view.wanted, view.store
        if key not in self._targets:
            self._targets[key] = Targets(self._context, size, view.wanted, view.store)
        return self._targets[key]
