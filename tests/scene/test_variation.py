"""``<u:vary>``: values that are drawn anew for each seed, and only those."""

from __future__ import annotations

import dataclasses
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.devices.sway import SwaySpec
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting
from uwsim.scene.spec import SceneSpec
from uwsim.scene.variation import apply_variations, draw
from uwsim.sensors.virtual_camera import VirtualCameraSpec

BASE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"
X = "<u:path>object[blackbox].position.x</u:path>"
UNIFORM = f"<u:uniform> {X} <u:low>1.9</u:low> <u:high>2.1</u:high> </u:uniform>"
SWAY = """<u:sway> <u:axis>x</u:axis> <u:amplitude>0.1</u:amplitude> <u:period>7</u:period>
  <u:phase>0.5</u:phase> </u:sway>"""


def write(folder: Path, *variations: str, vehicle: str = "") -> Path:
    """The scene of `visibility` with variations at its end, one a line from 2 on."""
    text = BASE.read_text()
    lines = "\n".join(variations)
    text = text.replace("</vehicle>", f"{vehicle}</vehicle>")
    text = text.replace("<UWSimScene>", '<UWSimScene xmlns:u="urn:uwsim:1">')
    text = text.replace("</UWSimScene>", f"<u:vary>\n{lines}\n</u:vary></UWSimScene>")
    path = folder / "scene.xml"
    path.write_text(text)
    return path


def scene(folder: Path, *variations: str, vehicle: str = "") -> SceneSpec:
    return read_scene(write(folder, *variations, vehicle=vehicle))


def box_x(spec: SceneSpec, seed: int) -> float:
    return apply_variations(spec, seed).objects[1].position[0]


def test_every_seed_has_a_scene_of_its_own_and_always_the_same(tmp_path: Path) -> None:
    spec = scene(tmp_path, UNIFORM)
    found = [box_x(spec, seed) for seed in range(200)]
    assert len(set(found)) == 200
    assert found == [box_x(spec, seed) for seed in range(200)]
    assert 1.9 <= min(found) < 1.905
    assert 2.095 < max(found) <= 2.1
    assert np.mean(found) == pytest.approx(2.0, abs=0.01)


def test_all_else_stays_as_the_file_says(tmp_path: Path) -> None:
    spec = scene(tmp_path, UNIFORM)
    back = apply_setting(apply_variations(spec, 3), "object[blackbox].position.x", "2")
    assert back == read_scene(BASE)


def test_one_variation_more_changes_no_other(tmp_path: Path) -> None:
    other = UNIFORM.replace(".x<", ".y<").replace("1.9", "0.3").replace("2.1", "0.4")
    for seed in range(5):
        alone = box_x(scene(tmp_path, UNIFORM), seed)
        assert box_x(scene(tmp_path, other, UNIFORM), seed) == alone
    both = apply_variations(scene(tmp_path, other, UNIFORM), 0).objects[1].position
    assert (both[0] - 1.9) / 0.2 != pytest.approx((both[1] - 0.3) / 0.1)


def test_a_value_has_one_stream_however_its_path_is_written(tmp_path: Path) -> None:
    named = "<u:path>vehicle[girona500].virtualCamera[bowtech1].std</u:path>"
    short = "<u:path>vehicle.virtualCamera.std</u:path>"
    bounds = "<u:low>0</u:low> <u:high>0.1</u:high>"
    stds = [
        apply_variations(scene(tmp_path, f"<u:uniform> {path} {bounds} </u:uniform>"), 7)
        .vehicles[0]
        .parts_of(VirtualCameraSpec)[0]
        .std
        for path in (named, short)
    ]
    assert stds[0] == stds[1]


def test_a_normal_value_is_cut_off_and_not_heaped_at_its_bounds(tmp_path: Path) -> None:
    normal = f"""<u:normal> {X} <u:mean>2</u:mean> <u:deviation>0.1</u:deviation>
      <u:low>1.9</u:low> </u:normal>"""
    spec = scene(tmp_path, normal)
    found = np.array([box_x(spec, seed) for seed in range(400)])
    assert found.min() > 1.9
    assert found.max() < 2.3
    assert len(set(found)) == 400
    from scipy.stats import kstest, truncnorm

    assert kstest(found, truncnorm(-1.0, 3.0, loc=2.0, scale=0.1).cdf).pvalue > 0.01


def test_whole_numbers_are_drawn_whole_bounds_included(tmp_path: Path) -> None:
    whole = """<u:uniform> <u:path>vehicle.virtualCamera.resw</u:path>
      <u:low>320</u:low> <u:high>323</u:high> </u:uniform>"""
    spec = scene(tmp_path, whole)
    found = [
        apply_variations(spec, seed).vehicles[0].parts_of(VirtualCameraSpec)[0].resw
        for seed in range(80)
    ]
    assert set(found) == {320, 321, 322, 323}
    assert all(type(width) is int for width in found)
    assert draw(spec, 0)[0].value == found[0]


def test_one_number_of_a_list_varies(tmp_path: Path) -> None:
    path = "vehicle.jointValues.3"
    spec = scene(tmp_path, uniform(path, "1", "1.4"))
    before = spec.nominal_scene.vehicles[0].joint_values
    drawn = [apply_variations(spec, seed).vehicles[0].joint_values for seed in range(5)]
    assert len({values[2] for values in drawn}) == 5
    assert all(1.0 <= values[2] <= 1.4 for values in drawn)
    assert {(*values[:2], *values[3:]) for values in drawn} == {(*before[:2], *before[3:])}
    assert draw(spec, 0)[0].path == "vehicle[girona500].jointValues.3"


def test_what_has_no_name_is_chosen_by_its_axis_or_number(tmp_path: Path) -> None:
    path = "<u:path>vehicle.sway[x].phase</u:path>"
    uniform = f"<u:uniform> {path} <u:low>-M_PI</u:low> <u:high>M_PI</u:high> </u:uniform>"
    spec = scene(tmp_path, uniform, vehicle=SWAY)
    assert apply_variations(spec, 1).vehicles[0].parts_of(SwaySpec)[0].phase != 0.5
    [drawn] = draw(spec, 1)
    assert (drawn.path, drawn.unit) == ("vehicle[girona500].sway[x].phase", "rad")
    assert drawn.drawn_from == "uniform -3.14159 to 3.14159"


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("object[blackbox].position.x", "1.5"),
        ("object[blackbox].position", "1.5 0.35 4.735"),
    ],
)
def test_a_setting_puts_a_variation_out_of_force(tmp_path: Path, path: str, value: str) -> None:
    other = UNIFORM.replace(".x<", ".y<")
    spec = apply_setting(scene(tmp_path, UNIFORM, other), path, value)
    assert {box_x(spec, seed) for seed in range(5)} == {1.5}
    is_all = path.endswith("position")
    assert len(spec.vary) == (0 if is_all else 1)


def test_a_setting_of_another_value_leaves_a_variation_in_force(tmp_path: Path) -> None:
    spec = apply_setting(scene(tmp_path, UNIFORM), "object[blackbox].position.y", "0.4")
    assert len({box_x(spec, seed) for seed in range(5)}) == 5


def uniform(path: str, low: str = "0", high: str = "1") -> str:
    return (
        f"<u:uniform> <u:path>{path}</u:path> <u:low>{low}</u:low> <u:high>{high}</u:high> "
        "</u:uniform>"
    )


@pytest.mark.parametrize(
    ("variation", "message"),
    [
        (uniform("object[blakbox].position.x"), "Did you mean 'blackbox'?"),
        (uniform("object[blackbox].positon.x"), "there is no <positon>. Did you mean 'position'?"),
        (uniform("object[blackbox].position"), "it is three numbers; choose one, .x; only a"),
        (uniform("object[blackbox].position.q"), "<position> has <x>, <y>, <z>"),
        (uniform("object[blackbox].file"), "it is text; only a number can vary"),
        (uniform("simParams.disableShaders"), "it is a flag; only a number can vary"),
        (uniform("vehicle.jointValues"), "it is a list; only a number can vary"),
        (uniform("vehicle.jointValues.9"), "<jointValues> has 5 numbers"),
        (uniform("object[blackbox]"), "<object> is not a value; its parts are name, file"),
        (uniform("object[blackbox].buried.x"), "<buried> is a value; it has no elements"),
        (uniform("object[blackbox].position.x", "2", "1"), "<u:low> 2 is not below <u:high> 1"),
        (uniform("vehicle.virtualCamera.std", "-1", "1"), "expected a number >= 0 and <= 10"),
        (uniform("vehicle.virtualCamera.std", "0", "11"), "expected a number >= 0 and <= 10"),
        (uniform("vehicle.virtualCamera.resw", "0.5", "9"), "it is an integer, and 0.5 is"),
        (uniform("object[blackbox].physics.mass"), "the file has no <physics> here"),
        (
            f"<u:normal> {X} <u:mean>0</u:mean> <u:deviation>0.1</u:deviation> <u:low>1</u:low> "
            "<u:high>2</u:high> </u:normal>",
            "its bounds are more than 6 deviations from <u:mean>",
        ),
        (
            f"<u:normal> {X} <u:mean>0</u:mean> <u:deviation>0</u:deviation> </u:normal>",
            "<u:deviation> is '0'; expected a number > 0",
        ),
    ],
)
def test_what_cannot_vary_is_an_error_with_its_line(
    tmp_path: Path, variation: str, message: str
) -> None:
    path = write(tmp_path, uniform("object[blackbox].position.z", "4", "5"), variation)
    [diagnostic] = [diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"]
    assert message in diagnostic.message
    assert path.read_text().split("\n")[(diagnostic.line or 0) - 1].strip() == variation.strip()
    with pytest.raises(SceneError):
        read_scene(path)


def test_one_value_cannot_vary_twice(tmp_path: Path) -> None:
    path = "object[blackbox].position.x"
    found = check_file(write(tmp_path, UNIFORM, uniform(path, "1", "3")))
    said = [diagnostic.message for diagnostic in found if diagnostic.severity == "error"]
    assert said == [f"<u:path> {path}: {path} varies already"]


def test_a_simulation_is_of_its_seed(tmp_path: Path) -> None:
    spec = scene(tmp_path, UNIFORM)
    for seed in (0, 5):
        simulation = open_scene(dataclasses.replace(spec, ros_interfaces=()), seed=seed)
        origin = simulation.world.bodies.find("blackbox").world_from_body.position
        located = simulation.world.model.scene.world_from_localized.inverse().transform(
            origin[None]
        )[0]
        assert located[0] == pytest.approx(box_x(spec, seed))
        simulation.close()


def test_a_vehicle_that_sways_with_a_phase_begins_within_its_swing(tmp_path: Path) -> None:
    spec = scene(tmp_path, vehicle=SWAY)
    simulation = open_scene(dataclasses.replace(spec, ros_interfaces=()))
    places = []
    for _ in range(3):
        origin = simulation.world.bodies.find("girona500").world_from_body.position
        places.append(
            simulation.world.model.scene.world_from_localized.inverse().transform(origin[None])[0][
                0
            ]
        )
        simulation.advance()
    assert places[0] == pytest.approx(2.0 + 0.1 * np.sin(0.5))
    assert np.diff(places) == pytest.approx(
        [0.1 * np.cos(0.5) * 2 * np.pi / 7 * 0.002] * 2, rel=0.01
    )
    simulation.world.vehicles.find("girona500").reset_pose(None)
    origin = simulation.world.bodies.find("girona500").world_from_body.position
    located = simulation.world.model.scene.world_from_localized.inverse().transform(origin[None])[0]
    assert located[0] == pytest.approx(places[-1], abs=1e-3)
