r"""The response of a camera: electrons, noise and digital numbers, from the light of each pixel.

For a pixel with the light :math:`L`, the vignetting :math:`V` and the exposure time :math:`t`, the
mean number of electrons is

.. math:: \lambda = S\, t\, V L + i_d\, t

with the sensitivity :math:`S` [e-/s] and the dark current :math:`i_d` [e-/s]. The electrons are a
Poisson number of that mean, at most the full well, plus the read noise :math:`N(0, r^2)`. With the
gain :math:`K` [e-/DN] and the black level :math:`n_0` [DN], the digital number is

.. math:: n = \operatorname{clip}(\lfloor n_0 + e / K + 1/2 \rfloor, 0, 4095)

These are the quantities of EMVA 1288, the standard of data sheets of cameras. (:math:`K` there is
the inverse, the overall system gain [DN/e-].) See `electrons` for the law of the numbers.

Not modelled: a Bayer pattern (each pixel has red, green and blue), fixed-pattern noise and
non-uniformity, blooming, cross talk, read noise of pixels whose well is full.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from .digital_numbers import FULL_SCALE, look_up, srgb_table
from .electrons import EXACT_LIMIT, draw_numbers, draw_rare_numbers
from .noise_words import gaussian_quantiles

Output = Literal["srgb8", "linear12"]
"""The numbers of an image: 8 bit with the curve of sRGB, or 12 bit in proportion to the light."""
LUMINANCE = (0.2126, 0.7152, 0.0722)
"""The weights of red, green and blue in the light of a grey pixel (ITU-R BT.709)."""

Light = npt.NDArray[np.float32]
"""The light of each pixel, (h, w, 3 or more); only the first three channels count."""
Pixels = npt.NDArray[np.uint8] | npt.NDArray[np.uint16]
"""An image, (h, w, 3), or (h, w) if it is grey."""


@dataclass(frozen=True, kw_only=True)
class CameraResponse:
    """The numbers of a camera, as on its data sheet."""

    exposure_time: float = 0.01
    """The exposure time [s]."""
    full_well: float = 10_000.0
    """The saturation capacity of a pixel [e-]."""
    gain: float | None = None
    """The electrons of a step of 12 bit, 1/K of EMVA 1288 [e-/DN]; None: full scale is the full
    well."""
    read_noise: float = 3.0
    """The standard deviation of the temporal dark noise [e-]."""
    dark_current: float = 0.0
    """The dark current of a pixel [e-/s]."""
    black_level: float = 64.0
    """The digital number without light [DN]."""
    sensitivity: float | None = None
    """The electrons per second of a pixel on the axis that sees the light 1 [e-/s]; None: the light
    of full scale in the scene fills the scale."""
    output: Output = "srgb8"
    """The numbers of the image."""
    has_noise: bool = True
    """True if the electrons have shot noise and read noise."""

    @property
    def electrons_per_number(self) -> float:
        """The electrons of a step of 12 bit [e-/DN]."""
        if self.gain is not None:
            return self.gain
        return self.full_well / (FULL_SCALE - self.black_level)

    @property
    def full_scale(self) -> float:
        """The electrons of the greatest digital number, or of a full well if it is less [e-]."""
        scale = self.electrons_per_number * (FULL_SCALE - self.black_level)
        return min(self.full_well, scale)

    def count_electrons(self, exposure: float) -> float:
        """Return the mean electrons of a pixel on the axis that sees the light 1.

        Args:
            exposure: the ratio of full scale to light, which counts without a sensitivity.
        """
        if self.sensitivity is None:
            return self.full_scale * exposure
        return self.sensitivity * self.exposure_time

    def expose(
        self, light: Light, falloff: npt.NDArray[np.float32], key: int, *, exposure: float = 1.0
    ) -> Pixels:
        """Take an image of light.

        Args:
            light: the light of each pixel, (h, w, channels), or (h, w, 1) for a grey image.
            falloff: the vignetting of each pixel, (h, w) [1].
            key: the 64-bit key of the noise.
            exposure: the ratio of full scale to light, which counts without a sensitivity.

        Returns:
            The image, (h, w, 3), or (h, w); 8 or 16 bit.
        """
        numbers = self.digitize(light, falloff, key, exposure=exposure)
        if self.output == "linear12":
            return numbers
        return look_up(numbers, srgb_table(self.black_level))

    def digitize(
        self, light: Light, falloff: npt.NDArray[np.float32], key: int, *, exposure: float = 1.0
    ) -> npt.NDArray[np.uint16]:
        """Return the digital numbers of light, 0..4095; the arguments are those of `expose`."""
        channels = 1 if light.shape[2] < 3 else 3
        numbers = np.empty((*light.shape[:2], channels), np.uint16)
        draw = draw_numbers if self.read_noise >= EXACT_LIMIT else draw_rare_numbers
        if not self.has_noise:
            draw = draw_numbers
        draw(
            np.ascontiguousarray(light, dtype=np.float32),
            np.ascontiguousarray(falloff, dtype=np.float32),
            np.array(
                [
                    self.count_electrons(exposure),
                    self.dark_current * self.exposure_time,
                    self.read_noise,
                    self.full_well,
                    1.0 / self.electrons_per_number,
                    self.black_level,
                    float(self.has_noise),
                ],
                dtype=np.float32,
            ),
            np.uint64(key),
            gaussian_quantiles(),
            numbers,
        )
        return np.ascontiguousarray(numbers[..., 0]) if channels == 1 else numbers


def weigh_grey(light: Light) -> Light:
    """Return the light of grey pixels, (h, w, 1), from red, green and blue."""
    red, green, blue = (np.float32(weight) for weight in LUMINANCE)
    grey: Light = red * light[..., 0] + green * light[..., 1] + blue * light[..., 2]
    return grey[..., None]
