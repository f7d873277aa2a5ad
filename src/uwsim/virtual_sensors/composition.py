r"""The composition of a recorded image with rendered virtual objects, and with added water.

A pixel shows the virtual object if that is nearer than the real surface, at the range :math:`R`
along the pixel's ray. Any other pixel keeps its recorded colour :math:`c` through the added water.
For an added fog of the density :math:`f` and the colour :math:`g`,

.. math:: c' = c\, t + g\, (1 - t), \qquad t = e^{-(f R)^2},

as in the renderer (`uwsim.rendering.water`). The exponents of two fogs add up, so an image of a
scene in the fog :math:`f_0` becomes that in :math:`\sqrt{f_0^2 + f^2}`. For physical water over an
image that was recorded in clear water, in linear light and in each channel,

.. math:: J' = J\, h(R) + B\, (1 - h(R))

with the fraction h of a wide target's light that arrives (`uwsim.optics.transmission`), and the
radiance B of the water behind everything, rendered for the pixel. A recorded image is taken as
sRGB with the exposure of the scene's cameras. A real surface that no geometry covers has an
infinite range, unless a range is assumed.

Particles change each colour as they change the rendered image of the whole scene, real and virtual.

Not modelled: the blur of physical water and the veil of lamps over recorded pixels, light from
virtual objects on real surfaces, refraction, and soft edges of virtual objects.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import exp
from ..base.numerics.srgb import decode_array
from ..cameras.digital_numbers import encode
from ..errors import BadSetting
from ..optics import Medium
from ..optics.transmission import compute_full_field

Pixels = npt.NDArray[np.uint8]
GREY = np.array([0.299, 0.587, 0.114])
"""The weights of red, green and blue in the brightness of grey images (ITU-R BT.601)."""
MIN_LIGHT = 1.0
"""The grey level that is added to both images whose ratio is a shadow."""
SAME_RANGE = 1e-3
"""The greatest difference of the ranges of one surface, as a fraction of the range [1]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Layers:
    """The rendered layers of the view of a camera."""

    virtual_colour: Pixels
    """The colours of the virtual objects alone, through all the water, (h, w, 3)."""
    virtual_range: npt.NDArray[np.float32]
    """The ranges of the virtual objects, (h, w) [m]; inf: none."""
    real_range: npt.NDArray[np.float32]
    """The ranges of the real surfaces, (h, w) [m]; inf: unknown, or none."""
    particles: npt.NDArray[np.int16] | None = None
    """The change of each stored colour by particles in the water, (h, w, 3); None: none."""
    shadow: npt.NDArray[np.float32] | None = None
    """The fraction of the light that virtual objects leave on real surfaces, (h, w, 3) [0..1];
    None: all."""

    @property
    def is_virtual(self) -> npt.NDArray[np.bool_]:
        """The pixels that show a virtual object, (h, w)."""
        is_nearer: npt.NDArray[np.bool_] = self.virtual_range < self.real_range
        return is_nearer


@dataclass(frozen=True, kw_only=True, eq=False)
class AddedFog:
    """A fog over recorded pixels."""

    density: float
    """The density f [1/m]."""
    colour: tuple[float, float, float]
    """The colour g in red, green and blue [0..1]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class AddedPhysicalWater:
    """A physical water over recorded pixels, which show the scene in clear water."""

    medium: Medium
    """The coefficients of the water in red, green and blue."""
    background: Pixels
    """The stored colours of the water behind everything, (h, w, 3)."""


AddedWater = AddedFog | AddedPhysicalWater | None


def compose_image(recorded_image: Pixels, layers: Layers, water: AddedWater = None) -> Pixels:
    """Return the recorded image with virtual objects and added water.

    Args:
        recorded_image: the recorded image, (h, w, 3), or (h, w) if it is grey.
        layers: the rendered layers of the same view.
        water: the water that is added over the recorded pixels; None: none.

    Raises:
        BadSetting: the recorded image has another size than the layers.
    """
    if recorded_image.shape[:2] != layers.real_range.shape:
        height, width = layers.real_range.shape
        raise BadSetting(
            f"A recorded image has {recorded_image.shape[1]}x{recorded_image.shape[0]} pixels; "
            f"the camera of the scene has {width}x{height}."
        )
    colours = (
        recorded_image
        if recorded_image.ndim == 3
        else np.repeat(recorded_image[..., None], 3, axis=2)
    )
    if layers.shadow is not None:
        colours = np.rint(colours * layers.shadow).astype(np.uint8)
    if isinstance(water, AddedFog):
        colours = add_fog(colours, layers.real_range, water)
    elif water is not None:
        colours = add_physical_water(colours, layers.real_range, water)
    is_virtual = layers.is_virtual[..., None]
    image: Pixels = np.where(is_virtual, layers.virtual_colour, colours)
    if layers.particles is not None:
        image = (image + layers.particles).clip(0, 255).astype(np.uint8)
    return image if recorded_image.ndim == 3 else _make_grey(image)


def add_fog(colours: Pixels, ranges: npt.NDArray[np.float32], fog: AddedFog) -> Pixels:
    """Return colours (h, w, 3) through fog, for surfaces at ranges (h, w) [m]."""
    if fog.density <= 0.0:
        return colours
    exponents = np.minimum(fog.density * ranges.astype(np.float64), 1e3)
    transmission = exp(-(exponents * exponents))[..., None]
    foggy = transmission * colours + (1.0 - transmission) * (255.0 * np.array(fog.colour))
    return np.rint(foggy).clip(0.0, 255.0).astype(np.uint8)


def add_physical_water(
    colours: Pixels, ranges: npt.NDArray[np.float32], water: AddedPhysicalWater
) -> Pixels:
    """Return colours (h, w, 3) through physical water, for surfaces at ranges (h, w) [m]."""
    is_known = np.isfinite(ranges)
    distances = np.where(is_known, ranges.astype(np.float64), 0.0)
    arrival = np.where(is_known[..., None], compute_full_field(water.medium, distances), 0.0)
    table = decode_array(np.arange(256.0) / 255.0)
    light = table[colours] * arrival + table[water.background] * (1.0 - arrival)
    return np.rint(255.0 * encode(light)).clip(0.0, 255.0).astype(np.uint8)


def compute_shadow(
    lit_colour: Pixels,
    unlit_colour: Pixels,
    lit_range: npt.NDArray[np.float32],
    unlit_range: npt.NDArray[np.float32],
) -> npt.NDArray[np.float32]:
    """Return the fraction of light that virtual objects leave on real surfaces, (h, w, 3).

    Args:
        lit_colour: the real surfaces alone, (h, w, 3).
        unlit_colour: all surfaces, with the shadows of the virtual ones, (h, w, 3).
        lit_range: the ranges of the real surfaces, (h, w) [m].
        unlit_range: the ranges of all surfaces, (h, w) [m].
    """
    ratio = (unlit_colour + np.float32(MIN_LIGHT)) / (lit_colour + np.float32(MIN_LIGHT))
    with np.errstate(invalid="ignore"):
        is_same = np.abs(lit_range - unlit_range) <= SAME_RANGE * lit_range
    return np.where(is_same[..., None], ratio.clip(0.0, 1.0), 1.0).astype(np.float32)


def _make_grey(colours: Pixels) -> Pixels:
    red, green, blue = (colours[..., i].astype(np.float64) for i in range(3))
    grey = GREY[0] * red + GREY[1] * green + GREY[2] * blue
    levels: Pixels = np.rint(grey).clip(0.0, 255.0).astype(np.uint8)
    return levels
