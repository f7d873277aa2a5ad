"""Lattices over small targets: the rays that bounds decide on are those that sines decide on."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.sensors.sonar.small_targets import (
    MAX_RAYS,
    N_RAYS_ACROSS,
    TURN,
    Discs,
    Fan,
    create_lattice,
)

HIGHEST = 0.3
"""Elevation up to which there are rays [rad]."""


def discs_of(radius: float, seed: int) -> Discs:
    """40 discs, each of a surface of its own, around the beams of `FAN` and beyond them."""
    rng = np.random.default_rng(seed)
    azimuth = rng.uniform(-1.1, 1.1, 40)
    elevation = rng.uniform(-1.3 * HIGHEST, 1.3 * HIGHEST, 40)
    level = np.cos(elevation)
    directions = [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)]
    radii = radius * rng.uniform(0.3, 1.0, 40)
    return Discs(azimuth, elevation, radii, np.stack(directions, axis=1), np.arange(40, dtype="i4"))


FAN = Fan(first_azimuth=-0.7, step=0.01, n=141, width=0.01, aperture=0.3)


def counted(discs: Discs) -> int:
    """The rays within the discs that beams receive, by the angle of each to the middle."""
    total = 0
    for azimuth, elevation, radius, middle in zip(*discs[:4], strict=True):
        step, shrink = 2.0 / N_RAYS_ACROSS * math.sqrt(radius**2), math.cos(elevation)
        n = math.ceil(1.5 * math.asin(math.sin(radius) / shrink) / step) + 1
        i, j = np.meshgrid(np.arange(-n, n + 1), np.arange(-n, n + 1), indexing="ij")
        turned = azimuth + step * (TURN[0] * i - TURN[1] * j) / shrink
        raised = elevation + step * (TURN[1] * i + TURN[0] * j)
        level = np.cos(raised)
        along = middle[0] * level * np.cos(turned) + middle[1] * level * np.sin(turned)
        along += middle[2] * np.sin(raised)
        margin = 1.25 * FAN.width
        is_received = (turned >= -0.7 - margin) & (turned <= 0.7 + margin)
        total += int(((along >= math.cos(radius)) & (abs(raised) <= HIGHEST) & is_received).sum())
    return total


@pytest.mark.parametrize("radius", [1e-4, 0.01, 0.2])
def test_a_lattice_is_made_coarser_by_the_rays_that_are_within_the_discs(radius: float) -> None:
    discs = discs_of(radius, seed=3)
    rays, n = create_lattice(discs, FAN, HIGHEST), counted(discs)
    assert n > 2 * MAX_RAYS
    spacing = 2.0 / N_RAYS_ACROSS * discs.radius[rays.surface] * math.sqrt(n / MAX_RAYS)
    assert rays.angles[:, 2] == pytest.approx(spacing, rel=1e-12)
