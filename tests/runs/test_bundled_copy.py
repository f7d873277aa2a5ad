"""``uwsim copy``: a bundled scene or benchmark with its files, to edit."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.assets.find import PACKAGE
from uwsim.base.files.input_files import record_inputs
from uwsim.cli import main
from uwsim.runs.bundled_copy import copy_bundled, copyable_names
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.scene.reader import read_scene


def files_read(path: Path) -> set[Path]:
    """Open a copied scene or benchmark; return the files of the scene that are read."""
    with record_inputs() as files:
        if path.stem in bundled_files("scenes"):
            open_scene(read_scene(path)).close()
        else:
            hash_inputs(make_plan(PlanRequest(benchmark=str(path))))
    return {file.path.resolve() for file in files if file.path.suffix != ".py"}


@pytest.mark.parametrize("name", ["grasp-scene", "remus-scene", "structured-light-scene", "grasp"])
def test_a_copy_reads_its_own_files_only(name: str, tmp_path: Path) -> None:
    copies = {path.resolve() for path in copy_bundled(name, tmp_path)}
    read = files_read(tmp_path / f"{name}.xml")
    assert not [path for path in read if path.is_relative_to(PACKAGE)]
    assert copies == read


def test_a_copied_benchmark_has_its_scene(tmp_path: Path) -> None:
    names = [path.name for path in copy_bundled("currents", tmp_path)]
    assert names[0] == "currents.xml"
    assert {"currents-scene.xml", "g500ARM5.urdf", "g500_physical.xml"} <= set(names)


def test_an_edited_copy_is_used(tmp_path: Path) -> None:
    copy_bundled("grasp-scene", tmp_path)
    part = tmp_path / "parts" / "g500_thrusters.xml"
    text = part.read_text()
    assert "<thruster" in text
    part.write_text(text.replace("<thruster", "<thrusterr"))
    with pytest.raises(Exception, match="thrusterr"):
        open_scene(read_scene(tmp_path / "grasp-scene.xml"))


def test_a_file_that_exists_is_kept_without_overwrite(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mine = tmp_path / "girona500_arm5e.urdf"
    mine.write_text("mine")
    assert main(["copy", "cirs", str(tmp_path)]) == 2
    assert "--overwrite" in capsys.readouterr().err
    assert mine.read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["girona500_arm5e.urdf"]
    assert main(["copy", "cirs", str(tmp_path), "--overwrite"]) == 0
    assert mine.read_text() != "mine"
    assert "uwsim run" in capsys.readouterr().out


def test_an_unknown_name_names_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["copy", "grasp-scne"]) == 2
    assert "grasp-scene" in capsys.readouterr().err


def test_every_bundled_scene_and_benchmark_can_be_copied() -> None:
    assert set(copyable_names()) == {*bundled_files("scenes"), *bundled_files("benchmarks")}
