"""The renderer: instances of models in, images out.

One forward pass draws colour, range and ids, whichever are requested, through UWSim's water
(`rendering.water`). What is seen through is blended over the rest, the farthest first. Not
modelled: the water's surface, caustics, reflections, refraction.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import moderngl
import numpy as np

from ..assets.mesh import Model
from ..base.geometry import Array, Intrinsics, Pose
from ..devices.lamp import MAX_LAMPS
from .brush import Brush
from .context import create_context
from .frame import FRAME, Frame
from .gpu_model import GpuModels
from .instance import INSTANCE, Instances, Numbers, Slots, in_view
from .lights.lamp import Lamp
from .lights.lamps import LAMPS, Lamps
from .lights.projector import Projector
from .lights.projector_light import PROJECTOR, ProjectorLight
from .lights.sun_shadow import MAX_CASTER_RADIUS, SunShadow, reached
from .program import build
from .projection import Projection, projection
from .rendered_image import RenderedImage
from .targets import STORES, TARGETS, Targets
from .water import Light, Water, sun_direction

__all__ = ["RenderedImage", "Renderer"]

SAMPLERS = {
    "base_map": 0,
    "shadow_map": 1,
    "lamp_maps": 2,
    "projector_map": 3,
    "projector_pattern": 4,
}
"""Texture unit of every sampler in the shaders."""

N_VIEWS = 4
"""So many of the last views are remembered."""
MAX_KEPT = 2**23
"""The largest image that is kept for a view that stays as it is [bytes]."""

Switches = tuple[tuple[str, int], ...]
"""Preprocessor switches of a shader and their values."""

ColourMask = tuple[bool, bool, bool, bool]
"""Whether red, green, blue and alpha of a target are written."""


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
        self._programs: dict[tuple[object, ...], moderngl.Program] = {}
        self._empty: dict[int, moderngl.VertexArray] = {}
        self._targets: dict[tuple[object, ...], Targets] = {}
        self._frame = Frame(self._context)
        self._slots = Slots(self._context)
        self._shadow = SunShadow(self._context)
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
            self._begin(view, world_from_camera)
            return self._target(view).image(view.intrinsics)

    def _begin(self, view: View, world_from_camera: Pose) -> None:
        """Issue the draw calls without waiting for them."""
        water, light, hidden, lamps = view.water, view.light, view.hidden, view.lamps
        shown = self._instances.without(hidden)
        pinhole = projection(view.intrinsics)
        seen = in_view(self._instances, shown, world_from_camera, pinhole.planes)
        switches: Switches = water.switches + light.switches
        in_shadow = [False] * len(seen)
        if "colour" in view.wanted and light.shadows:
            in_shadow = self._cast(shown, seen, view, world_from_camera, pinhole)
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
        drawn = list(zip(seen.tolist(), in_shadow, is_close, strict=True))
        self._draw_into(self._target(view), drawn, switches)

    def _cast(
        self,
        shown: Numbers,
        seen: Numbers,
        view: View,
        world_from_camera: Pose,
        pinhole: Projection,
    ) -> list[bool]:
        """Update the shadow map; returns which visible batches may be in shadow."""
        instances, sun = self._instances, sun_direction(view.light.sun)
        casters = instances.casting(shown, MAX_CASTER_RADIUS)
        may = reached(instances, casters, seen, sun, world_from_camera, pinhole.corner_rays)
        is_needed = may.any(axis=0)
        if is_needed.any():
            self._shadow.update(instances, casters[is_needed], sun)
        return [bool(one) for one in np.any(may, axis=1)]

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

    def _draw_into(
        self, target: Targets, drawn: Sequence[tuple[int, bool, bool]], switches: Switches
    ) -> None:
        """Draw near and small instances first, terrain last, then the background, then glass.

        Args:
            target: Where to draw.
            drawn: Number of each batch, whether it may lie in shadow, and whether its texture
                needs no smaller copies; near ones first.
            switches: Of all of them.
        """
        context = self._context
        batches = self._instances.numbered
        opacities = [batches[number][1].opacity for number, _, _ in drawn]
        draw = self._surface_pass(target, switches)
        target.framebuffer.use()
        target.framebuffer.clear(depth=1.0)  # of no account: every pixel is drawn
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        self._shadow.texture.use(SAMPLERS["shadow_map"])
        for one, opacity in zip(drawn, opacities, strict=True):
            if opacity >= 1.0:
                draw(*one)
        self._models.release(SAMPLERS["base_map"])
        context.disable(moderngl.CULL_FACE)
        program = self._program("background", target, ())
        if program.glo not in self._empty:
            self._empty[program.glo] = context.vertex_array(program, [])
        self._empty[program.glo].render(moderngl.TRIANGLES, vertices=3)
        clear = [
            (one, opacity) for one, opacity in zip(drawn, opacities, strict=True) if opacity < 1.0
        ]
        if clear:
            self._draw_glass(target, clear[::-1], switches)

    def _surface_pass(
        self, target: Targets, switches: Switches
    ) -> Callable[[int, bool, bool], None]:
        """Return what draws a batch, told as in `_draw_into`."""
        batches = self._instances.numbered
        # The image is upside down for OpenGL, so outside is clockwise.
        brush = Brush(self._context, self._instances, self._slots, outside="cw")

        @functools.cache
        def program(in_shadow: bool, is_textured: bool) -> moderngl.Program:
            own = {"SHADOWS": in_shadow, "TEXTURED": is_textured}
            present = tuple((name, 1) for name, value in own.items() if value)
            return self._program("surface", target, switches + present)

        def draw(number: int, in_shadow: bool, is_close: bool) -> None:
            texture = batches[number][1].texture
            if texture is not None:
                self._models.use(texture, SAMPLERS["base_map"], is_close=is_close)
            brush.draw(number, program(in_shadow, texture is not None))

        return draw

    def _draw_glass(
        self,
        target: Targets,
        clear: Sequence[tuple[tuple[int, bool, bool], float]],
        switches: Switches,
    ) -> None:
        """Blend transparent batches over the colours; range and ids are those of the nearest."""
        context, buffer, places = self._context, target.framebuffer, target.places

        def write(*, colour: bool, rest: bool) -> None:
            rgb = (colour, colour, colour, False)  # alpha stays 1
            others = (rest, rest, rest, rest)
            masks = [rgb if name == "colour" else others for name in places]
            _set_colour_masks(buffer, masks)

        shown = [(one, round(255.0 * opacity)) for one, opacity in clear if opacity > 0.0]
        if "colour" in places:
            write(colour=True, rest=False)
            buffer.depth_mask = False
            context.enable(moderngl.BLEND)
            context.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
            for one, opacity in shown:
                self._surface_pass(target, (*switches, ("OPACITY", opacity)))(*one)
            context.disable(moderngl.BLEND)
            buffer.depth_mask = True
        if set(places) != {"colour"}:
            write(colour=False, rest=True)
            draw = self._surface_pass(target, switches)
            for one, _ in shown:
                draw(*one)
        _set_colour_masks(buffer, [(True, True, True, True)] * len(places))
        self._models.release(SAMPLERS["base_map"])
        context.disable(moderngl.CULL_FACE)

    def _program(self, effect: str, target: Targets, switches: Switches) -> moderngl.Program:
        key = (effect, *target.places, *switches)
        if key not in self._programs:
            defines = {name.upper(): place for name, place in target.places.items()}
            self._programs[key] = build(
                self._context,
                effect,
                defines=defines | dict(switches),
                blocks=(FRAME, INSTANCE, LAMPS, PROJECTOR),
                samplers=SAMPLERS,
            )
        return self._programs[key]

    def _target(self, view: View) -> Targets:
        size = view.intrinsics.width, view.intrinsics.height
        key = size, view.wanted, view.store
        if key not in self._targets:
            self._targets[key] = Targets(self._context, size, view.wanted, view.store)
        return self._targets[key]


def _set_colour_masks(buffer: moderngl.Framebuffer, masks: Sequence[ColourMask]) -> None:
    """Say which channels of each target are written; moderngl takes that of a single one alone."""
    if len(masks) == 1:
        buffer.color_mask = masks[0]
    else:
        buffer.color_mask = masks  # type: ignore[assignment]  # one for each target
