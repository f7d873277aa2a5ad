r"""fault: a thruster that fails at a given time; an extension of the dialect.

.. code-block:: xml

    <vehicle> ... <u:dynamics>g500_physical</u:dynamics>
      <u:fault> <u:thruster>sway</u:thruster> <u:loss>1</u:loss> <u:start>30</u:start> </u:fault>
    </vehicle>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..dialect import element


@dataclass(frozen=True, kw_only=True)
class ThrusterFaultSpec:
    """A ``<u:fault>``: a thruster of a simulated vehicle loses thrust; it has no ``bind``."""

    thruster: str = element(namespaced=True)
    """Its name in the vehicle's side file."""
    loss: float = element(namespaced=True, default=1.0, minimum=0.0, maximum=1.0)
    """Share of the thrust that is lost; 1 is dead [1]."""
    start: float = element(namespaced=True, default=0.0, minimum=0.0)
    """Simulation time from which on [s]."""
    end: float | None = element(namespaced=True, default=None, above=0.0)
    """Simulation time up to which; without it stays so [s]."""

    def acts(self, time: float) -> bool:
        """Whether it is there at ``time`` [s]."""
        return time >= self.start and (self.end is None or time < self.end)
