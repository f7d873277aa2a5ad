"""Checks of recorded truths (``<u:truth>``) against the measures that read them, and the images."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import Diagnostic, UwsimError
from ..schema import Diagnostics, Spec, line_of
from ..world import Stage
from .ground_truth import TopicTruthSpec
from .recorded_truth import SAME_TIME, RecordedTruth, RecordedTruthSpec
from .spec import BenchmarkSpec
from .updaters import BagFogUpdaterSpec, chain


def truth_diagnostics(benchmark: BenchmarkSpec, stage: Stage) -> list[Diagnostic]:
    """Compare what a truth has with what is read of it; what cannot be read is reported elsewhere.

    An error where a measure reads another number of components; a warning where the truth begins
    after the first image, or ends before the recording.
    """
    diagnostics = Diagnostics(benchmark.path)
    for updater in chain(benchmark.scene_updater):
        if not isinstance(updater, BagFogUpdaterSpec) or updater.truth is None:
            continue
        try:
            truth = updater.truth.read(updater.path)
            times = updater.times(updater.find(stage))
        except UwsimError:
            continue
        if message := _uncovered(truth, *times):
            diagnostics.warning(line_of(updater.truth, "file"), message)
        for reads in _readers(benchmark, updater.truth):
            n_read, n = len(reads.components.split()), len(truth.columns)
            if n_read != n:
                diagnostics.error(
                    line_of(reads, "components"),
                    f"<components> names {n_read} of the numbers on {reads.topic!r}; "
                    f"{Path(updater.truth.file).name} publishes {n}: {', '.join(truth.columns)}",
                )
    return diagnostics.to_list()


def _readers(benchmark: BenchmarkSpec, truth: RecordedTruthSpec) -> Iterator[TopicTruthSpec]:
    """The ground truths of measures that are published by a recorded one."""
    for measure in benchmark.measures:
        reads: Spec | None = getattr(measure, "ground_truth", None)
        if isinstance(reads, TopicTruthSpec) and reads.topic.strip("/") == truth.topic.strip("/"):
            yield reads


def _uncovered(truth: RecordedTruth, gap: float, length: float) -> str:
    """Say which images have no truth; empty if all have one, as far as it can be seen.

    Args:
        truth: of the images.
        gap: between images [s].
        length: from the first image to the end of the recording, whatever its topic is [s].
    """
    first, last = truth.span
    if first <= SAME_TIME and last >= length - gap - SAME_TIME:
        return ""
    return (
        f"the truth is that of {first:.6g} s to {last:.6g} s, and the recording is one of 0 s to "
        f"{length:.6g} s from its first image on: other images are not scored"
    )
