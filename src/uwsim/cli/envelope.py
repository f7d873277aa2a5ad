"""``uwsim envelope``: the level at which a benchmark fails, with its confidence limits."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.interrupts import raise_on_interrupt
from ..base.terminal import clean_text
from ..envelope.directory import check_directory, prepare_directory
from ..envelope.search_request import SearchRequest, search_request
from ..errors import BadSetting, ErrorCollector
from ..runs.planning.plan_request import PlanRequest
from .options.completion import algorithm_names
from .options.help_texts import INPUT, OUTPUT, RUN, SEARCH, option
from .options.levels import read_levels
from .options.options import (
    CodeOptions,
    OverwriteOption,
    SettingOptions,
    TaskOptions,
    WorkerOptions,
    make_request,
)
from .output.progress import progress

if TYPE_CHECKING:
    from ..envelope import Envelope
    from ..runs.execute import Execution

MAX_REPEATS = 1000
"""The greatest number of seeds of a search."""


@dataclass(frozen=True, kw_only=True)
class SearchOptions:
    """The options of the search and its criterion."""

    parameter: Annotated[
        str,
        option(
            SEARCH,
            "--over",
            metavar="PARAMETER",
            help="The swept parameter of the benchmark to search, as fog.",
        ),
    ]
    criterion: Annotated[
        str,
        option(
            SEARCH,
            "--until",
            metavar="CRITERION",
            help="The criterion of a failed run, in the language of scores: corners > 5 "
            "[status != ok].",
        ),
    ] = "status != ok"
    range_start: Annotated[
        float | None,
        option(
            SEARCH,
            "--from",
            metavar="A",
            help="Near end of the range, where it passes [first of the sweep].",
        ),
    ] = None
    range_end: Annotated[
        float | None,
        option(
            SEARCH,
            "--to",
            metavar="B",
            help="Far end of the range, where it fails [last of the sweep].",
        ),
    ] = None
    tolerance: Annotated[
        float | None,
        option(
            SEARCH,
            "--tolerance",
            metavar="T",
            help="Resolution of the search of each seed [1 % of the range].",
        ),
    ] = None
    confidence: Annotated[
        float,
        option(
            SEARCH,
            "--confidence",
            metavar="C",
            help="Confidence level of the limits of the breaking point.",
        ),
    ] = 0.95
    level: Annotated[
        list[str] | None,
        option(
            SEARCH,
            "--level",
            metavar="NAME=VALUE",
            help="Fixed value of another swept parameter, as current=0.1.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class EnvelopeOptions:
    """The options of ``uwsim envelope``."""

    task: TaskOptions
    search: SearchOptions
    algorithm: Annotated[
        str | None,
        option(
            INPUT,
            "--algorithm",
            metavar="NAME|module:Class",
            help="Algorithm under test. The default is the benchmark's (u:algorithm).",
            autocompletion=algorithm_names,
        ),
    ] = None
    changes: SettingOptions
    seed: Annotated[int, option(RUN, "--seed", metavar="N", min=0, help="First seed.")] = 0
    repeat: Annotated[
        int,
        option(
            RUN,
            "--repeat",
            metavar="K",
            min=1,
            help="Search with K seeds, SEED ... SEED+K-1; 95 % needs six.",
        ),
    ] = 10
    processes: WorkerOptions
    out: Annotated[
        Path | None,
        option(OUTPUT, "--out", metavar="DIR", help="Output directory [./NAME.envelope]."),
    ] = None
    resume: Annotated[bool, option(OUTPUT, "--resume", help="Reuse the runs in --out.")] = False
    overwrite: OverwriteOption = False
    code: CodeOptions

    @property
    def directory(self) -> Path:
        """The directory of the envelope."""
        return self.out or Path(f"{Path(self.task.benchmark).stem}.envelope")

    @property
    def seeds(self) -> tuple[int, ...]:
        """The seed of each search."""
        return tuple(range(self.seed, self.seed + self.repeat))

    def plan_requests(self, errors: ErrorCollector) -> list[PlanRequest]:
        """Return the request of the runs; after an error, collect it and return none."""
        with errors.collect():
            request = replace(
                make_request(self.task, self.changes, self.code),
                algorithm=self.algorithm,
                seed=self.seed,
                mode="independent",
            )
            return [request]
        return []


def envelope(context: typer.Context, options: EnvelopeOptions) -> None:
    """Find the level at which a benchmark fails: a number, its unit and its confidence limits.

    Each seed is searched by bisection, with each level run alone (mode independent). A run is
    broken if the criterion is not 0 or its status is not ok. A criterion with the status replaces
    both: 'status == lost', with the names ok, lost, timeout, collision and error (algorithm error).
    The result is the median of the seeds' breaking points, with its exact confidence limits; 95 %
    needs at least six seeds. A benchmark that does not break up to B, and a criterion that is not
    monotonic, are reported.

    It writes envelope.json (reproducible byte for byte, with every run) and envelope.png. With
    --resume the runs in --out are reused, also for another criterion, range, tolerance or number of
    seeds.
    """
    from ..envelope import plan_for
    from ..runs.execute import plan_all, prepare_execution

    errors, request, search = ErrorCollector(), None, options.search
    workers = options.processes.workers
    requests = options.plan_requests(errors)
    executor, plans = plan_all(requests, workers, options.processes.callback_limit, errors)
    with errors.collect():
        check_numbers(search.confidence, options.repeat)
    levels = read_levels(search.level, errors)
    with errors.collect():
        check_directory(options.directory, resume=options.resume, overwrite=options.overwrite)
    for plan in plans:
        search_range = (search.range_start, search.range_end, search.tolerance)
        request = search_request(
            plan, search.parameter, search.criterion, search_range, levels, errors
        )
    errors.raise_errors()
    assert request is not None
    execution = prepare_execution(
        [plan_for(plan) for plan in plans],
        executor,
        options.directory,
        workers=workers,
        command=context.obj,
    )
    raise_on_interrupt()
    run_search(execution, request, options)


def check_numbers(confidence: float, repeat: int) -> None:
    """Raise BadSetting for invalid numbers of a search."""
    if not 0.0 < confidence < 1.0:
        raise BadSetting(f"--confidence is {confidence:g}; expected more than 0 and less than 1.")
    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: expected at most {MAX_REPEATS}.")


def run_search(execution: Execution, request: SearchRequest, options: EnvelopeOptions) -> None:
    """Search, write and print the result."""
    from ..envelope.find import find, max_runs
    from ..envelope.plot import draw
    from ..runs.execute import begin_runs

    [run], directory = execution.runs, options.directory
    settings = request.settings(options.seeds, options.search.confidence)
    with begin_runs(
        execution, prepare_directory(directory, resume=options.resume, overwrite=options.overwrite)
    ):
        title, n_max = f"{execution.title}, at most", max_runs(settings)
        with progress(title, n_max, unit="runs", n_parallel=options.processes.n_parallel) as on_run:
            envelope = find(run, request, settings, execution.executor, on_run)
        envelope.save(directory)
        draw(envelope, directory)
        execution.save_provenance(run, {"wall_s": execution.stopwatch.elapsed_time()})
    print_envelope(envelope, directory)


def print_envelope(envelope: Envelope, directory: Path) -> None:
    """Print the result."""
    from ..envelope.criterion import reasons

    lines = [envelope.sentence]
    counts = reasons(e.judgement for e in envelope.evaluations)
    n_broken = sum(counts.values())
    summary = f": {', '.join(f'{name} {n}' for name, n in counts.items())}" if counts else ""
    n_seeds = len(envelope.settings.seeds)
    seeds = "1 seed" if n_seeds == 1 else f"{n_seeds} seeds"
    lines.append(f"{seeds}, {len(envelope.evaluations)} runs, {n_broken} broken{summary}")
    lines += [f"warning: {warning}" for warning in envelope.warnings]
    lines.append(f"written: {directory}/envelope.json, envelope.png")
    typer.echo(clean_text("\n".join(lines)))
