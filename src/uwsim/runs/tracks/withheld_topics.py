"""The topics that a track withholds from the algorithm under test."""

from __future__ import annotations

from ...algorithms.policy import OBSERVATION
from ...bus import Bus
from ..planning.plan import Plan
from ..trial.policy_channel import agents_of
from .topic_sources import command_topics, topic_sources, topics_on_board

SIMULATION_SOURCE = "of the simulation itself"
"""The source of a topic that no sensor or device publishes."""


def withhold_topics(plan: Plan, bus: Bus) -> None:
    """Hide the topics that the track of a plan does not permit, before its algorithm starts.

    In any track, the topics of a vehicle with a ``<u:topicLink>`` are hidden: an operator is not on
    board. The topics that the link reports have reasons of their own.

    Permitted are the topics of the kinds of sensors and devices that the track lists, and topics
    with commands to the scene. All other topics that the simulation publishes are hidden, also
    those of no sensor, such as ``/tf`` and the observations of ``<u:environment>``.
    """
    for topic, link in topics_on_board(plan.scene).items():
        bus.hide_topic(topic, f"is on board; the algorithm is behind the link {link!r}")
    if plan.track is None:
        return
    for topic, source in withheld_topics(plan, bus).items():
        bus.hide_topic(topic, f"({source}) is not in track {plan.track.name!r}")


def withheld_topics(plan: Plan, bus: Bus) -> dict[str, str]:
    """Return the source of each topic that the track of a plan withholds, by topic."""
    assert plan.track is not None
    sources, commands = topic_sources(plan.scene), command_topics(plan.scene)
    published_topics = [
        name
        for name in bus.topics
        for endpoints in [bus.endpoints(name)]
        if endpoints is not None and endpoints.is_published and bus.hidden_reason(name) is None
    ]
    topics = [*published_topics, *_observation_topics(plan)]
    return {
        topic: sources.get(topic, SIMULATION_SOURCE)
        for topic in topics
        if topic not in commands and sources.get(topic) not in plan.track.sources
    }


def _observation_topics(plan: Plan) -> list[str]:
    """Return the topics of the observations of policies, which have the true state."""
    has_agents = bool(agents_of(plan.benchmark))
    topics = []
    for spec in plan.benchmark.environments:
        topic = f"{spec.vehicle}/{OBSERVATION}" if has_agents else OBSERVATION
        topics += [topic, *(f"{topic}/{image.name}" for image in spec.image)]
    return topics
