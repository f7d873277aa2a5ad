"""The algorithm that represents an external program, and the rule that admits it to the run."""

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


def make_client(spec: ClientSpec, bridges: Sequence[Bridge], *, timestep: float) -> Algorithm:
    """Make the algorithm that represents a program in the simulation; the caller attaches it.

    Args:
        spec: the specification of the program and its synchronization.
        bridges: the bridges of the open connections: exactly one, which the program uses.
        timestep: the step of the simulation [s].

    Raises:
        BadSetting: there is no transport, or more than one.
    """
    for bridge in bridges:
        bridge.admission = make_admission(spec, partial(report_refusal, bridge))
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


def make_admission(spec: ClientSpec, report: Report) -> Admission:
    """Return the rule that decides who may publish and call in the run of a program."""
    if spec.sync == "ack":
        return SingleProgram(report)
    if spec.sync == "step":
        return FirstCaller(SERVICE, report)
    is_free = spec.sync == "none"
    return TopicOwners(None if is_free else (output.topic for output in spec.outputs), report)


def report_refusal(bridge: Bridge, client_name: str, text: str) -> None:
    """Report a refusal to the log and to the refused program."""
    bridge.log.report(text, kind="refused: does not take part")
    bridge.report_error(client_name, text)
