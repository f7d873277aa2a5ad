"""A cable on the sea floor, ``objects/cable``, and a twine of a net, ``objects/twine``.

The cable is a piece of 1 m along y, of 0.1 m diameter. Its sheath is nearly black, with silt and
growth in patches. The twine is a piece of 1 m along y, of 0.01 m diameter. Pieces join at their
ends.
"""

from __future__ import annotations

import numpy as np

from ..parts import Part
from ..shapes import tube
from ..surfaces import make_material
from ..textures import noise, smoothstep

RADIUS, HALF_LENGTH = 0.05, 0.5
"""The radius and the half length of a piece [m]."""
SHEATH, SILT = (0.035, 0.033, 0.030), (0.13, 0.12, 0.09)
"""The reflectances of the sheath and of the silt on it."""
N_SIDES, N_RINGS = 10, 9
TWINE_RADIUS, TWINE = 0.005, (0.055, 0.060, 0.055)
"""The radius of a twine [m], and its reflectance."""
SIZE = 128
"""The side of the image [px]."""


def cable() -> tuple[Part, ...]:
    """Return a straight piece, open at its ends."""
    line = np.zeros((N_RINGS, 3))
    line[:, 1] = np.linspace(-HALF_LENGTH, HALF_LENGTH, N_RINGS)
    shape = tube(line, RADIUS, n=N_SIDES, has_lids=False)
    patches = noise("cable/silt", SIZE, SIZE, cells=4, octaves=5)
    amount = smoothstep(0.3, 1.4, patches)[..., None]
    image = np.array(SHEATH, dtype=np.float32) * np.ones((SIZE, SIZE, 1), np.float32)
    image *= 1.0 + 0.3 * noise("cable/wear", SIZE, SIZE, cells=12, octaves=3)[..., None]
    image = image + (np.array(SILT, dtype=np.float32) - image) * 0.7 * amount
    height = 0.001 * amount[..., 0]
    pixel = 2.0 * HALF_LENGTH / SIZE
    sheath = make_material("cable", image, height, 0.8, pixel=(pixel, pixel))
    return (sheath.cover(shape, crease=2.0),)


def twine() -> tuple[Part, ...]:
    """Return a straight piece of twine, open at its ends."""
    line = np.array([[0.0, -HALF_LENGTH, 0.0], [0.0, HALF_LENGTH, 0.0]])
    shape = tube(line, TWINE_RADIUS, n=4, has_lids=False)
    patches = noise("twine/growth", SIZE, SIZE, cells=8, octaves=4)
    image = np.array(TWINE, dtype=np.float32) * np.ones((SIZE, SIZE, 1), np.float32)
    image *= 1.0 + 0.25 * patches[..., None]
    pixel = 2.0 * HALF_LENGTH / SIZE
    cord = make_material("twine", image, 0.0005 * patches, 0.9, pixel=(pixel, pixel))
    return (cord.cover(shape, crease=2.0),)
