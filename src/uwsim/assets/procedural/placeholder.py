"""Labelled boxes as placeholders of about the right size for models that do not exist yet."""

from __future__ import annotations

from ..mesh import Mesh
from .shapes import box, mesh
from .textures import fill, paint_text, to_texture


def labelled_box(label: str, size: tuple[float, float, float]) -> tuple[Mesh, ...]:
    """Return a grey box on the origin's plane z = 0 with its name on every face.

    Args:
        label: Short enough to be read.
        size: Edges x, y, z [m].
    """
    image = fill(128, 256, (0.62, 0.64, 0.66))
    image[:5] = image[-5:] = image[:, :5] = image[:, -5:] = (0.25, 0.26, 0.28)
    paint_text(image, label, (0.5, 0.5), width=0.8, height=0.3, colour=(0.08, 0.08, 0.09))
    x, y, z = size
    shape = box((-x / 2, -y / 2, 0.0), (x / 2, y / 2, z))
    return (mesh(shape, texture=to_texture(f"label/{label}", image, repeats=False)),)
