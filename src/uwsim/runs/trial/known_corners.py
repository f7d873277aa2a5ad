"""Constant target corners of a file, set for trackers where no ``autoInit`` is called.

A benchmark of the original may have a constant place of its target in the image:

.. code-block:: xml

    <euclideanNorm> <name>corners</name>
      <groundTruth type="constant"> <value>215</value> <value>149</value> ... </groundTruth>
      <target>cornersTopic</target> ...
    </euclideanNorm>

The user of the original entered these numbers into the tracker.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...benchmark.ground_truth import ConstantSpec
from ...benchmark.measures import EuclideanNormSpec
from ..planning.plan import Plan

PARAMETER = "corners"
"""The parameter of the algorithm: x, y of four corners [px], eight numbers separated by blanks."""
TOPIC = "cornersTopic"
"""The topic of its estimates of the corners."""


def known_corners(plan: Plan) -> dict[str, str]:
    """Return the parameter with the constant corners of the file.

    It is empty when a measure initialises the algorithm itself (``publishOn``), when the file has
    no eight constants for the topic of the corners, or when the algorithm has no such parameter.
    """
    norms = [spec for spec in plan.benchmark.measures if isinstance(spec, EuclideanNormSpec)]
    defaults: object = getattr(plan.algorithm.cls, "PARAMETERS", None)
    is_initialised = any(norm.ground_truth.publish_on is not None for norm in norms)
    if is_initialised or not isinstance(defaults, Mapping) or PARAMETER not in defaults:
        return {}
    for norm in norms:
        truth = norm.ground_truth
        if not isinstance(truth, ConstantSpec) or norm.target.strip().lstrip("/") != TOPIC:
            continue
        if len(truth.values) == 8:
            return {PARAMETER: " ".join(f"{value:.12g}" for value in truth.values)}
    return {}
