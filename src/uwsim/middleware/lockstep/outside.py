"""Making the live client of a program outside."""

from __future__ import annotations

from collections.abc import Sequence

from ...bus import Algorithm
from ..bridge import Bridge
from .client import lockstep_clients
from .free_client import FreeClient
from .output_client import OutputClient
from .spec import ClientSpec
from .step_client import StepClient


def outside_client(spec: ClientSpec, bridges: Sequence[Bridge], *, timestep: float) -> Algorithm:
    """Return what stands for the program in the simulation; attach it.

    Args:
        spec: the program, and what is waited for.
        bridges: the open connection by which it comes; one.
        timestep: of the simulation [s].

    Raises:
        BadSetting: there is no transport, or more than one.
    """
    if spec.sync == "ack":
        (client,) = lockstep_clients(bridges, [spec.name], timestep=timestep, limit=spec.limit)
        return client
    (bridge,) = bridges
    if spec.sync == "step":
        return StepClient(bridge, spec, timestep=timestep)
    if spec.sync == "output":
        return OutputClient(bridge, spec, timestep=timestep)
    return FreeClient(bridge, spec)
