"""Topics and services of a bus that external programs may use: those with a ROS definition."""

from __future__ import annotations

from ..bus import Bus, Services, TopicEndpoints
from ..bus.bus import OBSERVERS_REASON
from ..messages.services import Service
from .log import Log
from .types import service_of, wire_type


def exposed_topics(bus: Bus, *, ignored_owner: object, log: Log) -> dict[str, TopicEndpoints]:
    """Return the endpoints of each topic that is not hidden, without those of ``ignored_owner``.

    Topics that a track withholds are logged once, because a program may wait for them in vain.
    """
    topics: dict[str, TopicEndpoints] = {}
    for name in bus.topics:
        endpoints = bus.endpoints(name, ignored_owner=ignored_owner)
        if endpoints is None:
            continue
        if (reason := bus.hidden_reason(name)) is not None:
            line = f"/{name} is not sent: it {reason}"
            if reason != OBSERVERS_REASON and not log.count(line):
                log.report(line)
            continue
        if wire_type(endpoints.type) is None:
            log.report(f"/{name} is not sent: {endpoints.type.__name__} has no definition")
            continue
        topics[name] = endpoints
    return topics


def exposed_services(services: Services) -> dict[str, Service]:
    """Return the services of a bus whose type is known, by name."""
    service_types: dict[str, Service] = {}
    for name in services.names:
        request_type = services.request_type(name)
        service = service_of(request_type) if request_type is not None else None
        if service is not None:
            service_types[name] = service
    return service_types
