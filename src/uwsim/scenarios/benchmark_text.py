"""The benchmark files of a scenario."""

from __future__ import annotations

from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

from ..benchmark.ground_truth import CORNERS
from .recorded_images import DEPTH_TOPIC, RECORDING_FILE, TRUTH_FILE, TRUTH_TOPIC
from .request import Levels
from .scenario_scene import IMAGE_TOPIC, INFO_TOPIC

FOG_LEVELS, WATER_LEVELS = Levels(0.0, 0.5, 0.1), Levels(1.0, 4.0, 1.0)
"""The default levels: fog densities [1/m], and factors on the coefficients of physical water."""
TRIGGERS = """<startOn> <type>onInit</type> </startOn>
      <stopOn> <type>never</type> </stopOn>"""


@dataclass(frozen=True, kw_only=True)
class BenchmarkText:
    """The contents of a benchmark file of a scenario."""

    scene: str
    """The name of the scene file."""
    vehicle: str
    """The name of the vehicle."""
    camera: str | None
    """The camera whose images are scored; None: none are."""
    target: str | None
    """The tracked object; None: estimates of the position are scored."""
    interval: float
    """The duration of a level [s]."""
    levels: Levels | None
    """The requested levels; None: the default."""
    image_depth: float = 1.0
    """The range of surfaces without a depth [m]."""
    noise: float = 0.0
    """The standard deviation of the noise of the recorded camera, as a fraction of white [1]."""
    has_recording: bool = False
    """True if images are recorded; False: rendered."""
    has_physical_water: bool = False
    """True if the scene has physical water."""

    def write(self) -> str:
        """Return the text of the file."""
        algorithm = ' u:algorithm="esm"' if self.target is not None else ""
        measures = self._write_corner_measures() if self.target else self._write_position_measure()
        function = "corners" if self.target else "position"
        return f"""<?xml version="1.0"?>
<benchmark xmlns:u="urn:uwsim:1" u:scene={quoteattr(self.scene)}{algorithm} u:mode="independent">
  <measures>
{measures}
  </measures>
  <startOn> <type>onInit</type> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>{function}</function>
  <sceneUpdater>
{self._write_updater()}
  </sceneUpdater>
</benchmark>
"""

    def _write_corner_measures(self) -> str:
        if self.has_recording:
            truth = f"""<groundTruth type="topic">
        <topic>{TRUTH_TOPIC}</topic> <components>{" ".join(CORNERS)}</components> <unit>px</unit>
        <publishOn>autoInit</publishOn>
      </groundTruth>"""
            face = ""
        else:
            truth = f"""<groundTruth type="cornersFromCamera">
        <camera>{escape(self.camera or "")}</camera> <target>{escape(self.target or "")}</target>
        <publishOn>autoInit</publishOn>
      </groundTruth>"""
            face = ' u:truth="face"'
        return f"""    <euclideanNorm u:value="mean" u:autoInit="once"{face}>
      <name>corners</name>
      {truth}
      <target>cornersTopic</target>
      <log>0.1</log>
      {TRIGGERS}
    </euclideanNorm>"""

    def _write_position_measure(self) -> str:
        return f"""    <euclideanNorm u:value="mean">
      <name>position</name>
      <groundTruth type="relativeLocation">
        <from>localizedWorld</from> <to>{escape(self.vehicle)}</to>
      </groundTruth>
      <target>positionTopic</target>
      <log>0.1</log>
      {TRIGGERS}
    </euclideanNorm>"""

    def _write_updater(self) -> str:
        if self.has_recording:
            truth, noise = "", ""
            if self.noise > 0.0:
                noise = f"\n      <u:noise>{self.noise!r}</u:noise>"
            if self.target is not None:
                truth = (
                    f"\n      <u:truth> <u:file>{TRUTH_FILE}</u:file> "
                    f"<u:topic>{TRUTH_TOPIC}</u:topic> </u:truth>"
                )
            return f"""    <bagFogUpdater>
      {self._write_levels(FOG_LEVELS)}
      <bag>{RECORDING_FILE}</bag>
      <imageTopic>{IMAGE_TOPIC}</imageTopic> <infoTopic>{INFO_TOPIC}</infoTopic>
      <imageDepth>{self.image_depth:.4g}</imageDepth>
      <u:depthTopic>{DEPTH_TOPIC}</u:depthTopic>{noise}{truth}
    </bagFogUpdater>"""
        if self.has_physical_water:
            return f"""    <u:waterUpdater u:quantity="scale">
      {self._write_levels(WATER_LEVELS)}
    </u:waterUpdater>"""
        return f"""    <sceneFogUpdater>
      {self._write_levels(FOG_LEVELS)}
    </sceneFogUpdater>"""

    def _write_levels(self, default: Levels) -> str:
        levels = self.levels or default
        return (
            f"<initialValue>{levels.start!r}</initialValue> <finalValue>{levels.end!r}</finalValue>"
            f" <step>{levels.step!r}</step>\n      <interval>{self.interval!r}</interval>"
        )
