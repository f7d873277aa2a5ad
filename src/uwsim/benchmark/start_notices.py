"""Benchmarks that can be read and never begin, or measure nothing."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from .measures import EuclideanNormSpec
from .spec import BenchmarkSpec
from .triggers import NeverSpec, ServiceSpec


def never_started(
    root: etree._Element, spec: BenchmarkSpec
) -> Iterator[tuple[etree._Element | None, str]]:
    """Say that no level can begin, or that nothing is measured in it; each with its element."""
    start, place = spec.start_on, root.find("startOn")
    if isinstance(start, NeverSpec):
        yield place, "<startOn> is 'never': no level will ever begin"
    told = [
        each.ground_truth.publish_on
        for each in spec.measures
        if isinstance(each, EuclideanNormSpec)
    ]
    if isinstance(start, ServiceSpec) and start.target in told:
        yield (
            place,
            f"<startOn> waits for the service {start.target!r}, which the algorithm serves "
            "(<publishOn>): nobody can call it here, so no level will begin",
        )
    box = root.find("measures")
    if box is not None and box.find("*") is None:
        yield box, "<measures> is empty: nothing is measured"
