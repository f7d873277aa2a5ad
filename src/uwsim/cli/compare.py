"""``uwsim compare``: compare results of one experiment."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ..base.terminal import clean_text
from .options.help_texts import COMPARED, OUTPUT, in_group
from .options.options import JsonOption
from .output.console import standard_output

Results = Annotated[
    list[Path],
    typer.Argument(
        metavar="RESULT",
        help="Result directories, or their result.json; or one with the results of several "
        "algorithms.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """What is compared, and how."""

    measure: Annotated[
        str | None,
        in_group(
            COMPARED,
            "--measure",
            metavar="NAME",
            help="What is compared: a column of the results, as corners or corners.max; without "
            "it the score.",
        ),
    ] = None
    baseline: Annotated[
        Path | None,
        in_group(
            COMPARED,
            "--baseline",
            metavar="RESULT",
            help="Compare every other result with this one; without it each with each.",
        ),
    ] = None
    higher_is_better: Annotated[
        bool,
        in_group(COMPARED, "--higher-is-better", help="Larger values are better."),
    ] = False
    force: Annotated[
        bool,
        in_group(
            COMPARED, "--force", help="Compare results of different experiments, with a warning."
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class PlaceOptions:
    """Where the comparison goes."""

    out: Annotated[Path, in_group(OUTPUT, "--out", metavar="DIR", help="Output directory.")] = Path(
        "comparison"
    )
    overwrite: Annotated[
        bool, in_group(OUTPUT, "--overwrite", help="Replace an earlier comparison in --out.")
    ] = False


def compare(
    results: Results,
    options: CompareOptions,
    place: PlaceOptions,
    as_json: JsonOption = False,
) -> None:
    """Report which of several results is better, by how much, and with what confidence.

    Rows are paired by seed and level: run every algorithm with the same --seed and --repeat, as
    `uwsim bench visibility --algorithm esm --repeat 12 --out esm.result`. For each level and for
    the whole sweep it reports the mean difference with its 95 % interval, effect sizes, paired
    tests corrected by Holm, success rates, and how many repeats would be needed where no difference
    is shown. Rows without a value are counted, not imputed. A difference cannot be significant with
    fewer than six repeats; more are needed where many levels are tested.

    Results whose benchmark, scene, models, mode, timestep, compatibility or settings of the scene
    differ are refused. Written: comparison.json, comparison.csv, comparison.html, plots as PNG and
    PDF. What the numbers mean: docs/statistics.md.
    """
    from ..analysis.comparison import compare_files, write_comparison
    from ..analysis.comparison.document import json_text
    from ..analysis.comparison.terminal import drawn
    from ..analysis.comparison.write import FOLDERS, OURS
    from ..results.directory import clear_directory

    paths, baseline = with_baseline(each_of(results), options.baseline)
    comparison = compare_files(
        paths,
        column=options.measure,
        baseline=baseline,
        higher_is_better=options.higher_is_better,
        force=options.force,
    )
    out = place.out
    clear_directory(out, overwrite=place.overwrite, pattern=OURS, folders=FOLDERS)
    if comparison.forced:
        warning = f"warning: not of one experiment: {'; '.join(comparison.forced)}"
        print(clean_text(warning), file=sys.stderr)
    for remark in comparison.remarks:
        print(clean_text(f"note: {remark}"), file=sys.stderr)
    page = write_comparison(comparison, out)
    if as_json:
        print(json_text(comparison), end="")
        return
    console = standard_output()
    for part in drawn(comparison, width=console.width):
        console.print(part)
    print(f"written: {out}/comparison.json, comparison.csv, plots; page: {page}")


def each_of(paths: Sequence[Path]) -> list[Path]:
    """Return the results that are meant: of a directory with several, as bench writes it, all."""
    found: list[Path] = []
    for path in paths:
        inside = sorted(file.parent for file in path.glob("*/result.json"))
        is_result = (path / "result.json").exists()
        found += inside if len(inside) > 1 and not is_result else [path]
    return found


def with_baseline(results: list[Path], baseline: Path | None) -> tuple[list[Path], int | None]:
    """Return the results with the baseline among them, and its place."""
    if baseline is None:
        return results, None
    from ..results.result_file import file_of

    files = [file_of(path).resolve() for path in results]
    if file_of(baseline).resolve() in files:
        return results, files.index(file_of(baseline).resolve())
    return [baseline, *results], 0
