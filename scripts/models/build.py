"""Making the models of a file and encoding them."""

from __future__ import annotations

from uwsim.base.numerics.opencv import deterministic_opencv

from .catalogue import SCENERY, STAND_INS
from .glb import encode_glb
from .parts import Part

FILES = (*STAND_INS, *SCENERY)
"""The files in ``data/models``, without ``.glb``."""


def build_file(file: str) -> bytes:
    """Make the models of a file and encode them as GLB; equal sources give equal bytes."""
    with deterministic_opencv():
        if file in STAND_INS:
            return encode_glb(
                {
                    name: tuple(Part(mesh=mesh, is_lossless=True) for mesh in make())
                    for name, make in STAND_INS[file].items()
                }
            )
        return encode_glb({name: make() for name, make in SCENERY[file].items()})
