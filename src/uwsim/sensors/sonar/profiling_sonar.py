"""A sonar whose beam steps over a sector (from a branch of UWSim that users run).

.. code-block:: xml

    <ProfilingSonar>
      <name>profiler</name> <relativeTo>base_link</relativeTo>
      <initAngle>-60</initAngle> <finalAngle>60</finalAngle> <angleIncr>1</angleIncr>
      <range>10</range> <fov>2</fov>
    </ProfilingSonar>

As in that branch, a sample is a whole scan at one time: see
`uwsim.sensors.sonar.multibeam_sensor`.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...schema import element
from .multibeam_sensor import FanSpec


@dataclass(frozen=True, kw_only=True)
class ProfilingSonarSpec(FanSpec):
    """A ``<ProfilingSonar>``."""

    fov: float = element(exclusive_minimum=0)
    """The field of view of each depth camera of the original UWSim [deg]; rays do not use it."""

    @property
    def camera_field(self) -> float:
        """The largest field of view of each depth camera of the original UWSim [deg]."""
        return self.fov
