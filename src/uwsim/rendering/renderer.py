"""The renderer: a scene in, pictures out. It knows nothing of topics, sensors or benchmarks.

One forward pass draws colour, range and ids, whichever are asked for, through UWSim's water
(`rendering.water`). Not modelled: the water's surface, caustics, reflections, transparency.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model
from ..errors import UnknownName
from ..geometry import Array, Intrinsics, Pose
from .context import create_context
from .gpu_model import Batch, GpuModels
from .program import Block, build
from .projection import clip_from_camera, frustum
from .sun_shadow import LARGEST_CASTER, SunShadow
from .targets import STORES, TARGETS, Targets
from .water import AMBIENT, SPECULAR, SUN_COLOURS, SUN_DIRECTIONS, Light, Water, fog_distance

FRAME = Block(
    "Frame",
    0,
    {
        "clip_from_camera": "mat4",
        "shadow_from_camera": "mat4",
        "up": "vec4",
        "sun": "vec4",
        "ambient": "vec4",
        "diffuse": "vec4",
        "specular": "vec4",
        "water_colour": "vec4",
        "attenuation": "vec4",
        "fog_colour": "vec4",
        "fog_distance": "vec4",
        "background": "vec4",
    },
)
INSTANCE = Block(
    "Instance", 1, {"camera_from_model": "mat4", "camera_normals": "mat4", "identity": "uvec4"}
)
SAMPLERS = {"base_map": 0, "shadow_map": 1}
SLOT = 256
"""Bytes between instances in their buffer; every driver's alignment divides it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """What a camera saw; arrays of its own, row 0 at the top, None where not asked for."""

    intrinsics: Intrinsics
    """The camera's pinhole."""
    colour: npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | None = None
    """Stored values before noise: (h, w, 3) uint8, or (h, w, 4) uint16 for ``linear16``."""
    range: npt.NDArray[np.float32] | None = None
    """Distance along the ray of each pixel (h, w) [m]; inf = nothing there."""
    ids: npt.NDArray[np.uint16] | None = None
    """Number of the instance seen (h, w); 0 = nothing there."""

    @property
    def depth(self) -> npt.NDArray[np.float32]:
        """Distance along the optical axis (h, w) [m]; inf = nothing there."""
        if self.range is None:
            raise ValueError("the picture was drawn without its range")
        stretch = np.linalg.norm(self.intrinsics.rays(), axis=2)  # (h, w)
        return (self.range / stretch).astype(np.float32)


@dataclass(eq=False)
class Instance:
    """A model that stands somewhere."""

    batches: tuple[Batch, ...]
    id: int
    """Its number in the id picture, 1..65535."""
    world_from_model: Array = field(default_factory=lambda: np.eye(4))
    """(4, 4); may carry scale, uneven or mirroring."""
    normals: Array = field(default_factory=lambda: np.eye(3))
    """World normals from model normals, (3, 3)."""
    centre: Array = field(default_factory=lambda: np.zeros(3))
    """Of the bounding sphere in W, (3,) [m]."""
    radius: float = 0.0
    """Of the bounding sphere [m]."""
    spheres: Array = field(default_factory=lambda: np.zeros((0, 4)))
    """Bounding spheres of the batches in W: centre, radius (n, 4) [m]."""
    mirrored: bool = False
    """Whether the matrix turns left into right."""

    def place(self, world_from_model: Array) -> None:
        """Stand it somewhere else."""
        self.world_from_model = np.array(world_from_model, dtype=np.float64)
        linear, origin = self.world_from_model[:3, :3], self.world_from_model[:3, 3]
        # The largest row sum of A'A bounds the square of the largest stretch; exact without shear.
        stretch = float(np.sqrt(np.abs(linear.T @ linear).sum(axis=1).max()))
        self.normals = np.linalg.inv(linear).T
        self.mirrored = bool(np.linalg.det(linear) < 0.0)
        centres = np.array([batch.centre for batch in self.batches]) @ linear.T + origin
        radii = np.array([batch.radius for batch in self.batches]) * stretch
        self.spheres = np.column_stack([centres, radii])
        low, high = (centres - radii[:, None]).min(axis=0), (centres + radii[:, None]).max(axis=0)
        self.centre = (low + high) / 2.0
        self.radius = float((np.linalg.norm(centres - self.centre, axis=1) + radii).max())


class Renderer:
    """Models placed in W, and pictures of them from anywhere.

    Use it from one thread; several may live in one process. `close` gives everything back.

    Raises:
        NoGraphics: no OpenGL context could be made.
    """

    def __init__(self) -> None:
        self._context = create_context()
        self._models = GpuModels(self._context)
        self._instances: dict[int, Instance] = {}
        self._next_handle = 1
        self._closed = False
        self._moves = 0  # counts changes of anything that may cast a shadow
        self._programs: dict[tuple[str, tuple[str, ...]], moderngl.Program] = {}
        self._targets: dict[tuple[object, ...], Targets] = {}
        self._frame = np.zeros((), dtype=FRAME.dtype)
        self._frame_buffer = self._context.buffer(reserve=FRAME.dtype.itemsize, dynamic=True)
        self._slots = np.zeros(0, dtype=_SLOT_DTYPE)
        self._slot_buffer = self._context.buffer(reserve=SLOT, dynamic=True)
        self._shadow = SunShadow(self._context, INSTANCE)
        self._empty_arrays: dict[int, moderngl.VertexArray] = {}

    @property
    def description(self) -> str:
        """What draws: ``llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6``."""
        facts = self._context.info
        return f"{facts['GL_RENDERER']}, {facts['GL_VERSION']}"

    def add(self, model: Model, id: int) -> int:
        """Put a model at the origin of W; returns the handle for `place` and `remove`.

        Args:
            model: Uploaded once, however often it is added.
            id: Its number in the id picture, 1..65535; several may share one.
        """
        if not 1 <= id <= 65535:
            raise ValueError(f"the id {id} is not in 1..65535")
        with self._context:
            instance = Instance(self._models.upload(model), id)
        instance.place(np.eye(4))
        handle = self._next_handle
        self._next_handle += 1
        self._instances[handle] = instance
        self._moves += 1
        return handle

    def place(self, handle: int, world_from_model: Array) -> None:
        """Move an instance; the matrix (4, 4) may carry scale."""
        instance = self._find(handle)
        if not np.array_equal(instance.world_from_model, world_from_model):
            instance.place(world_from_model)
            self._moves += 1

    def remove(self, handle: int) -> None:
        """Take an instance out of the scene."""
        self._find(handle)
        del self._instances[handle]
        self._moves += 1

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
    ) -> Picture:
        """Draw one picture.

        Args:
            world_from_camera: Where the camera is; OpenGL axes.
            intrinsics: Its pinhole.
            water: What stands between.
            light: What lights the scene.
            targets: What to draw; nothing else is computed.
            hidden: Ids of instances that this camera does not see (their shadows go too).
            colour: 8 bit, or 16 bit for noise to be added before the 8-bit store.
        """
        wanted = frozenset(targets)
        if not wanted or not wanted <= set(TARGETS) or colour not in STORES:
            raise ValueError(f"cannot draw {sorted(wanted)} as {colour!r}: {TARGETS}, {STORES}")
        seen = [i for i in self._instances.values() if i.id not in hidden]
        with self._context:
            target = self._target(intrinsics, wanted, colour)
            shadows = "colour" in wanted and light.shadows and self._cast(seen, light, hidden)
            clip = clip_from_camera(intrinsics)
            self._fill_frame(world_from_camera, intrinsics, clip, water, light)
            self._draw_into(target, seen, world_from_camera, clip, shadows)
            pixels = {name: target.read(name) for name in target.places}
        return Picture(intrinsics=intrinsics, **pixels)

    def close(self) -> None:
        """Give the context and everything in it back; the renderer is of no use afterwards."""
        if not self._closed:
            self._closed = True
            self._context.release()

    def _find(self, handle: int) -> Instance:
        if handle not in self._instances:
            raise UnknownName("instance", str(handle), map(str, self._instances))
        return self._instances[handle]

    def _program(
        self, effect: str, places: dict[str, int], switches: tuple[str, ...]
    ) -> moderngl.Program:
        key = effect, tuple(places), switches
        if key not in self._programs:
            defines = {name.upper(): place for name, place in places.items()}
            defines |= dict.fromkeys(switches, 1)
            self._programs[key] = build(
                self._context, effect, defines=defines, blocks=[FRAME, INSTANCE], samplers=SAMPLERS
            )
        return self._programs[key]

    def _target(self, intrinsics: Intrinsics, wanted: frozenset[str], store: str) -> Targets:
        size = intrinsics.width, intrinsics.height
        key = size, wanted, store
        if key not in self._targets:
            self._targets[key] = Targets(self._context, size, wanted, store)
        return self._targets[key]

    def _cast(self, seen: Sequence[Instance], light: Light, hidden: frozenset[int]) -> bool:
        """Bring the shadow map up to date; False when nothing casts a shadow."""
        casters = [instance for instance in seen if instance.radius <= LARGEST_CASTER]
        if casters:
            self._shadow.update(casters, _sun(light), (self._moves, hidden))
        return bool(casters)

    def _fill_frame(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        clip: Array,
        water: Water,
        light: Light,
    ) -> None:
        """Write what is the same for everything in the picture."""
        frame, rotation = self._frame, world_from_camera.rotation
        frame["clip_from_camera"] = clip.T
        frame["shadow_from_camera"] = (self._shadow.texture_from_world @ world_from_camera.matrix).T
        frame["up"] = *rotation[2], world_from_camera.position[2] - water.surface_height
        frame["sun"] = *(_sun(light) @ rotation), self._shadow.lift
        frame["ambient"] = light.rate * AMBIENT
        frame["diffuse"][:3] = light.rate * np.array(SUN_COLOURS[light.sun])
        frame["specular"] = light.rate * SPECULAR
        frame["water_colour"][:3] = water.colour
        frame["attenuation"][:3] = water.attenuation
        frame["fog_colour"] = *water.fog_colour, water.fog**2
        frame["fog_distance"][:3] = fog_distance(water, intrinsics)
        frame["background"][:3] = water.far_colour
        self._frame_buffer.write(frame.tobytes())
        self._frame_buffer.bind_to_uniform_block(FRAME.binding)

    def _draw_into(
        self,
        target: Targets,
        seen: Sequence[Instance],
        world_from_camera: Pose,
        clip: Array,
        shadows: bool,
    ) -> None:
        """Draw what is in view, near and small first, terrain last, then the emptiness."""
        context = self._context
        target.framebuffer.use()
        target.framebuffer.clear(depth=1.0)
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<="
        if "colour" in target.places:
            self._shadow.texture.use(SAMPLERS["shadow_map"])
        self._upload_slots(seen, world_from_camera)
        for slot, batch, mirrored in _in_view(seen, world_from_camera, frustum(clip)):
            switches: tuple[str, ...] = ()
            if "colour" in target.places:
                switches = ("SHADOWS",) * shadows
                if batch.texture is not None:
                    switches += ("TEXTURED",)
                    batch.texture.use(SAMPLERS["base_map"])
            if batch.two_sided:
                context.disable(moderngl.CULL_FACE)
            else:
                context.enable(moderngl.CULL_FACE)
            # The picture is upside down for OpenGL, so outside is clockwise unless mirrored.
            context.front_face = "ccw" if mirrored else "cw"
            self._slot_buffer.bind_to_uniform_block(
                INSTANCE.binding, offset=slot * SLOT, size=INSTANCE.dtype.itemsize
            )
            batch.draw(self._program("surface", target.places, switches))
        context.disable(moderngl.CULL_FACE)
        program = self._program("background", target.places, ())
        self._emptiness(program).render(moderngl.TRIANGLES, vertices=3)

    def _upload_slots(self, seen: Sequence[Instance], world_from_camera: Pose) -> None:
        """Write where every instance stands in the camera's frame."""
        if not seen:
            return
        if len(self._slots) < len(seen):
            self._slots = np.zeros(2 * len(seen), dtype=_SLOT_DTYPE)
            self._slot_buffer.orphan(self._slots.nbytes)
        camera_from_world = world_from_camera.inverse().matrix
        slots = self._slots[: len(seen)]
        models = camera_from_world @ np.array([i.world_from_model for i in seen])
        normals = camera_from_world[:3, :3] @ np.array([i.normals for i in seen])
        slots["camera_from_model"] = models.transpose(0, 2, 1)
        slots["camera_normals"][:, :3, :3] = normals.transpose(0, 2, 1)
        slots["identity"][:, 0] = [i.id for i in seen]
        self._slot_buffer.write(slots.tobytes())

    def _emptiness(self, program: moderngl.Program) -> moderngl.VertexArray:
        if program.glo not in self._empty_arrays:
            self._empty_arrays[program.glo] = self._context.vertex_array(program, [])
        return self._empty_arrays[program.glo]


_SLOT_DTYPE = np.dtype(
    {
        "names": list(INSTANCE.members),
        "formats": [INSTANCE.dtype[name] for name in INSTANCE.members],
        "offsets": [INSTANCE.dtype.fields[name][1] for name in INSTANCE.members],
        "itemsize": SLOT,
    }
)


def _sun(light: Light) -> Array:
    """Unit vector towards the sun in W, (3,)."""
    direction = np.array(SUN_DIRECTIONS[light.sun])
    unit: Array = direction / np.linalg.norm(direction)
    return unit


def _in_view(
    seen: Sequence[Instance], world_from_camera: Pose, planes: Array
) -> list[tuple[int, Batch, bool]]:
    """Batches whose bounding sphere is in the frustum, with slot and mirroring, near ones first.

    Near is by the far side of the sphere: small things come before the tank they float in.
    """
    if not seen:
        return []
    spheres = np.concatenate([instance.spheres for instance in seen])  # (n, 4) [m]
    centres = (spheres[:, :3] - world_from_camera.position) @ world_from_camera.rotation
    radii = spheres[:, 3]
    inside = (centres @ planes[:, :3].T + planes[:, 3] > -radii[:, None]).all(axis=1)
    order = np.argsort(np.linalg.norm(centres, axis=1) + radii, kind="stable")
    batches = [(s, b, i.mirrored) for s, i in enumerate(seen) for b in i.batches]
    return [batches[n] for n in order[inside[order]]]
