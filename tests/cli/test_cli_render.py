"""``uwsim render``: pictures of the bundled scene."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from uwsim.cli import main

SCENE = ["render", "visibility-scene", "--camera", "bowtech1"]


def render(folder: Path, *options: str, name: str = "view") -> np.ndarray:
    """Render into ``folder`` and return the colour picture, (h, w, 3)."""
    out = folder / f"{name}.png"
    assert main([*SCENE, "-o", str(out), *options]) == 0
    return np.asarray(Image.open(out))


def test_the_picture_has_the_cameras_size_and_the_seed_decides_its_noise(tmp_path: Path) -> None:
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


def test_where_nothing_is_there_depth_is_infinite_and_its_picture_0(tmp_path: Path) -> None:
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


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
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
