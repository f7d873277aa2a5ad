"""The passes that draw batches into an image: surfaces, the background, transparent batches."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Sequence

import moderngl

from .batch_drawer import BatchDrawer
from .caustics.caustic_light import CAUSTICS
from .caustics.focused_light import SAMPLERS as FOCUSED_LIGHT_SAMPLERS
from .frame import FRAME
from .gpu_model import GpuModels
from .instance import INSTANCE, Instances, Slots
from .lights.lamps import LAMPS
from .lights.projector_light import PROJECTOR
from .lights.shadow_region import Region
from .lights.sun_shadow import SunShadow
from .materials.maps import Switches, find_mask, find_switches, find_used_maps
from .materials.reflectance import create_table
from .physical.optics_block import OPTICS
from .program import build
from .surface.surface_block import SURFACE
from .targets import Targets

SAMPLERS = {
    "base_map": 0,
    "shadow_map": 1,
    "lamp_maps": 2,
    "projector_map": 3,
    "projector_pattern": 4,
    "normal_map": 11,
    "finish_map": 12,
    "emission_map": 13,
    "reflectance_table": 14,
    **FOCUSED_LIGHT_SAMPLERS,
}
"""The texture unit of every sampler in the shaders."""

DrawnBatch = tuple[int, bool, bool]
"""The index of a batch, True if it may lie in shadow, and True if it is drawn without mipmaps."""

ColourMask = tuple[bool, bool, bool, bool]
"""The flags of red, green, blue and alpha: True if that channel of a target is written."""


class Passes:
    """The passes that draw batches; poses, lights and shadow maps must be up to date.

    Args:
        context: the context of the renderer.
        models: the models and textures on the GPU.
        instances: all instances.
        slots: the buffer with the poses of the instances.
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
        self._empty_arrays: dict[int, moderngl.VertexArray] = {}
        self._reflectance_table: moderngl.Texture | None = None

    def draw(
        self,
        target: Targets,
        batches_in_view: Sequence[DrawnBatch],
        switches: Switches,
        draw_surface: Callable[[], None] | None = None,
    ) -> None:
        """Draw opaque batches in the given order, then the background, then transparent batches.

        Args:
            target: the framebuffer.
            batches_in_view: the batches in view, near ones first.
            switches: the switches of the shaders for all batches.
            draw_surface: draws the water's surface before transparent batches; None: it is absent.
        """
        context = self._context
        batches = self._instances.numbered_batches
        opacities = [batches[index][1].opacity for index, _, _ in batches_in_view]
        draw = self._surface_pass(target, switches)
        self._clear(target)
        for batch, opacity in zip(batches_in_view, opacities, strict=True):
            if opacity >= 1.0:
                draw(*batch)
        self._models.release()
        context.disable(moderngl.CULL_FACE)
        is_physical = tuple(switch for switch in switches if switch[0] == "PHYSICAL")
        program = self._program("background", target, is_physical)
        if program.glo not in self._empty_arrays:
            self._empty_arrays[program.glo] = context.vertex_array(program, [])
        self._empty_arrays[program.glo].render(moderngl.TRIANGLES, vertices=3)
        if draw_surface is not None:
            draw_surface()
            context.enable_only(moderngl.DEPTH_TEST)
        transparent_batches = [
            (batch, opacity)
            for batch, opacity in zip(batches_in_view, opacities, strict=True)
            if opacity < 1.0
        ]
        if transparent_batches:
            self._draw_transparent(target, transparent_batches[::-1], switches)

    def draw_over_backdrop(
        self,
        target: Targets,
        front: Sequence[DrawnBatch],
        back: Sequence[DrawnBatch],
        region: Region,
        switches: Switches,
    ) -> None:
        """Draw the batches in front of the backdrop, and the backdrop where shadows may fall on it.

        Args:
            target: the framebuffer; alpha remains 0 where the backdrop is visible and not drawn.
            front: the batches in front of the backdrop, near ones first.
            back: the batches of the backdrop.
            region: the rectangle in which shadows may fall on the backdrop.
            switches: the switches of the shaders for all batches.
        """
        self._clear(target)
        draw = self._surface_pass(target, switches)
        for batch in front:
            draw(*batch)
        depth_drawer, program = self._create_drawer(), self._program("backdrop", target, ())
        for index, _, _ in back:
            depth_drawer.draw(index, program)
        if region[2] > 0 and region[3] > 0:
            target.framebuffer.scissor = region
            target.framebuffer.use()
            draw = self._surface_pass(target, switches)
            # All batches after the first in shadow, too: at equal depths, the later is visible.
            for batch in itertools.dropwhile(lambda drawn_batch: not drawn_batch[1], back):
                draw(*batch)
            target.framebuffer.scissor = None  # type: ignore[assignment]  # no limits
        self._models.release()

    def draw_lamp_points(self, target: Targets, n_lamps: int) -> None:
        """Add the lamps that the camera sees to an image of radiance and range."""
        context, buffer = self._context, target.framebuffer
        program = self._program("lamp_point", target, (("LAMPS", n_lamps),))
        if program.glo not in self._empty_arrays:
            self._empty_arrays[program.glo] = context.vertex_array(program, [])
        buffer.use()
        buffer.depth_mask = False
        _set_colour_masks(buffer, [(name == "colour",) * 4 for name in target.attachments])
        context.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND | moderngl.PROGRAM_POINT_SIZE)
        blending = moderngl.ONE, moderngl.ONE, moderngl.ONE, moderngl.ZERO  # colours, then alpha
        context.blend_func = blending  # type: ignore[assignment]
        self._empty_arrays[program.glo].render(moderngl.POINTS, vertices=n_lamps)
        _set_colour_masks(buffer, [(True, True, True, True)] * len(target.attachments))
        buffer.depth_mask = True
        context.enable_only(moderngl.NOTHING)

    def _clear(self, target: Targets) -> None:
        """Clear a target and bind it, for opaque batches."""
        target.framebuffer.use()
        target.framebuffer.clear(depth=1.0)
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._context.depth_func = "<="
        self._shadow.texture.use(SAMPLERS["shadow_map"])

    def _create_drawer(self) -> BatchDrawer:
        # The image is upside down for OpenGL, so visible triangles are clockwise.
        return BatchDrawer(self._context, self._instances, self._slots, winding="cw")

    def _surface_pass(
        self, target: Targets, switches: Switches
    ) -> Callable[[int, bool, bool], None]:
        """Return a function that draws a batch; its arguments are those of `DrawnBatch`."""
        batches = self._instances.numbered_batches
        drawer = self._create_drawer()
        has_colour, is_physical = "colour" in target.attachments, ("PHYSICAL", 1) in switches

        @functools.cache
        def program(in_shadow: bool, surface_switches: Switches) -> moderngl.Program:
            shadow_switches = (("SHADOWS", 1),) if in_shadow else ()
            if ("MICROFACET", 1) in surface_switches:
                self._use_reflectance_table()
            return self._program("surface", target, switches + shadow_switches + surface_switches)

        def draw(index: int, in_shadow: bool, skips_mipmaps: bool) -> None:
            batch = batches[index][1]
            surface_switches = find_switches(
                batch.texture, batch.material, has_colour=has_colour, is_physical=is_physical
            )
            maps = find_used_maps(batch.texture, batch.material, surface_switches)
            mask = find_mask(batch.texture, batch.material)
            hides_levels = "normal_map" in maps and not is_physical
            for name, texture in maps.items():
                is_base = name == "base_map"
                self._models.use(
                    texture,
                    SAMPLERS[name],
                    skips_mipmaps=skips_mipmaps,
                    skips_blending=not is_base or (hides_levels and mask is None),
                    cutoff=mask.cutoff if is_base and mask is not None else None,
                )
            drawer.draw(index, program(in_shadow, surface_switches))

        return draw

    def _use_reflectance_table(self) -> None:
        if self._reflectance_table is None:
            self._reflectance_table = create_table(self._context)
        self._reflectance_table.use(SAMPLERS["reflectance_table"])

    def _draw_transparent(
        self,
        target: Targets,
        transparent_batches: Sequence[tuple[DrawnBatch, float]],
        switches: Switches,
    ) -> None:
        """Blend transparent batches over the colours; range and ids are of the nearest surface."""
        context, buffer, attachments = self._context, target.framebuffer, target.attachments

        def write(*, has_colour: bool, has_others: bool) -> None:
            rgb = (has_colour, has_colour, has_colour, False)  # alpha stays 1
            other_mask = (has_others, has_others, has_others, has_others)
            masks = [rgb if name == "colour" else other_mask for name in attachments]
            _set_colour_masks(buffer, masks)

        visible_batches = [
            (batch, round(255.0 * opacity))
            for batch, opacity in transparent_batches
            if opacity > 0.0
        ]
        if "colour" in attachments:
            write(has_colour=True, has_others=False)
            buffer.depth_mask = False
            context.enable(moderngl.BLEND)
            context.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
            for batch, opacity in visible_batches:
                self._surface_pass(target, (*switches, ("OPACITY", opacity)))(*batch)
            context.disable(moderngl.BLEND)
            buffer.depth_mask = True
        if set(attachments) != {"colour"}:
            write(has_colour=False, has_others=True)
            draw = self._surface_pass(target, switches)
            for batch, _ in visible_batches:
                draw(*batch)
        _set_colour_masks(buffer, [(True, True, True, True)] * len(attachments))
        self._models.release()
        context.disable(moderngl.CULL_FACE)

    def _program(self, effect: str, target: Targets, switches: Switches) -> moderngl.Program:
        key = (effect, *target.attachments, *switches)
        if key not in self._programs:
            defines = {name.upper(): number for name, number in target.attachments.items()}
            self._programs[key] = build(
                self._context,
                effect,
                defines=defines | dict(switches),
                blocks=(FRAME, INSTANCE, LAMPS, PROJECTOR, OPTICS, CAUSTICS, SURFACE),
                samplers=SAMPLERS,
            )
        return self._programs[key]


def _set_colour_masks(buffer: moderngl.Framebuffer, masks: Sequence[ColourMask]) -> None:
    """Set the written channels of each target; moderngl takes one mask for a single target."""
    if len(masks) == 1:
        buffer.color_mask = masks[0]
    else:
        buffer.color_mask = masks  # type: ignore[assignment]  # one for each target
