"""The base class of algorithms that represent an external program."""

from __future__ import annotations

from ..admission import Refusal
from ..bridge import Bridge
from .spec import ClientSpec


class ExternalProgram:
    """An algorithm of the simulation that represents an external program.

    Args:
        bridge: the bridge of the program's transport.
        spec: the specification of the program and its synchronization.
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec) -> None:
        self._bridge, self._spec = bridge, spec

    @property
    def name(self) -> str:
        """The name of the program in the result."""
        return self._spec.name

    @property
    def parameters(self) -> dict[str, float | str]:
        """The parameters, which are empty: the program has its own parameters."""
        return {}

    def pop_refusals(self) -> tuple[Refusal, ...]:
        """Return the refusals since the last call: programs that do not take part have tried to."""
        admission = self._bridge.admission
        return () if admission is None else admission.pop_refusals()
