"""The passes of the light that water scatters into an image: the blur and the veil of the lamps.

What each level of blur scatters is drawn at half the resolution, the wider levels at halves of the
resolution before. Then follow their Gaussians, and the sum from the widest level to the narrowest
with the veil of the lamps. The draw calls of a camera are listed once and repeated for each image.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import moderngl

from .blur_plan import MAX_LEVELS, BlurPlan, compute_radius
from .whole_images import Switches, WholeImagePasses

FIRST_LEVEL_UNIT = 7
"""The texture unit of the first level."""
LEVEL_SAMPLERS = {f"level_{i}": FIRST_LEVEL_UNIT + i for i in range(MAX_LEVELS - 2)}
"""The texture units of the levels."""
MAX_SMALL_LEVEL = 320
"""The largest level whose Gaussian is drawn along rows and columns at once, which takes less time
than two passes of few texels [texels]."""

Size = tuple[int, int]


@dataclass(frozen=True)
class DrawCall:
    """A triangle over a whole target."""

    array: moderngl.VertexArray
    """The program."""
    target: moderngl.Framebuffer
    """The framebuffer."""
    inputs: tuple[tuple[moderngl.Texture, int], ...]
    """The textures that are bound before, with their units."""


@dataclass(frozen=True)
class Level:
    """The textures of a coarse level of blur."""

    rows: moderngl.Framebuffer
    """The level after the Gaussian along its rows."""
    total: moderngl.Framebuffer
    """The level after its Gaussian, plus the wider levels."""


class Buffers:
    """The framebuffers of the blur for one size of images.

    Args:
        context: the context of the renderer.
        size: the width and height of the image [px].
        n_levels: the number of levels of blur.
    """

    def __init__(self, context: moderngl.Context, size: Size, n_levels: int) -> None:
        self.sources: list[moderngl.Framebuffer] = []
        """The scattered light: of the first level, with the mean light beside it; then of all the
        others; then of these without the narrowest; and so on."""
        self.levels: list[Level] = []
        """The blurred levels, the narrowest first; one at least."""
        for level in range(max(n_levels, 1)):
            size = _halve(size)
            n_textures = min(n_levels, 1) + 1 if level == 0 else n_levels - level
            textures = [create_texture(context, size) for _ in range(n_textures)]
            self.sources.append(context.framebuffer(textures))
            rows, total = (context.framebuffer([create_texture(context, size)]) for _ in range(2))
            self.levels.append(Level(rows, total))


class ScatteredLight:
    """The passes of blur and veil; one for a renderer.

    Args:
        context: the context of the renderer.
        passes: the programs.
        surface_unit: the texture unit of the image of surfaces.
    """

    def __init__(
        self, context: moderngl.Context, passes: WholeImagePasses, surface_unit: int
    ) -> None:
        self._context, self._passes, self._surface_unit = context, passes, surface_unit
        self._buffers: dict[object, Buffers] = {}
        self._draw_calls: dict[object, tuple[DrawCall, ...]] = {}

    def draw(self, plan: BlurPlan, size: Size, n_veils: int) -> moderngl.Texture:
        """Draw what the levels scatter, and the lamps' veil; return their sum.

        The image of surfaces, the open water and the weights must be bound. The unit of the image
        of surfaces has another texture afterwards.

        Args:
            plan: the plan of the blur.
            size: the width and height of the image [px].
            n_veils: the number of lamps whose veil is drawn.
        """
        key = size, n_veils, plan
        if key not in self._draw_calls:
            buffers_key = size, plan.n_levels
            if buffers_key not in self._buffers:
                self._buffers[buffers_key] = Buffers(self._context, size, plan.n_levels)
            buffers = self._buffers[buffers_key]
            self._draw_calls[key] = (
                *self._list_sources(buffers, plan.n_levels),
                *self._list_levels(buffers, plan, n_veils),
            )
        draw_calls = self._draw_calls[key]
        for call in draw_calls:
            for texture, unit in call.inputs:
                texture.use(unit)
            call.target.use()
            call.array.render(moderngl.TRIANGLES, vertices=3)
        return _textures(draw_calls[-1].target)[0]

    def _list_sources(self, buffers: Buffers, n_levels: int) -> Iterator[DrawCall]:
        """List the draw calls of what the levels scatter."""
        switches: Switches = (("N_LEVELS", min(n_levels, 1)),)
        yield self._call("scattered", switches, buffers.sources[0])
        if n_levels > 1:
            switches = (("WIDE", 1), ("N_LEVELS", n_levels - 1))
            mean = _textures(buffers.sources[0])[1], self._surface_unit
            yield self._call("scattered", switches, buffers.sources[1], mean)
        for finer_source, source in zip(buffers.sources[1:], buffers.sources[2:], strict=False):
            finer_levels = enumerate(_textures(finer_source)[1:], start=FIRST_LEVEL_UNIT)
            inputs = [(texture, unit) for unit, texture in finer_levels]
            switches = (("N_LEVELS", len(inputs)),)
            yield self._call("reduced", switches, source, *inputs)

    def _list_levels(self, buffers: Buffers, plan: BlurPlan, n_veils: int) -> Iterator[DrawCall]:
        """List the draw calls of the Gaussians and the sums, the widest level first."""
        for number in reversed(range(len(buffers.levels))):
            texture, level = _textures(buffers.sources[number])[0], buffers.levels[number]
            spread = plan.spreads[number] if plan.n_levels else 0.0
            kernel: Switches = (
                ("RADIUS", compute_radius(spread)),
                ("SPREAD", round(1000.0 * spread)),
            )
            is_small = texture.width * texture.height <= MAX_SMALL_LEVEL
            if spread > 0.0 and not is_small:
                yield self._call("blurred_rows", kernel, level.rows, (texture, FIRST_LEVEL_UNIT))
                texture = _textures(level.rows)[0]
            switches, inputs = kernel, [(texture, FIRST_LEVEL_UNIT)]
            if spread > 0.0 and is_small:
                switches += (("SQUARE", 1),)
            if number + 1 < len(buffers.levels):
                wider_total = _textures(buffers.levels[number + 1].total)[0]
                inputs.append((wider_total, FIRST_LEVEL_UNIT + 1))
                switches += (("WIDER", 1),)
            if number == 0 and n_veils:
                inputs.append((_textures(buffers.sources[0])[-1], FIRST_LEVEL_UNIT + 2))
                switches += (("LAMPS", n_veils),)
            if plan.n_levels == 0:
                switches += (("VEIL_ONLY", 1),)
            yield self._call("blurred", switches, level.total, *inputs)

    def _call(
        self,
        effect: str,
        switches: Switches,
        target: moderngl.Framebuffer,
        *inputs: tuple[moderngl.Texture, int],
    ) -> DrawCall:
        return DrawCall(self._passes.find_array(effect, switches), target, inputs)


def create_texture(context: moderngl.Context, size: Size) -> moderngl.Texture:
    """Create a texture of four floats that is interpolated, and continued at its edges."""
    texture = context.texture(size, 4, dtype="f4")
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture


def _textures(framebuffer: moderngl.Framebuffer) -> tuple[moderngl.Texture, ...]:
    return tuple(
        texture
        for texture in framebuffer.color_attachments
        if isinstance(texture, moderngl.Texture)
    )


def _halve(size: Size) -> Size:
    width, height = size
    return -(-width // 2), -(-height // 2)
