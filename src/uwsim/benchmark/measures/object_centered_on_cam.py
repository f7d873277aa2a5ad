r"""Object centred on a camera: the distance of a body's image from the centre of the image.

.. code-block:: xml

    <objectCenteredOnCam>
      <name>objectCentered</name> <target>blackbox</target> <camera>bowtech1</camera>
    </objectCenteredOnCam>
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ...base.geometry import image_centre, is_in_image
from ...schema import element
from ...world import World
from ..ground_truth import CentroidFromCamera
from ..metrics.signal import VALUES, Signal
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class ObjectCenteredOnCamSpec(MeasureSpec):
    """An ``<objectCenteredOnCam>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES

    target: str = element(refers_to="body")
    """The route of the body whose origin is projected."""
    camera: str = element(refers_to="camera")
    """The name of the virtual camera."""

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before its first sample [px]."""
        return 0.0

    def bind(self, world: World) -> ObjectCenteredOnCam:
        """Resolve camera and target; raises UnknownName if one is unknown."""
        camera = world.camera(self.camera)
        includes_behind = "unseen" in world.compatibility
        projection = CentroidFromCamera(
            camera, world.body(self.target), includes_behind=includes_behind
        )
        size = (camera.intrinsics.width, camera.intrinsics.height)
        return ObjectCenteredOnCam(projection, size, self.value, includes_behind=includes_behind)


class ObjectCenteredOnCam(Measure):
    r"""The distance :math:`\sqrt{d_x^2 + d_y^2}` of a body's projected origin from the centre.

    With the image coordinates u, v of the projected origin [px], in an image of w x h pixels,
    :math:`d_x = (w - 1)/2 - u` and, as the original UWSim counts rows from the bottom,
    :math:`d_y = v - (h - 1)/2`. There is a sample for each step at which the origin projects into
    the image, and no value if it is outside of the image at the last step. The detail ``visible``
    is the fraction of steps with a sample. Not modelled: occlusion.

    Compatibility ``unseen``: there is a sample at each step, wherever the origin projects to;
    points behind the camera are projected through its optical centre, upside down. ``visible`` is
    then 1.
    """

    unit = "px"

    def __init__(
        self,
        projection: CentroidFromCamera,
        size: tuple[int, int],
        value: str,
        *,
        includes_behind: bool = False,
    ) -> None:
        self._projection, self._size, self._statistic = projection, size, value
        self._includes_behind = includes_behind
        self._signal = Signal(("x", "y"))
        self._n_steps = 0
        self._is_visible = False

    def start(self) -> None:
        """Take the first sample."""
        self.update()

    def update(self) -> None:
        """Take a sample, if the body is in the image."""
        pixel = self._projection.pixel()
        self._n_steps += 1
        u, v = (math.nan, math.nan) if pixel is None else pixel
        self._is_visible = pixel is not None and (
            self._includes_behind or is_in_image(u, v, *self._size)
        )
        if self._is_visible:
            centre_u, centre_v = image_centre(*self._size)
            offset = (centre_u - u, v - centre_v)
            self._signal.add(math.hypot(*offset), offset)

    @property
    def value(self) -> float | None:
        """The last distance, or the statistic given by ``u:value`` [px]."""
        return self._signal.value(self._statistic) if self._is_visible else None

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if not self._n_steps:
            return "it was never on"
        return None if self._is_visible else "the target is not in the image"

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of distance and components, and the fraction of steps with a sample."""
        visible_share = self._signal.n / self._n_steps if self._n_steps else None
        return {**self._signal.details, "visible": visible_share}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the distance and its components."""
        return ("total", "x", "y")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The newest sample; None while the body is not in the image."""
        return self._signal.last_sample if self._is_visible else (None, None, None)
