"""The renderer: it draws images of instances of models, seen through water.

One forward pass draws the requested targets: colour through the water (`rendering.water`), range
and ids. Transparent surfaces are blended over the others, the farthest first. The water's
surface, caustics and light shafts are those of physical water. Not modelled: reflections in
other surfaces.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model
from ..base.geometry import Array, Intrinsics, Pose
from ..devices.lamp import MAX_LAMPS
from .backdrop import Backdrop, Backdrops, Colours
from .caustics.focused_light import FocusedLight
from .context import create_context
from .frame import Frame
from .gpu_model import GpuModels
from .instance import Indices, Instances, Slots, find_visible
from .lights.artificial_light import ArtificialLight
from .lights.caster_programs import CasterPrograms
from .lights.shadow_region import Region, compute_tile_bounds, find_shaded_region
from .lights.sun_shadow import (
    HULL_MARGIN,
    MAX_CASTER_RADIUS,
    MAX_HULL_RADIUS,
    SHADOW_MARGIN,
    SunShadow,
    find_shadow_pairs,
)
from .materials.maps import Switches
from .passes import SAMPLERS, Passes
from .physical.development import Development
from .physical.view import NO_CONTENTS, View, ViewContents
from .projection import Projection, projection
from .rendered_image import RenderedImage
from .surface.mirror_view import find_mirror_view
from .surface.surface_pass import SurfacePass, find_visible_range
from .targets import LIGHT, RADIANCE, TARGETS, Targets, check_targets
from .water import Light, Water, find_sun_direction

__all__ = ["RenderedImage", "Renderer"]

N_VIEWS = 4
"""The number of recent views whose images and backdrops are stored."""
MAX_SHADED_SHARE = 0.75
"""The largest fraction of an image in which the backdrop is drawn again for shadows [1]; above it,
to draw the whole image takes less time."""
MAX_STORED_BYTES = 2**24
"""The largest image that is stored for a view that does not change [bytes]."""


class Renderer:
    """A renderer of instances of models from any camera pose.

    Use it from one thread; a process may have several. `close` releases everything.

    Raises:
        NoGraphics: no OpenGL context is available.
    """

    def __init__(self) -> None:
        self._context = create_context()
        facts = self._context.info
        self.description = f"{facts['GL_RENDERER']}, {facts['GL_VERSION']}"
        """The driver: ``llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6``."""
        self._models = GpuModels(self._context)
        self._instances = Instances()
        self._targets: dict[tuple[object, ...], Targets] = {}
        self._frame = Frame(self._context)
        self._slots = Slots(self._context)
        caster_programs = CasterPrograms(self._context, self._models)
        self._shadow = SunShadow(self._context, caster_programs)
        self._backdrops = Backdrops(N_VIEWS, MAX_STORED_BYTES)
        self._passes = Passes(
            self._context, self._models, self._instances, self._slots, self._shadow
        )
        self._artificial_light = ArtificialLight(
            self._context, self._instances, SAMPLERS, caster_programs
        )
        self._development: Development | None = None
        self._focused_light = FocusedLight(self._context)
        self._surface_pass: SurfacePass | None = None
        self._images: dict[View, RenderedImage | None] = {}  # of recent views, the newest last

    def add(self, model: Model, id: int) -> int:
        """Add a model at the origin of W; return the handle for `place` and `remove`.

        Args:
            model: the model; it is uploaded once, however often it is added.
            id: the number in the id image, 1..65535; several instances may have the same.
        """
        if not 1 <= id <= 65535:
            raise ValueError(f"the id {id} is not in 1..65535")
        with self._context:
            batches = self._models.upload(model)
        return self._instances.add(batches, id)

    def place(self, handle: int, world_from_model: Array) -> None:
        """Set the pose of an instance; the matrix, (4, 4), may include scale."""
        self.place_all((handle,), np.asarray(world_from_model, dtype=np.float64)[None])

    def place_all(self, handles: Sequence[int], world_from_model: Array) -> None:
        """Set the poses of several instances; the matrices, (n, 4, 4), may include scale."""
        self._instances.place(handles, world_from_model)

    def remove(self, handle: int) -> None:
        """Remove an instance."""
        self._instances.remove(handle)

    def discard(self, model: Model) -> None:
        """Free the memory of a model, all of whose instances were removed."""
        with self._context:
            self._models.discard(model)

    def clear(self) -> None:
        """Remove every instance; uploaded models remain on the GPU for the next scenes."""
        self._images.clear()
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
        hidden_ids: frozenset[int] = frozenset(),
        colour: str = "uint8",
        contents: ViewContents = NO_CONTENTS,
    ) -> RenderedImage:
        """Draw one image.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole of the camera.
            water: the water between surfaces and camera.
            light: the light of the scene.
            targets: some of ``colour``, ``range``, ``ids``; nothing else is computed.
            hidden_ids: the ids of instances that are not drawn and cast no shadows.
            colour: the format of colours: ``uint8``, ``linear16`` if noise is added before
                conversion to 8 bit, or ``light`` in physical water, for a camera's response.
            contents: the lamps, projector, surface and particles.
        """
        names = frozenset(targets)
        check_targets(names, colour, has_physical_water=water.physical_water is not None)
        lamps, surface = tuple(contents.lamps), contents.surface
        if len(lamps) > MAX_LAMPS:
            raise ValueError(f"{len(lamps)} lamps are more than {MAX_LAMPS}")
        view = View(
            pose=world_from_camera.matrix.tobytes(),
            intrinsics=intrinsics,
            water=water,
            light=light,
            targets=names,
            hidden_ids=hidden_ids,
            colour_format=colour,
            version=self._instances.version,
            lamps=lamps,
            projector=contents.projector,
            surface=surface if water.physical_water is not None and "colour" in names else None,
            particles=contents.particles,
        )
        if contents.projector is not None or contents.particles is not None:
            return self._draw_view(view, world_from_camera)
        image = self._images.get(view)
        return image.copy() if image is not None else self._draw_and_store(view, world_from_camera)

    def close(self) -> None:
        """Release the graphics context; the renderer cannot be used afterwards."""
        self._context.release()

    def _draw_and_store(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image, and store it if its view was drawn before: another request is likely."""
        image = self._draw_view(view, world_from_camera)
        is_repeated = view in self._images
        self._images[view] = (
            image.copy() if is_repeated and image.n_bytes <= MAX_STORED_BYTES else None
        )
        if len(self._images) > N_VIEWS:
            del self._images[next(iter(self._images))]
        return image

    def _draw_view(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image and read it back."""
        with self._context:
            if view.is_physical:
                return (
                    self._draw_with_margin(view, world_from_camera)
                    if any(view.margin)
                    else self._draw_physical(view, world_from_camera)
                )
            background = self._issue_draw_calls(view, world_from_camera)
            return self._find_targets(view).read_image(view.intrinsics, background)

    def _draw_with_margin(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image whose colours have light from a margin around it."""
        columns, rows = view.margin
        wide_view = replace(
            view,
            intrinsics=view.intrinsics.with_margin(columns, rows),
            targets=frozenset({"colour"}),
        )
        colours = self._draw_physical(wide_view, world_from_camera)
        image = colours.crop(view.intrinsics, columns, rows)
        other_view = replace(view, targets=view.targets - {"colour"})
        if other_view.targets:
            self._issue_draw_calls(other_view, world_from_camera)
            other_image = self._find_targets(other_view).read_image(view.intrinsics)
            image = replace(image, range=other_image.range, ids=other_image.ids)
        return image

    def _draw_physical(self, view: View, world_from_camera: Pose) -> RenderedImage:
        """Draw an image through physical water: surfaces first, then whole images."""
        physical_water, lens = view.water.physical_water, view.intrinsics
        assert physical_water is not None
        if self._development is None:
            self._development = Development(self._context)
        self._development.prepare(
            physical_water,
            world_from_camera,
            lens,
            surface_height=view.water.surface_height,
            lamps=view.lamps,
            light_rate=view.light.rate,
        )
        if physical_water.has_surface:
            if self._surface_pass is None:
                self._surface_pass = SurfacePass(self._context)
            self._surface_pass.prepare(
                physical_water,
                view.surface,
                view.water.surface_height,
                world_from_camera,
                lens,
                view.light.rate,
            )
            if physical_water.has_mirror and self._surface_pass.is_visible:
                self._surface_pass.set_mirror(self._draw_mirror(view, world_from_camera))
        focusing_switches = self._focused_light.prepare(
            physical_water,
            view.surface,
            world_from_camera,
            view.water.surface_height,
            view.water.surface_height - self._instances.find_lowest_point(MAX_CASTER_RADIUS),
        )
        surface_view = replace(view, colour_format=RADIANCE, switches=focusing_switches)
        self._issue_draw_calls(surface_view, world_from_camera)
        surfaces = self._find_targets(surface_view)
        if view.lamps:
            self._passes.draw_lamp_points(surfaces, len(view.lamps))
        radiance = surfaces.radiance
        surface_pass = self._surface_pass if physical_water.has_surface else None
        if surface_pass is not None and not surface_pass.is_direct:
            self._development.use_textures()
            radiance = surface_pass.draw(
                lens, radiance, searches_bodies=not physical_water.has_mirror
            )
        is_dry = surface_pass is not None and surface_pass.is_dry
        target = self._find_targets(replace(view, targets=frozenset({"colour"})))
        self._development.develop(
            physical_water,
            lens,
            len(view.lamps),
            radiance,
            target.framebuffer,
            view.particles,
            None
            if is_dry
            else self._focused_light.draw_shafts(physical_water, view.surface, lens, radiance),
            is_exposed=view.colour_format != LIGHT,
            is_dry=is_dry,
        )
        colour = target.read_image(lens).colour
        return replace(surfaces.read_image(lens), colour=colour, image_model="physical")

    def _draw_mirror(self, view: View, world_from_camera: Pose) -> moderngl.Texture | None:
        """Draw the bodies that the surface mirrors; return None if there are none in view."""
        water, surface_height = view.water.physical_water, view.water.surface_height
        assert water is not None
        assert self._surface_pass is not None
        is_above = world_from_camera.position[2] > surface_height
        has_waves = view.surface is not None and view.surface.waves is not None
        pose, lens = find_mirror_view(
            world_from_camera,
            view.intrinsics,
            surface_height,
            view.intrinsics.far if is_above else find_visible_range(water),
            has_waves=has_waves,
        )
        indices = self._instances.find_shown(view.hidden_ids)
        heights = self._instances.corners[indices, :, 2] - surface_height
        is_mirrored = ((heights if is_above else -heights) > 0.0).any(axis=1)
        planes = projection(lens).planes
        if not len(find_visible(self._instances, indices[is_mirrored], pose, planes)):
            return None
        switches: Switches = (("MIRROR", 1 if is_above else 2),)
        if not has_waves:
            floor_depth = surface_height - self._instances.find_lowest_point(MAX_CASTER_RADIUS)
            switches += self._focused_light.prepare(
                water, view.surface, pose, surface_height, floor_depth
            )
        mirror_view = replace(
            view,
            intrinsics=lens,
            targets=frozenset({"colour"}),
            colour_format=RADIANCE,
            switches=switches,
        )
        with self._surface_pass.turn_to(pose, world_from_camera):
            self._issue_draw_calls(mirror_view, pose)
        radiance = self._find_targets(mirror_view).radiance
        radiance.filter = (moderngl.NEAREST, moderngl.NEAREST)  # ranges are not to be mixed
        radiance.repeat_x = radiance.repeat_y = False  # beyond the image is what is at its edge
        return radiance

    def _issue_draw_calls(self, view: View, world_from_camera: Pose) -> Colours | None:
        """Issue the draw calls without waiting for them; return the backdrop, if there is one."""
        water, light, hidden_ids = view.water, view.light, view.hidden_ids
        candidates = self._instances.find_shown(hidden_ids)
        pinhole = projection(view.intrinsics)
        indices = find_visible(self._instances, candidates, world_from_camera, pinhole.planes)
        switches: Switches = water.switches + light.switches + view.switches
        casters, may_cast = candidates[:0], np.zeros((len(indices), 0), dtype=bool)
        if "colour" in view.targets and light.shadows:
            hulls = self._find_hulls(candidates, view)
            casters, may_cast = self._update_sun_shadow(
                candidates, hulls, indices, view, world_from_camera, pinhole
            )
            if len(np.intersect1d(casters, hulls)) > 0:
                switches += (("HULLS", 1),)
        if "colour" in view.targets:
            switches += self._artificial_light.prepare(
                view.lamps, view.projector, candidates, world_from_camera, hidden_ids
            )
        self._frame.fill(
            world_from_camera,
            view.intrinsics,
            pinhole.clip_from_camera,
            water,
            light,
            self._shadow,
        )
        self._slots.fill(self._instances, world_from_camera.inverse().matrix)
        skips_mipmaps = self._instances.can_skip_mipmaps(
            indices, world_from_camera, view.intrinsics
        )
        in_shadow = np.any(may_cast, axis=1)
        batches = [
            (int(n), bool(s), c) for n, s, c in zip(indices, in_shadow, skips_mipmaps, strict=True)
        ]
        target, backdrop = self._find_targets(view), self._backdrops.find(view, self._instances)
        backdrop_indices = indices[:0]
        if backdrop is not None:
            backdrop_indices = backdrop.find(self._instances, indices)
        # A backdrop without terrain saves little time.
        n_casters = len(self._instances.find_casters(backdrop_indices, MAX_CASTER_RADIUS))
        if n_casters < len(backdrop_indices):
            assert backdrop is not None
            n_front = len(indices) - len(backdrop_indices)
            front, back = batches[:n_front], batches[n_front:]
            if backdrop.colours is None:
                sunlit_batches = [(index, False, close) for index, _, close in back]
                self._passes.draw(target, sunlit_batches, switches)
                intrinsics, sun = view.intrinsics, find_sun_direction(water, light)
                tiles = compute_tile_bounds(
                    target.read_depths(), world_from_camera, intrinsics, sun
                )
                backdrop.store(target.read_colours(), tiles, backdrop_indices)
            region = self._find_shaded_region(view, backdrop, casters)
            if region is not None:
                self._passes.draw_over_backdrop(target, front, back, region, switches)
                return backdrop.colours
        is_mirror = any(name == "MIRROR" for name, _ in view.switches)
        has_surface = view.has_surface and not is_mirror
        surface_drawer = partial(self._draw_surface, target) if has_surface else None
        self._passes.draw(target, batches, switches, surface_drawer)
        return None

    def _draw_surface(self, target: Targets) -> None:
        """Draw the water's surface among bodies if the whole camera is under water."""
        assert self._development is not None
        assert self._surface_pass is not None
        if self._surface_pass.is_direct:
            self._development.use_textures()
            self._surface_pass.draw_among(target)

    def _find_shaded_region(
        self, view: View, backdrop: Backdrop, casters: Indices
    ) -> Region | None:
        """Return the region of a backdrop where shadows may fall; None if it is too large."""
        intrinsics, margin = view.intrinsics, SHADOW_MARGIN + 8.0 * self._shadow.lift
        sun = find_sun_direction(view.water, view.light)
        region = find_shaded_region(backdrop.tiles, self._instances, casters, sun, margin)
        return (
            region
            if region[2] * region[3] <= MAX_SHADED_SHARE * intrinsics.width * intrinsics.height
            else None
        )

    def _update_sun_shadow(
        self,
        candidates: Indices,
        hulls: Indices,
        receivers: Indices,
        view: View,
        world_from_camera: Pose,
        pinhole: Projection,
    ) -> tuple[Indices, npt.NDArray[np.bool_]]:
        """Update the shadow map; return k casters, and for n receivers which may shade them."""
        instances, sun = self._instances, find_sun_direction(view.water, view.light)
        casters = instances.find_casters(candidates, MAX_CASTER_RADIUS)
        casters = np.union1d(casters, hulls)
        margin = HULL_MARGIN if len(hulls) > 0 else SHADOW_MARGIN
        may_cast = find_shadow_pairs(
            instances, casters, receivers, sun, world_from_camera, pinhole.corner_rays, margin
        )
        is_needed = may_cast.any(axis=0)
        if is_needed.any():
            self._shadow.update(instances, casters[is_needed], sun)
        return casters[is_needed], may_cast[:, is_needed]

    def _find_hulls(self, indices: Indices, view: View) -> Indices:
        """Return the batches of hulls that shade the light of sun and sky in physical water."""
        if not (view.is_physical and view.light.shadows):
            return indices[:0]
        radii = MAX_CASTER_RADIUS, MAX_HULL_RADIUS
        return self._instances.find_hulls(indices, radii, view.water.surface_height)

    def _find_targets(self, view: View) -> Targets:
        size = view.intrinsics.width, view.intrinsics.height
        key = size, view.targets, view.colour_format
        if key not in self._targets:
            self._targets[key] = Targets(self._context, size, view.targets, view.colour_format)
        return self._targets[key]
