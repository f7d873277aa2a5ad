r"""The passes that add the water's surface, the sky and the air to an image of surfaces.

The image of surfaces has the radiance of bodies and their range. The first pass draws the surface
where no body is nearer; the second gives other pixels that begin in air the sky, or bodies through
air.
A body that pierces the surface is therefore cut by each pixel, and a camera at the water line sees
air above and water below it. The output has the same form: radiance, and the range in water.

From below, unpolarised light of the sky is refracted into Snell's window and reflected in part
(Fresnel); radiance in water is :math:`n^2` times that in air. Outside of the window the surface
mirrors the open water. The range is that of the surface, so that water before it follows with its
blur, as before any body. From above, the sky is reflected, the sun glitters by the slopes that
pixels do not resolve (C. Cox and W. Munk, *J. Opt. Soc. Am.* 44, 838 (1954)), and light from below
is divided by :math:`n^2`: of the open water, and of bodies that the whole field of their light
reaches, without blur. Their image is refracted within the picture. Air takes contrast: 2 % are left
at the visibility (H. Koschmieder, *Beitr. Phys. freien Atmos.* 12, 33 (1924)).

Bodies on the side of the camera are mirrored by a second view (`mirror_view`). Where crests break,
foam covers the surface (`foam.glsl`): from a downward acceleration of 0.35 g on, as the mean of its
threads and gaps. It neither outlasts its crest nor drifts.

Not modelled: bodies above the water in Snell's window,
light that breaking waves take into the water, blur of water that is seen from above.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import moderngl
import numpy as np

from ...base.geometry import Intrinsics, Pose
from ...optics import compute_full_field
from ..materials.maps import Switches
from ..physical.moving_surface import MovingSurface
from ..physical.optics_block import OPTICS
from ..physical.physical_water import PhysicalWater
from ..program import build
from ..targets import RADIANCE, Targets
from .hemispheres import Hemispheres
from .ripples import RippleTile
from .sky import compute_sky
from .surface_block import SURFACE, SurfaceBlock
from .surface_mesh import COARSE_STEP, SurfaceMesh, find_view
from .wave_grids import WaveGrids

SAMPLERS = {
    "surface_image": 0,
    "open_water_map": 5,
    "weight_table": 6,
    "mirror_image": 6,
    "wave_grids": 7,
    "wave_grid": 7,
    "ripple_tile": 8,
    "hemispheres": 15,
}
"""The texture unit of every sampler of these passes. Those of the first pass of bodies, which
continues with transparent ones, are not among them."""
MIN_VISIBLE_SHARE = 0.01
"""The share of light from the surface below which a camera under water does not see it [1]."""


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """The draw calls of an image."""

    switches: Switches
    """The switches of the shaders."""
    sides: tuple[bool, ...]
    """The sides of the surface that are drawn: True is from above."""
    is_above: bool
    """True if the camera is above the still surface."""
    sectors: tuple[tuple[int, int], ...]
    """The first index and the number of indices of each part of the mesh."""

    @property
    def is_direct(self) -> bool:
        """True if the whole camera is under water: the surface is drawn among the bodies."""
        return self.sides == (False,)


class SurfacePass:
    """The passes of the water's surface; one for a renderer.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._block = SurfaceBlock(context)
        self._grids = WaveGrids(context)
        self._ripples = RippleTile(context)
        self._hemispheres = Hemispheres(context)
        self._fine_mesh, self._coarse_mesh = (
            SurfaceMesh(context),
            SurfaceMesh(context, COARSE_STEP),
        )
        self._targets: dict[tuple[int, int], Targets] = {}
        self._drawing = Drawing(switches=(), sides=(), is_above=True, sectors=())
        self._mirror: moderngl.Texture | None = None
        self._programs: dict[object, tuple[moderngl.Program, moderngl.VertexArray]] = {}

    def prepare(
        self,
        water: PhysicalWater,
        surface: MovingSurface | None,
        surface_height: float,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        light_rate: float,
    ) -> None:
        """Fill the textures and the block ``Surface``, before bodies are drawn.

        Args:
            water: the water and its light.
            surface: the waves; None: the surface is level.
            surface_height: the height of the still surface in W [m].
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole of the camera.
            light_rate: the factor on daylight.
        """
        grids = self._grids
        grids.set_surface(surface)
        height = float(world_from_camera.position[2]) - surface_height
        bound = grids.max_elevation + 2.0 * intrinsics.near
        sides = tuple(
            side for side, is_seen in ((True, height > -bound), (False, height < bound)) if is_seen
        )
        view = find_view(world_from_camera, intrinsics, height, bound)
        if sides == (False,):
            view = replace(view, max_radius=min(view.max_radius, find_visible_range(water)))
        switches: Switches = ()
        variance = 0.0
        if surface is not None and surface.waves is not None and view.sectors:
            variance = grids.slope_variance
            if sides == (False,):
                grids.update_near(surface.time, world_from_camera.position, view.max_radius)
            else:
                grids.update(surface.time, world_from_camera.position)
            switches += (("WAVES", len(grids.frames)),)
            if grids.has_foam:
                switches += (("FOAM", 1),)
        ripples, ripple_variance = water.ripples, 0.0
        if surface is not None and ripples is not None:
            missing_variance = 0.5 * sum(ripples.slope_variances) - variance
            ripple_variance = max(missing_variance, ripples.short_wave_variance)
        if surface is not None and ripples is not None and ripple_variance > 0.0:
            self._ripples.update(surface.seed, surface.time, ripples.direction)
            switches += (("RIPPLES", 1),)
        sky = compute_sky(water.daylight)
        self._hemispheres.update(water, sky, light_rate)
        self._block.fill(
            water,
            sky,
            grids,
            height=height,
            ripple_variance=ripple_variance,
            world_from_camera=world_from_camera,
            intrinsics=intrinsics,
            light_rate=light_rate,
        )
        self._mirror = None
        self._drawing = Drawing(
            switches=switches,
            sides=sides,
            is_above=height > 0.0,
            sectors=self._find_mesh(sides).find_ranges(view),
        )

    @contextmanager
    def turn_to(self, mirror_pose: Pose, world_from_camera: Pose) -> Iterator[None]:
        """Let ``Surface`` have the rotation of the camera of the mirror for some time."""
        self._block.turn(mirror_pose.rotation)
        yield
        self._block.turn(world_from_camera.rotation)

    def set_mirror(self, mirror: moderngl.Texture | None) -> None:
        """Set the image of mirrored bodies, radiance and range; None: there are none."""
        self._mirror = mirror

    @property
    def is_visible(self) -> bool:
        """True if the camera may see the surface."""
        return bool(self._drawing.sectors)

    @property
    def is_dry(self) -> bool:
        """True if the whole camera is in air: no water is in front of the surface."""
        return self._drawing.sides == (True,)

    @property
    def is_direct(self) -> bool:
        """True if `draw_among` draws the surface; else `draw` does."""
        return self._drawing.is_direct

    def draw_among(self, target: Targets) -> None:
        """Draw the surface from below among opaque bodies, after the background.

        ``Optics`` and its textures must be bound.

        Args:
            target: the radiance and the range of bodies, and their depths.
        """
        if not self._drawing.sectors:
            return
        target.write_colour_only()
        self._use_textures()
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._draw_sides((("DIRECT", 1),))
        target.write_all()

    def draw(
        self, intrinsics: Intrinsics, bodies: moderngl.Texture, *, searches_bodies: bool
    ) -> moderngl.Texture:
        """Draw the surface and the sky into a copy of an image of bodies.

        ``Optics`` and its textures must be bound.

        Args:
            intrinsics: the pinhole of the camera.
            bodies: the radiance and the range of bodies, four floats.
            searches_bodies: True to look for mirrored bodies above the surface in the picture.

        Returns:
            The radiance and the range in water, four floats.
        """
        context, size = self._context, (intrinsics.width, intrinsics.height)
        if size not in self._targets:
            self._targets[size] = Targets(context, size, frozenset({"colour"}), RADIANCE)
        target = self._targets[size]
        bodies.use(SAMPLERS["surface_image"])
        self._use_textures()
        target.framebuffer.use()
        target.framebuffer.clear(depth=1.0)
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<"
        self._draw_sides((("BODIES_ABOVE", 1),) if searches_bodies else ())
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        self._array("air", "screen", (("BEHIND", 1),)).render(moderngl.TRIANGLES, vertices=3)
        context.enable_only(moderngl.NOTHING)
        return target.radiance

    def _draw_sides(self, switches: Switches) -> None:
        """Draw the visible sides of the surface."""
        context = self._context
        context.enable(moderngl.CULL_FACE)
        context.front_face = "cw"  # the image is upside down for OpenGL
        for is_above in self._drawing.sides:
            context.cull_face = "back" if is_above else "front"
            side: Switches = (("ABOVE", 1),) if is_above else ()
            if self._mirror is not None and is_above == self._drawing.is_above:
                side += (("MIRROR", 1),)
            array = self._array("water_surface", "water_surface", switches + side)
            for first, n in self._drawing.sectors:
                array.render(moderngl.TRIANGLES, vertices=n, first=first)
        context.cull_face = "back"
        context.front_face = "ccw"
        context.enable_only(moderngl.NOTHING)

    def _use_textures(self) -> None:
        self._grids.texture.use(SAMPLERS["wave_grids"])
        self._grids.near_texture.use(SAMPLERS["wave_grid"])
        self._ripples.texture.use(SAMPLERS["ripple_tile"])
        self._hemispheres.texture.use(SAMPLERS["hemispheres"])
        if self._mirror is not None:
            self._mirror.use(SAMPLERS["mirror_image"])

    def _find_mesh(self, sides: tuple[bool, ...]) -> SurfaceMesh:
        """Return the mesh for the visible sides of the surface."""
        return self._coarse_mesh if sides == (False,) else self._fine_mesh

    def _array(self, effect: str, vertex: str, switches: Switches) -> moderngl.VertexArray:
        switches += self._drawing.switches
        mesh = self._find_mesh(self._drawing.sides)
        key = effect, switches, mesh is self._fine_mesh
        if key not in self._programs:
            program = build(
                self._context,
                effect,
                defines=dict(switches),
                blocks=(OPTICS, SURFACE),
                samplers=SAMPLERS,
                vertex=vertex,
            )
            content = [] if vertex == "screen" else [(mesh.vertices, "2f", "vertex")]
            indices = None if vertex == "screen" else mesh.indices
            self._programs[key] = program, self._context.vertex_array(program, content, indices)
        return self._programs[key][1]


def find_visible_range(water: PhysicalWater) -> float:
    """Return the range beyond which less than `MIN_VISIBLE_SHARE` of light arrives [m]."""
    ranges = np.array([2.0 * 1.25**step for step in range(48)])
    shares = compute_full_field(water.medium, ranges).max(axis=-1)
    visible_ranges = ranges[shares > MIN_VISIBLE_SHARE]
    return float(visible_ranges[-1]) * 1.25 if len(visible_ranges) else float(ranges[0])
