"""``uwsim replay``: a result as a page, or as a film."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.interrupts import raise_on_interrupt
from ..base.terminal import warn
from ..errors import BadSetting, ErrorCollector
from .options.help_texts import FILES, INPUT, OUTPUT, option
from .options.options import DataPathOption, ResultArgument
from .output.progress import progress
from .views import read_size

if TYPE_CHECKING:
    from ..viewer.film.film import FilmSpec
    from ..viewer.recorded import RecordedTrial
    from ..viewer.replay import Replay

MIN_SIDE, MAX_SIDE = 160, 7680
"""The minimum and maximum width and height of a film [px]."""
MAX_RATE = 120.0
"""The greatest frame rate of a film [Hz]."""
WEBP_RATE = 10.0
"""The default frame rate of a WebP [Hz]."""
RECORDING = ".mcap"
"""The suffix of a recording for 3-D panels."""
FILM_RATE = 30.0
"""The default frame rate of films except WebP [Hz]."""
N_NAMED = 5
"""The greatest number of files that a warning names."""


@dataclass(frozen=True, kw_only=True)
class TrialOptions:
    """The options that choose a trial and a part of it."""

    trial: Annotated[
        int | None,
        option(
            INPUT,
            "--trial",
            metavar="N",
            min=0,
            help="Number of the trial, as in units/N.motion; without it all of the first seed.",
        ),
    ] = None
    start: Annotated[
        float | None,
        option(
            INPUT,
            "--begin",
            metavar="SECONDS",
            min=0.0,
            help="Simulation time of the first image; without it the trial's beginning.",
        ),
    ] = None
    end: Annotated[
        float | None,
        option(
            INPUT,
            "--until",
            metavar="SECONDS",
            min=0.0,
            help="Simulation time of the last image; without it the trial's end.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class FilmOptions:
    """The options of a film."""

    view: Annotated[
        str,
        option(
            INPUT,
            "--view",
            metavar="orbit|chase|fixed|camera",
            help="A slow orbit, from behind the vehicle, from a fixed point, or of a camera.",
        ),
    ] = "orbit"
    camera: Annotated[
        str | None,
        option(
            INPUT,
            "--camera",
            metavar="NAME",
            help="The virtual camera of the inset, or of --view camera; without it the first.",
        ),
    ] = None
    curve: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--curve",
            metavar="MEASURE",
            help="A measure whose curve is drawn, or a column of its log as "
            "'success.height'; may be repeated. Without it the first four.",
        ),
    ] = None
    is_plain: Annotated[bool, option(INPUT, "--plain", help="No inset and no curves.")] = False
    fog: Annotated[
        bool,
        option(
            INPUT,
            "--with-fog",
            help="Draw the water's fog in the external view; a camera's image always has it.",
        ),
    ] = False
    is_smooth: Annotated[
        bool,
        option(OUTPUT, "--smooth", help="Smooth edges in the external view; takes twice as long."),
    ] = False
    size: Annotated[
        str, option(OUTPUT, "--size", metavar="WxH", help="Size of the film [px]; even numbers.")
    ] = "960x720"
    rate: Annotated[
        float | None,
        option(
            OUTPUT,
            "--fps",
            metavar="HZ",
            help="Images per second; without it 30, and 10 for a .webp.",
        ),
    ] = None
    speed: Annotated[
        float,
        option(OUTPUT, "--speed", metavar="FACTOR", help="Simulation time per second of the film."),
    ] = 1.0

    def spec(self, part: TrialOptions, out: Path) -> FilmSpec:
        """Return the spec of the film.

        Raises:
            SeveralErrors: options are invalid.
        """
        from ..viewer.film.encoder import WEBP
        from ..viewer.film.film import FilmSpec
        from ..viewer.film.paths import view_kind

        errors = ErrorCollector()
        view, size = view_kind("orbit"), (960, 720)
        default_rate = WEBP_RATE if out.suffix.lower() == WEBP else FILM_RATE
        rate = default_rate if self.rate is None else self.rate
        with errors.collect():
            view = view_kind(self.view)
        with errors.collect():
            size = check_film_size(read_size(self.size))
        with errors.collect():
            if not 0.1 <= rate <= MAX_RATE:
                raise BadSetting(f"--fps {rate:g}: expected 0.1 to {MAX_RATE:g}.")
        with errors.collect():
            if not 0.01 <= self.speed <= 1000.0:
                raise BadSetting(f"--speed {self.speed:g}: expected 0.01 to 1000.")
        errors.raise_errors()
        return FilmSpec(
            size=size,
            rate=rate,
            speed=self.speed,
            view=view,
            camera=self.camera,
            inset=not self.is_plain,
            curves=tuple(self.curve or ()),
            has_curves=not self.is_plain,
            start=part.start,
            end=part.end,
            fog=self.fog,
            samples=2 if self.is_smooth else 1,
        )


def replay(
    result: ResultArgument,
    *,
    part: TrialOptions,
    film: FilmOptions,
    out: Annotated[
        Path | None,
        option(
            OUTPUT,
            "--out",
            "-o",
            metavar="FILE",
            help="A page for any browser, .html; or a film: .mp4, .webm (both by ffmpeg, extra "
            "'film') or .webp; or .mcap for Foxglove: /tf, shapes and measures of a trial. "
            "Without it the page is served until Ctrl-C.",
        ),
    ] = None,
    port: Annotated[
        int,
        option(
            OUTPUT,
            "--port",
            metavar="N",
            min=0,
            max=65535,
            help="Port of the page; 0: any free port.",
        ),
    ] = 0,
    overwrite: Annotated[
        bool, option(OUTPUT, "--overwrite", help="Replace an earlier file.")
    ] = False,
    scene: Annotated[
        Path | None,
        option(FILES, "--scene", metavar="FILE.xml", help="The scene, if it is not found by name."),
    ] = None,
    data_path: DataPathOption = None,
) -> None:
    """Show a result again: as a page for the browser, or as a film.

    It does not run the simulation again: every bench stores the poses of all bodies
    (units/N.motion). The images are rendered from these, with the fog and light at that time, but
    without noise. The page has all levels, all views and the curves of all measures, in one file
    that needs no network. The options from --view to --speed are for films. Levels are chapters.
    The same result and options give the same bytes. The rows of report.html link to
    RESULT/replay.html.
    """
    from ..viewer.film.encoder import check_film_path
    from ..viewer.replay import SUFFIXES

    folders = tuple(data_path or ())
    if out is None or out.suffix.lower() in SUFFIXES:
        replay = open_replay(result, part.trial, scene, folders)
        show_page(replay, out, overwrite=overwrite, port=port)
        return
    if out.suffix.lower() == RECORDING:
        typer.echo(write_mcap(open_trials(result, part.trial, scene, folders)[0], out, overwrite))
        return
    check_film_path(out, overwrite=overwrite, other_suffixes=(SUFFIXES[0], RECORDING))
    spec = film.spec(part, out)
    trials = open_trials(result, part.trial, scene, folders)
    typer.echo(write_film(trials, spec, out))


def write_mcap(trial: RecordedTrial, out: Path, overwrite: bool) -> str:
    """Write a trial as a recording, and show progress; return a line that describes the file."""
    from ..viewer.recording import check_recording_path, write_recording

    check_recording_path(out, overwrite=overwrite)
    with progress("recording", trial.track.n_frames, unit="rows") as on_row:
        n = write_recording(trial, out, on_row)
    return f"{trial.title}: {n} messages; written: {out}"


def open_replay(
    result: Path, index: int | None, scene: Path | None, folders: tuple[Path, ...]
) -> Replay:
    """Open a result for the page, with all trials or only the one with an index."""
    from ..verify.recorded_plan import FileOverrides
    from ..viewer.replay import Replay

    directory = result.parent if result.name == "result.json" else result
    overrides = FileOverrides(scene=scene, data_path=folders)
    replay = Replay(directory, None if index is None else (index,), overrides)
    warn_missing_tracks(directory, replay.trials_without_motion, "their levels have no images")
    return replay


def warn_missing_tracks(directory: Path, indices: Sequence[int], consequence: str) -> None:
    """Warn in one line about trials without a file of poses."""
    from ..results.journal import FOLDER, track_path

    if indices:
        files = ", ".join(track_path(directory, index).name for index in indices[:N_NAMED])
        remainder = f" and {len(indices) - N_NAMED} more" if len(indices) > N_NAMED else ""
        warn(f"{directory}/{FOLDER}: {files}{remainder}: missing; {consequence}")


def show_page(replay: Replay, out: Path | None, *, overwrite: bool, port: int) -> None:
    """Write the page, or serve it until Ctrl-C; rewrite the report that links to it."""
    from ..analysis.report import write_report
    from ..results.directory import REPLAY
    from ..viewer.serve import serve

    if out is None:
        page = serve(replay.html(), port=port)
        typer.echo(f"{replay.title}: {page.url} (Ctrl-C ends)")
        page.wait()
        return
    if out.is_dir():
        raise BadSetting(f"-o {out}: is a folder.")
    if out.exists() and not overwrite:
        raise BadSetting(f"-o {out}: exists; --overwrite replaces it.")
    out.parent.mkdir(parents=True, exist_ok=True)
    replay.save(out)
    typer.echo(f"{replay.title}: written: {out}")
    if out.resolve() == (replay.directory / REPLAY).resolve():
        typer.echo(f"its rows link to it: {write_report(replay.directory)}")


def open_trials(
    result: Path, index: int | None, scene: Path | None, folders: tuple[Path, ...]
) -> list[RecordedTrial]:
    """Open the trial of a result with an index, or all trials of its first seed.

    The path of a result is that of the directory or of ``result.json``.
    """
    from ..results.journal import trials_without_motion
    from ..verify.recorded_plan import FileOverrides
    from ..viewer.recorded import RecordedTrial, trials_of_first_seed

    directory = result.parent if result.name == "result.json" else result
    overrides = FileOverrides(scene=scene, data_path=folders)
    indices = trials_of_first_seed(directory) if index is None else (index,)
    if index is None:
        warn_missing_tracks(
            directory, trials_without_motion(directory), "their levels are left out"
        )
    return [RecordedTrial.open(directory, trial_index, overrides) for trial_index in indices]


def write_film(trials: list[RecordedTrial], spec: FilmSpec, out: Path) -> str:
    """Write a film, and show progress; return a line that describes the file."""
    from ..viewer.film.film import TrialSequenceFilm, n_frames_of, save_film
    from ..viewer.film.processes import DrawingProcesses, count_processes

    n_frames = sum(n_frames_of(trial, spec) for trial in trials)
    n = count_processes(n_frames)
    n_drawn = 0

    def count_frame() -> None:
        nonlocal n_drawn
        n_drawn += 1
        on_frame()

    raise_on_interrupt()
    try:
        with (
            closing(
                DrawingProcesses(trials, spec, n) if n > 1 else TrialSequenceFilm(trials, spec)
            ) as film,
            progress("film", n_frames, unit="images") as on_frame,
        ):
            save_film(film, out, count_frame)
        return (
            f"{trials[0].title}: {n_frames} images, {n_frames / spec.rate:.1f} s, "
            f"{spec.size[0]}x{spec.size[1]}; written: {out}"
        )
    except KeyboardInterrupt:
        if n_drawn:
            seconds = n_drawn / spec.rate
            warn(f"{out}: has the first {n_drawn} of {n_frames} images, {seconds:.1f} s")
        raise


def check_film_size(size: tuple[int, int]) -> tuple[int, int]:
    """Raise BadSetting for a size that films cannot have: odd, too small or too large."""
    if size[0] % 2 or size[1] % 2 or min(size) < MIN_SIDE or max(size) > MAX_SIDE:
        raise BadSetting(
            f"--size {size[0]}x{size[1]}: expected even numbers from {MIN_SIDE} to {MAX_SIDE}, "
            "as in 960x720."
        )
    return size
