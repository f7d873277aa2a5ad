"""Models on the graphics side: merged by texture, uploaded once."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Mesh, Model, Texture

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
    """Triangles of a model that are drawn with one call: same texture, same sides."""

    vertices: moderngl.Buffer
    indices: moderngl.Buffer
    texture: Texture | None
    """Uploaded when first drawn: `GpuModels.texture`."""
    two_sided: bool
    centre: npt.NDArray[np.float64]
    """Of the bounding sphere, model frame, (3,) [m]."""
    radius: float
    """Of the bounding sphere [m]."""
    corners: npt.NDArray[np.float64]
    """Of the bounding box, model frame, (8, 3) [m]."""
    arrays: dict[int, moderngl.VertexArray]
    """Vertex array for each program, by the program's number; made when first drawn."""

    def draw(self, program: moderngl.Program) -> None:
        """Draw all triangles with the state as it is."""
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
        array.render(moderngl.TRIANGLES)


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
        self._textures: dict[tuple[str, int], tuple[Texture, moderngl.Texture]] = {}

    def upload(self, model: Model) -> tuple[Batch, ...]:
        """The model's batches; the same object is uploaded only once."""
        known = self._models.get(id(model))
        if known is None:
            groups: dict[tuple[int, bool], list[Mesh]] = {}
            for mesh in model.meshes:
                if len(mesh.triangles):
                    groups.setdefault((id(mesh.texture), mesh.two_sided), []).append(mesh)
            known = model, tuple(self._batch(meshes) for meshes in groups.values())
            self._models[id(model)] = known  # holds the model, so that its id stays its own
        return known[1]

    def _batch(self, meshes: list[Mesh]) -> Batch:
        vertices = np.empty(sum(len(mesh.vertices) for mesh in meshes), dtype=VERTEX)
        triangles, first = [], 0
        for mesh in meshes:
            part = vertices[first : first + len(mesh.vertices)]
            part["vertex"], part["vertex_normal"] = mesh.vertices, mesh.normals
            part["uv"], part["tint"] = mesh.uvs, mesh.colour
            triangles.append(mesh.triangles.astype(np.uint32) + np.uint32(first))
            first += len(mesh.vertices)
        points = vertices["vertex"].astype(np.float64)
        box = np.stack([points.min(axis=0), points.max(axis=0)])  # (2, 3) [m]
        centre = box.mean(axis=0)
        return Batch(
            vertices=self._context.buffer(vertices.tobytes()),
            indices=self._context.buffer(np.concatenate(triangles).tobytes()),
            texture=meshes[0].texture,
            two_sided=meshes[0].two_sided,
            centre=centre,
            radius=float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())),
            corners=np.array(list(itertools.product(*box.T))),
            arrays={},
        )

    def texture(self, texture: Texture) -> moderngl.Texture:
        """The texture on the graphics side, with its smaller copies; made once."""
        key = texture.name, id(texture.pixels)
        if key not in self._textures:
            height, width = texture.pixels.shape[:2]
            upright = np.ascontiguousarray(texture.pixels[::-1])  # OpenGL's first row is v = 0
            made = self._context.texture((width, height), 3, upright.tobytes(), alignment=1)
            made.repeat_x = made.repeat_y = texture.repeats
            made.build_mipmaps()
            made.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._textures[key] = texture, made
        return self._textures[key][1]
