"""What a comparison promises: honest pairs, honest tests, honest words."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from rich.console import Console
from scipy import stats

from tests.support.compared_results import INPUTS, entries, make_result, noisy_result
from tests.support.synthetic_results import (
    frozen_result,
    lost_result,
    nested_result,
    one_level_result,
    visibility_result,
)
from uwsim.analysis.comparison import (
    Comparison,
    compare,
    differences,
    read_entries,
    remarks,
    shared_column,
    write_comparison,
)
from uwsim.analysis.comparison.document import csv_text, json_text
from uwsim.analysis.comparison.matrix import matrix
from uwsim.analysis.comparison.page import render
from uwsim.analysis.comparison.plots import _bars as bars_plot
from uwsim.analysis.comparison.plots import curves_plot, differences_plot, success_plot
from uwsim.analysis.comparison.sentences import distinct_texts, sentences
from uwsim.analysis.comparison.terminal import renderables
from uwsim.errors import ResultError, UnknownName
from uwsim.results.inputs import Inputs
from uwsim.results.result import Result
from uwsim.results.result_file import save
from uwsim.results.run_info import RunInfo
from uwsim.statistics import Interval, mean_interval, rate, repeats_needed, sign_flip

EVIL = "<script>alert('x')</script>"


def compared(*results: Result, **options: bool) -> Comparison:
    found = entries(*results)
    return compare(found, shared_column(found, None), **options)


def said(comparison: Comparison) -> str:
    return " ".join(s for versus in comparison.pairs for s in sentences(comparison, versus))


# ---------------------------------------------------------------------------- pairs


def test_rows_are_paired_by_seed_and_level_and_lost_ones_are_counted_not_guessed() -> None:
    first = make_result("esm", {0.0: [1.0, 2.0, 3.0, 4.0], 0.5: [5.0, None, 7.0, None]})
    second = make_result("ic", {0.0: [1.5, 2.0, 3.25, 4.0], 0.5: [None, 6.0, 8.0, None]})
    clear, foggy = compared(first, second).pairs[0].levels
    assert clear.seeds == (0, 1, 2, 3)
    assert clear.value.difference == mean_interval([0.5, 0.0, 0.25, 0.0])
    assert clear.value.p == sign_flip([0.5, 0.0, 0.25, 0.0])
    assert (foggy.n_only_first, foggy.n_only_second, foggy.n_neither) == (1, 1, 1)
    assert (foggy.value.difference.n, foggy.value.difference.mean) == (1, 1.0)
    assert foggy.success is not None
    assert (foggy.success.first, foggy.success.second) == (rate(2, 4), rate(2, 4))
    assert (foggy.success.first_only, foggy.success.second_only) == (1, 1)


def test_only_seeds_and_levels_of_both_are_compared_and_the_rest_is_reported() -> None:
    first = make_result("esm", {0.0: [1.0] * 4, 0.5: [1.0] * 4})
    second = make_result("ic", {0.5: [2.0] * 4, 1.0: [2.0] * 4}, seed=2)
    comparison = compared(first, second)
    (at,) = comparison.pairs[0].levels
    assert (at.level, at.seeds) == ((0.5,), (2, 3))
    assert "Rows without a partner are omitted: 6 of esm, 6 of ic." in said(comparison)


def test_levels_are_paired_though_their_last_bits_differ() -> None:
    first, second = make_result("esm", {0.1 + 0.2: [1.0] * 2}), make_result("ic", {0.3: [2.0] * 2})
    assert compared(first, second).pairs[0].levels[0].value.difference.mean == 1.0


def test_without_a_seed_in_common_nothing_is_compared() -> None:
    first, second = (
        make_result("esm", {0.0: [1.0] * 3}),
        make_result("ic", {0.0: [1.0] * 3}, seed=5),
    )
    with pytest.raises(
        ResultError,
        match=r"esm\.result and ic\.result have no seed .* seed 0 to 2 at 0; seed 5 to 7 at 0\.",
    ):
        compared(first, second)


def test_a_result_that_does_not_say_its_seed_cannot_be_paired() -> None:
    bare = replace(one_level_result(), run=RunInfo(algorithm="esm"))
    with pytest.raises(ResultError, match="does not record its seeds"):
        compared(bare, replace(bare, run=RunInfo(algorithm="ic")))


# ---------------------------------------------------------------------------- of one experiment


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"inputs": {**INPUTS, "benchmark": ("visibility.xml", "sha256:1")}}, "benchmark: visib"),
        ({"inputs": {**INPUTS, "scene": ("tank.xml", "sha256:2")}}, "scene: visibility-scene.xml "),
        ({"inputs": {**INPUTS, "assets": {}}}, "asset blackbox.osg: 777777777777 in esm.result"),
        ({"run": {"mode": "sequential"}}, "mode: independent in esm.result, sequential in ic.res"),
        ({"run": {"timestep": (0.001, "s")}}, "timestep: 0.002 s in esm.result, 0.001 s in ic"),
        ({"run": {"compatibility": ("rows",)}}, "compatibility: none in esm.result, rows in ic"),
        ({"run": {"settings": (("wind", "2"),)}}, "settings of the scene: none in esm.result, win"),
    ],
)
def test_what_makes_another_experiment_is_named(change: dict[str, object], said: str) -> None:
    first, second = make_result("esm", {0.0: [1.0]}), make_result("ic", {0.0: [1.0]})
    run = replace(second.run, **change.get("run", {}))
    other = replace(second, run=run, inputs=Inputs.from_dict(change.get("inputs", INPUTS)))
    found = differences(entries(first, other))
    assert len(found) >= 1
    assert found[0].startswith(said)
    assert differences(entries(first, second)) == ()


def with_files(result: Result, **roles: object) -> Result:
    return replace(result, inputs=Inputs.from_dict({**INPUTS, **roles}))


def test_another_plugin_of_the_same_name_makes_another_experiment() -> None:
    first, second = make_result("esm", {0.0: [1.0]}), make_result("ic", {0.0: [1.0]})
    one = with_files(first, plugins=(("parts.py", "sha256:aa"),))
    assert differences(entries(one, with_files(second, plugins=(("parts.py", "sha256:bb"),)))) == (
        "plugin parts.py: aa in esm.result, bb in ic.result",
    )
    assert remarks(entries(one, one)) == ()
    assert differences(entries(one, second)) == ()
    assert remarks(entries(one, second)) == (
        "plugin parts.py: aa in esm.result, absent in ic.result",
    )


def test_another_source_of_one_algorithm_is_remarked() -> None:
    first, second = (
        make_result("own:Tracker", {0.0: [1.0]}),
        make_result("own:Tracker", {0.0: [2.0]}),
    )
    found = entries(
        with_files(first, algorithm={"own.py": "sha256:aa"}),
        with_files(second, algorithm={"own.py": "sha256:bb"}),
    )
    assert differences(found) == ()
    [said] = remarks(found)
    assert said.startswith("source of own:Tracker, own.py: aa in ")


def test_parameters_and_settings_of_an_algorithm_make_no_other_experiment() -> None:
    first, second = make_result("esm", {0.0: [1.0]}), make_result("esm2", {0.0: [1.0]})
    run = replace(second.run, parameters={"levels": 1}, settings=(("algorithm.levels", "1"),))
    assert differences(entries(first, replace(second, run=run))) == ()


def test_versions_and_unfinished_runs_are_remarked() -> None:
    first, second = make_result("esm", {0.0: [1.0]}), make_result("ic", {0.0: [1.0]})
    other = replace(second, run=replace(second.run, version="0.2.0", trial_counts=(3, 12)))
    assert remarks(entries(first, second)) == ()
    assert remarks(entries(first, other)) == (
        "run with different versions, version: 0.1.0 in esm.result, 0.2.0 in ic.result",
        "ic is not finished: 3 of 12 trials are finished",
    )


def test_what_cannot_be_held_together_is_an_error_with_the_nearest_name() -> None:
    first = make_result("esm", {0.0: [1.0]})
    with pytest.raises(UnknownName, match="Did you mean 'corners'"):
        shared_column(entries(first, make_result("ic", {0.0: [1.0]})), "corner")
    with pytest.raises(ResultError, match="is a status; expected a score"):
        shared_column(entries(first, first), "status")
    with pytest.raises(ResultError, match=r"sweep different levels: fog \[1/m\] in esm.result"):
        shared_column(entries(first, nested_result()), None)
    columns = [replace(c, unit="m") if c.name == "corners" else c for c in first.columns]
    with pytest.raises(ResultError, match="in different units: px in esm"):
        shared_column(entries(first, replace(first, columns=tuple(columns))), "corners")


def test_a_total_of_pixels_is_in_pixels() -> None:
    assert shared_column(entries(make_result("esm", {0.0: [1.0]})), None).label == "total [px]"


# ---------------------------------------------------------------------------- what follows


def test_a_clear_difference_is_found_and_the_winner_named() -> None:
    comparison = compared(
        noisy_result("esm", 1.0, n=10, salt=1), noisy_result("ic", 1.5, n=10, salt=2)
    )
    (versus,) = comparison.pairs
    assert {at.value.verdict for at in versus.levels} == {"first"}
    assert versus.sweep.value.verdict == "first"
    assert "esm is better than ic: 'total' of ic is 0.499 px above that of esm" in said(comparison)
    assert "esm is better at 3 levels (fog 0 m⁻¹ to fog 1 m⁻¹)." in said(comparison)


def test_where_more_is_better_the_winner_is_the_other() -> None:
    results = noisy_result("esm", 1.0, n=10, salt=1), noisy_result("ic", 1.5, n=10, salt=2)
    (versus,) = compared(*results, higher_is_better=True).pairs
    assert versus.sweep.value.verdict == "second"
    (other,) = compared(*results).pairs
    assert versus.levels[0].value.superiority == 1 - (other.levels[0].value.superiority or 0.0)


def test_pairs_show_what_their_shared_noise_would_hide() -> None:
    a, b = noisy_result("esm", 1.0, n=12, salt=1), noisy_result("ic", 1.25, n=12, salt=2)
    (versus,) = compared(a, b).pairs
    at = versus.levels[0]
    unpaired = stats.ttest_ind(a.numbers("total")[0::3], b.numbers("total")[0::3])
    assert unpaired.pvalue > 0.2
    assert at.value.verdict == "first"


def test_the_other_way_round_everything_is_mirrored() -> None:
    a, b = noisy_result("esm", 1.0, n=7, salt=1), noisy_result("ic", 1.1, n=7, salt=2)
    (there,), (back,) = compared(a, b).pairs, compared(b, a).pairs
    one, other = there.sweep.value, back.sweep.value
    assert one.p == other.p
    assert one.difference.low == pytest.approx(-(other.difference.high or 0.0), rel=1e-9)
    assert one.hedges_g == pytest.approx(-(other.hedges_g or 0.0))
    assert one.repeats_needed == other.repeats_needed


def test_levels_are_no_repeats() -> None:
    levels = tuple(np.linspace(0.0, 1.0, 20).tolist())
    comparison = compared(
        noisy_result("esm", 1.0, n=4, salt=1, levels=levels),
        noisy_result("ic", 1.5, n=4, salt=2, levels=levels),
    )
    overall = comparison.pairs[0].sweep
    assert overall.value.difference.n == 4
    assert overall.value.p == 2 / 2**4
    assert overall.value.verdict == "too few"
    assert "Too few repeats to test (4 of 6 needed)" in said(comparison)
    assert "With 4 repeats p cannot fall below 0.125: at least 6 are needed" in said(comparison)
    assert "20 levels have too few repeats to test (4 of 10 needed)" in said(comparison)


def test_six_seeds_and_three_results_are_too_few_to_test_and_not_no_difference() -> None:
    # 48.8 px against 4.2 px in every seed, and 3 * 2/2^6 = 0.094 is the smallest p there is
    near = noisy_result("esm", 4.2, n=6, salt=1), noisy_result("ecc", 4.3, n=6, salt=2)
    comparison = compared(*near, noisy_result("frozen", 48.8, n=6, salt=3))
    assert {versus.sweep.value.verdict for versus in comparison.pairs} == {"too few"}
    text = said(comparison)
    assert "Too few repeats to test (6 of 7 needed): 'total' of frozen is 44.6 px above" in text
    assert "p cannot fall below 0.0312, 0.0938 after Holm: at least 7 are needed" in text
    assert "No difference is shown" not in text
    assert "too few repeats to test (6 of 7 needed)" in Page(render(comparison, ())).text
    assert "9 levels" not in text
    assert "3 levels have too few repeats to test (6 of 9 needed)" in text


def test_with_the_repeats_that_are_called_needed_the_clearest_difference_is_shown() -> None:
    for n_results in (2, 3, 5):
        means = [10.0**i for i in range(n_results)]
        for n in range(2, 11):
            results = [noisy_result(f"a{i}", m, n=n, salt=i) for i, m in enumerate(means)]
            comparison = compared(*results)
            found = {versus.sweep.value.verdict for versus in comparison.pairs}
            at = {a.value.verdict for versus in comparison.pairs for a in versus.levels}
            enough = n >= comparison.min_sweep_repeats, n >= comparison.min_level_repeats
            assert (found == {"first"}, at == {"first"}) == enough
            assert (found == {"too few"}, at == {"too few"}) == tuple(not e for e in enough)


def test_few_pairs_that_a_step_of_holm_can_reach_are_tested() -> None:
    # 7 pairs pass the first step, 2 * 2/2^7 = 0.031; then 6 pass the second, 2/2^6 = 0.031
    values = {0.0: [1.0 + 0.1 * i for i in range(7)], 1.0: [1.0] * 6 + [None]}
    other = {0.0: [9.0 - 0.1 * i for i in range(7)], 1.0: [3.0 + 0.1 * i for i in range(7)]}
    clear, few = compared(make_result("a", values), make_result("b", other)).pairs[0].levels
    assert (clear.value.difference.n, few.value.difference.n) == (7, 6)
    assert (clear.value.p_holm, few.value.p_holm) == (2 / 2**6, 2 / 2**6)
    assert (clear.value.verdict, few.value.verdict) == ("first", "first")


def test_a_narrow_interval_is_printed_with_the_digits_that_show_it() -> None:
    assert distinct_texts(44.58, 44.62) == ("44.58", "44.62")
    assert distinct_texts(0.2, 0.4) == ("0.2", "0.4")
    assert distinct_texts(44.6, 44.6) == ("44.6", "44.6")


# ---------------------------------------------------------------------------- who beats whom


def test_the_matrix_says_who_beats_whom_and_the_best_stands_first() -> None:
    comparison = compared(
        noisy_result("bad", 3.0, n=10, salt=1),
        noisy_result("good", 1.0, n=10, salt=2),
        noisy_result("twin", 1.0, n=10, salt=3),
    )
    found = matrix(comparison)
    assert found.columns == ("good", "twin", "bad")
    standings = [[cell.verdict for cell in row.cells] for row in found.rows]
    assert standings == [
        ["itself", "not shown", "better"], ["not shown", "itself", "better"],
        ["worse", "worse", "itself"],
    ]  # fmt: skip
    assert found.rows[0].cells[2].text == "better -2"
    higher = matrix(
        compared(
            noisy_result("a", 1.0, n=8, salt=1),
            noisy_result("b", 3.0, n=8, salt=2),
            higher_is_better=True,
        )
    )
    assert higher.columns == ("b", "a")


def test_the_matrix_against_a_baseline_has_one_column() -> None:
    found = entries(*(noisy_result(name, i + 1.0, n=8, salt=i) for i, name in enumerate("abc")))
    comparison = compare(found, shared_column(found, None), baseline=found[1])
    against = matrix(comparison)
    assert against.columns == ("b",)
    assert [(row.name, row.cells[0].verdict) for row in against.rows] == [
        ("b", "itself"), ("a", "better"), ("c", "worse"),
    ]  # fmt: skip


def test_the_matrix_says_how_many_rows_ended_ok(three: Comparison) -> None:
    assert {row.name: row.ok for row in matrix(three).rows} == {
        "esm": "100 %", "ic": "100 %", "orb": "79.2 %",
    }  # fmt: skip


def test_the_matrix_stands_before_the_tables_and_on_a_narrow_terminal_in_symbols(
    three: Comparison,
) -> None:
    wide, narrow = shown(three, 120), shown(three, 30)
    assert wide[0].startswith("Each result against each: total [px] over the whole sweep, lower is")
    assert re.split(r"  +", wide[2]) == ["esm", "100 %", "not shown -0.0329", "better -0.566"]
    cells = [line.split() for line in narrow]
    assert ["1", "esm", "100", "%", "?", "+"] in cells
    assert ["3", "orb", "79.2", "%", "-", "-"] in cells
    assert "+ the row is better; - the column is better; ? no difference is shown." in " ".join(
        narrow
    )


def test_a_printed_comparison_has_a_line_for_each_pair_with_its_numbers(three: Comparison) -> None:
    lines = str(three).splitlines()
    for line, pair in zip(lines, three.pairs, strict=True):
        value = pair.sweep.value
        numbers = (value.difference.mean, value.difference.low, value.difference.high)
        assert f"{pair.second.name} minus {pair.first.name}: " in line
        assert [float(text) for text in re.findall(r"-?\d+\.\d+", line)[:3]] == pytest.approx(
            numbers, rel=5e-3
        )
        winner = {"first": pair.first.name, "second": pair.second.name}.get(value.verdict)
        assert line.endswith(f": {winner} is better" if winner else f": {value.verdict}")
    assert any(line.endswith("is better") for line in lines)
    assert any(line.endswith("not shown") for line in lines)
    assert len(repr(three)) < 100


def test_one_repeat_shows_nothing_and_says_so() -> None:
    comparison = compared(
        make_result("esm", {0.0: [1.0], 0.5: [2.0], 1.0: [3.0]}),
        make_result("ic", {0.0: [1.5], 0.5: [2.5], 1.0: [2.75]}),
    )
    (versus,) = comparison.pairs
    assert {at.value.verdict for at in versus.levels} == {"one repeat"}
    assert versus.sweep.value.p is None
    assert "One repeat (seed 0) allows no inference about other seeds." in said(comparison)
    assert "It is below at 1 of these levels and above at 2." in said(comparison)
    assert "--repeat 6 or more for the sweep as a whole, 7 or more for single levels" in said(
        comparison
    )


def test_equal_results_are_equal_and_not_merely_not_different() -> None:
    comparison = compared(
        make_result("a", {0.0: [1.0, 2.0, 3.0]}), make_result("b", {0.0: [1.0, 2.0, 3.0]})
    )
    assert comparison.pairs[0].sweep.value.verdict == "equal"
    assert "Both are equal in every one of 3 repeats" in said(comparison)


def test_the_sweep_is_over_the_levels_where_every_repeat_has_a_value_from_both() -> None:
    first = make_result("esm", {0.0: [1.0, 1.0], 0.5: [2.0, 2.0], 1.0: [9.0, None]})
    second = make_result("ic", {0.0: [2.0, 3.0], 0.5: [2.0, 3.0], 1.0: [1.0, 1.0]})
    comparison = compared(first, second)
    overall = comparison.pairs[0].sweep
    assert overall.levels == ((0.0,), (0.5,))
    assert overall.value.difference == mean_interval([0.5, 1.5])
    assert "over the 2 of 3 levels at which every repeat of both has a value" in said(comparison)
    assert "the measure describes the remaining runs only" in said(comparison)


def test_a_sweep_in_which_nobody_survives_is_not_compared_but_success_is() -> None:
    first = make_result("esm", {0.0: [1.0, None], 0.5: [None, 2.0]})
    comparison = compared(first, make_result("ic", {0.0: [1.0, 1.0], 0.5: [1.0, 1.0]}))
    overall = comparison.pairs[0].sweep
    assert overall.value.verdict == "no pair"
    assert overall.success is not None
    assert (overall.success.first.mean, overall.success.second.mean) == (0.5, 1.0)
    assert "The sweep as a whole is not compared" in said(comparison)


def test_success_at_a_level_is_mcnemars_test() -> None:
    first = make_result("esm", {0.0: [1.0] * 9, 1.0: [1.0] * 8 + [None]})
    second = make_result("ic", {0.0: [1.0] * 9, 1.0: [None] * 8 + [1.0]})
    comparison = compared(first, second)
    easy, hard = comparison.pairs[0].levels
    assert easy.success is not None
    assert hard.success is not None
    assert (hard.success.first_only, hard.success.second_only) == (8, 1)
    assert hard.success.p == pytest.approx(stats.binomtest(1, 9).pvalue)
    assert (easy.success.p, easy.success.p_holm) == (1.0, None)
    assert hard.success.p_holm == hard.success.p  # the easy level could not have differed
    assert "McNemar's test shows a difference at 1 level (fog 1 m⁻¹)." in said(comparison)


def test_holm_counts_the_levels_of_all_pairs_of_results() -> None:
    comparison = compared(*(noisy_result(name, 1.0, n=8, salt=i) for i, name in enumerate("abc")))
    assert comparison.n_tests == 9
    at = [at.value for versus in comparison.pairs for at in versus.levels]
    ps = sorted(d.p for d in at if d.p is not None)
    assert min(d.p_holm for d in at if d.p_holm is not None) == min(1.0, 9 * ps[0])
    sweeps = [versus.sweep.value for versus in comparison.pairs]
    assert min(d.p_holm or 1 for d in sweeps) == min(1.0, 3 * min(d.p or 1 for d in sweeps))


def test_levels_with_too_few_pairs_for_any_test_do_not_count() -> None:
    few: list[float | None] = [1.0] * 3 + [None] * 5
    first = make_result("a", {0.0: [1.0 + 0.01 * i for i in range(8)], 1.0: few})
    second = make_result("b", {0.0: [2.0 - 0.02 * i for i in range(8)], 1.0: few})
    comparison = compared(first, second)
    assert comparison.n_tests == 1
    shown, hidden = comparison.pairs[0].levels
    assert shown.value.p_holm == shown.value.p
    assert hidden.value.p_holm is None


def test_algorithms_that_do_not_differ_are_seldom_called_different() -> None:
    found = 0
    for trial in range(100):
        a, b = (
            noisy_result("a", 1.0, n=9, salt=2 * trial + 1000),
            noisy_result("b", 1.0, n=9, salt=2 * trial + 1),
        )
        (versus,) = compared(a, b).pairs
        found += any(at.value.verdict in ("first", "second") for at in versus.levels)
    assert found <= 10  # 5 expected; more than 10 once in 90 times


def test_repeats_are_planned_for_the_strictest_step_of_holm() -> None:
    (versus,) = compared(
        noisy_result("a", 1.0, n=9, salt=1), noisy_result("b", 1.09, n=9, salt=2)
    ).pairs
    for at in versus.levels:
        assert at.value.hedges_g is not None
        assert at.value.repeats_needed == repeats_needed(at.value.hedges_g, alpha=0.05 / 3)


def test_against_a_baseline_only_that_is_compared_and_it_stands_first() -> None:
    found = entries(*(noisy_result(name, 1.0, n=3, salt=i) for i, name in enumerate("abc")))
    comparison = compare(found, shared_column(found, None), baseline=found[1])
    assert [(v.first.name, v.second.name) for v in comparison.pairs] == [("b", "a"), ("b", "c")]
    assert [entry.name for entry in comparison.entries] == ["b", "a", "c"]


def test_it_is_reported_whether_both_saw_the_same_images() -> None:
    a, b = visibility_result("a", seeds=(1, 2)), visibility_result("b", seeds=(1, 2))
    streams = (replace(b.image_streams[0], sha256="d5" * 32), b.image_streams[1])
    assert "the same images, byte for byte (2 streams)" in said(compared(a, b))
    assert "the same bytes in 1 of 2 image streams" in said(
        compared(a, replace(b, image_streams=streams))
    )


def test_streams_without_images_are_not_the_same_images() -> None:
    a, b = visibility_result("a", seeds=(1, 2)), visibility_result("b", seeds=(1, 2))
    empty = [replace(stream, frames=0, sha256="e3" * 32) for stream in a.image_streams]
    none = [replace(result, image_streams=tuple(empty)) for result in (a, b)]
    assert "images" not in said(compared(*none))
    one = [replace(r, image_streams=(empty[0], r.image_streams[1])) for r in (a, b)]
    assert "byte for byte (1 stream)" in said(compared(*one))
    assert "the same bytes in 0 of 2 image streams" in said(compared(a, none[1]))


def test_a_class_is_named_without_the_folders_of_its_file(tmp_path: Path) -> None:
    paths = []
    for name in ("/home/me/learning/policy.py:Policy", "/home/me/old/policy.py:Policy", "esm"):
        result = noisy_result(name, 1.0, n=3, salt=1)
        folder = tmp_path / f"{len(paths)}.result"
        folder.mkdir()
        paths.append(save(result, folder / "result.json"))
    names = [entry.name for entry in read_entries(paths)]
    assert names == ["policy.py:Policy (0.result)", "policy.py:Policy (1.result)", "esm"]


# ---------------------------------------------------------------------------- what is written


@pytest.fixture(scope="module")
def three() -> Comparison:
    lost = noisy_result("orb", 1.6, n=8, salt=3)
    rows = [
        (*row[:3], None, None, "lost", row[6]) if row[2] == 1.0 and row[0] in range(5) else row
        for row in lost.rows
    ]
    return compared(
        noisy_result("esm", 1.0, n=8, salt=1),
        noisy_result("ic", 1.05, n=8, salt=2),
        replace(lost, rows=tuple(rows)),
    )


def test_numbers_have_the_same_bytes_every_time_and_agree_with_each_other(
    three: Comparison,
) -> None:
    text, table = json_text(three), csv_text(three)
    again = compare(three.entries, three.column)
    assert (json_text(again), csv_text(again)) == (text, table)
    document = json.loads(text)
    assert document["format"] == "uwsim-comparison/1"
    assert [pair["second"] for pair in document["pairs"]] == ["ic", "orb", "orb"]
    lines = list(csv.DictReader(io.StringIO(table)))
    assert len(lines) == 3 * (3 + 1)
    for line in lines:
        (pair,) = [
            pair
            for pair in document["pairs"]
            if (pair["first"], pair["second"]) == (line["first"], line["second"])
        ]
        (found,) = (
            [pair["sweep"]]
            if line["scope"] == "sweep"
            else [at for at in pair["levels"] if at["level"] == [float(line["fog [1/m]"])]]
        )
        for name in ("difference", "difference_low", "p_sign_flip", "hedges_g"):
            assert line[name] == ("" if found[name] is None else repr(found[name]))
        assert line["verdict"] == found["verdict"]
    entry = document["results"][2]["levels"][2]
    assert (entry["n_missing"], entry["n_ok"], entry["seeds"]) == (5, 3, list(range(8)))


@pytest.fixture(scope="module")
def written(three: Comparison, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_comparison(three, tmp_path_factory.mktemp("three")).parent


class Page(HTMLParser):
    """Tags and text of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


def test_the_page_holds_everything_loads_nothing_and_runs_nothing(written: Path) -> None:
    page = Page((written / "comparison.html").read_text())
    sources = [v for _, attrs in page.tags for k, v in attrs.items() if k in ("src", "href")]
    assert len(sources) == 3
    assert all(str(source).startswith("data:image/png") for source in sources)
    assert not {"script", "iframe", "link", "object"} & {tag for tag, _ in page.tags}
    for text in ("esm, ic, orb compared on visibility", "esm better", "Not shown is not equal"):
        assert text in page.text
    assert sorted(path.name for path in written.rglob("*") if path.is_file()) == [
        "comparison.csv", "comparison.html", "comparison.json", "curves.pdf", "curves.png",
        "differences.pdf", "differences.png", "success.pdf", "success.png",
    ]  # fmt: skip


@pytest.mark.slow
def test_plots_have_the_same_bytes_every_time(
    three: Comparison, written: Path, tmp_path: Path
) -> None:
    write_comparison(three, tmp_path)
    for path in written.rglob("*.*"):
        assert path.read_bytes() == (tmp_path / path.relative_to(written)).read_bytes()


def test_names_from_results_are_text(tmp_path: Path) -> None:
    comparison = compared(
        noisy_result(EVIL, 1.0, n=2, salt=1), noisy_result("$\\evil/$", 1.2, n=2, salt=2)
    )
    page = Page(write_comparison(comparison, tmp_path).read_text())
    assert "script" not in [tag for tag, _ in page.tags]
    assert EVIL in page.text


def test_experiments_that_differ_are_warned_of_on_the_page() -> None:
    found = entries(noisy_result("a", 1.0, n=2, salt=1), noisy_result("b", 1.0, n=2, salt=2))
    comparison = compare(
        found, shared_column(found, None), experiment_differences=("mode: x in a, y in b",)
    )
    text = Page(render(comparison, ())).text
    assert "These results are not of one experiment." in text
    assert "mode: x in a, y in b" in text


@pytest.mark.parametrize("width", [60, 80, 200])
def test_on_the_terminal_no_line_is_cut(three: Comparison, width: int) -> None:
    console = Console(width=width, file=io.StringIO())
    for part in renderables(three, width=width):
        console.print(part)
    assert isinstance(console.file, io.StringIO)
    text = console.file.getvalue()
    assert "…" not in text
    assert max(map(len, text.splitlines())) <= width
    assert "total [px]: ic minus esm; lower is better" in text
    assert " 8 : 3 of 8 " in text or width < 100


def shown(comparison: Comparison, width: int) -> list[str]:
    """The lines that are printed."""
    console = Console(width=width, file=io.StringIO())
    for part in renderables(comparison, width=width):
        console.print(part)
    assert isinstance(console.file, io.StringIO)
    return [line.rstrip() for line in console.file.getvalue().splitlines()]


def table_of(comparison: Comparison) -> list[list[str]]:
    """The cells of the first table of a pair of results, as they are printed."""
    printed = shown(comparison, 300)
    start = next(i for i, line in enumerate(printed) if line.startswith("total [px]: ")) + 1
    return [re.split(r"  +", line.strip()) for line in printed[start : start + 4]]


@pytest.mark.parametrize(
    "name", ["fog [1/m]", "n", "difference", "g", "A", "p", "ok", "verdict", "needs"]
)
def test_an_algorithm_named_like_a_heading_takes_no_columns_place(name: str) -> None:
    values = {"first": 1.0, "second": 1.5}
    neutral = [noisy_result(who, mean, n=7, salt=i) for i, (who, mean) in enumerate(values.items())]
    expected = [
        [cell.replace("first", name) for cell in row] for row in table_of(compared(*neutral))
    ]
    renamed = noisy_result(name, 1.0, n=7, salt=0), neutral[1]
    assert table_of(compared(*renamed)) == expected
    assert len({len(row) for row in expected}) == 1
    swapped = table_of(compared(neutral[1], renamed[0]))
    assert swapped[0][2:4] == ["second", name]
    assert [row[2:4] for row in swapped[1:]] == [row[3:1:-1] for row in expected[1:]]


def test_a_level_named_like_a_number_of_the_comparison_does_not_replace_it_in_the_csv() -> None:
    results = []
    for result in (noisy_result("a", 1.0, n=3, salt=1), noisy_result("b", 1.1, n=3, salt=2)):
        columns = [
            replace(c, name="n", unit=None) if c.kind == "level" else c for c in result.columns
        ]
        results.append(replace(result, columns=tuple(columns)))
    line = next(csv.DictReader(io.StringIO(csv_text(compared(*results)))))
    assert (line["n (level)"], line["n"]) == ("0.0", "3")


@pytest.mark.parametrize(
    "make",
    [
        visibility_result,
        *(
            pytest.param(make, marks=pytest.mark.slow)
            for make in (lost_result, one_level_result, nested_result, frozen_result)
        ),
    ],
)
def test_any_results_can_be_compared(make: Callable[[], Result], tmp_path: Path) -> None:
    first = make()
    second = replace(first, run=replace(first.run, algorithm="other"))
    page = write_comparison(compared(first, second), tmp_path)
    assert "compared on" in page.read_text()


def test_differences_stand_on_a_zero_line_and_the_winning_side_is_named(three: Comparison) -> None:
    figure = differences_plot(three)
    assert len(figure.axes) == 3
    words = [text.get_text() for text in figure.axes[0].texts]
    assert words == ["↑ esm better", "↓ ic better", "ic − esm"]
    assert figure.axes[0].lines[0].get_ydata()[0] == 0.0
    assert curves_plot(three).axes[0].get_ylabel() == "total [px]"
    assert (
        success_plot(
            compared(noisy_result("a", 1.0, n=2, salt=1), noisy_result("b", 1.0, n=2, salt=2))
        )
        is None
    )


SWEEPS = [
    ({0.0: 1.0, 0.5: 2.0, 1.0: 3.0}, {0.5: 5.0, 1.0: 6.0, 2.0: 7.0}),
    ({0.0: 1.0, 0.5: 2.0}, {0.5: 5.0, 1.0: 6.0}),
]


def sweep(algorithm: str, means: dict[float, float]) -> Result:
    return make_result(algorithm, {fog: [mean, mean + 0.25, None] for fog, mean in means.items()})


@pytest.mark.parametrize("is_reversed", [False, True])
def test_curves_show_the_levels_that_both_have(is_reversed: bool) -> None:
    results = [sweep(name, means) for name, means in zip("ab", SWEEPS[0], strict=True)]
    axes = curves_plot(compared(*(results[::-1] if is_reversed else results))).axes[0]
    drawn_xs = {x for line in axes.lines for x in np.asarray(line.get_xdata(), float) if x >= 0.01}
    assert {0.5, 1.0} <= drawn_xs
    assert not {0.0, 2.0} & {*drawn_xs}
    low, high = axes.get_xlim()
    assert 0.0 < low < 0.5
    assert 1.0 < high < 2.0


@pytest.mark.parametrize("is_reversed", [False, True])
def test_one_common_level_is_drawn_with_its_values(is_reversed: bool) -> None:
    results = [sweep(name, means) for name, means in zip("ab", SWEEPS[1], strict=True)]
    comparison = compared(*(results[::-1] if is_reversed else results))
    axes = curves_plot(comparison).axes[0]
    names = [text.get_text() for text in axes.get_yticklabels()]
    dots = [line.get_xdata()[0] for line in axes.lines if len(line.get_xdata()) == 1]
    assert dict(zip(names, dots, strict=True)) == {"a": 2.125, "b": 5.125}
    figure = success_plot(comparison)
    assert figure is not None
    assert [text.get_text() for text in figure.axes[0].get_yticklabels()] == names
    assert "1 level, 3 repeats" in render(comparison, ())


def test_of_three_results_those_levels_are_drawn_that_two_have() -> None:
    three = [sweep(name, means) for name, means in zip("ab", SWEEPS[0], strict=True)]
    three.append(sweep("c", {0.0: 1.0, 0.5: 2.0, 4.0: 1.0}))
    low, high = curves_plot(compared(*three)).axes[0].get_xlim()
    assert low < 0.0
    assert 1.0 < high < 2.0


def test_bars_with_long_names_have_room_for_all_texts() -> None:
    names = [f"a_folder_of_a_policy_{i}.py:PolicyWithAVeryLongName{i}" for i in range(4)]
    results = [sweep(name, {0.5: 1.0 + i}) for i, name in enumerate(names)]
    comparison = compared(*results)
    for figure in (curves_plot(comparison), differences_plot(comparison)):
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        axes = figure.axes[0]
        for text in (axes.xaxis.label, *axes.get_yticklabels()):
            box = text.get_window_extent(canvas.get_renderer())
            assert 0.0 <= box.x0 < box.x1 <= figure.bbox.x1
        assert axes.bbox.width > 0.25 * figure.bbox.width


def test_bars_without_any_value_say_so() -> None:
    nothing = Interval(n=0, mean=None, std=None, low=None, high=None)
    some = Interval(n=2, mean=1.0, std=0.1, low=0.5, high=1.5)
    for bars, is_empty in (([nothing, nothing], True), ([nothing, some], False)):
        figure = bars_plot([("a", each, False) for each in bars], "total [px]", has_zero_line=True)
        texts = [text.get_text() for text in figure.axes[0].texts]
        assert any("no data: no repeat has a value in both results" in t for t in texts) == is_empty
