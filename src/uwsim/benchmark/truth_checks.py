"""Checks that recorded truths (``<u:truth>``) fit the measures that use them, and the images."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import Diagnostic, UwsimError
from ..schema import Diagnostics, Spec, line_of
from ..world import Stage
from .ground_truth import TopicTruthSpec
from .recorded_truth import TIME_TOLERANCE, RecordedTruth, RecordedTruthSpec
from .spec import BenchmarkSpec
from .updaters import BagFogUpdaterSpec, chain


def truth_diagnostics(benchmark: BenchmarkSpec, stage: Stage) -> list[Diagnostic]:
    """Compare the columns and times of recorded truths with the measures and recordings.

    It is an error if a measure names another number of components than the truth has columns. It
    is a warning if the truth begins after the first image, or ends before the recording ends. Files
    that cannot be read are skipped.
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
        if message := _coverage_warning(truth, *times):
            diagnostics.warning(line_of(updater.truth, "file"), message)
        for topic_truth in _topic_truths(benchmark, updater.truth):
            n_read, n = len(topic_truth.components.split()), len(truth.columns)
            if n_read != n:
                diagnostics.error(
                    line_of(topic_truth, "components"),
                    f"<components> names {n_read} of the numbers on {topic_truth.topic!r}; "
                    f"{Path(updater.truth.file).name} publishes {n}: {', '.join(truth.columns)}",
                )
    return diagnostics.to_list()


def _topic_truths(benchmark: BenchmarkSpec, truth: RecordedTruthSpec) -> Iterator[TopicTruthSpec]:
    for measure in benchmark.measures:
        source: Spec | None = getattr(measure, "ground_truth", None)
        if isinstance(source, TopicTruthSpec) and source.topic.strip("/") == truth.topic.strip("/"):
            yield source


def _coverage_warning(truth: RecordedTruth, gap: float, length: float) -> str:
    """Return a warning about images without a truth; empty if there is none.

    Args:
        truth: the truth of the images.
        gap: the time from the first image to the second [s].
        length: the time from the first image to the last message of any topic [s].
    """
    start, end = truth.span
    if start <= TIME_TOLERANCE and end >= length - gap - TIME_TOLERANCE:
        return ""
    return (
        f"the truth is from {start:.6g} s to {end:.6g} s, the recording from its "
        f"first image to {length:.6g} s: images without truth are not scored"
    )
