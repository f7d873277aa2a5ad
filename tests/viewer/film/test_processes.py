"""Films that several processes draw have the bytes of one; what goes wrong is one line."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from uwsim.cli import main
from uwsim.errors import RunFailed, UnknownName
from uwsim.viewer.film.encoder import as_rgb
from uwsim.viewer.film.film import FilmSpec, TrialSequenceFilm, n_frames_of, save_film
from uwsim.viewer.film.processes import DrawingProcesses, count_processes
from uwsim.viewer.recorded import RecordedTrial

SPEC = FilmSpec(size=(160, 160), rate=25.0)


@pytest.fixture
def drawing(trial: RecordedTrial) -> Iterator[DrawingProcesses]:
    with closing(DrawingProcesses([trial], SPEC, 2)) as processes:
        yield processes


@pytest.mark.slow
def test_two_processes_draw_the_images_of_one(trial: RecordedTrial) -> None:
    # two trials, and images between those of the inset, which comes ten times a second
    with closing(TrialSequenceFilm([trial, trial], SPEC)) as reel:
        alone = list(reel.frames(as_rgb))
        assert reel.draw(len(alone) - 1).tobytes() == alone[-1]
    n = 2 * n_frames_of(trial, SPEC)
    assert len(alone) == n == 60
    assert len(set(alone)) > n // 4  # it moves
    with closing(DrawingProcesses([trial, trial], SPEC, 3)) as processes:
        assert list(processes.frames(as_rgb)) == alone


@pytest.mark.slow
def test_a_process_that_dies_is_named_and_leaves_no_file(
    drawing: DrawingProcesses, trial: RecordedTrial, tmp_path: Path
) -> None:
    def kill() -> None:
        drawing._processes[1].kill()

    path = tmp_path / "film.webp"
    with pytest.raises(RunFailed, match="draws the film has ended: killed by SIGKILL"):
        save_film(drawing, path, kill)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_what_a_process_cannot_draw_is_an_error_of_the_film(trial: RecordedTrial) -> None:
    spec = FilmSpec(size=(160, 160), curves=("nonsense",))
    with (
        closing(DrawingProcesses([trial], spec, 1)) as processes,
        pytest.raises(UnknownName, match="nonsense"),
    ):
        next(processes.frames(as_rgb))


def test_a_short_film_has_one_process() -> None:
    assert count_processes(20) == 1
    assert 1 <= count_processes(10_000) <= 16


@pytest.mark.slow
def test_the_command_draws_long_films_by_several_processes(
    result: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = ["--size", "160x160", "--fps", "100"]
    for n, name in [(1, "one.webp"), (2, "two.webp")]:
        monkeypatch.setattr(
            "uwsim.viewer.film.processes.count_processes", lambda n_frames, n=n: min(n, n_frames)
        )
        assert main(["replay", str(result), "-o", str(tmp_path / name), *options]) == 0
    assert (tmp_path / "one.webp").read_bytes() == (tmp_path / "two.webp").read_bytes()
