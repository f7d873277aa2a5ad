r"""The volume scattering function at large angles, from the veil of a lamp in open water.

The black squares of a board do not show backscatter: most of their light is blur from the white
ones. A picture of the lamp's veil in open water, with no object nearer than four attenuation
lengths, does. With the veil :math:`V_1` of the estimated water by the model of `optics.lamp_light`
and the measured veil :math:`V`,

.. math:: \beta(170°) = \frac{V}{V_1}\, b\, p(170°)

The unit of :math:`V` is that of the board in the reference water, whose loss is removed with the
forward model. Standard deviation: 7 % by the veil's model, 5 % by the lamp's geometry.

Not modelled: lobes of lamps that are not uniform in their cone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..optics import Lamp, Medium, compute_lamp_veil
from .estimate import Estimate
from .forward_model import ForwardModel, WaterNumbers, make_phase_function
from .measurements import OpenWaterReading
from .readings import BoardReading

ANGLE = math.radians(170.0)
"""The angle of the result [rad]."""
MODEL_ERROR = math.hypot(0.07, 0.05)
"""The relative standard deviation by the veil's model and the lamp's geometry."""


@dataclass(frozen=True, kw_only=True)
class Backscatter:
    """The scattering of a water at 170 degrees."""

    value: float
    """The volume scattering function at 170 degrees [1/m/sr]."""
    standard_deviation: float
    """The standard deviation [1/m/sr]."""
    ratio: float
    """The value over that of the fitted phase function."""


def estimate_backscatter(
    estimate: Estimate, reading: OpenWaterReading, reference: WaterNumbers
) -> Backscatter | None:
    """Estimate backscatter; None without a board with a reference in the channel."""
    boards = [
        r for r in estimate.readings if isinstance(r, BoardReading) and r.reference is not None
    ]
    if not boards:
        return None
    board = max(boards, key=lambda entry: entry.side)
    same_shape = WaterNumbers(reference.absorption, reference.scattering, estimate.water.shape)
    loss = float(ForwardModel.from_readings([board]).compute_losses(same_shape)[0])
    # The board's reference signal lacks exp(-loss); a white surface in 1 W/m^2 has 1 / pi.
    veil = reading.ratio * math.exp(-loss) / math.pi
    phase = make_phase_function(estimate.water.shape)
    medium = Medium(
        absorption=(estimate.water.absorption,),
        scattering=(estimate.water.scattering,),
        phase_function=phase,
    )
    lamp = Lamp(
        position=reading.lamp_position,
        direction=(0.0, 0.0, 1.0),
        intensity=(1.0,),
        half_angle=reading.lamp_half_angle,
    )
    axis = np.array([0.0, 0.0, 1.0])
    model = float(compute_lamp_veil(medium, lamp, (0.0, 0.0, 0.0), axis, math.inf)[0])
    if not model > 0.0:
        return None
    ratio = veil / model
    value = ratio * estimate.water.scattering * float(phase.compute_density(ANGLE))
    return Backscatter(value=value, standard_deviation=MODEL_ERROR * value, ratio=ratio)
