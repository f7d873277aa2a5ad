"""What the report promises: it says everything, loads nothing and runs nothing."""

from __future__ import annotations

import html
import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.support.synthetic_results import (
    F_STAR,
    LOSS_REASON,
    frozen_result,
    lost_result,
    nested_result,
    one_level_result,
    visibility_result,
)
from uwsim.analysis.report import render, write_report
from uwsim.analysis.report.page import rounded_text
from uwsim.cli import main
from uwsim.errors import ResultError
from uwsim.results.inputs import Inputs
from uwsim.results.log import Log, save_log
from uwsim.results.measures_file import MeasureNote, save_measures
from uwsim.results.provenance import save_provenance
from uwsim.results.result import MAX_VALUE, Column, MissingValue, Result, SavedImage
from uwsim.results.result_file import save
from uwsim.results.run_info import RunInfo

QUAD = (10.0, 10.0, 30.0, 10.0, 30.0, 20.0, 10.0, 20.0)
EVIL = "<script>alert('x')</script>\"><img src=http://e.org/x onerror=alert(1)>"


class Page(HTMLParser):
    """Tags and text of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.source, self.text = text, ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


def page_of(result: Result, directory: Path) -> Page:
    """The page without plots, which take most of the time."""
    text = render(result, directory, plots=())
    (directory / "report.html").write_text(text)
    return Page(text)


def whole_page_of(result: Result, directory: Path) -> Page:
    """The page as ``uwsim report`` draws it."""
    save(result, directory)
    return Page(write_report(directory).read_text())


def with_image(result: Result, directory: Path, *rows: int) -> Result:
    (directory / "pictures").mkdir()
    Image.fromarray(np.full((24, 32, 3), 80, np.uint8)).save(directory / "pictures" / "a.png")
    images = [
        SavedImage(row=row, camera="bowtech1", file="pictures/a.png", truth=QUAD, estimate=QUAD)
        for row in rows
    ]
    return replace(result, images=tuple(images))


def test_the_report_says_what_was_run_and_found(tmp_path: Path) -> None:
    save_provenance({"host": "reef", "load": [0.25, 0.5, 1.0], "packages": {"x": "1.2"}}, tmp_path)
    save_log(Log(measure="corners", header=("time [s]",)), tmp_path)
    result = visibility_result()
    text = page_of(result, tmp_path).text
    for said in (
        "visibility run with esm",
        "27 levels, fog density 0 to 1.3 m⁻¹",
        "24 of 27",
        LOSS_REASON,
        "threshold",
        "sha256:" + "3f" * 32,
        "c4" * 32,
        f"{F_STAR:.3f} m⁻¹",
        "30.8 grey level",
        "measure-corners.csv",
        "reef",
        "packages.x",
        "0.25 0.5 1",
        "This scene cannot tell trackers apart",
        "gives 0.893, not 0.86, which needs fog 1.031",
    ):
        assert said in text, said
    assert "(frozen), which reads no image" not in text


def test_every_level_stands_in_the_table(tmp_path: Path) -> None:
    page = page_of(visibility_result(), tmp_path)
    rows = re.findall(r"<tr( class=\"bad\")?><td>\d", (tmp_path / "report.html").read_text())
    assert len(rows) >= 27
    assert page.text.count("0.85") >= 1
    assert rows.count(' class="bad"') == 3


def test_streams_without_images_are_not_listed(tmp_path: Path) -> None:
    result = visibility_result("esm", seeds=(1, 2))
    first, second = result.image_streams
    streams = (replace(first, sha256="e3" * 32, frames=0), second)
    text = render(replace(result, image_streams=streams), tmp_path, plots=())
    assert "e3" * 32 not in text
    assert second.sha256 in text
    assert "<summary>1 stream</summary>" in text


def test_the_report_loads_nothing_and_runs_nothing(tmp_path: Path) -> None:
    page = whole_page_of(with_image(visibility_result(), tmp_path, 0, 5), tmp_path)
    sources = [v for _, attrs in page.tags for k, v in attrs.items() if k in ("src", "href")]
    assert len(sources) == 3 + 2
    assert all(source is not None and source.startswith("data:image/") for source in sources)
    assert not {"script", "iframe", "link", "object"} & {tag for tag, _ in page.tags}
    policy = [attrs for tag, attrs in page.tags if attrs.get("http-equiv")]
    assert "default-src 'none'" in str(policy[0]["content"])


def test_names_from_files_are_text_wherever_they_stand(tmp_path: Path) -> None:
    base = visibility_result()
    columns = [replace(c, name=EVIL) if c.name == "corners" else c for c in base.columns]
    columns = [replace(c, unit=EVIL) if c.name == "centroid" else c for c in columns]
    rows = [(*row[:-2], EVIL if row[-2] == "lost" else row[-2], row[-1]) for row in base.rows]
    evil = Result(
        inputs=Inputs(benchmark=(EVIL, EVIL), assets={EVIL: EVIL}),
        run=RunInfo(
            algorithm=EVIL, mode=EVIL, parameters={EVIL: [EVIL]}, other_values={EVIL: EVIL}
        ),
        columns=tuple(columns),
        rows=tuple(rows),
        missing_values=tuple(
            MissingValue(row=m.row, column="total", reason=EVIL) for m in base.missing_values
        ),
        facts={EVIL: (1.0, EVIL), "f_star": (1.1, EVIL), "d": (1.3, "m")},
        image_streams=tuple(replace(s, topic=EVIL, sha256=EVIL) for s in base.image_streams),
    )
    save_provenance({EVIL: EVIL}, tmp_path)
    evil = with_image(evil, tmp_path, 0)
    page = whole_page_of(replace(evil, images=(replace(evil.images[0], camera=EVIL),)), tmp_path)
    tags = [tag for tag, _ in page.tags]
    assert "script" not in tags
    assert all(not key.startswith("on") for _, attrs in page.tags for key in attrs)
    images = [attrs["src"] for tag, attrs in page.tags if tag == "img"]
    assert all(str(source).startswith("data:image/") for source in images)
    assert page.text.count("<script>") > 10
    assert html.escape("<script>") in (tmp_path / "report.html").read_text()


def test_the_paragraph_about_the_static_scene_stands_only_where_nothing_moves(
    tmp_path: Path,
) -> None:
    still = with_image(visibility_result(), tmp_path, 0, 5)
    moved = replace(still.images[1], truth=tuple(v + 3 for v in QUAD))
    sentence = "This scene cannot tell trackers apart"
    assert sentence in page_of(still, tmp_path).text
    assert sentence not in page_of(replace(still, images=(still.images[0], moved)), tmp_path).text


@pytest.mark.parametrize(
    ("mode", "facts", "name", "is_static"),
    [
        ("independent", {"shift": (31.5, "px")}, "visibility-moving", False),
        ("independent", {"shift": (0.0, "px")}, "visibility", True),
        ("sequential", {"shift": (0.0, "px")}, "my-own", True),
        ("sequential", {"shift": (31.5, "px")}, "my-own", False),
        ("independent", {}, "visibility-moving", False),
        ("independent", {}, "visibility", False),  # its name is no measurement
        ("sequential", {}, "my-own", True),
    ],
)
def test_a_vehicle_that_sways_is_no_static_scene_though_levels_end_at_one_phase(
    mode: str, facts: dict[str, object], name: str, is_static: bool, tmp_path: Path
) -> None:
    result = with_image(visibility_result(), tmp_path, 0, 5)
    result = replace(
        result,
        run=replace(result.run, mode=mode),
        facts=facts,
        inputs=replace(result.inputs, benchmark=(f"{name}.xml", "sha256:0")),
    )
    text = page_of(result, tmp_path).text
    assert ("This scene cannot tell trackers apart" in text) == is_static


def test_the_control_beside_the_result_is_drawn_into_the_plots(tmp_path: Path) -> None:
    save(frozen_result(), tmp_path / "control")
    page = whole_page_of(visibility_result(), tmp_path)
    assert "(frozen), which reads no image" in page.text


def test_losses_over_repeats_are_given_from_first_to_last(tmp_path: Path) -> None:
    page = whole_page_of(visibility_result(seeds=tuple(range(1, 11))), tmp_path)
    assert "fog 1.15 m⁻¹ to fog 1.25 m⁻¹" in page.text
    assert "earliest and latest of the first levels that did not end ok" in page.text
    assert "exact 95 % interval" in page.text
    page = whole_page_of(visibility_result(), tmp_path)
    assert "Solid vertical line: first level that did not end ok." in page.text


def test_an_image_that_is_gone_or_broken_is_reported_and_does_not_stop_the_report(
    tmp_path: Path,
) -> None:
    result = with_image(visibility_result(), tmp_path, 0, 1)
    (tmp_path / "pictures" / "b.png").write_bytes(b"\x89PNG broken")
    gone = replace(result.images[0], file="pictures/gone.png")
    broken = replace(result.images[1], file="pictures/b.png")
    page = page_of(replace(result, images=(gone, broken)), tmp_path)
    assert page.text.count("image cannot be read") == 2


def test_a_link_out_of_the_directory_is_not_followed(tmp_path: Path) -> None:
    secret = tmp_path / "secret.png"
    Image.fromarray(np.zeros((8, 8, 3), np.uint8)).save(secret)
    directory = tmp_path / "result"
    directory.mkdir()
    (directory / "a.png").symlink_to(secret)
    image = SavedImage(row=0, camera="c", file="a.png")
    page = page_of(replace(visibility_result(), images=(image,)), directory)
    assert "image cannot be read" in page.text


@pytest.mark.parametrize("make", [lost_result, one_level_result, nested_result, frozen_result])
def test_any_result_has_a_report(make: Callable[[], Result], tmp_path: Path) -> None:
    assert "Results by level" in page_of(make(), tmp_path).text


def test_the_largest_numbers_of_all_are_drawn_without_a_warning(tmp_path: Path) -> None:
    swept = visibility_result(seeds=(1, 2, 3, 4))
    numbers = {swept.index(name) for name in ("corners", "corners.mean", "centroid", "total")}
    rows = tuple(
        tuple(
            (-1) ** (i // 5) * MAX_VALUE * (1 - i / 200)
            if j in numbers and cell is not None
            else cell
            for j, cell in enumerate(row)
        )
        for i, row in enumerate(swept.rows)
    )
    page = page_of(replace(swept, rows=rows), tmp_path)
    assert "e+59" in page.text


def test_a_prediction_beyond_everything_is_drawn_without_a_warning(tmp_path: Path) -> None:
    facts = {"f_star": (1e308, "1/m"), "S": (1e308, "1")}
    assert "1e+308" in whole_page_of(replace(visibility_result(), facts=facts), tmp_path).text


def test_letters_of_no_font_are_drawn_without_a_warning(tmp_path: Path) -> None:
    level = Column(name="none", kind="level")
    measure = Column(name="m", kind="measure", unit="\u7c73\x1b")
    save(
        Result(inputs=Inputs(), run=RunInfo(), columns=(level, measure), rows=((1.0, 2.0),)),
        tmp_path,
    )
    assert write_report(tmp_path, pdf=True).exists()


def test_a_result_with_no_rows_has_a_report(tmp_path: Path) -> None:
    empty = replace(visibility_result(), rows=(), missing_values=())
    assert "No level was run" in page_of(empty, tmp_path).text


def test_without_measures_there_is_still_a_report(tmp_path: Path) -> None:
    bare = Result(
        inputs=Inputs(), run=RunInfo(), columns=(Column(name="none", kind="level"),), rows=((1.0,),)
    )
    assert "1 level, one scene" in page_of(bare, tmp_path).text


@pytest.mark.slow
def test_uwsim_report_draws_it_again_from_the_directory_or_the_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    save(one_level_result(), tmp_path)
    assert main(["report", str(tmp_path)]) == 0
    first = (tmp_path / "report.html").read_bytes()
    assert main(["report", str(tmp_path / "result.json")]) == 0
    assert (tmp_path / "report.html").read_bytes() == first
    assert "report.html" in capsys.readouterr().out


def test_uwsim_report_of_nothing_is_one_clean_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    with pytest.raises(ResultError, match="no result here"):
        write_report(tmp_path)


def test_parameters_are_written_as_people_write_them_and_empty_ones_not_at_all(
    tmp_path: Path,
) -> None:
    said = RunInfo(parameters={"levels": 3.0, "threshold": 0.25}, notes=())
    page_of(replace(visibility_result(), run=said), tmp_path)
    text = (tmp_path / "report.html").read_text()
    assert "parameter levels</td><td>3</td>" in text
    assert "parameter threshold</td><td>0.25</td>" in text
    assert "<td>notes</td>" not in text
    assert "<td>levels</td>" not in text


def test_the_floor_is_what_the_run_has_measured_and_not_what_its_name_suggests(
    tmp_path: Path,
) -> None:
    named = replace(
        visibility_result(), inputs=Inputs(benchmark=("visibility-of-mine.xml", "sha256:0"))
    )
    text = page_of(named, tmp_path).text
    assert "This result does not state its score" in text
    assert "about 1 px" not in text
    facts = {"floor_corners": (2.8794, "px"), "floor_centroid": (1.6345, "px")}
    text = page_of(replace(named, facts={**named.facts, **facts}), tmp_path).text
    assert "at the level with the greatest error: corners 2.88 px, centroid 1.63 px." in text
    assert "error floor of corners, of a perfect tracker" in text


def endings_of(page: Page) -> dict[str, str]:
    """Status -> how many rows, from the table of endings."""
    found = re.findall(
        r'<span class="status \w+">([\w ]+)</span><span class="meaning">', page.source
    )
    numbers = re.findall(r'<span class="meaning">[^<]*</span></td><td>(\d+)</td>', page.source)
    return dict(zip(found, numbers, strict=True))


def test_every_class_of_ending_is_counted_also_those_that_never_came(tmp_path: Path) -> None:
    counts = endings_of(page_of(visibility_result(), tmp_path))
    assert counts == {
        "ok": "24",
        "lost": "3",
        "timeout": "0",
        "collision": "0",
        "algorithm error": "0",
    }


def test_reasons_that_differ_in_numbers_alone_are_reported_once_and_counted(tmp_path: Path) -> None:
    base = visibility_result()
    notes = [
        MissingValue(
            row=row, column="total", reason=f"tracker lost at {row}.5 s: ZNCC 0.{row} on 5 frames"
        )
        for row in (24, 25)
    ]
    notes.append(MissingValue(row=26, column="total", reason="no estimate for 1.5 s"))
    text = page_of(replace(base, missing_values=tuple(notes)), tmp_path).text
    assert "2 × tracker lost at 24.5 s: ZNCC 0.24 on 5 frames" in text
    assert "1 × no estimate for 1.5 s" in text


def test_a_long_reason_is_not_repeated_in_every_line(tmp_path: Path) -> None:
    base = visibility_result()
    long = "tracker raised: " + "a very long message of a library " * 5
    notes = [MissingValue(row=row, column="total", reason=f"{long}{row}") for row in (24, 25)]
    notes.append(MissingValue(row=26, column="total", reason=f"{long}25"))
    text = page_of(replace(base, missing_values=tuple(notes)), tmp_path).text
    assert "as above, with other numbers" in text
    assert re.search(r"as above(?!,)", text)


def test_each_repeat_has_its_first_failure(tmp_path: Path) -> None:
    page = page_of(visibility_result(seeds=(1, 2, 3)), tmp_path)
    assert "The first level of each repeat that did not end ok" in page.text
    assert (
        len(re.findall(r'<tr><td>[123]</td><td class="text">fog 1\.\d+ m⁻¹</td>', page.source)) == 3
    )
    assert "The first level of each repeat" not in page_of(visibility_result(), tmp_path).text


def test_captions_say_unit_statistic_and_what_bands_are(tmp_path: Path) -> None:
    text = whole_page_of(visibility_result(seeds=(1, 2, 3)), tmp_path).text
    for said in (
        "Figure 1. total [px] = corners+centroid.",
        "Figure 2. corners [px], mean over each level.",
        "Points: means over 3 repeats (seeds 1 to 3).",
        "Bands: 95 % intervals of that mean",
        "corners: mean over each level; total = corners+centroid; ended_at: simulation time at",
    ):
        assert said in text, said


def test_intervals_stand_apart_from_their_means(tmp_path: Path) -> None:
    source = page_of(visibility_result(seeds=(1, 2, 3)), tmp_path).source
    assert re.search(r'<td>\d\.\d+<span class="interval">\[\d\.\d+, \d\.\d+\]</span></td>', source)
    assert '<span class="status ok">3 of 3 ok</span><span class="interval">29 to 100 %' in source


def test_the_command_is_given_as_typed_without_what_changes_nothing(tmp_path: Path) -> None:
    typed = ["bench", "visibility", "--seed", "1", "--out", "/a b", "--workers=2", "--overwrite"]
    save_provenance({"command": [*typed, "--set", "oceanState.fog.density=0.4"]}, tmp_path)
    source = page_of(visibility_result(), tmp_path).source
    command = "uwsim bench visibility --seed 1 --set oceanState.fog.density=0.4\nuwsim verify"
    assert command in source


def test_without_provenance_the_command_is_put_together(tmp_path: Path) -> None:
    base = visibility_result(seeds=(1, 2))
    run = replace(
        base.run,
        settings=(("vehicle[g].virtualCamera[c].std", "0.016"),),
        levels=(("fog", 0.2),),
        compatibility=("thresholds",),
    )
    text = page_of(replace(base, run=run), tmp_path).text
    assert (
        "uwsim bench visibility --algorithm esm --seed 1 --repeat 2 --mode sequential "
        "--set 'vehicle[g].virtualCamera[c].std=0.016' --level fog=0.2 --compat thresholds"
    ) in text
    assert "Only these levels of the sweep were run: fog=0.2." in text
    assert "Compatibility quirks: thresholds." in text


def test_an_unfinished_result_says_so_first(tmp_path: Path) -> None:
    base = visibility_result()
    text = page_of(replace(base, run=replace(base.run, trial_counts=(1, 3))), tmp_path).text
    assert "Not finished: 1 of 3 trials are finished." in text
    assert "Not finished" not in page_of(base, tmp_path).text


def test_of_many_images_forty_are_shown_and_of_other_repeats_the_failures(
    tmp_path: Path,
) -> None:
    several = visibility_result(seeds=(1, 2, 3))
    page = page_of(with_image(several, tmp_path, *range(len(several.rows))), tmp_path)
    captions = re.findall(r"<figcaption[^>]*>(seed \d) · (fog [\d.]+)", page.source)
    assert [seed for seed, _ in captions].count("seed 1") == 27
    assert len(captions) == 27 + 2
    assert "29 of 81 images: every level of the first repeat" in page.text
    large = nested_result()
    (tmp_path / "b").mkdir()
    page = page_of(with_image(large, tmp_path / "b", *range(len(large.rows))), tmp_path / "b")
    assert page.source.count("<figcaption") == 40
    assert "40 of 81 images: evenly chosen" in page.text


def test_one_row_is_no_curve(tmp_path: Path) -> None:
    assert "Figure 1." not in whole_page_of(one_level_result(), tmp_path).text
    assert "1 row, 9 columns" in page_of(one_level_result(), tmp_path).text


def test_cards_have_three_digits_and_nothing_is_zero(tmp_path: Path) -> None:
    base = visibility_result()
    rows = list(base.rows)
    rows[0] = (0.0, 2.06e-05, *rows[0][2:5], 36.4, *rows[0][6:])
    rows[23] = (rows[23][0], 1.7, *rows[23][2:5], -2083.2, *rows[23][6:])
    text = page_of(replace(base, rows=tuple(rows)), tmp_path).text
    assert "0.00 to 1.70 px" in text
    assert "36.4 to −2080 px" in text


@pytest.mark.parametrize(
    ("value", "against", "text"),
    [
        (1.0, 1.0, "1"),
        (3.0, 0.0, "3"),
        (0.0, 3.0, "0"),
        (3.0, 0.5, "3.00"),
        (5538.48, 9831.2, "5540"),
        (-2083.2, 36.4, "−2080"),
        (12345.0, 7.0, "12345"),
        (0.13827, 2.16, "0.138"),
        (2.06e-05, 1.7, "0.00"),
        (1.1583, 1.1583, "1.16"),
        (2.5e9, 1.0, "2.5e+09"),
    ],
)
def test_a_number_on_a_card_has_three_digits_and_a_count_no_decimals(
    value: float, against: float, text: str
) -> None:
    assert rounded_text(value, against) == text


def test_a_measure_that_is_the_same_at_both_ends_is_one_number(tmp_path: Path) -> None:
    base = visibility_result()
    kinds = [column.name for column in base.columns]
    at = kinds.index("centroid")
    rows = tuple((*row[:at], None if row[at] is None else 1.0, *row[at + 1 :]) for row in base.rows)
    source = page_of(replace(base, rows=rows), tmp_path).source
    card = source.split('<div class="label">centroid</div>')[1]
    assert card.split('<div class="value">')[1].startswith("1 px<")


def test_the_prediction_is_given_only_where_fog_is_swept(tmp_path: Path) -> None:
    base = visibility_result()
    current = (Column(name="current", kind="level", unit="m/s"), *base.columns[1:])
    text = page_of(replace(base, columns=current), tmp_path).text
    assert "predicted loss of tracking" not in text
    assert "the paper's fog" not in text
    assert "predicted loss of tracking (fog f*)" in page_of(base, tmp_path).text


def test_without_pixels_their_floor_is_not_reported(tmp_path: Path) -> None:
    base = visibility_result()
    columns = tuple(replace(c, unit="m") if c.unit == "px" else c for c in base.columns)
    assert "floor of the ground truth" not in page_of(replace(base, columns=columns), tmp_path).text


def test_where_a_body_is_in_the_image_has_no_floor(tmp_path: Path) -> None:
    base = visibility_result()
    others = {"centroid": {"unit": "m"}, "corners.max": {"name": "corners.visible", "unit": None}}
    columns = tuple(replace(c, **others.get(c.name, {})) for c in base.columns)
    assert "floor of the ground truth" in page_of(base, tmp_path).text
    assert "floor of the ground truth" not in page_of(replace(base, columns=columns), tmp_path).text


@pytest.mark.slow
def test_a_huge_result_has_a_report_of_sane_size(tmp_path: Path) -> None:
    base = visibility_result()
    rows = tuple((0.001 * i, *base.rows[26][1:]) for i in range(5_000))
    notes = tuple(MissingValue(row=i, column="total", reason=LOSS_REASON * 4) for i in range(5_000))
    page = page_of(replace(base, rows=rows, missing_values=notes), tmp_path)
    assert len(page.source) < 2_000_000
    assert "The first 1000 of 5000 levels" in page.text


def test_captions_are_the_measures_own_words_and_value(tmp_path: Path) -> None:
    notes = {
        "corners": MeasureNote(meaning="distance between truth g and estimate e", value="rms"),
        "centroid": MeasureNote(meaning="", value="last"),
    }
    save_measures(notes, tmp_path)
    text = whole_page_of(visibility_result(), tmp_path).text
    assert (
        "corners [px]: distance between truth g and estimate e; root mean square over each level."
        in text
    )
    assert "centroid [px], last value of each level." in text


def test_lock_step_and_chosen_levels_are_plain_lines_and_not_warnings(tmp_path: Path) -> None:
    for how in ("own process, grade (b)", "lock-step, web, grade (a)"):
        result = visibility_result()
        run = replace(result.run, clients=(("esm", how),), levels=(("fog", 0.5),))
        page = page_of(replace(result, run=run), tmp_path)
        assert "esm takes part" in page.text
        assert "Only these levels of the sweep were run: fog=0.5." in page.text
        assert 'class="warning"' not in page.source


@pytest.mark.parametrize(
    "how",
    [
        "real time, web, not repeatable",
        "in process",
        "lock-step, ros1, grade (a), not guaranteed",
        "anything else",
    ],
)
def test_what_reduces_confidence_is_a_warning(how: str, tmp_path: Path) -> None:
    result = visibility_result()
    run = replace(result.run, clients=(("tracker", how),))
    source = page_of(replace(result, run=run), tmp_path).source
    warning = re.search(r'<div class="warning">(.*?)</div>', source, re.DOTALL)
    assert warning is not None
    assert "tracker takes part" in warning[1]


def test_no_hash_of_an_input_is_empty(tmp_path: Path) -> None:
    result = visibility_result()
    assets = {"box": "sha256:", **(result.inputs.assets or {})}
    page = page_of(replace(result, inputs=replace(result.inputs, assets=assets)), tmp_path)
    assert not re.search(r"sha256:\s*<", page.source)


def test_the_report_shows_measures_over_time(tmp_path: Path) -> None:
    header = ("fog [1/m]", "time [s]", "total [px]")
    samples = tuple((0.0, 0.1 * k, 1.0 + 0.1 * k) for k in range(5))
    save_log(Log(measure="corners", header=header, samples=samples), tmp_path)
    page = whole_page_of(visibility_result(), tmp_path)
    assert "Within the levels" in page.text
    assert "corners [px] over the time of the level." in page.text
