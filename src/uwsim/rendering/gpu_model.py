"""Models on the GPU: merged by texture, in pieces, uploaded once."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model, Texture
from .merged import VERTEX, Merged, merged


class Buffers:
    """Merged meshes on the GPU, and a vertex array for each program that draws them."""

    def __init__(self, context: moderngl.Context, each: Merged) -> None:
        self._context = context
        self._whole = (
            context.buffer(each.vertices.tobytes()),
            context.buffer(each.triangles.tobytes()),
        )
        self._bare: tuple[moderngl.Buffer, moderngl.Buffer] | None = None
        self._arrays: dict[moderngl.Program, moderngl.VertexArray] = {}

    def array(self, program: moderngl.Program) -> moderngl.VertexArray:
        """The vertex array for a program; made when first drawn."""
        array = self._arrays.get(program)
        if array is None:
            present = [n for n in ("vertex", "vertex_normal", "uv", "tint") if n in program]
            (vertices, indices), layout = self._whole, _layout(present)
            if present == ["vertex"]:
                (vertices, indices), layout = self._places(), "3f"
            array = self._context.vertex_array(program, [(vertices, layout, *present)], indices)
            self._arrays[program] = array
        return array

    def release(self) -> None:
        """Free the memory."""
        for array in self._arrays.values():
            array.release()
        for buffer in (*self._whole, *(self._bare or ())):
            buffer.release()

    def _places(self) -> tuple[moderngl.Buffer, moderngl.Buffer]:
        """Places alone, each once: edges have a vertex for each normal and colour that meet there.

        Of maps of shadows most of the time goes into vertices.
        """
        if self._bare is None:
            vertices, triangles = self._whole
            places = np.frombuffer(vertices.read(), VERTEX)["vertex"]
            numbers = np.frombuffer(triangles.read(), np.uint32)
            bare, of_each = np.unique(places, axis=0, return_inverse=True)
            indices = of_each.reshape(-1)[numbers].astype(np.uint32)
            self._bare = (
                self._context.buffer(bare.tobytes()),
                self._context.buffer(indices.tobytes()),
            )
        return self._bare


@dataclass(frozen=True, eq=False)
class Batch:
    """Triangles of a model drawn with one call: same texture, sides and opacity, near by."""

    buffers: Buffers
    """Shared by the pieces of a model."""
    first: int
    """Where its own indices begin ..."""
    size: int
    """... and how many they are."""
    texture: Texture | None
    """Uploaded when first drawn: `GpuModels.use`."""
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

    def draw(self, program: moderngl.Program) -> None:
        """Draw all triangles with the state as it is (`brush`)."""
        array = self.buffers.array(program)
        array.render(moderngl.TRIANGLES, vertices=self.size, first=self.first)


def _layout(present: list[str]) -> str:
    """The format of VERTEX with the members that the program does not read skipped."""
    sizes = {"vertex": 3, "vertex_normal": 3, "uv": 2, "tint": 3}
    return " ".join(f"{n}f" if name in present else f"{4 * n}x" for name, n in sizes.items())


KEPT_SCENES = 4
"""Models and textures that none of so many scenes has used are removed from the GPU."""


class GpuModels:
    """Uploads models and textures, each once, and keeps them while scenes use them.

    A model is uploaded when it comes into a scene, a texture when it is first seen: of a tank with
    its house, a camera that looks down needs one of nine. One that the last `KEPT_SCENES` have not
    used is removed: scenes that vary from seed to seed have models of their own.
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
        self._bound: tuple[Texture, bool] | None = None  # of this pass; whether without mipmaps
        self._n_scenes = 0  # that have ended
        self._models_used: dict[int, int] = {}  # number of the scene that used one last
        self._textures_used: dict[tuple[str, int], int] = {}

    def upload(self, model: Model) -> tuple[Batch, ...]:
        """The model's batches; the same object is uploaded only once."""
        known = self._models.get(id(model))
        if known is None:
            several = [self._batches(each) for each in merged(model)]
            known = model, tuple(itertools.chain.from_iterable(several))
            self._models[id(model)] = known  # holds the model, so that its id stays its own
        self._models_used[id(model)] = self._n_scenes
        return known[1]

    def end_scene(self) -> None:
        """Remove the models and textures that none of the last scenes has used."""
        self._n_scenes += 1
        oldest = self._n_scenes - KEPT_SCENES
        for model, _ in list(self._models.values()):
            if self._models_used[id(model)] < oldest:
                self.discard(model)
        for key, last in list(self._textures_used.items()):
            if last < oldest:
                _, made = self._textures.pop(key)
                del self._textures_used[key]
                self._with_copies.discard(made.glo)  # the number is given to another one
                made.release()

    def discard(self, model: Model) -> None:
        """Free the buffers of a model that is in no scene any more."""
        _, batches = self._models.pop(id(model), (model, ()))
        self._models_used.pop(id(model), None)
        for buffers in {id(batch.buffers): batch.buffers for batch in batches}.values():
            buffers.release()

    def _batches(self, each: Merged) -> list[Batch]:
        """Upload merged meshes; a batch for each piece of them."""
        buffers = Buffers(self._context, each)
        return [
            Batch(
                buffers=buffers,
                first=piece.first,
                size=piece.size,
                texture=each.texture,
                two_sided=each.two_sided,
                opacity=each.opacity,
                centre=piece.centre,
                radius=piece.radius,
                corners=piece.corners,
                normal=piece.normal,
                density=piece.density,
            )
            for piece in each.pieces
        ]

    def use(self, texture: Texture, unit: int, *, is_close: bool) -> None:
        """Bind a texture until `release`; that of a close surface is sampled without mipmaps."""
        if self._bound is not None and self._bound[0] is texture and self._bound[1] == is_close:
            return
        made = self._upload_texture(texture)
        made.use(unit)
        if is_close:
            self._close[texture.repeats].use(unit)
            self._bound = texture, True
            return
        self.release(unit)
        self._bound = texture, False
        if made.glo not in self._with_copies:  # to make them takes longer than an image
            made.build_mipmaps()
            made.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
            self._with_copies.add(made.glo)

    def release(self, unit: int) -> None:
        """Unbind the sampler, so that the next texture is sampled by its own filter."""
        self._close[True].clear(unit)
        self._bound = None

    def _upload_texture(self, texture: Texture) -> moderngl.Texture:
        """The texture on the GPU; uploaded once."""
        key = texture.name, id(texture.pixels)
        if key not in self._textures:
            height, width = texture.pixels.shape[:2]
            upright = np.ascontiguousarray(texture.pixels[::-1])  # OpenGL's first row is v = 0
            made = self._context.texture((width, height), 3, upright.tobytes(), alignment=1)
            made.repeat_x = made.repeat_y = texture.repeats
            self._textures[key] = texture, made
        self._textures_used[key] = self._n_scenes
        return self._textures[key][1]
