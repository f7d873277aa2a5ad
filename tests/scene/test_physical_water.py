"""The element <u:water>: where its numbers come from, and what is reported."""

from __future__ import annotations

import math
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


SPECTRUM = """<u:spectrum>
  <u:wavelengths>412 440 488 510 532 555 650 676 715</u:wavelengths>
  <u:beamAttenuation>1.2 1.1 1 0.95 0.9 0.9 0.8 0.8 0.7</u:beamAttenuation>
  <u:scattering>1 0.9 0.85 0.8 0.8 0.75 0.7 0.7 0.65</u:scattering>
  <u:excludesWater>1</u:excludesWater>
</u:spectrum>
"""


def test_a_spectrum_has_three_channels(tmp_path: Path) -> None:
    with compile_water(tmp_path, SPECTRUM) as simulation:
        medium = simulation.world.model.optical_water
        assert medium is not None
        assert medium.scattering == pytest.approx((0.7, 0.79, 0.89), abs=0.04)
        assert medium.absorption == pytest.approx((0.4, 0.2, 0.19), abs=0.06)


def test_a_spectrum_is_read_from_a_table(tmp_path: Path) -> None:
    (tmp_path / "ac-s.csv").write_text(
        "wavelength,absorption,scattering\n400,0.3,0.5\n550,0.3,0.5\n700,0.3,0.5\n"
    )
    water = "<u:spectrum> <u:file>ac-s.csv</u:file> </u:spectrum>"
    with compile_water(tmp_path, water) as simulation:
        medium = simulation.world.model.optical_water
        assert medium is not None
        assert medium.n_channels == 3
        assert medium.scattering == pytest.approx((0.5, 0.5, 0.5), abs=0.01)


def test_an_error_of_a_table_of_spectra_has_its_line(tmp_path: Path) -> None:
    (tmp_path / "ac-s.csv").write_text("wavelength,absorption,scatering\n400,0.3,0.5\n")
    with pytest.raises(FileError, match=r"ac-s.csv:1: no column is called 'scatering'"):
        compile_water(tmp_path, "<u:spectrum> <u:file>ac-s.csv</u:file> </u:spectrum>")


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
        ("<u:spectrum/>", "has none of <u:file> and <u:wavelengths>"),
        (SPECTRUM.replace("0.65<", "0.65 0.6<"), "have 9 and 10 values; expected one of each"),
        (SPECTRUM.replace("412 ", "200 "), "wavelengths"),
        (SPECTRUM.replace("beamAtt", "att"), "is not an element of"),
        (SPECTRUM.replace("1.2 ", "0.2 "), "The absorption at 412 nm is -0.7"),
        ("<u:type>pool</u:type>" + SPECTRUM, "has <u:type> and <u:spectrum>"),
        ("<u:file>missing.json</u:file>", "'missing.json' is in none of the folders"),
        ("<u:typ>pool</u:typ>", "<u:typ> is not an element of <u:water>"),
        ("<u:type>pool</u:type> <u:exposure>0</u:exposure>", "scene.xml:4: .*exposure"),
    ],
)
def test_invalid_water_is_reported_with_its_line(tmp_path: Path, water: str, text: str) -> None:
    assert re.search(text, error_of(tmp_path, water))


def test_all_errors_of_a_water_are_reported_at_once(tmp_path: Path) -> None:
    phase = (
        "<u:phaseFunction> <u:phaseTable> <u:angles>0.1 0.2 3</u:angles> <u:values>1 1</u:values>"
        " </u:phaseTable> </u:phaseFunction>"
    )
    file = "<u:file>missing.json</u:file>"
    error = error_of(tmp_path, f"<u:type>jerlov-1D</u:type> {BEAM} {file} {phase}")
    for text in (
        "has <u:type> and <u:file> and coefficients; expected one of",
        "No water is called 'jerlov-1D'. Did you mean 'jerlov-1C'?",
        "The scattering of green is 0.25 1/m",
        "'missing.json' is in none of the folders",
        "A phase function has 3 angles and 2 values",
    ):
        assert text in error


def test_an_empty_phase_function_is_an_error_with_the_names_of_all(tmp_path: Path) -> None:
    error = error_of(tmp_path, "<u:type>pool</u:type>\n<u:phaseFunction> </u:phaseFunction>")
    assert "scene.xml:5: <u:phaseFunction> has 0 phase functions; expected one of" in error
    assert "<u:fournierForand>, <u:henyeyGreenstein>, <u:phaseTable>" in error


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


def test_a_spectrum_of_the_element_has_up_to_1000_wavelengths(tmp_path: Path) -> None:
    def write_spectrum(count: int) -> str:
        wavelengths = " ".join(f"{350.0 + 0.5 * i:g}" for i in range(count))
        return (
            f"<u:spectrum> <u:wavelengths>{wavelengths}</u:wavelengths>"
            f"<u:absorption>{'0.2 ' * count}</u:absorption>"
            f"<u:scattering>{'0.3 ' * count}</u:scattering> </u:spectrum>"
        )

    with compile_water(tmp_path, write_spectrum(1000)) as simulation:
        optics = simulation.world.scenery.state.water.physical_water
        assert optics is not None
        assert optics.medium.absorption == pytest.approx((0.2, 0.2, 0.2))
    text = error_of(tmp_path, write_spectrum(1001))
    assert "<u:wavelengths> has 1001 numbers; expected 1000 at most" in text


def test_the_sun_may_be_in_the_zenith_in_four_decimals(tmp_path: Path) -> None:
    sun = "<u:type>clear</u:type> <u:sun> <u:elevation>{}</u:elevation> </u:sun>"
    for elevation in ("1.5708", "M_PI_2"):
        with compile_water(tmp_path, sun.format(elevation)) as simulation:
            optics = simulation.world.scenery.state.water.physical_water
            assert optics is not None
            assert optics.daylight.elevation == 0.5 * math.pi
    text = error_of(tmp_path, sun.format("1.5709"))
    assert "expected a number >= 0 and <= 1.5708 [rad]" in text


@pytest.mark.parametrize(
    ("values", "last", "text"),
    [
        ("0.08 0.08 0.08 0.08 0.08", "3.1416", ""),
        ("0.08 0.08 0.08 0.08 0.08", "3.1417", "expected numbers >= 0 and <= 3.1416"),
        ("0.08 0.08 0 0.08 0.08", "3.1416", ":7: .*contains '0'; expected numbers >= 1e-12"),
        ("1e9 1e9 1e9 1e9 1e9", "3.1416", ":5: The integral of a phase function"),
    ],
)
def test_the_limits_of_a_phase_table_are_those_that_messages_state(
    values: str, last: str, text: str, tmp_path: Path
) -> None:
    water = (
        "<u:type>clear</u:type>\n<u:phaseFunction> <u:phaseTable>\n"
        f"<u:angles>0.1 1 2 3 {last}</u:angles>\n<u:values>{values}</u:values>"
        "</u:phaseTable> </u:phaseFunction>"
    )
    if not text:
        compile_water(tmp_path, water).close()
    else:
        assert re.search(text, error_of(tmp_path, water))
