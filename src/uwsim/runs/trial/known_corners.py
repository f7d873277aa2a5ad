"""Constant target corners of a benchmark file, as a parameter for trackers.

A benchmark of the original UWSim may give the image position of its target as constants:

.. code-block:: xml

    <euclideanNorm> <name>corners</name>
      <groundTruth type="constant"> <value>215</value> <value>149</value> ... </groundTruth>
      <target>cornersTopic</target> ...
    </euclideanNorm>

The user entered these numbers into the tracker. Here a tracker that no measure initialises
(``publishOn``) receives them as a parameter.
"""

from __future__ import annotations

from ...benchmark.ground_truth import ConstantSpec
from ...benchmark.measures import EuclideanNormSpec
from ..planning.plan import Plan

PARAMETER = "corners"
"""The parameter of the algorithm: x, y of four corners [px], eight numbers separated by spaces."""
TOPIC = "cornersTopic"
"""The topic of the algorithm's estimates of the corners."""


def known_corners(plan: Plan) -> dict[str, str]:
    """Return the parameter with the constant corners of the file.

    It is empty if a measure initialises the algorithm (``publishOn``), if the file does not have
    eight constants for the topic of the corners, or if the algorithm has no such parameter.
    """
    norms = [spec for spec in plan.benchmark.measures if isinstance(spec, EuclideanNormSpec)]
    names = plan.algorithm.facts.parameter_names
    is_initialised = any(norm.ground_truth.publish_on is not None for norm in norms)
    if is_initialised or names is None or PARAMETER not in names:
        return {}
    for norm in norms:
        truth = norm.ground_truth
        if not isinstance(truth, ConstantSpec) or norm.target.strip().lstrip("/") != TOPIC:
            continue
        if len(truth.values) == 8:
            return {PARAMETER: " ".join(f"{value:.12g}" for value in truth.values)}
    return {}
