"""``uwsim envelope``: the level at which a benchmark breaks, with its bound."""

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
from .options.help_texts import INPUT, OUTPUT, RUN, SEARCH, in_group
from .options.levels import read_levels
from .options.options import CodeOptions, SettingOptions, TaskOptions, WorkerOptions, request_of
from .output.progress import progress

if TYPE_CHECKING:
    from ..envelope import Envelope
    from ..runs.execute import Execution

MAX_REPEATS = 1000


@dataclass(frozen=True, kw_only=True)
class SearchOptions:
    """What is searched for."""

    over: Annotated[
        str,
        in_group(
            SEARCH,
            "--over",
            metavar="PARAMETER",
            help="The swept parameter of the benchmark that is searched, as fog.",
        ),
    ]
    until: Annotated[
        str,
        in_group(
            SEARCH,
            "--until",
            metavar="CRITERION",
            help="When a run counts as broken, in the language of scores: corners > 5 "
            "[status != ok].",
        ),
    ] = "status != ok"
    start: Annotated[
        float | None,
        in_group(
            SEARCH, "--from", metavar="A", help="Near end, where it passes [first of the sweep]."
        ),
    ] = None
    stop: Annotated[
        float | None,
        in_group(SEARCH, "--to", metavar="B", help="Far end, where it fails [last of the sweep]."),
    ] = None
    tolerance: Annotated[
        float | None,
        in_group(
            SEARCH,
            "--tolerance",
            metavar="T",
            help="Resolution of the search of each seed [1 % of the range].",
        ),
    ] = None
    confidence: Annotated[
        float,
        in_group(
            SEARCH,
            "--confidence",
            metavar="C",
            help="Confidence level of the bound of the breaking point.",
        ),
    ] = 0.95
    level: Annotated[
        list[str] | None,
        in_group(
            SEARCH,
            "--level",
            metavar="NAME=VALUE",
            help="Fixed value of another swept parameter, as current=0.1.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class EnvelopeOptions:
    """What ``uwsim envelope`` takes."""

    task: TaskOptions
    search: SearchOptions
    algorithm: Annotated[
        str | None,
        in_group(
            INPUT,
            "--algorithm",
            metavar="NAME|module:Class",
            help="What is tested; without it the one that the benchmark names.",
            autocompletion=algorithm_names,
        ),
    ] = None
    changes: SettingOptions
    seed: Annotated[
        int, in_group(RUN, "--seed", metavar="N", min=0, help="Seed of the first search.")
    ] = 0
    repeat: Annotated[
        int,
        in_group(
            RUN,
            "--repeat",
            metavar="K",
            min=1,
            help="Search with K seeds, SEED ... SEED+K-1; 95 % needs six.",
        ),
    ] = 10
    by: WorkerOptions
    out: Annotated[
        Path | None,
        in_group(OUTPUT, "--out", metavar="DIR", help="Output directory [./NAME.envelope]."),
    ] = None
    resume: Annotated[
        bool, in_group(OUTPUT, "--resume", help="Use the runs that are in --out already.")
    ] = False
    overwrite: Annotated[
        bool, in_group(OUTPUT, "--overwrite", help="Replace an earlier envelope in --out.")
    ] = False
    files: CodeOptions

    @property
    def directory(self) -> Path:
        """Where the envelope goes."""
        return self.out or Path(f"{Path(self.task.benchmark).stem}.envelope")

    @property
    def seeds(self) -> tuple[int, ...]:
        """One a search."""
        return tuple(range(self.seed, self.seed + self.repeat))

    def plan_requests(self, wrong: ErrorCollector) -> list[PlanRequest]:
        """Return what is asked for of each run, none with an error; collects errors."""
        with wrong.collect():
            request = replace(
                request_of(self.task, self.changes, self.files),
                algorithm=self.algorithm,
                seed=self.seed,
                mode="independent",
            )
            return [request]
        return []


def envelope(context: typer.Context, options: EnvelopeOptions) -> None:
    """Find the level at which a benchmark fails: a number, its unit and its confidence bound.

    Each seed is searched by bisection, every level run alone (mode independent). A run counts as
    broken where the criterion is not 0 or its status is not ok. A criterion that uses the status
    decides alone: 'status == lost', with the names ok, lost, timeout, collision and error. The
    result is the median of the seeds' breaking points, with its exact confidence limits; 95 % needs
    at least six seeds. A benchmark that does not break up to B, and a criterion that is not
    monotonic, are reported.

    Writes envelope.json (reproducible byte for byte, with every run) and envelope.png. With
    --resume the runs in --out are reused, also for another criterion, range, tolerance or number of
    seeds.
    """
    from ..envelope import plan_for
    from ..runs.execute import plan_all, prepare_execution

    wrong, request, search = ErrorCollector(), None, options.search
    workers = options.by.workers
    requests = options.plan_requests(wrong)
    executor, plans = plan_all(requests, workers, options.by.callback_limit, wrong)
    with wrong.collect():
        check_numbers(search.confidence, options.repeat)
    chosen = read_levels(search.level, wrong)
    with wrong.collect():
        check_directory(options.directory, resume=options.resume, overwrite=options.overwrite)
    for plan in plans:
        ends = (search.start, search.stop, search.tolerance)
        request = search_request(plan, search.over, search.until, ends, chosen, wrong)
    wrong.raise_errors()
    assert request is not None
    execution = prepare_execution(
        [plan_for(plan) for plan in plans],
        executor,
        options.directory,
        workers=workers,
        command=context.obj,
    )
    raise_on_interrupt()
    search_and_write(execution, request, options)


def check_numbers(confidence: float, repeat: int) -> None:
    """Refuse invalid numbers of a search; raises BadSetting."""
    if not 0.0 < confidence < 1.0:
        raise BadSetting(f"--confidence is {confidence:g}; expected more than 0 and less than 1.")
    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")


def search_and_write(
    execution: Execution, request: SearchRequest, options: EnvelopeOptions
) -> None:
    """Search, write and print the result."""
    from ..envelope.find import find, max_runs
    from ..envelope.plot import draw
    from ..runs.execute import begin_runs

    [run], directory = execution.runs, options.directory
    asked = request.settings(options.seeds, options.search.confidence)
    with begin_runs(
        execution, prepare_directory(directory, resume=options.resume, overwrite=options.overwrite)
    ):
        title, most = f"{execution.title}, at most", max_runs(asked)
        with progress(title, most, of="runs", at_once=options.by.at_once) as on_run:
            envelope = find(run, request, asked, execution.executor, on_run)
        envelope.save(directory)
        draw(envelope, directory)
        execution.save_provenance(run, {"wall_s": execution.stopwatch.elapsed_time()})
    tell(envelope, directory)


def tell(envelope: Envelope, directory: Path) -> None:
    """Print what was found."""
    from ..envelope.criterion import reasons

    lines = [envelope.sentence]
    by = reasons(e.judgement for e in envelope.evaluations)
    n_broken = sum(by.values())
    why = f": {', '.join(f'{name} {n}' for name, n in by.items())}" if by else ""
    n_seeds = len(envelope.settings.seeds)
    seeds = "1 seed" if n_seeds == 1 else f"{n_seeds} seeds"
    lines.append(f"{seeds}, {len(envelope.evaluations)} runs, {n_broken} broken{why}")
    lines += [f"warning: {warning}" for warning in envelope.warnings]
    lines.append(f"written: {directory}/envelope.json, envelope.png")
    typer.echo(clean_text("\n".join(lines)))
