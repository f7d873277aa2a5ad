"""Signals of LEDs and boards from the path tracer: the truth of the calibration's tests.

The water fills the space around an LED, and the camera's side of a board. The board's grey card is
infinite, and its second reflection is not traced.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tests.optics.path_tracer import PhaseTables, _trace_to_plane, tabulate, trace_led
from uwsim.base.numerics.jit import njit
from uwsim.optics import PhaseFunction

FloatArray = npt.NDArray[np.float64]

HALF_ANGLES = np.radians([0.25, 0.5, 1.0, 2.0, 5.0, 10.0])
SIDES = (0.15, 0.04, 0.01)
LAMP_OFFSET = 0.15
LAMP_HALF_ANGLE = math.radians(30.0)
WHITE, BLACK = 0.9, 0.05
N_RINGS = 100
RING_WIDTH = 0.02
"""The width of a ring of the lamp's irradiance, in units of the distance."""


@dataclass(frozen=True)
class Water:
    """A water for the tracer."""

    phase: PhaseFunction
    beam_attenuation: float
    scattering: float

    @property
    def albedo(self) -> float:
        return self.scattering / self.beam_attenuation


def trace_led_signals(
    water: Water, distance: float, n_paths: int, seed: int, half_angles: FloatArray = HALF_ANGLES
) -> FloatArray:
    """Trace the light of a Lambertian LED of 1 W/sr within half-angles."""
    depth = water.beam_attenuation * distance
    estimate = trace_led(tabulate(water.phase), depth, water.albedo, half_angles, n_paths, seed)
    return estimate.value / distance**2


def trace_board_signals(
    water: Water, distance: float, n_paths: int, seed: int, sides: tuple[float, ...] = SIDES
) -> FloatArray:
    """Trace the differences of white and black squares, read in the inner half of all four."""
    tables = tabulate(water.phase)
    irradiance = trace_lamp_irradiance(tables, water, distance, 4 * n_paths, seed)
    generator = np.random.default_rng(seed + 1)
    return np.array(
        [
            _trace_difference(
                generator,
                tables.angles,
                water.beam_attenuation,
                water.albedo,
                distance,
                side,
                irradiance,
                n_paths,
            )
            for side in sides
        ]
    )


def trace_lamp_irradiance(
    tables: PhaseTables, water: Water, distance: float, n_paths: int, seed: int
) -> FloatArray:
    """Trace the scattered irradiance of the board by the lamp, in rings around its axis."""
    return _trace_irradiance(
        np.random.default_rng(seed),
        tables.angles,
        water.beam_attenuation,
        water.albedo,
        distance,
        n_paths,
    )


@njit
def _trace_irradiance(
    generator: np.random.Generator,
    angles: FloatArray,
    attenuation: float,
    albedo: float,
    distance: float,
    n_paths: int,
) -> FloatArray:
    irradiance = np.zeros(N_RINGS)
    position, direction = np.zeros(3), np.zeros(3)
    width = RING_WIDTH * distance
    edge = math.cos(LAMP_HALF_ANGLE)
    power = 2.0 * math.pi * (1.0 - edge) / n_paths
    for _ in range(n_paths):
        cosine = 1.0 - generator.random() * (1.0 - edge)
        azimuth = 2.0 * math.pi * generator.random()
        sine = math.sqrt(1.0 - cosine * cosine)
        position[:] = 0.0
        direction[0], direction[1] = sine * math.cos(azimuth), sine * math.sin(azimuth)
        direction[2] = cosine
        weight = _trace_to_plane(
            generator, angles, attenuation, albedo, distance, position, direction
        )
        ring = int(math.hypot(position[0], position[1]) / width)
        if weight > 0.0 and ring < N_RINGS:
            irradiance[ring] += weight * power / (math.pi * width**2 * (2 * ring + 1))
    return irradiance


@njit
def compute_irradiance(
    attenuation: float, distance: float, radius: float, irradiance: FloatArray
) -> float:
    """Compute the irradiance at a radius from the lamp's axis, direct and scattered."""
    length = math.hypot(radius, distance)
    cosine = distance / length
    value = 0.0
    if cosine >= math.cos(LAMP_HALF_ANGLE):
        value = math.exp(-attenuation * length) * cosine / length**2
    place = max(radius / (RING_WIDTH * distance) - 0.5, 0.0)
    ring = int(place)
    if ring < N_RINGS - 1:
        value += irradiance[ring] + (place - ring) * (irradiance[ring + 1] - irradiance[ring])
    return value


@njit
def _trace_difference(
    generator: np.random.Generator,
    angles: FloatArray,
    attenuation: float,
    albedo: float,
    distance: float,
    side: float,
    irradiance: FloatArray,
    n_paths: int,
) -> float:
    total = 0.0
    position, direction = np.zeros(3), np.zeros(3)
    direct = math.exp(-attenuation * distance)
    for _ in range(n_paths):
        x = side * (0.25 + 0.5 * generator.random())
        y = side * (0.25 + 0.5 * generator.random())
        if generator.random() < 0.5:
            x = -x
        if generator.random() < 0.5:
            y = -y
        sign = 1.0 if x * y > 0.0 else -1.0
        # The direct ray, then a scattered one.
        value = compute_irradiance(
            attenuation, distance, math.hypot(x - LAMP_OFFSET, y), irradiance
        )
        total += direct * value * (WHITE if sign > 0.0 else -BLACK)
        position[0], position[1], position[2] = x, y, 0.0
        direction[:] = 0.0
        direction[2] = 1.0
        weight = _trace_to_plane(
            generator, angles, attenuation, albedo, distance, position, direction
        )
        if weight > 0.0:
            x, y = position[0], position[1]
            reflectance = 0.5 * (WHITE + BLACK)
            if abs(x) < side and abs(y) < side:
                reflectance = WHITE if x * y > 0.0 else BLACK
            value = compute_irradiance(
                attenuation, distance, math.hypot(x - LAMP_OFFSET, y), irradiance
            )
            total += sign * weight * value * reflectance
    return 2.0 * total / n_paths / math.pi
