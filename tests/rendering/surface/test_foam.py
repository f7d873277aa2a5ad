"""Images of foam on breaking crests."""

from __future__ import annotations

import numpy as np
import pytest

from tests.rendering.physical.photographs import camera_of
from tests.rendering.surface.seas import BLACK_WATER, OVERCAST, look, make_waves, take, water_of
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.surface import wave_grids

POSE, LENS = look((0.0, 0.0, 12.0), (9.0, 5.0, 0.0)), camera_of(260.0, 320, 240)


def draw_cover(height: float, monkeypatch: pytest.MonkeyPatch) -> np.ndarray:
    """Return the light that foam adds to the image of a sea, over that of white foam."""
    surface = MovingSurface(time=2.0, waves=make_waves(height, period=4.0), seed=1)
    images = []
    for threshold in (wave_grids.FOAM_THRESHOLD, 1e9):
        monkeypatch.setattr(wave_grids, "FOAM_THRESHOLD", threshold)
        renderer = Renderer()
        water = water_of(BLACK_WATER, OVERCAST)
        images.append(take(renderer, water, POSE, LENS, surface)[..., 1])
        renderer.close()
    return (images[0] - images[1]) / (0.5 - images[1])


def test_a_calm_sea_has_no_foam(monkeypatch: pytest.MonkeyPatch) -> None:
    assert np.abs(draw_cover(0.3, monkeypatch)).max() == 0.0


def test_foam_frays_at_its_edges(monkeypatch: pytest.MonkeyPatch) -> None:
    """Patches with hard edges cover less than a tenth of their pixels in part."""
    cover = draw_cover(1.2, monkeypatch)
    assert 0.001 < (cover > 0.1).mean() < 0.2
    assert 0.5 < cover.max() < 1.0
    is_partial = (cover > 0.05) & (cover < 0.7)
    assert is_partial.sum() > 0.3 * (cover > 0.05).sum()
