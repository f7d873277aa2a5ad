"""A real camera with virtual objects: each of its images is composed with the scene's view."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..base.terminal import warn
from ..errors import AssetError, BadSetting, UnknownName
from ..messages import CompressedImage, Image, image
from ..messages.compressed import encode_png
from ..rendering.noise import add_noise
from ..rendering.rendered_image import RenderedImage
from ..scene.object import TERRAIN
from ..simulation import Simulation
from ..simulation.scenery.scenery import Scenery
from .composition import (
    AddedFog,
    AddedPhysicalWater,
    AddedWater,
    Layers,
    Pixels,
    compose_image,
    compute_shadow,
)
from .received_images import decode_depth, decode_image

PREFIX = "/virtual"
"""The prefix of the topics of virtual sensors."""
COMPOSED_PREFIX = f"{PREFIX}/composed"
"""The prefix of the topics of composed images."""
COMPRESSED_ENDING = "/compressed"
"""The end of the names of topics with compressed images."""
MAX_WARNINGS = 3
"""The number of refused images that are reported one by one."""


@dataclass(frozen=True, kw_only=True)
class ImageComposition:
    """The settings of the composition of a real camera's images."""

    camera: str
    """The virtual camera at the place of the real one."""
    topic: str
    """The topic of the real images; one that ends in ``/compressed`` has CompressedImage."""
    depth_topic: str = ""
    """The topic of depth images of the same camera; empty: ranges are those of the scene's real
    objects."""
    real_objects: tuple[str, ...] = ()
    """The objects of the scene that are in the real images, besides the terrain and the vehicle."""
    fog: float = 0.0
    """The density of the added fog [1/m]."""
    unknown_range: float | None = None
    """The assumed range of real surfaces without geometry [m]; None: infinite."""
    adds_water: bool = False
    """True if the scene's physical water is added over the real images, taken in clear water."""
    has_particles: bool = False
    """True if the particles of the scene are added, over real and virtual pixels."""
    has_shadows: bool = False
    """True if virtual objects cast shadows of the sun on real ones."""


class ComposedCamera:
    """A camera whose real images are composed with virtual objects, and published.

    Args:
        simulation: the simulation, whose vehicle follows the real one.
        composition: the settings.
        vehicle: the name of the vehicle that carries the camera; it is in the real images.
        frames: the folder of PNG files, one for each image; None: none are written.

    Raises:
        UnknownName: the scene has no such camera or object.
        BadSetting: the settings do not fit the water of the scene.
    """

    def __init__(
        self,
        simulation: Simulation,
        composition: ImageComposition,
        vehicle: str,
        frames: Path | None = None,
    ) -> None:
        world = simulation.world
        self._simulation, self._composition, self._frames = simulation, composition, frames
        self._scenery, self._camera = world.scenery, world.sensors.camera(composition.camera)
        self._rng = world.stream(f"{vehicle}/{composition.camera}/virtual-noise")
        self._real_ids, self._virtual_ids = _split_parts(
            simulation, vehicle, composition.real_objects
        )
        self._check_water()
        name = composition.topic.removesuffix(COMPRESSED_ENDING)
        self.topic = f"{COMPOSED_PREFIX}/{name.strip('/')}"
        """The topic of the composed images."""
        self.n_images = 0
        """The number of composed images."""
        self.n_refused = 0
        """The number of images that could not be composed."""
        self._depth: npt.NDArray[np.float64] | None = None
        bus = world.bus
        self._publish = bus.publisher(self.topic, Image)
        if composition.depth_topic:
            bus.subscribe(composition.depth_topic, Image, self._receive_depth)
        if composition.topic.endswith(COMPRESSED_ENDING):
            bus.subscribe(composition.topic, CompressedImage, self._receive)
        else:
            bus.subscribe(composition.topic, Image, self._receive)

    def _check_water(self) -> None:
        composition, model = self._composition, self._scenery.image_model
        if model == "physical" and composition.fog > 0.0:
            raise BadSetting(
                "Fog is added in scenes with the fog law; this scene has physical water."
            )
        if model != "physical" and composition.adds_water:
            raise BadSetting(
                "The scene has no physical water to add; expected <u:water>, or a fog density."
            )
        if composition.has_particles and (model != "physical" or self._scenery.particles is None):
            raise BadSetting("The scene has no particles to add; expected <u:particles>.")
        if not math.isfinite(composition.fog) or composition.fog < 0.0:
            raise BadSetting(f"A fog of {composition.fog:g} 1/m; expected a number of at least 0.")

    def compose(self, real_image: Pixels) -> Pixels:
        """Return a real image, taken at the present pose, with virtual objects and water."""
        return compose_image(real_image, self._render_layers(), self._make_water())

    def _receive(self, message: Image | CompressedImage) -> None:
        try:
            composed_image = self.compose(decode_image(message))
        except (AssetError, BadSetting) as error:
            self._refuse(str(error))
            return
        time, header = self._simulation.time, message.header
        self._publish(image(composed_image, time=time, frame_id=header.frame_id))
        if self._frames is not None:
            path = self._frames / f"{self.n_images:06d}.png"
            path.write_bytes(encode_png(composed_image))
        self.n_images += 1

    def _receive_depth(self, message: Image) -> None:
        try:
            depth = decode_depth(message)
        except AssetError as error:
            self._refuse(str(error))
            return
        self._depth = depth

    def _refuse(self, reason: str) -> None:
        self.n_refused += 1
        if self.n_refused <= MAX_WARNINGS:
            warn(f"{self._composition.topic}: {reason} It is left out.")

    def _render_layers(self) -> Layers:
        particles = self._render_particles() if self._composition.has_particles else None
        with hide_particles(self._scenery):
            return replace(self._render_clear_layers(), particles=particles)

    def _render_particles(self) -> npt.NDArray[np.int16]:
        """Return the change of each stored colour of the whole scene by particles, (h, w, 3)."""
        seen_colour = self._render(frozenset(), {"colour"}).colour
        with hide_particles(self._scenery):
            clear_colour = self._render(frozenset(), {"colour"}).colour
        assert seen_colour is not None
        assert clear_colour is not None
        change = (
            seen_colour.view(np.uint8)[..., :3].astype(np.int16)
            - clear_colour.view(np.uint8)[..., :3]
        )
        return change.astype(np.int16)

    def _render_clear_layers(self) -> Layers:
        virtual_view = self._render(self._real_ids, {"colour", "range"}, fog=self._total_fog)
        assert virtual_view.colour is not None
        assert virtual_view.range is not None
        has_real_parts = bool(self._real_ids)
        unknown_range = np.full(virtual_view.range.shape, np.inf, np.float32)
        real_range = unknown_range
        if has_real_parts:
            rendered_range = self._render(self._virtual_ids, {"range"}).range
            assert rendered_range is not None
            real_range = rendered_range
        if self._depth is not None:
            real_range = self._merge_depth(real_range)
        colours = virtual_view.colour.view(np.uint8)
        return Layers(
            virtual_colour=self._add_noise(colours),
            virtual_range=virtual_view.range,
            real_range=self._assume_range(real_range, virtual_view.range),
            shadow=self._render_shadow() if self._composition.has_shadows else None,
        )

    def _merge_depth(self, real_range: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Return the measured ranges; where there are none, those of the geometry."""
        assert self._depth is not None
        lens = self._camera.intrinsics
        if self._depth.shape != real_range.shape:
            raise BadSetting(
                f"A depth image has {self._depth.shape[1]}x{self._depth.shape[0]} pixels; the "
                f"camera of the scene has {lens.width}x{lens.height}."
            )
        measured_range = (self._depth * lens.ray_lengths).astype(np.float32)
        return np.where(np.isfinite(measured_range), measured_range, real_range)

    def _assume_range(
        self, real_range: npt.NDArray[np.float32], virtual_range: npt.NDArray[np.float32]
    ) -> npt.NDArray[np.float32]:
        """Return ranges with the assumed one where none is known; it hides no virtual object."""
        assumed_range = self._composition.unknown_range
        if assumed_range is None:
            return real_range
        is_free = np.isinf(real_range) & np.isinf(virtual_range)
        return np.where(is_free, np.float32(assumed_range), real_range)

    def _add_noise(self, colours: Pixels) -> Pixels:
        """Return the colours with the noise of the virtual camera."""
        std = self._camera.state.std
        if std <= 0.0 or self._camera.has_response:
            return colours
        wide_colours = np.zeros((*colours.shape[:2], 4), np.uint16)
        wide_colours[..., :3] = colours[..., :3].astype(np.uint16) * 257
        return add_noise(wide_colours, std, self._rng)

    def _render_shadow(self) -> npt.NDArray[np.float32]:
        lit_view = self._render(self._virtual_ids, {"colour", "range"}, fog=0.0)
        unlit_view = self._render(frozenset(), {"colour", "range"}, fog=0.0)
        assert lit_view.colour is not None
        assert lit_view.range is not None
        assert unlit_view.colour is not None
        assert unlit_view.range is not None
        lit_colour, unlit_colour = lit_view.colour.view(np.uint8), unlit_view.colour.view(np.uint8)
        return compute_shadow(lit_colour, unlit_colour, lit_view.range, unlit_view.range)

    @property
    def _total_fog(self) -> float | None:
        """The density of the scene's fog with the added one [1/m]; None: the scene's."""
        added_fog, scene_fog = self._composition.fog, self._scenery.state.water.fog
        if added_fog <= 0.0:
            return None
        return math.sqrt(added_fog * added_fog + scene_fog * scene_fog)

    def _make_water(self) -> AddedWater:
        state = self._scenery.state
        if self._composition.fog > 0.0:
            water = state.water.scale_by_light(state.light)
            return AddedFog(density=self._composition.fog, colour=water.fog_colour)
        if self._composition.adds_water and state.water.physical_water is not None:
            background = self._render(self._real_ids | self._virtual_ids, {"colour"}).colour
            assert background is not None
            return AddedPhysicalWater(
                medium=state.water.physical_water.medium,
                background=background.view(np.uint8)[..., :3],
            )
        return None

    def _render(
        self, hidden_ids: frozenset[int], targets: Collection[str], *, fog: float | None = None
    ) -> RenderedImage:
        return self._scenery.render_clean(
            self._camera.world_from_camera,
            self._camera.intrinsics,
            fog=fog,
            targets=targets,
            is_polished=self._camera.is_polished,
            hidden_ids=hidden_ids,
        )


@contextmanager
def hide_particles(scenery: Scenery) -> Iterator[None]:
    """Draw no particles of a scene within the block."""
    particles, scenery.particles = scenery.particles, None
    try:
        yield
    finally:
        scenery.particles = particles


def _split_parts(
    simulation: Simulation, vehicle: str, real_objects: Collection[str]
) -> tuple[frozenset[int], frozenset[int]]:
    """Return the segmentation IDs of the real and of the virtual parts; raise UnknownName."""
    scene, parts = simulation.world.model.scene, simulation.world.scenery.parts
    object_names = [spec.name for spec in scene.objects]
    for name in real_objects:
        if name not in object_names:
            raise UnknownName("object", name, object_names)
    real_names = {*real_objects, TERRAIN}
    index = [spec.name for spec in scene.vehicles].index(vehicle)
    real_ids = frozenset(
        part.id
        for part in parts
        if part.vehicle == index or (part.object is not None and part.name in real_names)
    )
    return real_ids, frozenset(part.id for part in parts) - real_ids
