"""The overview of tasks and algorithms: its groups, rates, ranks, files and drawing."""

from __future__ import annotations

import csv
import io
import itertools
import json
from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text
from PIL import Image

from tests.support.compared_results import Values, make_result
from tests.support.grasp_results import grasping_result
from uwsim.analysis.comparison import Entry
from uwsim.analysis.overview import (
    overview_csv,
    overview_json,
    overview_rows,
    rank_algorithms,
    read_tasks,
    write_overview,
)
from uwsim.analysis.overview.ranks import compare_algorithms, success_of
from uwsim.analysis.overview.tasks import OverviewTask
from uwsim.analysis.plots import level_label
from uwsim.analysis.plots.success_overview import (
    COLOUR_MAP,
    INK,
    OverviewRow,
    _luminance,
    success_overview,
)
from uwsim.cli import main
from uwsim.errors import ResultError
from uwsim.results.result import Column, Result
from uwsim.results.result_file import save
from uwsim.statistics import rate


def of_task(task: str, result: Result) -> Result:
    return replace(
        result, inputs=replace(result.inputs, benchmark=(f"{task}.xml", "sha256:" + "11" * 32))
    )


def outcomes(*n_ok: int, n: int = 8) -> Values:
    """Return the values of a level for each number of successes; the last seeds fail."""
    return {0.5 * i: [1.0 if seed < k else None for seed in range(n)] for i, k in enumerate(n_ok)}


@pytest.fixture(scope="module")
def paths(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("results")
    results = [
        of_task("hover", make_result("best", outcomes(8, 8))),
        of_task("hover", make_result("worst", outcomes(2, 0))),
        of_task("track", make_result("best", outcomes(8, 7, 6))),
        of_task("track", make_result("worst", outcomes(3, 0, 0))),
        replace(grasping_result(), run=replace(grasping_result().run, algorithm="best")),
    ]
    for i, result in enumerate(results):
        save(result, folder / f"{i}.result")
    return [folder / f"{i}.result" for i in range(len(results))]


@pytest.fixture(scope="module")
def tasks(paths: list[Path]) -> tuple[OverviewTask, ...]:
    return read_tasks(paths)


def test_results_are_grouped_by_benchmark(tasks: tuple[OverviewTask, ...]) -> None:
    assert [(task.name, [e.name for e in task.entries]) for task in tasks] == [
        ("hover", ["best", "worst"]),
        ("track", ["best", "worst"]),
        ("grasp", ["best"]),
    ]


def test_a_row_is_a_task_or_a_value_of_its_outer_parameter(
    tasks: tuple[OverviewTask, ...],
) -> None:
    rows = overview_rows(tasks)
    assert [(row.task, row.parameter, row.outer_level) for row in rows] == [
        ("hover", "fog density [m⁻¹]", ""),
        ("track", "fog density [m⁻¹]", ""),
        ("grasp", "current [m/s]", "fog 0 m⁻¹"),
        ("grasp", "current [m/s]", "fog 0.5 m⁻¹"),
        ("grasp", "current [m/s]", "fog 1 m⁻¹"),
    ]
    assert rows[1].levels == ("0.0", "0.5", "1.0")
    assert rows[1].rates["worst"] == (rate(3, 8), rate(0, 8), rate(0, 8))
    assert rows[2].rates["best"][0] == rate(4, 4)
    assert "worst" not in rows[2].rates


def test_a_parameter_with_one_value_is_left_out() -> None:
    result = grasping_result()
    foggy = replace(result, rows=tuple(r for r in result.rows if r[2] == 0.5), missing_values=())
    entry = Entry(name="grasp", source="x", result=foggy, sha256="0" * 64)
    rows = overview_rows([OverviewTask(name="grasp", entries=(entry,))])
    assert [(r.parameter, r.outer_level, r.levels) for r in rows] == [
        ("current [m/s]", "", ("0.0", "0.1", "0.2", "0.3"))
    ]


def test_a_task_with_one_level_states_all_its_parameters() -> None:
    """Which parameter is the difficulty is not known then: the first often is."""
    result = grasping_result()
    rows = result.rows[:1]
    one = replace(result, rows=rows, missing_values=(), remarks=())
    entry = Entry(name="grasp", source="x", result=one, sha256="0" * 64)
    (row,) = overview_rows([OverviewTask(name="grasp", entries=(entry,))])
    assert (row.parameter, row.outer_level, row.levels) == ("fog 0 m⁻¹, current 0 m/s", "", ("",))


def test_noise_of_the_water_is_not_that_of_a_camera() -> None:
    water = Column(name="noise", kind="level", unit="dB re 1 uPa2/Hz")
    assert level_label(water) == "noise level of the water [dB re 1 µPa²/Hz]"
    assert level_label(Column(name="noise", kind="level", unit="1")) == "camera noise [1]"


def test_titles_of_narrow_maps_do_not_overlap() -> None:
    names = [
        "baseline-1 (baseline-1)",
        "an-entry-with-a-very-long-name",
        "baseline-3",
        "WWWWWWWWWW",
    ]
    row = OverviewRow(task="hover", parameter="current 0 m/s", outer_level="", levels=("",),
                      rates={name: (rate(1, 1),) for name in names})  # fmt: skip
    figure = success_overview([row], names)
    figure.draw_without_rendering()
    boxes = [
        text.get_window_extent()
        for axes in figure.axes[: len(names)]
        for text in axes.findobj(Text)
        if isinstance(text, Text) and text.get_text() and text.get_text() == axes.get_title("left")
    ]
    assert len(boxes) == len(names)
    assert all(a.x1 < b.x0 for a, b in itertools.pairwise(boxes))
    width = figure.bbox.width
    assert all(text.get_window_extent().x0 >= 0 for text in figure.texts)
    assert all(text.get_window_extent().x1 <= width for text in figure.texts)


def test_ranks_are_over_the_tasks_of_all(tasks: tuple[OverviewTask, ...]) -> None:
    ranks = rank_algorithms(tasks)
    assert ranks is not None
    assert (ranks.algorithms, ranks.tasks, ranks.n_seeds) == (
        ("best", "worst"), ("hover", "track"), (8, 8),
    )  # fmt: skip
    best, worst = ranks.ranks
    assert best.score == pytest.approx((1.0 + 21 / 24) / 2)
    assert worst.score == pytest.approx((1 / 8 + 3 / 24) / 2)
    assert (best.rank, worst.rank, worst.low, worst.high) == (1, 2, 2, 2)
    assert ranks.strengths[0].value == -ranks.strengths[1].value > 0.0
    assert rank_algorithms(tasks[2:]) is None


@pytest.mark.parametrize(
    ("n", "note"), [(8, "8 seeds cannot separate 5 algorithms: 9 are"), (9, "")]
)
def test_too_few_seeds_for_the_algorithms_are_stated(n: int, note: str) -> None:
    """Holm's first step multiplies 2/2^n by the ten pairs of five algorithms."""
    entries = [
        Entry(
            name=f"a{i}",
            source="x",
            sha256="0" * 64,
            result=of_task("hover", make_result(f"a{i}", outcomes(*[n] * i, *[0] * (4 - i), n=n))),
        )
        for i in range(5)
    ]
    ranks = rank_algorithms([OverviewTask(name="hover", entries=tuple(entries))])
    assert ranks is not None
    assert ranks.note.startswith(note)
    assert bool(ranks.note) == (n == 8)
    assert (ranks.ranks[0].low, ranks.ranks[0].n_worse) == ((None, 0) if n == 8 else (1, 4))


def test_algorithms_are_compared_over_the_tasks_that_both_ran(
    tasks: tuple[OverviewTask, ...],
) -> None:
    common = compare_algorithms(tasks, "best", ["worst"])["worst"]
    assert (common.n_tasks, common.verdict) == (2, "better")
    assert common.first == pytest.approx((1.0 + 21 / 24) / 2)
    assert compare_algorithms(tasks, "worst", ["best"])["best"].verdict == "worse"
    assert compare_algorithms(tasks[2:], "worst", ["best"]) == {}
    assert success_of(tasks[1:], "worst") == pytest.approx(3 / 24)


def test_seeds_that_one_did_not_run_do_not_count() -> None:
    first = of_task("hover", make_result("a", outcomes(8)))
    second = of_task("hover", make_result("b", outcomes(4), seed=4))
    entry = {"source": "x", "sha256": "0" * 64}
    task = OverviewTask(
        name="hover",
        entries=(
            Entry(name="a", result=first, **entry),
            Entry(name="b", result=second, **entry),
        ),
    )
    ranks = rank_algorithms([task])
    assert ranks is not None
    assert ranks.n_seeds == (4,)
    assert ranks.ranks[0].place == ranks.ranks[1].place  # both succeed under seeds 4 to 7
    assert ranks.strengths == ()


def test_a_folder_with_a_result_of_each_task_is_one_entry(paths: list[Path]) -> None:
    """The last has an algorithm of another name; the folder of two results of one task has none."""
    folders = ["ours", "both", "ours", "both", "ours"]
    assert [[e.name for e in task.entries] for task in read_tasks(paths, folders=folders)] == [
        ["ours", "both"], ["ours", "both"], ["ours"],
    ]  # fmt: skip
    tasks = read_tasks(paths, folders=["both", "both", "", "", ""])
    assert [[e.name for e in task.entries] for task in tasks] == [
        ["best", "worst"], ["best", "worst"], ["best"],
    ]  # fmt: skip


def test_other_experiments_of_one_benchmark_are_refused(paths: list[Path], tmp_path: Path) -> None:
    other = of_task("hover", make_result("third", outcomes(8, 8)))
    save(replace(other, run=replace(other.run, timestep=(0.01, "s"))), tmp_path / "x.result")
    with pytest.raises(ResultError, match=r"The results of hover .* timestep: .* Use --force"):
        read_tasks([*paths, tmp_path / "x.result"])
    assert read_tasks([*paths, tmp_path / "x.result"], force=True)[0].experiment_differences


def test_results_without_rows_are_refused(paths: list[Path], tmp_path: Path) -> None:
    save(replace(make_result("a", outcomes(8)), rows=(), missing_values=()), tmp_path / "x.result")
    with pytest.raises(ResultError, match=r"x.result: has no rows; expected"):
        read_tasks([*paths, tmp_path / "x.result"])


def test_the_files_have_the_numbers(tasks: tuple[OverviewTask, ...]) -> None:
    rows = list(csv.DictReader(io.StringIO(overview_csv(tasks))))
    assert len(rows) == 2 * 2 + 2 * 3 + 12
    assert rows[6]["level"] == "fog 1 m⁻¹"
    assert (rows[6]["n"], rows[6]["n_ok"], rows[6]["rate"]) == ("8", "6", "0.75")
    document = json.loads(overview_json(tasks, rank_algorithms(tasks)))
    assert document["ranked_tasks"] == [
        {"name": "hover", "n_seeds": 8},
        {"name": "track", "n_seeds": 8},
    ]
    assert [rank["algorithm"] for rank in document["ranks"]] == ["best", "worst"]
    assert json.loads(overview_json(tasks, None))["ranks"] == []


def test_each_cell_is_readable_in_colour_and_grey(tasks: tuple[OverviewTask, ...]) -> None:
    """Every text has a contrast of 3.5 or more, and lightness grows with the rate."""
    figure = success_overview(overview_rows(tasks), ["best", "worst"])
    best = figure.axes[0]
    assert best.get_title(loc="left") == "best"
    assert [text.get_text() for text in best.texts[:3]] == ["0.0", "8/8", "63–100"]
    colours = [mpl.colormaps[COLOUR_MAP](i / 100) for i in range(101)]
    luminances = [_luminance(colour) for colour in colours]
    assert luminances == sorted(luminances)
    inks = _luminance(to_rgb("white")), _luminance(to_rgb(INK))
    for luminance in luminances:
        ratios = (inks[0] + 0.05) / (luminance + 0.05), (luminance + 0.05) / (inks[1] + 0.05)
        assert max(ratios) > 3.5


@pytest.mark.slow
def test_the_command_writes_the_overview(
    paths: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = [str(path) for path in paths]
    assert main(["compare", "--overview", *names, "--out", str(tmp_path / "a")]) == 0
    printed = capsys.readouterr().out
    assert "Success over hover (8 seeds), track (8 seeds)" in printed
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == [
        "overview.csv", "overview.json", "overview.pdf", "overview.png",
    ]  # fmt: skip
    again = write_overview(read_tasks(paths), tmp_path / "b")
    assert again.read_bytes() == (tmp_path / "a" / "overview.png").read_bytes()
    with Image.open(again) as image:
        assert image.size[0] > 600
    assert main(["compare", "--overview", *names, "--measure", "fog"]) == 2
    assert "leave out --measure" in capsys.readouterr().err
