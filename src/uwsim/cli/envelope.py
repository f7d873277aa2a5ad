"""``uwsim envelope``: up to where a benchmark holds, as one number with its bound."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..envelope.search_request import SearchRequest, search_request
from ..errors import AllErrors, BadSetting
from ..files.input_files import recorded
from ..interrupts import raise_from_now_on
from ..runs.foreign_code import announce_code
from ..runs.make_plan import chosen_level, make_plan, say_warnings
from ..runs.timing import Stopwatch
from ..terminal import printable, warn
from .bench import OTHER_CODE
from .completion import algorithm_names
from .executor import CALLBACK_LIMIT, CallbackLimitOption, WorkersOption, executor_of, n_at_once
from .faults import running
from .options import (
    BenchmarkArgument,
    CompatOption,
    DataPathOption,
    NoCodeOption,
    PluginOption,
    SceneOption,
    SetOption,
)
from .progress import progress
from .taught import INPUT, OUTPUT, RUN, SEARCH, in_group

if TYPE_CHECKING:
    from ..envelope import Envelope
    from ..runs.executors.executor import Executor
    from ..runs.plan import Plan
    from ..runs.run import Run

MAX_REPEATS = 1000


def envelope(
    context: typer.Context,
    benchmark: BenchmarkArgument,
    over: Annotated[
        str,
        in_group(
            SEARCH,
            "--over",
            metavar="PARAMETER",
            help="What grows: a swept parameter of the benchmark, as fog.",
        ),
    ],
    until: Annotated[
        str,
        in_group(
            SEARCH,
            "--until",
            metavar="CRITERION",
            help="When a run counts as broken, in the language of scores: corners > 5.",
        ),
    ],
    start: Annotated[
        float | None,
        in_group(
            SEARCH, "--from", metavar="A", help="Near end, where it holds [first of the sweep]."
        ),
    ] = None,
    stop: Annotated[
        float | None,
        in_group(SEARCH, "--to", metavar="B", help="Far end, where it breaks [last of the sweep]."),
    ] = None,
    tolerance: Annotated[
        float | None,
        in_group(
            SEARCH,
            "--tolerance",
            metavar="T",
            help="How finely each seed is searched [1 % of the range].",
        ),
    ] = None,
    confidence: Annotated[
        float,
        in_group(
            SEARCH,
            "--confidence",
            metavar="C",
            help="How surely the bound shall hold the breaking point.",
        ),
    ] = 0.95,
    level: Annotated[
        list[str] | None,
        in_group(
            SEARCH,
            "--level",
            metavar="NAME=VALUE",
            help="Where another swept parameter stays, as current=0.1.",
        ),
    ] = None,
    scene: SceneOption = None,
    algorithm: Annotated[
        str | None,
        in_group(
            INPUT,
            "--algorithm",
            metavar="NAME|module:Class",
            help="What is tested; without it the one that the benchmark names.",
            autocompletion=algorithm_names,
        ),
    ] = None,
    settings: SetOption = None,
    compat: CompatOption = None,
    seed: Annotated[
        int, in_group(RUN, "--seed", metavar="N", min=0, help="Seed of the first search.")
    ] = 0,
    repeat: Annotated[
        int,
        in_group(
            RUN,
            "--repeat",
            metavar="K",
            min=1,
            help="Search with K seeds, SEED ... SEED+K-1; 95 % needs six.",
        ),
    ] = 10,
    workers: WorkersOption = "1",
    callback_limit: CallbackLimitOption = CALLBACK_LIMIT,
    out: Annotated[
        Path | None,
        in_group(OUTPUT, "--out", metavar="DIR", help="Where it goes [./NAME.envelope]."),
    ] = None,
    resume: Annotated[
        bool, in_group(OUTPUT, "--resume", help="Use the runs that are in --out already.")
    ] = False,
    overwrite: Annotated[
        bool, in_group(OUTPUT, "--overwrite", help="Replace an earlier envelope in --out.")
    ] = False,
    plugin: PluginOption = None,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Find the level at which a benchmark breaks: one number, its unit, and its bound.

    Each seed is searched by bisection, every level played alone (mode independent). A run is broken
    where the criterion is not 0, and where its status is not ok: what is lost has no error. A
    criterion that asks for the status decides itself: 'status == lost', with the names ok, lost,
    timeout, collision and error. What is found is the median of the seeds' breaking points, with
    its exact limits; six seeds are the fewest for 95 %. 'Does not break up to B', and a criterion
    that goes back, are said.

    Written: envelope.json, the same bytes twice, with every run; envelope.png. With --resume the
    runs in --out are used again, whatever criterion, range, tolerance or number of seeds is asked
    for now.
    """
    from ..envelope import plan_for

    wrong, executor, plan = AllErrors(), None, None
    with wrong.kept():
        executor = executor_of(workers, callback_limit)
    with wrong.kept():
        check_numbers(confidence, repeat)
    with wrong.kept():
        plan = make_plan(
            benchmark,
            scene=scene,
            algorithm=algorithm,
            seed=seed,
            repeat=1,
            mode="independent",
            levels=[],
            settings=settings or [],
            compat=compat or [],
            data_path=tuple(data_path or ()),
            plugins=plugin or [],
            no_code=no_code,
        )
    chosen = []
    for text in level or []:
        with wrong.kept():
            chosen.append(chosen_level(text))
    directory = out or Path(f"{Path(benchmark).stem}.envelope")
    with wrong.kept():
        check_out(directory, resume=resume, overwrite=overwrite)
    request = None
    if plan is not None:
        request = search_request(plan, over, until, (start, stop, tolerance), chosen, wrong)
    wrong.check()
    assert executor is not None
    assert plan is not None
    assert request is not None
    seeds = tuple(range(seed, seed + repeat))
    play(
        plan_for(plan), directory, request, seeds, confidence=confidence, executor=executor,
        at_once=n_at_once(workers),
        resume=resume, overwrite=overwrite, command=context.obj,
    )  # fmt: skip


def check_numbers(confidence: float, repeat: int) -> None:
    """Refuse what no search can be asked for; raises BadSetting."""
    if not 0.0 < confidence < 1.0:
        raise BadSetting(f"--confidence is {confidence:g}; expected more than 0 and less than 1.")
    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")


def check_out(directory: Path, *, resume: bool, overwrite: bool) -> None:
    """Refuse a directory that may not be written into; raises BadSetting."""
    from ..results.directory import check_begun, check_room

    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    if resume:
        check_begun(directory, ours=OURS, folders=FOLDERS)
    else:
        hint = "Use --resume to use its runs, or --overwrite to start anew."
        check_room(directory, overwrite=overwrite, ours=OURS, folders=FOLDERS, hint=hint)


def play(
    plan: Plan,
    directory: Path,
    request: SearchRequest,
    seeds: tuple[int, ...],
    *,
    confidence: float,
    executor: Executor,
    at_once: int,
    resume: bool,
    overwrite: bool,
    command: Sequence[str],
) -> None:
    """Search, write and say what was found."""
    from ..envelope import Asked, Envelope, Evaluations, strategy
    from ..envelope.plot import draw
    from ..results.directory import alone_in, discard_drafts, empty
    from ..results.provenance import carried, machine, save_beginning, save_provenance
    from ..runs.input_watch import watchable
    from ..runs.run import Run, hash_inputs

    announce_code(plan.scene)
    with recorded() as files:
        inputs, renderer = hash_inputs(plan)
    say_warnings(plan)
    raise_from_now_on()
    over, where, at = request.over, request.where, request.at
    watch = Stopwatch()
    with running(), alone_in(directory):
        check_out(directory, resume=resume, overwrite=overwrite)
        if not resume:
            empty(directory)
        discard_drafts(directory, OURS, FOLDERS)
        if said := save_beginning(command, directory):
            warn(OTHER_CODE.format(said))
        run = Run(
            plan=plan,
            out=directory,
            inputs=inputs,
            renderer=renderer,
            files=watchable(files),
        )
        most = 9 + len(seeds) * (where.most_cuts() + 1)
        title = f"{Path(plan.benchmark.path).stem} ({plan.algorithm_name}), at most"
        with progress(title, most, of="runs", at_once=at_once) as on_run:
            runs = Evaluations(run, at=at, over=over, criterion=request.criterion)
            found = runs.run(strategy(seeds, where), executor, on_run)
        envelope = Envelope(
            asked=Asked(
                over=over,
                unit=request.spec.reference_unit,
                until=request.criterion.text,
                fixed={name: value for name, value in at.values if name != over},
                where=where,
                seeds=seeds,
                confidence=confidence,
            ),
            found=found,
            evaluations=tuple(runs.made[key] for key in sorted(runs.made, key=lambda k: k[::-1])),
            inputs=inputs,
            run=played(run),
        )
        envelope.save(directory)
        draw(envelope, directory)
        save_provenance(
            {
                **machine(),
                "wall_s": watch.passed(),
                "command": list(command),
                **carried(directory),
            },
            directory,
        )
    tell(envelope, directory)


OURS = re.compile(
    r"""(?x)
    envelope\.(json|png) | provenance\.json | units/\d+\.(jsonl|part)
  | pictures/\d+-[^/]+\.png(\.part)?
    """
)
"""Files that this command writes."""
FOLDERS = ("units", "pictures")


def played(run: Run) -> dict[str, object]:
    """Say what was played and with what, as results do; seeds and levels stand elsewhere."""
    from ..runs.plan import Trial

    head = run.head(Trial(index=0, repeat=0, seed=0, levels=(), is_alone=True))
    return {k: v for k, v in head["run"].items() if k not in ("seed", "repeats", "levels")}


def tell(envelope: Envelope, directory: Path) -> None:
    """Print what was found."""
    from ..envelope.criterion import reasons

    lines = [envelope.sentence]
    by = reasons(e.judgement for e in envelope.evaluations)
    n_broken = sum(by.values())
    why = f": {', '.join(f'{name} {n}' for name, n in by.items())}" if by else ""
    n_seeds = len(envelope.asked.seeds)
    seeds = "1 seed" if n_seeds == 1 else f"{n_seeds} seeds"
    lines.append(f"{seeds}, {len(envelope.evaluations)} runs, {n_broken} broken{why}")
    lines += [f"warning: {warning}" for warning in envelope.warnings]
    lines.append(f"written: {directory}/envelope.json, envelope.png")
    typer.echo(printable("\n".join(lines)))
