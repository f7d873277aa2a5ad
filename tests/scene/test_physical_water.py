"""The element <u:water>: where its numbers come from, and what is reported."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import uwsim
from uwsim.errors import FileError, UwsimError
from uwsim.optics import FournierForand, HenyeyGreenstein, find_water
from uwsim.optics.water_file import WaterFile, write_water
from uwsim.rendering.caustics.ripples import Ripples
from uwsim.simulation.scenery.scene_water import choose_water

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState>
    <u:water law="physical">
      {water}
    </u:water>
  </oceanState>
  <vehicle> <name>girona500</name> <file>g500ARM5.urdf</file>
    <jointValues>
      <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint>
    </jointValues>
    <position> <x>0</x> <y>0</y> <z>-4</z> </position>
  </vehicle>
</UWSimScene>
"""
COEFFICIENTS = """
<u:absorption> <r>0.5</r> <g>0.1</g> <b>0.05</b> </u:absorption>
<u:scattering> <r>0.2</r> <g>0.25</g> <b>0.3</b> </u:scattering>
"""
BEAM = COEFFICIENTS.replace("absorption", "beamAttenuation")


def compile_water(folder: Path, water: str) -> uwsim.Simulation:
    """Return a simulation of a scene with water."""
    path = folder / "scene.xml"
    path.write_text(SCENE.format(water=water))
    return uwsim.load(path)


def error_of(folder: Path, water: str) -> str:
    """Return the error of a scene with invalid water."""
    with pytest.raises(UwsimError) as caught:
        compile_water(folder, water)
    return str(caught.value)


def test_a_named_water_has_its_numbers(tmp_path: Path) -> None:
    with compile_water(tmp_path, "<u:type>jerlov-1C</u:type>") as simulation:
        optics = simulation.world.scenery.state.water.physical_water
        assert optics is not None
        assert optics.medium == find_water("jerlov-1C")
        assert optics.transfer == "srgb"
        assert simulation.world.scenery.image_model == "physical"


def test_a_white_board_at_the_start_has_070_of_full_scale(tmp_path: Path) -> None:
    from uwsim.rendering.physical.daylight_field import compute_light_field

    with compile_water(tmp_path, "<u:type>jerlov-1C</u:type>") as simulation:
        optics = simulation.world.scenery.state.water.physical_water
        assert optics is not None
        field = compute_light_field(optics.medium, optics.daylight)
        beam, diffuse = field.compute_irradiance(4.0)
        assert optics.exposure * (beam + diffuse).max() == pytest.approx(0.7)


def test_coefficients_and_a_phase_function_make_a_medium(tmp_path: Path) -> None:
    phase = "<u:phaseFunction> <u:henyeyGreenstein/> </u:phaseFunction>"
    with compile_water(tmp_path, COEFFICIENTS + phase) as simulation:
        medium = simulation.world.model.optical_water
        assert medium is not None
        assert medium.absorption == (0.5, 0.1, 0.05)
        assert medium.phase_function == HenyeyGreenstein(0.9)


def test_a_water_file_is_read(tmp_path: Path) -> None:
    water = WaterFile(name="tank", medium=find_water("tank"), source="a test")
    (tmp_path / "tank.json").write_text(write_water(water))
    with compile_water(tmp_path, "<u:file>tank.json</u:file>") as simulation:
        medium = simulation.world.model.optical_water
        assert medium is not None
        assert medium == find_water("tank")
        assert medium.phase_function == FournierForand()


def test_an_error_of_a_water_file_has_its_line(tmp_path: Path) -> None:
    (tmp_path / "tank.json").write_text('{\n  "uwsim_water": 1,\n  "scatering": [1, 1, 1]\n}\n')
    with pytest.raises(FileError, match=r"tank.json:3: 'scatering' is not a key"):
        compile_water(tmp_path, "<u:file>tank.json</u:file>")


@pytest.mark.parametrize(
    ("water", "text"),
    [
        ("<u:type>jerlov-1D</u:type>", r"scene.xml:3: .*'jerlov-1D'.*jerlov-1C"),
        ("", "scene.xml:3: The water has no numbers; expected one of"),
        ("<u:type>pool</u:type>" + COEFFICIENTS, "has <u:type> and coefficients"),
        (BEAM, "The scattering of green is 0.25 1/m; expected at most the beam"),
        ("<u:file>missing.json</u:file>", "'missing.json' is in none of the folders"),
        ("<u:typ>pool</u:typ>", "<u:typ> is not an element of <u:water>"),
        ("<u:type>pool</u:type> <u:exposure>0</u:exposure>", "scene.xml:4: .*exposure"),
    ],
)
def test_invalid_water_is_reported_with_its_line(tmp_path: Path, water: str, text: str) -> None:
    assert re.search(text, error_of(tmp_path, water))


def test_a_view_without_fog_is_in_the_purest_water(tmp_path: Path) -> None:
    with compile_water(tmp_path, "<u:type>jerlov-9C</u:type>") as simulation:
        scenery = simulation.world.scenery
        water = scenery.state.water
        model = simulation.world.model
        assert choose_water(water, None, model) == water
        clear = choose_water(water, 0.0, model).physical_water
        assert clear is not None
        assert clear.medium == find_water("clear")


def test_fog_cannot_be_set_in_physical_water(tmp_path: Path) -> None:
    with (
        compile_water(tmp_path, "<u:type>pool</u:type>") as simulation,
        pytest.raises(UwsimError, match="no effect in physical water"),
    ):
        simulation.set_fog(0.2)


WAVES = """<depth>20</depth> <u:waves>
  <u:regularWave> <u:height>0.2</u:height> <u:period>3</u:period> </u:regularWave>
</u:waves>
<u:water law="physical">"""


def ripples_of(folder: Path, water: str, *, has_waves: bool = False) -> Ripples | None:
    """Return the ripples of a scene with water, and with waves."""
    scene = SCENE.replace('<u:water law="physical">', WAVES) if has_waves else SCENE
    (folder / "scene.xml").write_text(scene.format(water=water))
    with uwsim.load(folder / "scene.xml") as simulation:
        optics = simulation.world.scenery.state.water.physical_water
        assert optics is not None
        return optics.ripples


def test_ripples_are_those_of_the_scene_or_of_a_light_wind_over_waves(tmp_path: Path) -> None:
    named = "<u:type>clear</u:type>"
    stated = "<u:ripples> <u:windSpeed>5</u:windSpeed> <u:direction>0.5</u:direction> </u:ripples>"
    assert ripples_of(tmp_path, named) is None
    assert ripples_of(tmp_path, named, has_waves=True) == Ripples(wind_speed=2.0)
    ripples = ripples_of(tmp_path, named + stated, has_waves=True)
    assert ripples is not None
    assert (ripples.wind_speed, ripples.direction) == (5.0, pytest.approx(0.5))


def test_caustics_and_shafts_of_a_scene_can_be_switched_off(tmp_path: Path) -> None:
    switches = "<u:caustics>0</u:caustics> <u:lightShafts>0</u:lightShafts>"
    with compile_water(tmp_path, "<u:type>clear</u:type>" + switches) as simulation:
        optics = simulation.world.scenery.state.water.physical_water
        assert optics is not None
        assert not optics.has_caustics
        assert not optics.has_light_shafts
    text = error_of(
        tmp_path, "<u:type>clear</u:type><u:ripples><u:windSpeed>50</u:windSpeed></u:ripples>"
    )
    assert "windSpeed" in text
    assert "20" in text


@pytest.mark.parametrize("n", [4, 5, 200, 201])
def test_a_phase_table_has_5_to_200_numbers(n: int, tmp_path: Path) -> None:
    angles = " ".join(f"{3.14 * i / (n - 1):.9f}" for i in range(n))
    values = " ".join(["0.0795775"] * n)
    table = f"<u:angles>{angles}</u:angles> <u:values>{values}</u:values>"
    water = (
        "<u:type>clear</u:type>"
        f"<u:phaseFunction> <u:phaseTable> {table} </u:phaseTable> </u:phaseFunction>"
    )
    if 5 <= n <= 200:
        compile_water(tmp_path, water).close()
        return
    expected = "4 rows; expected 5" if n == 4 else "<u:angles> has 201 numbers; expected 200"
    assert expected in error_of(tmp_path, water)
