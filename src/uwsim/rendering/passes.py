"""The passes that draw batches into an image: surfaces, the background, what is seen through."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Sequence

import moderngl

from .brush import Brush
from .frame import FRAME
from .gpu_model import GpuModels
from .instance import INSTANCE, Instances, Slots
from .lights.lamps import LAMPS
from .lights.projector_light import PROJECTOR
from .lights.shadow_region import Region
from .lights.sun_shadow import SunShadow
from .program import build
from .targets import Targets

SAMPLERS = {
    "base_map": 0,
    "shadow_map": 1,
    "lamp_maps": 2,
    "projector_map": 3,
    "projector_pattern": 4,
}
"""Texture unit of every sampler in the shaders."""

Switches = tuple[tuple[str, int], ...]
"""Preprocessor switches of a shader and their values."""

Drawn = tuple[int, bool, bool]
"""Number of a batch, whether it may lie in shadow, and whether it needs no mipmaps."""

ColourMask = tuple[bool, bool, bool, bool]
"""Whether red, green, blue and alpha of a target are written."""


class Passes:
    """Draws batches whose places, lights and shadow map are up to date.

    Args:
        context: of the renderer.
        models: with the textures of the batches.
        instances: whose batches they are.
        slots: with the places of these.
        shadow: the sun's shadow map.
    """

    def __init__(
        self,
        context: moderngl.Context,
        models: GpuModels,
        instances: Instances,
        slots: Slots,
        shadow: SunShadow,
    ) -> None:
        self._context, self._models = context, models
        self._instances, self._slots, self._shadow = instances, slots, shadow
        self._programs: dict[tuple[object, ...], moderngl.Program] = {}
        self._empty: dict[int, moderngl.VertexArray] = {}

    def draw(
        self,
        target: Targets,
        drawn: Sequence[Drawn],
        switches: Switches,
    ) -> None:
        """Draw near and small instances first, terrain last, then the background, then glass.

        Args:
            target: Where to draw.
            drawn: The batches in view, near ones first.
            switches: Of all of them.
        """
        context = self._context
        batches = self._instances.numbered
        opacities = [batches[number][1].opacity for number, _, _ in drawn]
        draw = self._surface_pass(target, switches)
        self._clear(target)
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

    def draw_before(
        self,
        target: Targets,
        front: Sequence[Drawn],
        behind: Sequence[Drawn],
        region: Region,
        switches: Switches,
    ) -> None:
        """Draw what is in front of the backdrop, and the backdrop where shadows may fall on it.

        Args:
            target: Where to draw; what the backdrop fills stays clear.
            front: As in `draw`.
            behind: The batches of the backdrop.
            region: Where shadows may fall on them.
            switches: Of all of them.
        """
        self._clear(target)
        draw = self._surface_pass(target, switches)
        for one in front:
            draw(*one)
        clear, program = self._brush(), self._program("behind", target, ())
        for number, _, _ in behind:
            clear.draw(number, program)
        if region[2] > 0 and region[3] > 0:
            target.framebuffer.scissor = region
            target.framebuffer.use()
            draw = self._surface_pass(target, switches)
            # Those after the first in shadow, too: of two at one depth the later is seen.
            for one in itertools.dropwhile(lambda each: not each[1], behind):
                draw(*one)
            target.framebuffer.scissor = None  # type: ignore[assignment]  # no limits
        self._models.release(SAMPLERS["base_map"])

    def _clear(self, target: Targets) -> None:
        """Empty a target and bind it, for opaque batches."""
        target.framebuffer.use()
        target.framebuffer.clear(depth=1.0)
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._context.depth_func = "<="
        self._shadow.texture.use(SAMPLERS["shadow_map"])

    def _brush(self) -> Brush:
        # The image is upside down for OpenGL, so outside is clockwise.
        return Brush(self._context, self._instances, self._slots, outside="cw")

    def _surface_pass(
        self, target: Targets, switches: Switches
    ) -> Callable[[int, bool, bool], None]:
        """Return what draws a batch; its arguments are those of `Drawn`."""
        batches = self._instances.numbered
        brush = self._brush()

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
        clear: Sequence[tuple[Drawn, float]],
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


def _set_colour_masks(buffer: moderngl.Framebuffer, masks: Sequence[ColourMask]) -> None:
    """Say which channels of each target are written; moderngl takes that of a single one alone."""
    if len(masks) == 1:
        buffer.color_mask = masks[0]
    else:
        buffer.color_mask = masks  # type: ignore[assignment]  # one for each target
