"""The programs that draw shadow maps: surfaces with holes cast shadows with holes."""

from __future__ import annotations

import moderngl

from ..gpu_model import Batch, GpuModels
from ..instance import INSTANCE
from ..materials.maps import find_mask
from ..program import build

BASE_MAP_UNIT = 0
"""The texture unit of the base colour, as in images."""


class CasterPrograms:
    """The programs of shadow maps: one for opaque surfaces, and one for each alpha of holes.

    Args:
        context: the context of the renderer.
        models: the models and textures on the GPU.
    """

    def __init__(self, context: moderngl.Context, models: GpuModels) -> None:
        self._context, self._models = context, models
        self._opaque_program = self._build({})
        self._masked_programs: dict[int, moderngl.Program] = {}

    def select(self, batch: Batch) -> moderngl.Program:
        """Return the program for a batch, and bind the texture that has its holes."""
        mask = find_mask(batch.texture, batch.material)
        if mask is None:
            return self._opaque_program
        self._models.use(mask.texture, BASE_MAP_UNIT, skips_mipmaps=False, cutoff=mask.cutoff)
        if mask.cutoff not in self._masked_programs:
            self._masked_programs[mask.cutoff] = self._build({"ALPHA_TEST": mask.cutoff})
        return self._masked_programs[mask.cutoff]

    def release(self) -> None:
        """Unbind the textures of holes."""
        self._models.release()

    def _build(self, defines: dict[str, int]) -> moderngl.Program:
        return build(
            self._context,
            "shadow",
            defines=defines,
            blocks=[INSTANCE],
            samplers={"base_map": BASE_MAP_UNIT},
        )
