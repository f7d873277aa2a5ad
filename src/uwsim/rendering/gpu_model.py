"""Models on the GPU: merged by texture, in pieces, uploaded once."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Mesh, Model, Texture
from .pieces import crosses, densities, flat_normal, pieces

VERTEX = np.dtype(
    [
        ("vertex", np.float32, (3,)),
        ("vertex_normal", np.float32, (3,)),
        ("uv", np.float32, (2,)),
        ("tint", np.float32, (3,)),
    ]
)


@dataclass(frozen=True, eq=False)
class Batch:
    """Triangles of a model drawn with one call: same texture, sides and opacity, near by."""

    vertices: moderngl.Buffer
    indices: moderngl.Buffer
    first: int
    """Where its own indices begin ..."""
    size: int
    """... and how many they are."""
    texture: Texture | None
    """Uploaded when first drawn: `GpuModels.texture`."""
    two_sided: bool
    opacity: float
    """1 hides what is behind it, 0 is not seen."""
    centre: npt.NDArray[np.float64]
    """Centre of the bounding sphere, model frame, (3,) [m]."""
    radius: float
    """Radius of the bounding sphere [m]."""
    corners: npt.NDArray[np.float64]
    """Corners of the bounding box, model frame, (8, 3) [m]."""
    normal: npt.NDArray[np.float64]
    """Of its plane, model frame, (3,); 0 if it is bent."""
    density: float
    """Texels along a metre, where most are [1/m]; 0 without a texture."""
    arrays: dict[int, moderngl.VertexArray]
    """Vertex array for each program, by the program's number; made when first drawn, and shared
    by the pieces of a model."""

    def draw(self, program: moderngl.Program) -> None:
        """Draw all triangles, from one side or both; else with the state as it is."""
        array = self.arrays.get(program.glo)
        if array is None:
            context = program.ctx
            present = [
                name for name in ("vertex", "vertex_normal", "uv", "tint") if name in program
            ]
            array = context.vertex_array(
                program, [(self.vertices, _layout(present), *present)], self.indices
            )
            self.arrays[program.glo] = array
        if self.two_sided:
            program.ctx.disable(moderngl.CULL_FACE)
        else:
            program.ctx.enable(moderngl.CULL_FACE)
        array.render(moderngl.TRIANGLES, vertices=self.size, first=self.first)


def _layout(present: list[str]) -> str:
    """The format of VERTEX with the members that the program does not read skipped."""
    sizes = {"vertex": 3, "vertex_normal": 3, "uv": 2, "tint": 3}
    return " ".join(f"{n}f" if name in present else f"{4 * n}x" for name, n in sizes.items())


class GpuModels:
    """Uploads models and textures, each once, for as long as the context lives.

    A model is uploaded when it comes into a scene, a texture when it is first seen: of a tank with
    its house, a camera that looks down needs one of nine.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._models: dict[int, tuple[Model, tuple[Batch, ...]]] = {}
        self._close = {
            repeats: context.sampler(repeats, repeats, filter=(moderngl.LINEAR, moderngl.LINEAR))
            for repeats in (False, True)
        }
        self._textures: dict[tuple[str, int], tuple[Texture, moderngl.Texture]] = {}
        self._with_copies: set[int] = set()  # numbers of the textures that have smaller ones

    def upload(self, model: Model) -> tuple[Batch, ...]:
        """The model's batches; the same object is uploaded only once."""
        known = self._models.get(id(model))
        if known is None:
            groups: dict[tuple[int, bool, float], list[Mesh]] = {}
            for mesh in model.meshes:
                if len(mesh.triangles):
                    look = id(mesh.texture), mesh.two_sided, mesh.opacity
                    groups.setdefault(look, []).append(mesh)
            several = [self._batches(meshes) for meshes in groups.values()]
            known = model, tuple(itertools.chain.from_iterable(several))
            self._models[id(model)] = known  # holds the model, so that its id stays its own
        return known[1]

    def discard(self, model: Model) -> None:
        """Free the buffers of a model that is in no scene any more."""
        _, batches = self._models.pop(id(model), (model, ()))
        arrays = {id(each): each for batch in batches for each in batch.arrays.values()}
        buffers = {id(each): each for batch in batches for each in (batch.vertices, batch.indices)}
        for array in arrays.values():
            array.release()
        for buffer in buffers.values():
            buffer.release()

    def _batches(self, meshes: list[Mesh]) -> list[Batch]:
        """Merge meshes of one texture, and cut what is large."""
        vertices = np.empty(sum(len(mesh.vertices) for mesh in meshes), dtype=VERTEX)
        several, first = [], 0
        for mesh in meshes:
            part = vertices[first : first + len(mesh.vertices)]
            part["vertex"], part["vertex_normal"] = mesh.vertices, mesh.normals
            part["uv"], part["tint"] = mesh.uvs, mesh.colour
            several.append(mesh.triangles.astype(np.uint32) + np.uint32(first))
            first += len(mesh.vertices)
        triangles = np.concatenate(several)
        points = vertices["vertex"].astype(np.float64)
        normals = crosses(points, triangles)
        texture = meshes[0].texture
        texels = np.zeros(len(triangles))
        if texture is not None:
            height, width = texture.pixels.shape[:2]
            places = vertices["uv"].astype(np.float64) * [width, height]
            texels = densities(points, triangles, places)
        parts = pieces(points, triangles, normals)
        ordered = triangles[np.concatenate(parts)]  # a piece is a run of triangles
        buffers = self._context.buffer(vertices.tobytes()), self._context.buffer(ordered.tobytes())
        arrays: dict[int, moderngl.VertexArray] = {}
        batches, first = [], 0
        for piece in parts:
            corners = points[triangles[piece]].reshape(-1, 3)
            box = np.stack([corners.min(axis=0), corners.max(axis=0)])  # (2, 3) [m]
            centre = box.mean(axis=0)
            batch = Batch(
                vertices=buffers[0],
                indices=buffers[1],
                first=first,
                size=3 * len(piece),
                texture=texture,
                two_sided=meshes[0].two_sided,
                opacity=meshes[0].opacity,
                centre=centre,
                radius=float(np.sqrt(((corners - centre) ** 2).sum(axis=1).max())),
                corners=np.array(list(itertools.product(*box.T))),
                normal=flat_normal(normals[piece]),
                density=float(texels[piece].max()),
                arrays=arrays,
            )
            batches.append(batch)
            first += batch.size
        return batches

    def use(self, texture: Texture, unit: int, *, is_close: bool) -> None:
        """Bind a texture; that of a close surface is sampled without mipmaps."""
        made = self._upload_texture(texture)
        made.use(unit)
        if is_close:
            self._close[texture.repeats].use(unit)
            return
        self.release(unit)
        if made.glo not in self._with_copies:  # to make them takes longer than an image
            made.build_mipmaps()
            made.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._with_copies.add(made.glo)

    def release(self, unit: int) -> None:
        """Unbind the sampler, so that the next texture is sampled by its own filter."""
        self._close[True].clear(unit)

    def _upload_texture(self, texture: Texture) -> moderngl.Texture:
        """The texture on the GPU; uploaded once."""
        key = texture.name, id(texture.pixels)
        if key not in self._textures:
            height, width = texture.pixels.shape[:2]
            upright = np.ascontiguousarray(texture.pixels[::-1])  # OpenGL's first row is v = 0
            made = self._context.texture((width, height), 3, upright.tobytes(), alignment=1)
            made.repeat_x = made.repeat_y = texture.repeats
            self._textures[key] = texture, made
        return self._textures[key][1]
