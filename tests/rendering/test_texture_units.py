"""OpenGL 3.3 guarantees 16 texture units for each stage of shaders."""

from __future__ import annotations

import pytest

from uwsim.rendering import passes
from uwsim.rendering.physical import development
from uwsim.rendering.surface import surface_pass

N_UNITS = 16


@pytest.mark.parametrize("module", [passes, development, surface_pass])
def test_no_sampler_needs_a_unit_beyond_the_guaranteed_ones(module: object) -> None:
    samplers: dict[str, int] = module.SAMPLERS  # type: ignore[attr-defined]
    assert {name: unit for name, unit in samplers.items() if not 0 <= unit < N_UNITS} == {}


def test_textures_of_the_composition_have_units_of_their_own() -> None:
    names = ["surface_image", "open_water_map", "weight_table", "level_0", "particle_image"]
    names += ["cloud_layers_map", "cloud_lamplight_map", "cloud_daylight_map", "shaft_image"]
    units = [development.SAMPLERS[name] for name in names]
    assert len(set(units)) == len(units)
