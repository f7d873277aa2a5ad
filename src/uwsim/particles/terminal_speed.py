r"""Terminal speeds of spheres and bubbles in water.

A sphere that settles or rises has the speed at which drag and weight in water are equal,

.. math:: w^2 = \frac{4}{3} \frac{g d}{C_D} \frac{|\rho_s - \rho|}{\rho}, \qquad
    C_D = \frac{24}{Re} (1 + 0.150\, Re^{0.681}) + \frac{0.407}{1 + 8710 / Re}

(P. P. Brown and D. F. Lawler, *J. Environ. Eng.* 129, 222 (2003)), with the Reynolds number
:math:`Re = w d / \nu`. A small bubble in natural water has a rigid skin of surfactants and follows
this law without mass. A large one is flat, and

.. math:: w = \sqrt{\frac{2.14\, \sigma}{\rho d} + 0.505\, g d}

(R. Clift, J. R. Grace and M. E. Weber, *Bubbles, Drops, and Particles*, Academic Press (1978),
eq. 7-3) with the surface tension :math:`\sigma`. The slower of the two holds; they meet at 1.4 mm.
Not modelled: swarms, growth of a rising bubble, clean water, spiral paths.
"""

from __future__ import annotations

import math

GRAVITY = 9.81
"""The acceleration of gravity [m/s2]."""
WATER_DENSITY = 1025.0
"""The density of sea water [kg/m3]."""
VISCOSITY = 1.05e-6
"""The kinematic viscosity of sea water at 20 degrees Celsius [m2/s]."""
SURFACE_TENSION = 0.0735
"""The surface tension of sea water [N/m]."""
MIN_BUBBLE_WIDTH = 0.2e-3
"""The diameter below which the law of large bubbles is not considered [m]."""
N_ITERATIONS = 60


def compute_sphere_speed(
    diameter: float,
    density: float,
    *,
    water_density: float = WATER_DENSITY,
    viscosity: float = VISCOSITY,
) -> float:
    """Compute the terminal speed of a rigid sphere [m/s].

    Args:
        diameter: the diameter [m].
        density: the density of the sphere [kg/m3]; one below that of water rises.
        water_density: the density of the water [kg/m3].
        viscosity: the kinematic viscosity of the water [m2/s].

    Returns:
        The speed, upwards positive.
    """
    ratio = (water_density - density) / water_density
    drive = 4.0 / 3.0 * GRAVITY * diameter * abs(ratio)  # C_D w^2 [m2/s2]
    low, high = 0.0, 100.0
    for _ in range(N_ITERATIONS):  # C_D w^2 rises with w
        speed = 0.5 * (low + high)
        drag = compute_drag_coefficient(speed * diameter / viscosity) * speed * speed
        low, high = (speed, high) if drag < drive else (low, speed)
    return math.copysign(0.5 * (low + high), ratio)


def compute_drag_coefficient(reynolds: float) -> float:
    """Compute the drag coefficient of a sphere by Brown and Lawler [1]."""
    if reynolds <= 0.0:
        return math.inf
    creeping = 24.0 / reynolds * (1.0 + 0.150 * math.pow(reynolds, 0.681))
    return creeping + 0.407 / (1.0 + 8710.0 / reynolds)


def compute_bubble_speed(diameter: float) -> float:
    """Compute the speed of a bubble that rises in natural sea water [m/s].

    Args:
        diameter: the diameter of a sphere of its volume [m].
    """
    rigid_speed = compute_sphere_speed(diameter, 0.0)
    if diameter < MIN_BUBBLE_WIDTH:
        return rigid_speed
    flat_speed = math.sqrt(
        2.14 * SURFACE_TENSION / (WATER_DENSITY * diameter) + 0.505 * GRAVITY * diameter
    )
    return min(rigid_speed, flat_speed)
