"""Errors and warnings about the topics of ``<u:topicLink>``."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.topic_link import TopicLinkSpec
from ...errors import Diagnostic
from ..subjects import CheckedScene
from .streams import published_topics


def check_topic_links(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report routes from a topic to itself, and warn of reports that nothing publishes."""
    topics: set[str] | None = None
    for vehicle in scene.spec.vehicles:
        for link in vehicle.parts_of(TopicLinkSpec):
            for route in (*link.command, *link.report):
                if route.source == route.target:
                    message = f"<from> and <to> are both {route.to!r}; expected two topics"
                    yield scene.error(route, f"<u:topicLink> {link.name!r}: {message}")
            for route in link.report:
                topics = published_topics(scene.spec) if topics is None else topics
                if route.source not in topics:
                    near = scene.diagnostics.suggest(route.source, topics, "warning")
                    message = f"nothing in the scene publishes {route.from_!r}.{near}"
                    yield scene.warning(route, f"<u:topicLink> {link.name!r}: {message}", "from")
