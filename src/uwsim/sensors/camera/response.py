"""The response of a camera: exposure time, electrons, noise, numbers and shutter.

.. code-block:: xml

    <u:response>
      <u:exposureTime>0.008</u:exposureTime>
      <u:fullWell>10500</u:fullWell>
      <u:readNoise>2.4</u:readNoise>
      <u:shutter>rolling</u:shutter> <u:rowTime>2e-5</u:rowTime>
      <u:output>linear12</u:output>
    </u:response>
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...cameras import CameraResponse, Shutter
from ...cameras.vignetting import NO_VIGNETTING, evaluate_polynomial
from ...schema import Numbers, Spec, element

MAX_TIME = 10.0
"""The greatest exposure time and row time [s]."""
N_FALLOFF = 3
"""The number of coefficients of a measured vignetting."""


@dataclass(frozen=True, kw_only=True)
class ResponseSpec(Spec):
    """A ``<u:response>``: the response of a camera, from the numbers of its data sheet.

    It replaces the noise ``<std>``. Light is linear until the numbers are stored.
    """

    exposure_time: float = element(
        namespaced=True, default=0.01, exclusive_minimum=0.0, maximum=MAX_TIME
    )
    """The exposure time [s]."""
    full_well: float = element(namespaced=True, default=10_000.0, minimum=10.0, maximum=1e7)
    """The saturation capacity of a pixel [e-]."""
    gain: float | None = element(
        namespaced=True, default=None, exclusive_minimum=0.0, maximum=10_000.0
    )
    """The electrons of a step of 12 bit, the inverse of the system gain K [e-/DN]. Without it, full
    scale is the full well."""
    read_noise: float = element(namespaced=True, default=3.0, minimum=0.0, maximum=10_000.0)
    """The standard deviation of the temporal dark noise [e-]."""
    dark_current: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1e7)
    """The dark current of a pixel [e-/s]."""
    black_level: float = element(namespaced=True, default=64.0, minimum=0.0, maximum=2048.0)
    """The number without light [DN of 12 bit]."""
    sensitivity: float | None = element(
        namespaced=True, default=None, exclusive_minimum=0.0, maximum=1e12
    )
    """The electrons per second of a pixel on the axis that sees a white surface in the irradiance 1
    [e-/s]. Without it, the aperture is set so that the light of full scale in the scene gives full
    scale in the exposure time."""
    vignetting: Literal["cos4", "none"] = element(namespaced=True, default="cos4")
    """The vignetting: the natural law of a lens, cos^4 of the angle in front of it, or none."""
    falloff: Numbers = element(namespaced=True, default=())
    """The coefficients a2, a4 and a6 of a measured vignetting instead, 1 + a2 r^2 + a4 r^4 + a6 r^6
    with r = 1 in the corner [1]."""
    output: Literal["srgb8", "linear12"] = element(namespaced=True, default="srgb8")
    """The numbers of the image: sRGB of 8 bit (rgb8, mono8), or linear numbers of 12 bit, 0 to 4095
    (rgb16, mono16)."""
    shutter: Literal["global", "rolling"] = element(namespaced=True, default="global")
    """The shutter: all rows at once, or row by row from the top. The time of an image is the middle
    of the exposure of the middle row."""
    row_time: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=MAX_TIME)
    """The time from the start of a row to that of the next, with a rolling shutter [s]."""
    motion_blur: bool = element(namespaced=True, default=True)
    """True if the motion of the camera during the exposure blurs the image."""

    def find_errors(self, height: int) -> Iterator[str]:
        """Yield the errors of the numbers together, for an image of ``height`` rows."""
        if self.shutter == "rolling" and self.row_time == 0.0:
            yield "the shutter is rolling without a <u:rowTime>; expected more than 0 s"
        if self.shutter == "global" and self.row_time > 0.0:
            yield (
                f"<u:rowTime> is {self.row_time:g} s with a global shutter; expected "
                "<u:shutter>rolling</u:shutter>"
            )
        if self.row_time * height > MAX_TIME:
            yield (
                f"{height} rows of {self.row_time:g} s last {self.row_time * height:g} s; "
                f"expected at most {MAX_TIME:g} s"
            )
        if self.read_noise > self.full_well:
            yield (
                f"<u:readNoise> is {self.read_noise:g} e- and <u:fullWell> {self.full_well:g} e-; "
                "expected less noise than the full well"
            )
        if self.falloff and len(self.falloff) != N_FALLOFF:
            yield f"<u:falloff> has {len(self.falloff)} numbers; expected 3: a2 a4 a6"
        elif self.falloff:
            squares = np.linspace(0.0, 1.0, 101)
            values = evaluate_polynomial(tuple(self.falloff), squares)
            if float(values.min()) <= 0.0 or float(values.max()) > 2.0:
                yield "<u:falloff> is not between 0 and 2 everywhere in the image"

    @property
    def camera_response(self) -> CameraResponse:
        """The electrons and numbers."""
        return CameraResponse(
            exposure_time=self.exposure_time,
            full_well=self.full_well,
            gain=self.gain,
            read_noise=self.read_noise,
            dark_current=self.dark_current,
            black_level=self.black_level,
            sensitivity=self.sensitivity,
            output=self.output,
        )

    @property
    def camera_shutter(self) -> Shutter:
        """The times of the rows."""
        return Shutter(
            mode=self.shutter,
            row_time=self.row_time,
            exposure_time=self.exposure_time if self.motion_blur else 0.0,
        )

    @property
    def falloff_coefficients(self) -> tuple[float, ...] | None:
        """The coefficients of `uwsim.cameras.vignetting.compute_falloff`."""
        if self.falloff:
            return tuple(self.falloff)
        return None if self.vignetting == "cos4" else NO_VIGNETTING
