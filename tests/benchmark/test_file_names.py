"""Names of cameras, measures and algorithms as names of files."""

from pathlib import Path

from tests.support.short_benchmark import BENCHMARK, run
from tests.support.synthetic_results import visibility_result
from uwsim.analysis.plots import draw_plots
from uwsim.assets.bundled import bundled_files
from uwsim.cli.bench import result_folders
from uwsim.results.inputs import Inputs
from uwsim.results.result import Column, Result


def test_a_camera_may_be_called_as_no_file_can_be(tmp_path: Path) -> None:
    scene = bundled_files("scenes")["visibility-scene"].read_text()
    (tmp_path / "tank.xml").write_text(scene.replace("bowtech1", "left/front"))
    text = BENCHMARK.replace("visibility-scene.xml", "tank.xml").replace("LENGTH", "0.2")
    (tmp_path / "b.xml").write_text(text.replace("bowtech1", "left/front"))
    result = run(tmp_path / "b.xml", tmp_path / "out", levels=["fog=0"])
    assert [(p.camera, p.file) for p in result.images] == [
        ("left/front", "pictures/00000-left_front.png")
    ]
    assert (tmp_path / "out" / "pictures" / "00000-left_front.png").is_file()


def test_measures_that_are_alike_in_80_letters_have_a_plot_each(tmp_path: Path) -> None:
    names = ["m" * 80 + "1", "m" * 80 + "2", "all-measures"]
    columns = (
        Column(name="fog", kind="level", unit="1/m"),
        *(Column(name=name, kind="measure") for name in names),
    )
    result = Result(
        inputs=Inputs(),
        run=visibility_result().run,
        columns=columns,
        rows=((0.0, 1.0, 2.0, 3.0),) * 2,
    )
    plots = draw_plots(result, tmp_path)
    assert len({plot.name for plot in plots}) == len(plots) == 4


def test_the_folder_of_an_algorithm_is_no_folder_of_a_result() -> None:
    assert result_folders(["esm", "own:Tracker"]) == ["esm", "own.Tracker"]
    assert len({name.lower() for name in result_folders(["Control", "units", "a:b", "a.b"])}) == 4
    assert not {"control", "units"} & {
        name.lower() for name in result_folders(["Control", "units"])
    }
