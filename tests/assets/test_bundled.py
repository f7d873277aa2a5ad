"""Where files named on the command line are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.assets.bundled import benchmark_file, bundled_files, scene_file
from uwsim.errors import AssetNotFound


def test_a_bundled_file_is_found_by_its_bare_name() -> None:
    assert benchmark_file("visibility") == bundled_files("benchmarks")["visibility"]
    assert scene_file("visibility-scene") == bundled_files("scenes")["visibility-scene"]


def test_a_file_of_that_name_in_the_current_folder_is_meant_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("visibility").write_text("mine")
    assert benchmark_file("visibility").read_text() == "mine"


def test_a_file_is_found_in_the_data_path(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "tank.xml").touch()
    assert scene_file("tank.xml", (tmp_path,)) == tmp_path / "data" / "tank.xml"


def test_a_file_that_is_nowhere_names_folders_and_the_nearest_bundled_one(tmp_path: Path) -> None:
    with pytest.raises(AssetNotFound, match="Did you mean 'visibility'") as caught:
        benchmark_file("visibilty", (tmp_path,))
    assert str(tmp_path) in str(caught.value)
