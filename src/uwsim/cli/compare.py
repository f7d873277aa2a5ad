"""``uwsim compare``: compare results of one experiment."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ..base.terminal import clean_text
from ..errors import BadSetting
from .options.help_texts import COMPARISON, OUTPUT, option
from .options.options import JsonOption, OverwriteOption
from .output.console import standard_output

Results = Annotated[
    list[Path],
    typer.Argument(
        metavar="RESULT",
        help="Result directories, or their result.json; or one directory with the results of "
        "several algorithms.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """The results to compare, and the method."""

    measure: Annotated[
        str | None,
        option(
            COMPARISON,
            "--measure",
            metavar="NAME",
            help="The column of the results to compare, as corners or corners.max; without it the "
            "score.",
        ),
    ] = None
    baseline: Annotated[
        Path | None,
        option(
            COMPARISON,
            "--baseline",
            metavar="RESULT",
            help="Compare every other result with this one; without it all pairs.",
        ),
    ] = None
    higher_is_better: Annotated[
        bool, option(COMPARISON, "--higher-is-better", help="Larger values are better.")
    ] = False
    overview: Annotated[
        bool,
        option(
            COMPARISON,
            "--overview",
            help="Show the success of all algorithms in all benchmarks of the results: a heat map, "
            "and the ranks of the algorithms.",
        ),
    ] = False
    force: Annotated[
        bool,
        option(
            COMPARISON, "--force", help="Compare results of different experiments, with a warning."
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class ComparisonOutput:
    """The directory of the comparison."""

    out: Annotated[Path, option(OUTPUT, "--out", metavar="DIR", help="Output directory.")] = Path(
        "comparison"
    )
    overwrite: OverwriteOption = False


def compare(
    results: Results, options: CompareOptions, output: ComparisonOutput, as_json: JsonOption = False
) -> None:
    """Report which of several results is better, by how much, and with what confidence.

    Rows are paired by seed and level: run every algorithm with the same --seed and --repeat, as
    `uwsim bench visibility --algorithm esm --repeat 12 --out esm.result`. Each level and the whole
    sweep have the mean difference with its 95 % interval, effect sizes, paired tests corrected by
    Holm, and success rates. Where no difference is significant, it reports the number of repeats
    that would show one. Rows without a value are counted, not imputed. A significant difference
    needs at least six repeats, and more for many levels.

    Results of different benchmarks, scenes, models, modes, timesteps, compatibility or settings of
    the scene are an error. It writes comparison.json, comparison.csv, comparison.html, plots as PNG
    and PDF. docs/statistics.md explains the numbers.

    With --overview the results may be of several benchmarks. A folder with a result for each of
    several benchmarks is one entry, which has the name of the folder. It writes overview.png,
    overview.pdf, overview.csv and overview.json.
    """
    if options.overview:
        _write_overview(results, options, output, as_json=as_json)
        return
    from ..analysis.comparison import compare_files, write_comparison
    from ..analysis.comparison.document import json_text
    from ..analysis.comparison.terminal import renderables
    from ..analysis.comparison.write import WRITTEN_FILES, WRITTEN_FOLDERS
    from ..results.directory import clear_directory

    paths, baseline = add_baseline(expand_results(results), options.baseline)
    comparison = compare_files(
        paths,
        column=options.measure,
        baseline=baseline,
        higher_is_better=options.higher_is_better,
        force=options.force,
    )
    out = output.out
    clear_directory(out, overwrite=output.overwrite, pattern=WRITTEN_FILES, folders=WRITTEN_FOLDERS)
    if comparison.experiment_differences:
        warning = f"warning: not of one experiment: {'; '.join(comparison.experiment_differences)}"
        print(clean_text(warning), file=sys.stderr)
    for remark in comparison.remarks:
        print(clean_text(f"note: {remark}"), file=sys.stderr)
    page = write_comparison(comparison, out)
    if as_json:
        print(json_text(comparison), end="")
        return
    console = standard_output()
    for part in renderables(comparison, width=console.width):
        console.print(part)
    print(f"written: {out}/comparison.json, comparison.csv, plots; page: {page}")


def _write_overview(
    paths: Sequence[Path], options: CompareOptions, output: ComparisonOutput, *, as_json: bool
) -> None:
    """Write the overview of results of several benchmarks; print it, or the ranks."""
    from ..analysis.overview import overview_json, rank_algorithms, read_tasks, write_overview
    from ..analysis.overview.terminal import overview_parts
    from ..analysis.overview.write import OVERVIEW_FILES
    from ..results.directory import clear_directory

    if options.measure is not None or options.baseline is not None or options.higher_is_better:
        raise BadSetting(
            "--overview shows success rates: leave out --measure, --baseline, --higher-is-better."
        )
    result_paths = [(path, result) for path in paths for result in expand_results([path])]
    folders = ["" if result == path else path.resolve().name for path, result in result_paths]
    tasks = read_tasks([result for _, result in result_paths], folders=folders, force=options.force)
    clear_directory(output.out, overwrite=output.overwrite, pattern=OVERVIEW_FILES, folders=())
    for task in tasks:
        if task.experiment_differences:
            text = f"{task.name}: not of one experiment: {'; '.join(task.experiment_differences)}"
            print(clean_text(f"warning: {text}"), file=sys.stderr)
    image = write_overview(tasks, output.out)
    if as_json:
        print(overview_json(tasks, rank_algorithms(tasks)), end="")
        return
    console = standard_output()
    for part in overview_parts(tasks):
        console.print(part)
    print(f"written: {image}, overview.pdf, overview.csv, overview.json")


def expand_results(paths: Sequence[Path]) -> list[Path]:
    """Return the results; a directory with the results of several algorithms gives all of these."""
    results: list[Path] = []
    for path in paths:
        result_paths = sorted(file.parent for file in path.glob("*/result.json"))
        is_result = (path / "result.json").exists()
        results += result_paths if len(result_paths) > 1 and not is_result else [path]
    return results


def add_baseline(results: list[Path], baseline: Path | None) -> tuple[list[Path], int | None]:
    """Return the results with the baseline among them, and its index."""
    if baseline is None:
        return results, None
    from ..results.result_file import file_of

    files = [file_of(path).resolve() for path in results]
    if file_of(baseline).resolve() in files:
        return results, files.index(file_of(baseline).resolve())
    return [baseline, *results], 0
