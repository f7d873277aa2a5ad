"""Making the live client of a program outside, and admitting it alone to the run."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ...bus import Algorithm
from ..admission import Admission, FirstCaller, Report, SingleProgram, TopicOwners
from ..bridge import Bridge
from .client import lockstep_clients
from .free_client import FreeClient
from .output_client import OutputClient
from .spec import ClientSpec
from .step_client import SERVICE, StepClient


def make_external_client(
    spec: ClientSpec, bridges: Sequence[Bridge], *, timestep: float
) -> Algorithm:
    """Return what stands for the program in the simulation; attach it.

    Args:
        spec: the program, and what is waited for.
        bridges: the open connection by which it comes; one.
        timestep: of the simulation [s].

    Raises:
        BadSetting: there is no transport, or more than one.
    """
    for bridge in bridges:
        bridge.admission = admission_of(spec, partial(report, bridge))
    if spec.sync == "ack":
        (client,) = lockstep_clients(
            bridges, [spec.name], timestep=timestep, limit=spec.limit, secret=spec.secret
        )
        return client
    (bridge,) = bridges
    if spec.sync == "step":
        return StepClient(bridge, spec, timestep=timestep)
    if spec.sync == "output":
        return OutputClient(bridge, spec, timestep=timestep)
    return FreeClient(bridge, spec)


def admission_of(spec: ClientSpec, report: Report) -> Admission:
    """Return who may publish and call in the run of a program."""
    if spec.sync == "ack":
        return SingleProgram(report)
    if spec.sync == "step":
        return FirstCaller(SERVICE, report)
    is_free = spec.sync == "none"
    return TopicOwners(None if is_free else (each.topic for each in spec.outputs), report)


def report(bridge: Bridge, sender: str, text: str) -> None:
    """Report what is refused to the log, and to who sent it."""
    bridge.log.report(text, kind="refused: does not take part")
    bridge.report_error(sender, text)
