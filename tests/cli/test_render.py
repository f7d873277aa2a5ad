"""``uwsim render``: images of the bundled scene."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np
import pytest
from lxml import etree
from PIL import Image

from uwsim.assets.bundled import bundled_files
from uwsim.cli import main

ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
SCENES = sorted(bundled_files("scenes").values())
SCENES += sorted(Path(ORIGINALS).glob("scenes/*.xml")) if ORIGINALS else []
SCENE = ["render", "visibility-scene", "--camera", "bowtech1"]


def render(folder: Path, *options: str, name: str = "view") -> np.ndarray:
    """Render into ``folder`` and return the colour image, (h, w, 3)."""
    out = folder / f"{name}.png"
    assert main([*SCENE, "-o", str(out), *options]) == 0
    return np.asarray(Image.open(out))


def test_the_image_has_the_cameras_size_and_the_seed_decides_its_noise(tmp_path: Path) -> None:
    one = render(tmp_path, "--seed", "1")
    same = render(tmp_path, "--seed", "1", name="same")
    other = render(tmp_path, "--seed", "2", name="other")
    assert (one.shape, one.dtype) == ((240, 320, 3), np.uint8)
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


def test_depth_is_in_metres_for_programs_and_in_millimetres_for_eyes(tmp_path: Path) -> None:
    render(tmp_path, "--depth")
    metres = np.load(tmp_path / "view-depth.npy")
    millimetres = np.asarray(Image.open(tmp_path / "view-depth.png"))
    assert (metres.dtype, millimetres.dtype) == (np.float32, np.uint16)
    assert metres[120, 160] == pytest.approx(1.345, abs=0.02)  # the poster under the camera
    assert np.abs(millimetres / 1000.0 - metres).max() <= 0.0005 + 1e-6


def test_where_nothing_is_there_depth_is_infinite_and_its_image_0(tmp_path: Path) -> None:
    render(tmp_path, "--depth", "--set", "vehicle[girona500].orientation=M_PI 0 0")  # looks up
    metres = np.load(tmp_path / "view-depth.npy")
    millimetres = np.asarray(Image.open(tmp_path / "view-depth.png"))
    assert np.isinf(metres).any()
    assert (millimetres[np.isinf(metres)] == 0).all()


def test_segmentation_comes_with_the_name_of_each_number(tmp_path: Path) -> None:
    render(tmp_path, "--segmentation")
    ids = np.asarray(Image.open(tmp_path / "view-ids.png"))
    with (tmp_path / "view-ids.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["name"] for row in rows} >= {"blackbox", "terrain"}
    assert {int(row["id"]): int(row["pixels"]) for row in rows} == {
        number: int((ids == number).sum()) for number in np.unique(ids)
    }


def test_a_setting_changes_what_is_drawn(tmp_path: Path) -> None:
    murky = render(tmp_path, "--set", "oceanState.fog.density=5")
    fog = np.array([0.0, 0.05, 0.3]) * 255.0
    assert murky.mean(axis=(0, 1)) == pytest.approx(fog, abs=3.0)  # noise is cut at 0


def draw(scene: Path | str, out: Path, *options: str) -> np.ndarray:
    assert main(["render", str(scene), "-o", str(out), *options]) == 0
    return np.asarray(Image.open(out))


BARE = """<UWSimScene>{}<vehicle><name>g500</name><file>data/scenes/g500ARM5.urdf</file>
<position><x>0</x><y>0</y><z>-3</z></position><orientation><r>M_PI</r><p>0</p><y>0</y>
</orientation></vehicle></UWSimScene>"""
VIEWER = """<camera><freeMotion>0</freeMotion><objectToTrack>g500/base_link</objectToTrack>
<fov>{}</fov><position><x>0</x><y>-4</y><z>0</z></position></camera>"""


def scene_file(folder: Path, inside: str = "") -> Path:
    file = folder / "scene.xml"
    file.write_text(BARE.format(inside))
    return file


def test_without_a_name_the_first_camera_of_the_scene_sees(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named = render(tmp_path)
    assert np.array_equal(draw("visibility-scene", tmp_path / "any.png"), named)
    assert "camera 'bowtech1'" in capsys.readouterr().out


def test_a_scene_without_cameras_is_seen_by_its_viewer(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    near = draw(scene_file(tmp_path, VIEWER.format(30)), tmp_path / "a.png", "--segmentation")
    assert near.shape == (600, 800, 3)
    assert "view of its <camera>" in capsys.readouterr().out
    narrow = np.asarray(Image.open(tmp_path / "a-ids.png")) > 0
    assert narrow[300, 350:450].any()  # what it tracks is in the middle
    draw(scene_file(tmp_path, VIEWER.format(60)), tmp_path / "b.png", "--segmentation")
    wide = np.asarray(Image.open(tmp_path / "b-ids.png")) > 0
    assert 0 < wide.sum() < 0.4 * narrow.sum()


def test_a_scene_without_any_camera_is_seen_from_where_all_of_its_vehicle_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    draw(scene_file(tmp_path), tmp_path / "a.png", "--segmentation", "--size", "200x150")
    assert "orbit view" in capsys.readouterr().out
    ids = np.asarray(Image.open(tmp_path / "a-ids.png"))
    assert ids.shape == (150, 200)
    frame = np.concatenate([ids[0], ids[-1], ids[:, 0], ids[:, -1]])
    assert not frame.any()  # nothing is cut off
    assert np.count_nonzero(ids) > 0.1 * ids.size


ALONE = [path for path in SCENES if path.read_text().count("<vehicle>") == 1]
"""Scenes with one vehicle: two of them may be too far apart to be seen in one view."""

COVERED = {
    ("docking-girona-scene", "orbit"): 0.007,
    ("docking-girona-scene", "top"): 0.008,
    ("docking-scene", "orbit"): 0.004,
    ("net-scene", "orbit"): 0.001,
    ("net-scene", "top"): 0.003,
    ("pier-waves-scene", "orbit"): 0.005,
    ("pier-waves-scene", "top"): 0.002,
    ("pipe-scene", "orbit"): 0.002,
    ("pipe-scene", "top"): 0.0015,
    ("search-scene", "orbit"): 0.0015,
    ("search-scene", "top"): 0.004,
    ("teleoperation-scene", "orbit"): 0.001,
    ("teleoperation-scene", "top"): 0.001,
    ("tether-scene", "orbit"): 0.003,
    ("tether-scene", "top"): 0.0015,
    ("wreck-physical-scene", "top"): 0.003,
}
"""The least shares of vehicles that are far away, or behind a pier, wreck, dock or net; else 1 %.

From above the water the colours are enlarged by 1.3 by refraction, but not these numbers of parts.
"""


def vehicles_of(scene: Path) -> tuple[str, ...]:
    """Beginnings of the names of links, ``vehicle/``."""
    names = etree.parse(scene).xpath("vehicle/name/text()")
    return tuple(f"{name.strip()}/" for name in names)


@pytest.mark.slow
@pytest.mark.parametrize("path", ALONE, ids=lambda path: f"{path.parents[1].name}-{path.stem}")
@pytest.mark.parametrize("view", ["orbit", "top"])
def test_every_bundled_and_original_scene_shows_all_of_its_vehicle(
    path: Path, view: str, tmp_path: Path
) -> None:
    draw(path, tmp_path / "a.png", "--view", view, "--size", "160x120", "--segmentation")
    ids = np.asarray(Image.open(tmp_path / "a-ids.png"))
    with (tmp_path / "a-ids.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["name"].startswith(vehicles_of(path))]
    own = np.isin(ids, [int(row["id"]) for row in rows])
    frame = np.concatenate([own[0], own[-1], own[:, 0], own[:, -1]])
    assert own.mean() > COVERED.get((path.stem, view), 0.01)
    assert not frame.any()  # nothing is cut off


def test_from_above_the_bow_points_up_where_x_of_the_file_does(tmp_path: Path) -> None:
    draw("visibility-scene", tmp_path / "a.png", "--view", "top", "--segmentation")
    ids = np.asarray(Image.open(tmp_path / "a-ids.png"))
    with (tmp_path / "a-ids.csv").open() as file:
        names = {row["name"]: int(row["id"]) for row in csv.DictReader(file)}
    rows, columns = np.nonzero(ids == names["girona500/base_link"])
    assert np.ptp(rows) > 1.3 * np.ptp(columns)  # 1.5 m by 1 m


def test_a_view_from_a_point_to_a_point_of_the_file_has_it_in_its_middle(tmp_path: Path) -> None:
    options = ["--from", "4,2,3.5", "--at", "2,0.35,4.735", "--size", "120x90", "--segmentation"]
    draw("visibility-scene", tmp_path / "a.png", *options)
    ids = np.asarray(Image.open(tmp_path / "a-ids.png"))
    with (tmp_path / "a-ids.csv").open() as file:
        names = {int(row["id"]): row["name"] for row in csv.DictReader(file)}
    assert names[int(ids[45, 60])] == "blackbox"


def test_views_round_the_scene_are_clear_unless_fog_is_asked_for(tmp_path: Path) -> None:
    fog = "oceanState.fog.density"
    ocean = (
        "<oceanState><fog><density>5</density><color><r>0</r><g>0</g><b>1</b></color></fog>"
        "</oceanState>"
    )
    file = scene_file(tmp_path, ocean)
    clear = draw(file, tmp_path / "a.png", "--view", "orbit")
    thick = draw(file, tmp_path / "b.png", "--view", "orbit", "--set", f"{fog}=5")
    assert clear.std() > 20.0
    assert (thick == [0, 0, 255]).all()


@pytest.mark.slow
def test_another_size_keeps_how_high_a_camera_sees(tmp_path: Path) -> None:
    quiet = ["--set", "vehicle.virtualCamera.std=0", "--segmentation"]
    draw("visibility-scene", tmp_path / "a.png", *quiet)
    draw("visibility-scene", tmp_path / "b.png", *quiet, "--size", "640x480")
    draw("visibility-scene", tmp_path / "c.png", *quiet, "--size", "640x240")
    whole, large, wide = (
        np.asarray(Image.open(tmp_path / f"{name}-ids.png")) for name in ("a", "b", "c")
    )
    assert (large[::2, ::2] == whole).mean() > 0.98
    assert (wide[:, 160:480] == whole).mean() > 0.99


def test_ghosts_are_seen_in_views_and_not_by_cameras(tmp_path: Path) -> None:
    file = scene_file(tmp_path)
    file.write_text(file.read_text().replace("</vehicle>", "<vr>1</vr></vehicle>"))
    draw(file, tmp_path / "a.png", "--segmentation")
    assert np.asarray(Image.open(tmp_path / "a-ids.png")).any()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["render", "cirs", "--view", "orbt", "-o", "a.png"], "Did you mean 'orbit'"),
        (["render", "cirs", "--view", "top", "--camera", "bowtech1", "-o", "a.png"], "at a time"),
        (["render", "cirs", "--from", "1,2,3", "-o", "a.png"], "--at"),
        (["render", "cirs", "--from", "1,2", "--at", "1,2,3", "-o", "a.png"], "three numbers"),
        (
            ["render", "cirs", "--from", "1,2,3", "--at", "1 2 3", "-o", "a.png"],
            "has one point as position and target",
        ),
        (["render", "cirs", "--size", "800", "-o", "a.png"], "WxH"),
        (["render", "cirs", "--size", "0x5", "-o", "a.png"], "WxH"),
        (
            ["render", "cirs", "--size", "16000x16000", "-o", "a.png"],
            "--size is '16000x16000': 256 million pixels; at most 33 million",
        ),
        (["render", "visibility-scene", "--camera", "bowtech", "-o", "a.png"], "'bowtech1'"),
        ([*SCENE, "-o", "a.jpg"], "only .png"),
        ([*SCENE, "-o", "nowhere/a.png"], "nowhere/a.png"),
        (["render", "visibility-scen", "--camera", "c", "-o", "a.png"], "'visibility-scene'"),
        ([*SCENE, "-o", "a.png", "--set", "oceanState.fog.densty=1"], "'density'"),
        ([*SCENE, "-o", "a.png", "--set", "oceanState"], "NAME=VALUE"),
        ([*SCENE, "-o", "a.png", "--compat", "fog"], "fog-distance"),
    ],
)
def test_wrong_input_gets_one_line_that_names_what_is_right(
    arguments: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("view", [(), ("--view", "orbit")])
def test_a_size_counts_the_margin_of_the_image(
    view: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SEA.replace("</u:type>", "</u:type><u:blurMargin>0.5</u:blurMargin>"))
    arguments = ["render", str(path), "--size", "7680x4320", *view]
    assert main([*arguments, "-o", str(tmp_path / "a.png")]) == 2
    *_, line = capsys.readouterr().err.splitlines()
    assert "--size: an image of 7680 x 4320 pixels, 132.7 million with <u:blurMargin>" in line
    assert line.endswith("expected at most 33 million.")


SEA = """<UWSimScene xmlns:u="urn:uwsim:1"><oceanState> <depth>30</depth>
<u:waves><u:jonswap><u:significantHeight>0.8</u:significantHeight><u:peakPeriod>4</u:peakPeriod>
</u:jonswap></u:waves><u:water law="physical"><u:type>jerlov-II</u:type></u:water></oceanState>
</UWSimScene>"""


def test_the_time_moves_the_waves(tmp_path: Path) -> None:
    (tmp_path / "sea.xml").write_text(SEA)
    view = ("--from", "0,0,2", "--at", "8,0,0", "--size", "160x120")
    images = [
        draw(tmp_path / "sea.xml", tmp_path / f"{i}.png", *view, *time).astype(np.float64)
        for i, time in enumerate(((), ("--time", "0"), ("--time", "1.5s"), ("--time", "1500ms")))
    ]
    assert np.array_equal(images[0], images[1])
    assert np.array_equal(images[2], images[3])
    assert np.abs(images[2] - images[0]).mean() > 3.0


def test_a_wrong_time_names_its_option(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main([*SCENE, "-o", str(tmp_path / "a.png"), "--time", "soon"]) == 2
    assert "--time 'soon': expected a duration" in capsys.readouterr().err
