r"""Clouds of sediment as a bounded number of Gaussian puffs.

A puff of the mass m has the density :math:`m\, (2\pi\sigma^2)^{-3/2} e^{-r^2 / 2\sigma^2}`. It
moves with the water and with the velocity v of the jet that it was born in, which decreases as
:math:`e^{-t/T}` with T = 2 s. It grows by diffusion and by the water that it entrains on its way,

.. math:: \frac{d\sigma^2}{dt} = 2 K + 2 \alpha \sigma |v|

with :math:`\alpha` = 0.25 (J. M. Richards, *J. Fluid Mech.* 21, 97 (1965)), sinks at the settling
speed w, and loses to the floor, h below its centre,

.. math:: \frac{dm}{dt} = -m\, w \sqrt{\frac{2}{\pi \sigma^2}}\, e^{-h^2 / 2\sigma^2}

Light that passes it at the distance d from its centre, from :math:`t_1` to :math:`t_2` along the
ray with the centre's foot at :math:`t_0`, has the optical depth

.. math:: \tau = \frac{s\, m}{4 \pi \sigma^2} e^{-d^2 / 2\sigma^2} \left[
    \mathrm{erf}\left(\frac{t_2 - t_0}{\sqrt 2 \sigma}\right) -
    \mathrm{erf}\left(\frac{t_1 - t_0}{\sqrt 2 \sigma}\right) \right]

with the scattering s per mass. When there is no room for a new puff the two oldest become one with
their mass, centre and variance. Not modelled: shear, walls, and the mirror image in the floor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..base.geometry import Array
from ..base.record import Record
from .sediment import SedimentSpec

MAX_PUFFS = 96
"""The largest number of puffs of a scene."""
X, Y, Z, VARIANCE, MASS, VELOCITY_X, VELOCITY_Y, VELOCITY_Z, FLOOR, BIRTH, NUMBER = range(11)
"""The columns of a puff: the centre [m], sigma^2 [m2], the mass [kg], the velocity of the jet
[m/s], the height of the floor in W [m], the time of its birth [s], and its number."""
N_COLUMNS = 11
DECAY_TIME = 2.0
"""The time T in which the velocity of the jet falls to 1/e [s]."""
ENTRAINMENT = 0.25
"""The growth of a puff's width over the way of its jet [1]."""
MIN_MASS = 1e-5
"""The mass below which a puff counts as settled [kg]."""


@dataclass(slots=True)
class PuffsState(Record):
    """The state of the clouds of a scene."""

    puffs: Array = field(default_factory=lambda: np.zeros((MAX_PUFFS, N_COLUMNS)))
    """The puffs, the oldest first, (`MAX_PUFFS`, `N_COLUMNS`); in W."""
    n_puffs: int = 0
    """The number of puffs."""
    n_born: int = 0
    """The number of puffs born so far."""
    eroded_mass: float = 0.0
    """The mass eroded so far [kg]."""
    settled_mass: float = 0.0
    """The mass settled so far [kg]."""
    time: float = 0.0
    """The time up to which the puffs have moved [s]."""


class Puffs:
    """The clouds of sediment of a scene."""

    def __init__(self, spec: SedimentSpec) -> None:
        self._spec = spec
        self.state = PuffsState()
        """The state: the puffs."""

    def add(self, place: Array, width: float, mass: float, velocity: Array, floor: float) -> None:
        """Add a puff.

        Args:
            place: the centre in W, (3,) [m].
            width: sigma, above 0 [m].
            mass: the mass [kg].
            velocity: the velocity of the jet in W, (3,) [m/s].
            floor: the height of the floor in W [m].
        """
        state = self.state
        if state.n_puffs == MAX_PUFFS:
            self._merge_oldest()
        puff = state.puffs[state.n_puffs]
        puff[X : Z + 1], puff[VELOCITY_X : VELOCITY_Z + 1] = place, velocity
        puff[VARIANCE], puff[MASS], puff[FLOOR] = width * width, mass, floor
        puff[BIRTH], puff[NUMBER] = state.time, state.n_born
        state.n_puffs += 1
        state.n_born += 1
        state.eroded_mass += mass

    def advance(self, time: float, water_velocity: Array) -> None:
        """Move the puffs up to a time [s] in water that moves, (3,) [m/s]."""
        state = self.state
        n = state.n_puffs
        moved_puffs = self.predict(time, water_velocity)
        lost_mass = state.puffs[:n, MASS].copy() - moved_puffs[:, MASS]
        is_settled = moved_puffs[:, MASS] < MIN_MASS
        state.settled_mass += math.fsum(lost_mass.tolist())
        state.settled_mass += math.fsum(moved_puffs[is_settled, MASS].tolist())
        kept_puffs = moved_puffs[~is_settled]
        state.n_puffs = len(kept_puffs)
        state.puffs[: state.n_puffs] = kept_puffs
        state.puffs[state.n_puffs :] = 0.0
        state.time = time

    def predict(self, time: float, water_velocity: Array) -> Array:
        """Return the puffs at a time after that of the state, (n, `N_COLUMNS`)."""
        state, spec = self.state, self._spec
        puffs = state.puffs[: state.n_puffs].copy()
        step = time - state.time
        if step <= 0.0 or not len(puffs):
            return puffs
        decay = math.exp(-step / DECAY_TIME)
        jet_velocities = puffs[:, VELOCITY_X : VELOCITY_Z + 1]
        ways = jet_velocities * (DECAY_TIME * (1.0 - decay))
        lengths = np.sqrt((ways * ways).sum(axis=1))
        puffs[:, X : Z + 1] += ways + water_velocity * step
        puffs[:, Z] = np.maximum(puffs[:, Z] - spec.settling_speed * step, puffs[:, FLOOR])
        puffs[:, VELOCITY_X : VELOCITY_Z + 1] = jet_velocities * decay
        widths = np.sqrt(puffs[:, VARIANCE]) + ENTRAINMENT * lengths
        puffs[:, VARIANCE] = widths * widths + 2.0 * spec.diffusivity * step
        for puff in puffs:
            width, height = math.sqrt(puff[VARIANCE]), puff[Z] - puff[FLOOR]
            rate = spec.settling_speed * math.sqrt(2.0 / math.pi) / width
            puff[MASS] *= math.exp(-step * rate * math.exp(-0.5 * (height / width) ** 2))
        return puffs

    def _merge_oldest(self) -> None:
        """Merge the two oldest puffs; mass, centre, variance and momentum remain."""
        state = self.state
        first, second = state.puffs[0].copy(), state.puffs[1].copy()
        mass = first[MASS] + second[MASS]
        share = second[MASS] / mass
        puff = (1.0 - share) * first + share * second
        offset = second[X : Z + 1] - first[X : Z + 1]
        puff[VARIANCE] += share * (1.0 - share) * float((offset * offset).sum()) / 3.0
        puff[MASS], puff[BIRTH], puff[NUMBER] = mass, first[BIRTH], second[NUMBER]
        state.puffs[1] = puff
        state.puffs[:-1] = state.puffs[1:].copy()
        state.puffs[-1] = 0.0
        state.n_puffs -= 1


def compute_optical_depth(
    centre: Array, width: float, mass: float, scattering: float, ray: Array, end: float
) -> float:
    """Compute the optical depth of a puff along a ray from the origin: the formula above.

    Args:
        centre: the centre, (3,) [m].
        width: sigma [m].
        mass: the mass [kg].
        scattering: the scattering over the mass per volume [m2/kg].
        ray: the unit direction of the ray, (3,).
        end: the end of the ray [m].
    """
    foot = math.fsum((ray * centre).tolist())
    offset = centre - foot * ray
    square = math.fsum((offset * offset).tolist()) / (2.0 * width * width)
    scale = 1.0 / (math.sqrt(2.0) * width)
    part = math.erf((end - foot) * scale) - math.erf(-foot * scale)
    return scattering * mass / (4.0 * math.pi * width * width) * math.exp(-square) * part
