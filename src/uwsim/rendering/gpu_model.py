"""Models on the GPU: merged by texture, in pieces, uploaded once."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model, Texture
from .merged import VERTEX, MergedMesh, merge_model


class Buffers:
    """The merged meshes on the GPU, and a vertex array for each program that draws them."""

    def __init__(self, context: moderngl.Context, mesh: MergedMesh) -> None:
        self._context = context
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
            attributes = [n for n in ("vertex", "vertex_normal", "uv", "tint") if n in program]
            (vertices, indices), layout = self._merged_buffers, _layout(attributes)
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
        """Return the positions alone, each once, for shadow maps.

        Edges have a vertex for each normal and colour; vertices take most of a shadow map's time.
        """
        if self._position_buffers is None:
            vertices, triangles = self._merged_buffers
            positions = np.frombuffer(vertices.read(), VERTEX)["vertex"]
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
    """A set of adjacent triangles with the same texture, sides and opacity; one draw call."""

    buffers: Buffers
    """The buffers, shared by the pieces of a model."""
    first_index: int
    """The position of the batch's first index."""
    size: int
    """The number of its indices."""
    texture: Texture | None
    """The texture, uploaded when first drawn: `GpuModels.use`."""
    two_sided: bool
    opacity: float
    """The opacity: 1 hides what is behind the batch, 0 is invisible."""
    centre: npt.NDArray[np.float64]
    """The centre of the bounding sphere, model frame, (3,) [m]."""
    radius: float
    """The radius of the bounding sphere [m]."""
    corners: npt.NDArray[np.float64]
    """The corners of the bounding box, model frame, (8, 3) [m]."""
    normal: npt.NDArray[np.float64]
    """The normal of the batch's plane, model frame, (3,); 0 if it is bent."""
    density: float
    """The largest number of texels along a metre [1/m]; 0 without a texture."""

    def draw(self, program: moderngl.Program) -> None:
        """Draw all triangles with the current state of OpenGL (`brush`)."""
        array = self.buffers.array(program)
        array.render(moderngl.TRIANGLES, vertices=self.size, first=self.first_index)


def _layout(attributes: list[str]) -> str:
    """Return the format of VERTEX in which members that the program does not read are skipped."""
    sizes = {"vertex": 3, "vertex_normal": 3, "uv": 2, "tint": 3}
    return " ".join(f"{n}f" if name in attributes else f"{4 * n}x" for name, n in sizes.items())


MAX_UNUSED_SCENES = 4
"""The number of scenes after which an unused model or texture is removed from the GPU."""


class GpuModels:
    """The models and textures on the GPU, each uploaded once.

    A model is uploaded when it is added to a scene, a texture when it is first drawn: of a tank
    with its house, a camera that looks down needs one of nine. Those that the last
    `MAX_UNUSED_SCENES` did not use are removed: varied scenes have other models for each seed.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._models: dict[int, tuple[Model, tuple[Batch, ...]]] = {}
        self._close = {
            repeats: context.sampler(repeats, repeats, filter=(moderngl.LINEAR, moderngl.LINEAR))
            for repeats in (False, True)
        }
        self._textures: dict[tuple[str, int], tuple[Texture, moderngl.Texture]] = {}
        self._mipmapped_textures: set[int] = set()  # numbers of the textures that have mipmaps
        self._bound: tuple[Texture, bool] | None = None  # of this pass; True: without mipmaps
        self._n_scenes = 0  # number of scenes that have ended
        self._models_used: dict[int, int] = {}  # number of the last scene that used it
        self._textures_used: dict[tuple[str, int], int] = {}

    def upload(self, model: Model) -> tuple[Batch, ...]:
        """Return the model's batches; the same object is uploaded only once."""
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
        """Upload merged meshes, and return a batch for each of their pieces."""
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
            )
            for piece in mesh.pieces
        ]

    def use(self, texture: Texture, unit: int, *, is_close: bool) -> None:
        """Bind a texture until `release`; a close surface is sampled without mipmaps."""
        if self._bound is not None and self._bound[0] is texture and self._bound[1] == is_close:
            return
        gpu_texture = self._upload_texture(texture)
        gpu_texture.use(unit)
        if is_close:
            self._close[texture.repeats].use(unit)
            self._bound = texture, True
            return
        self.release(unit)
        self._bound = texture, False
        # Their creation takes longer than an image.
        if gpu_texture.glo not in self._mipmapped_textures:
            gpu_texture.build_mipmaps()
            gpu_texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._mipmapped_textures.add(gpu_texture.glo)

    def release(self, unit: int) -> None:
        """Unbind the sampler, so that the next texture is sampled by its own filter."""
        self._close[True].clear(unit)
        self._bound = None

    def _upload_texture(self, texture: Texture) -> moderngl.Texture:
        """Return the texture on the GPU; it is uploaded once."""
        key = texture.name, id(texture.pixels)
        if key not in self._textures:
            height, width = texture.pixels.shape[:2]
            pixels = np.ascontiguousarray(texture.pixels[::-1])  # OpenGL's first row is v = 0
            gpu_texture = self._context.texture((width, height), 3, pixels.tobytes(), alignment=1)
            gpu_texture.repeat_x = gpu_texture.repeat_y = texture.repeats
            self._textures[key] = texture, gpu_texture
        self._textures_used[key] = self._n_scenes
        return self._textures[key][1]
