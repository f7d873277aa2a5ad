"""What of a bus is shown to the outside: topics and services whose types are known there."""

from __future__ import annotations

from ..bus import Bus, Services, TopicEnds
from ..messages.services import Service
from .log import Log
from .types import service_of, wire_type


def known_topics(bus: Bus, *, besides: object, log: Log) -> dict[str, TopicEnds]:
    """Return who is at the ends of each topic, ``besides`` one owner; not of withheld ones."""
    found: dict[str, TopicEnds] = {}
    for name in bus.topics:
        ends = bus.ends(name, besides=besides)
        if ends is None or bus.is_withheld(name):
            continue
        if wire_type(ends.type) is None:
            log.say(f"/{name} is not shown: {ends.type.__name__} has no definition")
            continue
        found[name] = ends
    return found


def known_services(services: Services) -> dict[str, Service]:
    """Return the services of a bus whose type is known, by name."""
    found: dict[str, Service] = {}
    for name in services.names:
        request_type = services.request_type(name)
        service = service_of(request_type) if request_type is not None else None
        if service is not None:
            found[name] = service
    return found
