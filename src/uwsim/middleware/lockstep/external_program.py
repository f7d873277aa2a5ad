"""What the live clients of a program outside share."""

from __future__ import annotations

from ..admission import Refusal
from ..bridge import Bridge
from .spec import ClientSpec


class ExternalProgram:
    """Stands for a program outside, as an algorithm of the simulation.

    Args:
        bridge: to the transport by which it comes.
        spec: the program, and what is waited for.
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec) -> None:
        self._bridge, self._spec = bridge, spec

    @property
    def name(self) -> str:
        """Its name in the result."""
        return self._spec.name

    @property
    def parameters(self) -> dict[str, float | str]:
        """Those of the program are its own."""
        return {}

    def take_refusals(self) -> tuple[Refusal, ...]:
        """Return what was refused since the last call of programs that do not take part."""
        admission = self._bridge.admission
        return () if admission is None else admission.take_refusals()
