"""Particles in the water that cameras see: marine snow, bubbles, clouds of sediment."""

from __future__ import annotations

from .bubbles import BubblesSpec
from .draws import PARTICLE
from .lattice import find_particles
from .marine_snow import MarineSnowSpec
from .particles import ParticlesSpec
from .plume import find_plume
from .population import Kind, SizeClass
from .terminal_speed import compute_bubble_speed, compute_sphere_speed
from .view import Drift, View

__all__ = [
    "PARTICLE",
    "BubblesSpec",
    "Drift",
    "Kind",
    "MarineSnowSpec",
    "ParticlesSpec",
    "SizeClass",
    "View",
    "compute_bubble_speed",
    "compute_sphere_speed",
    "find_particles",
    "find_plume",
]
