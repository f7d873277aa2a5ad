"""The processes that render a data set, each with a graphics context of its own.

Worker k of w renders every w-th unfinished scene draw. A worker that ends or fails ends the run;
finished draws remain on disk, and the same command continues.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from ..base.environment import set_environment
from ..base.terminal import suppress_cast_warnings
from ..errors import RunFailed, UwsimError, type_and_text
from ..model.scene_model import SceneModel
from ..runs.executors.executor import ENVIRONMENT
from ..runs.executors.parent_watch import exit_with_parent, start_ignoring_interrupts
from ..simulation.scenery.renderer_pool import RendererPool
from .request import DatasetRequest
from .scene_draw import DatasetSources, record_line, render_draw
from .shards import draw_indices, write_shard

OnImage = Callable[[], object]
"""A function that is called after each image."""


def render_all(
    request: DatasetRequest,
    sources: DatasetSources,
    numbers: Sequence[int],
    on_image: OnImage,
    model: SceneModel | None = None,
) -> None:
    """Render scene draws in this process, or in ``request.workers`` processes.

    Args:
        request: the request.
        sources: the specs.
        numbers: the numbers of the draws.
        on_image: a function that is called after each image.
        model: the compiled scene if draws do not differ and this process has it.
    """
    n_workers = min(request.workers, len(numbers))
    if n_workers <= 1:
        render_draws(request, sources, numbers, on_image, model)
        return
    parts = [numbers[k::n_workers] for k in range(n_workers)]
    workers = [_Worker(request, sources, part) for part in parts]
    try:
        _follow(workers, on_image)
    finally:
        for worker in workers:
            worker.kill()


def render_draws(
    request: DatasetRequest,
    sources: DatasetSources,
    numbers: Sequence[int],
    on_image: OnImage,
    model: SceneModel | None = None,
) -> None:
    """Render scene draws one after another in this process."""
    from ..physics.compile_scene import compile_scene
    from .scene_draw import find_scene_seed

    pool = RendererPool()
    try:
        if model is None and not sources.varies and numbers:
            seed = find_scene_seed(request, sources, numbers[0])
            model = compile_scene(sources.scene, seed=seed, data_path=sources.folders)
        for number in numbers:
            lines = []
            shared_model = None if sources.varies else model
            indices = draw_indices(request, number)
            for record in render_draw(request, sources, number, indices, pool, shared_model):
                lines.append(record_line(record))
                on_image()
            write_shard(request.out, number, lines)
    finally:
        pool.close()


class _Worker:
    """The parent's handle of a worker process."""

    def __init__(
        self, request: DatasetRequest, sources: DatasetSources, numbers: Sequence[int]
    ) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, child_pipe = context.Pipe(duplex=False)
        parent, self._parent = context.Pipe(duplex=False)
        self.process: BaseProcess = context.Process(
            target=work, args=(child_pipe, parent, request, sources, list(numbers))
        )
        with set_environment(ENVIRONMENT):
            start_ignoring_interrupts(self.process)
        for end in (child_pipe, parent):
            end.close()
        self.is_finished = False

    @property
    def handles(self) -> tuple[Connection, int]:
        """Handles that become ready when the worker has sent a report or has ended."""
        return self.pipe, self.process.sentinel

    def kill(self) -> None:
        """Kill the worker if it has not ended."""
        self.process.kill()
        self.process.join()
        self.process.close()
        self.pipe.close()
        self._parent.close()


def _follow(workers: list[_Worker], on_image: OnImage) -> None:
    """Count the images of workers until all have ended; raise the first error."""
    while running_workers := [worker for worker in workers if not worker.is_finished]:
        wait(
            [
                handle
                for worker in running_workers
                for handle in (worker.pipe, worker.process.sentinel)
            ]
        )
        for worker in running_workers:
            is_alive = worker.process.is_alive()  # read before the reports
            with suppress(EOFError, OSError):
                while worker.pipe.poll():
                    report = worker.pipe.recv()
                    if isinstance(report, str):
                        raise RunFailed(report)
                    if report is None:
                        worker.is_finished = True
                    else:
                        on_image()
            if not is_alive and not worker.is_finished:
                code = worker.process.exitcode
                raise RunFailed(
                    f"A worker process ended with status {code}. Finished images remain; the same "
                    "command continues."
                )


def work(
    pipe: Connection,
    parent: Connection,
    request: DatasetRequest,
    sources: DatasetSources,
    numbers: list[int],
) -> None:
    """Render scene draws, and report each image as 1, the end as None, an error as its text."""
    exit_with_parent(parent)
    suppress_cast_warnings()
    try:
        render_draws(request, sources, numbers, lambda: pipe.send(1))
        pipe.send(None)
    except (BrokenPipeError, ConnectionError):
        pass  # the parent has ended
    except UwsimError as error:
        pipe.send(str(error))
    except Exception as error:
        pipe.send(type_and_text(error))
