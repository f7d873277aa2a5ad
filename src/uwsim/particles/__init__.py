"""Particles in the water that cameras see: marine snow, bubbles, clouds of sediment."""

from __future__ import annotations

from .bubbles import BubblesSpec
from .lattice import PARTICLE, Drift, View, find_particles, find_plume
from .marine_snow import MarineSnowSpec
from .population import Kind, SizeClass
from .particles import ParticlesSpec
from .terminal_speed import compute_bubble_speed, compute_sphere_speed

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
