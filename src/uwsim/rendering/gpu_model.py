"""Models and textures on the GPU; the meshes of a model are merged and divided into batches."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Material, Model, Texture
from .materials.masked_levels import compute_masked_levels
from .merged import MergedMesh, merge_model


class Buffers:
    """A merged mesh on the GPU, with a vertex array for each program that draws it."""

    def __init__(self, context: moderngl.Context, mesh: MergedMesh) -> None:
        self._context, self._dtype = context, mesh.vertices.dtype
        self._merged_buffers = (
            context.buffer(mesh.vertices.tobytes()),
            context.buffer(mesh.triangles.tobytes()),
        )
        self._position_buffers: tuple[moderngl.Buffer, moderngl.Buffer] | None = None
        self._arrays: dict[moderngl.Program, moderngl.VertexArray] = {}

    def array(self, program: moderngl.Program) -> moderngl.VertexArray:
        """Return the vertex array for a program; create it at the first draw call."""
        array = self._arrays.get(program)
        if array is None:
            attributes = [name for name in self._dtype.names or () if name in program]
            (vertices, indices), layout = self._merged_buffers, _layout(self._dtype, attributes)
            if attributes == ["vertex"]:
                (vertices, indices), layout = self._upload_positions(), "3f"
            array = self._context.vertex_array(program, [(vertices, layout, *attributes)], indices)
            self._arrays[program] = array
        return array

    def release(self) -> None:
        """Free the memory."""
        for array in self._arrays.values():
            array.release()
        for buffer in (*self._merged_buffers, *(self._position_buffers or ())):
            buffer.release()

    def _upload_positions(self) -> tuple[moderngl.Buffer, moderngl.Buffer]:
        """Return buffers of the vertices' unique positions and of indices, for shadow maps.

        A position may have several vertices with different normals and colours. The time to draw a
        shadow map depends mainly on the number of vertices.
        """
        if self._position_buffers is None:
            vertices, triangles = self._merged_buffers
            positions = np.frombuffer(vertices.read(), self._dtype)["vertex"]
            vertex_indices = np.frombuffer(triangles.read(), np.uint32)
            unique_positions, position_indices = np.unique(positions, axis=0, return_inverse=True)
            indices = position_indices.reshape(-1)[vertex_indices].astype(np.uint32)
            self._position_buffers = (
                self._context.buffer(unique_positions.tobytes()),
                self._context.buffer(indices.tobytes()),
            )
        return self._position_buffers


@dataclass(frozen=True, eq=False)
class Batch:
    """A set of adjacent triangles with one texture and one opacity, drawn by one call."""

    buffers: Buffers
    """The buffers of the merged mesh, which its batches share."""
    first_index: int
    """The position of the batch's first index."""
    size: int
    """The number of the batch's indices, three per triangle."""
    texture: Texture | None
    """The texture; it is uploaded when it is first drawn (`GpuModels.use`)."""
    two_sided: bool
    """True if the triangles are visible from both sides."""
    opacity: float
    """The opacity: 1 hides what is behind the batch, 0 is invisible."""
    centre: npt.NDArray[np.float64]
    """The centre of the bounding sphere in the model's frame, (3,) [m]."""
    radius: float
    """The radius of the bounding sphere [m]."""
    corners: npt.NDArray[np.float64]
    """The corners of the bounding box in the model's frame, (8, 3) [m]."""
    normal: npt.NDArray[np.float64]
    """The unit normal of a flat batch in the model's frame, (3,); 0 if it is not flat."""
    density: float
    """The largest number of texels per metre on a triangle [1/m]; 0 without a texture."""
    material: Material | None = None
    """The maps and holes; None: there is only a base colour."""

    def draw(self, program: moderngl.Program) -> None:
        """Draw all triangles with the current state of OpenGL (`batch_drawer`)."""
        array = self.buffers.array(program)
        array.render(moderngl.TRIANGLES, vertices=self.size, first=self.first_index)


def _layout(dtype: np.dtype[np.void], attributes: list[str]) -> str:
    """Return the buffer format of vertices, with padding for members that the program lacks."""
    sizes = {name: dtype[name].shape[0] for name in dtype.names or ()}
    return " ".join(f"{n}f" if name in attributes else f"{4 * n}x" for name, n in sizes.items())


RGBA_CHANNELS = 4
"""The number of channels of an image with alpha."""
TextureKey = tuple[str, int, int | None]
"""The name of a texture, the identity of its pixels, and the threshold of its holes."""
MAX_UNUSED_SCENES = 4
"""The number of consecutive scenes without a model or texture after which the GPU discards it."""


class GpuModels:
    """The models and textures on the GPU, each uploaded once.

    A model is uploaded when it is added to a scene, a texture when it is first drawn: a camera that
    looks down sees few textures of a scene. Models and textures that were not used in the last
    `MAX_UNUSED_SCENES` are removed: scenes that are varied by a seed have other models.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._models: dict[int, tuple[Model, tuple[Batch, ...]]] = {}
        self._plain_samplers = {
            repeats: context.sampler(repeats, repeats, filter=(moderngl.LINEAR, moderngl.LINEAR))
            for repeats in (False, True)
        }
        # Maps of normals and finish are blended less than colours: that takes half the time. So
        # are colours with a normal map in UWSim's image model: normals hide where levels change.
        self._sharp_samplers = {
            repeats: context.sampler(
                repeats, repeats, filter=(moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
            )
            for repeats in (False, True)
        }
        self._textures: dict[TextureKey, tuple[Texture, moderngl.Texture]] = {}
        self._mipmapped_textures: set[int] = set()  # OpenGL names of the textures with mipmaps
        self._bound: dict[int, tuple[Texture, bool, bool, int | None]] = {}  # arguments of `use`
        self._n_scenes = 0  # number of scenes that have ended
        self._models_used: dict[int, int] = {}  # number of the last scene that used a model
        self._textures_used: dict[TextureKey, int] = {}

    def upload(self, model: Model) -> tuple[Batch, ...]:
        """Return the batches of a model, which is uploaded at the first call."""
        entry = self._models.get(id(model))
        if entry is None:
            batch_lists = [self._upload_batches(mesh) for mesh in merge_model(model)]
            entry = model, tuple(itertools.chain.from_iterable(batch_lists))
            self._models[id(model)] = entry  # holds the model, so that its id remains unique
        self._models_used[id(model)] = self._n_scenes
        return entry[1]

    def end_scene(self) -> None:
        """Remove the models and textures that none of the last scenes has used."""
        self._n_scenes += 1
        min_scene = self._n_scenes - MAX_UNUSED_SCENES
        for model, _ in list(self._models.values()):
            if self._models_used[id(model)] < min_scene:
                self.discard(model)
        for key, scene in list(self._textures_used.items()):
            if scene < min_scene:
                _, gpu_texture = self._textures.pop(key)
                del self._textures_used[key]
                # Another texture may get the number.
                self._mipmapped_textures.discard(gpu_texture.glo)
                gpu_texture.release()

    def discard(self, model: Model) -> None:
        """Free the buffers of a model that is in no scene any more."""
        _, batches = self._models.pop(id(model), (model, ()))
        self._models_used.pop(id(model), None)
        for buffers in {id(batch.buffers): batch.buffers for batch in batches}.values():
            buffers.release()

    def _upload_batches(self, mesh: MergedMesh) -> list[Batch]:
        """Upload a merged mesh, and return a batch for each of its pieces."""
        buffers = Buffers(self._context, mesh)
        return [
            Batch(
                buffers=buffers,
                first_index=piece.first_index,
                size=piece.size,
                texture=mesh.texture,
                two_sided=mesh.two_sided,
                opacity=mesh.opacity,
                centre=piece.centre,
                radius=piece.radius,
                corners=piece.corners,
                normal=piece.normal,
                density=piece.density,
                material=mesh.material,
            )
            for piece in mesh.pieces
        ]

    def use(
        self,
        texture: Texture,
        unit: int,
        *,
        skips_mipmaps: bool,
        skips_blending: bool = False,
        cutoff: int | None = None,
    ) -> None:
        """Bind a texture to a unit until `release`; it is sampled with or without mipmaps.

        Args:
            texture: the texture.
            unit: the texture unit.
            skips_mipmaps: True if it is sampled without mipmaps.
            skips_blending: True if the nearest mipmap is sampled instead of a blend of two, as for
                maps of normals and finish.
            cutoff: the alpha of its holes, 1..255; None: it has none.
        """
        key = texture, skips_mipmaps, skips_blending, cutoff
        if self._bound.get(unit) == key:
            return
        self._bound[unit] = key
        gpu_texture = self._upload_texture(texture, cutoff)
        gpu_texture.use(unit)
        if skips_mipmaps:
            self._plain_samplers[texture.repeats].use(unit)
            return
        if skips_blending:
            self._sharp_samplers[texture.repeats].use(unit)
        else:
            self._plain_samplers[True].clear(unit)
        # Mipmaps are created only when needed: that takes longer than to draw an image.
        if gpu_texture.glo not in self._mipmapped_textures:
            _build_mipmaps(gpu_texture, texture, cutoff)
            gpu_texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._mipmapped_textures.add(gpu_texture.glo)

    def release(self) -> None:
        """Unbind the samplers, so that the next textures are sampled by their own filters."""
        for unit in self._bound:
            self._plain_samplers[True].clear(unit)
        self._bound.clear()

    def _upload_texture(self, texture: Texture, cutoff: int | None) -> moderngl.Texture:
        """Return the texture on the GPU; it is uploaded once for each threshold of holes."""
        key = texture.name, id(texture.pixels), cutoff
        if key not in self._textures:
            height, width = texture.pixels.shape[:2]
            pixels = np.ascontiguousarray(texture.pixels[::-1])  # OpenGL's first row is v = 0
            gpu_texture = self._context.texture(
                (width, height), texture.pixels.shape[2], pixels.tobytes(), alignment=1
            )
            gpu_texture.repeat_x = gpu_texture.repeat_y = texture.repeats
            self._textures[key] = texture, gpu_texture
        self._textures_used[key] = self._n_scenes
        return self._textures[key][1]


def _build_mipmaps(gpu_texture: moderngl.Texture, texture: Texture, cutoff: int | None) -> None:
    """Create the smaller images of a texture; those of a texture with holes keep its threads."""
    if cutoff is None or gpu_texture.components != RGBA_CHANNELS:
        gpu_texture.build_mipmaps()
        return
    levels = compute_masked_levels(texture.pixels, cutoff)
    gpu_texture.build_mipmaps(0, len(levels))
    for number, pixels in enumerate(levels, start=1):
        gpu_texture.write(np.ascontiguousarray(pixels[::-1]).tobytes(), level=number, alignment=1)
