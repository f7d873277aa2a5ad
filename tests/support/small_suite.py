"""A suite of two short tasks in a tank, and entries for it."""

from __future__ import annotations

from pathlib import Path

from uwsim.cli import main

HOLD = """<benchmark xmlns:u="urn:uwsim:1" u:scene="open-water-scene.xml" u:timestep="0.02"
  u:mode="independent" u:prelude="false">
  <measures>
    <positionError u:value="rms">
      <name>offset</name> <target>bluerov2</target>
      <position> <x>0</x> <y>0</y> <z>1.5</z> </position>
    </positionError>
    <u:outcome>
      <name>outcome</name> <success>offset &lt; LIMIT</success> <ends>false</ends>
      <failure> <status>far</status> <condition>offset_max &gt; 0.9</condition> </failure>
    </u:outcome>
  </measures>
  <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
  <function>offset</function>
  <sceneUpdater>
    <currentForceUpdater>
      <initialValue>0</initialValue> <finalValue>0.4</finalValue>
      <sphericalDirection> <theta>M_PI_2</theta> <phi>0</phi> </sphericalDirection>
      <forceVariation>0</forceVariation> <forcePeriod>4</forcePeriod>
      <directionVariation> <theta>0</theta> <phi>0</phi> </directionVariation>
      <directionPeriod> <theta>4</theta> <phi>30</phi> </directionPeriod>
      <random>0</random> <step>0.4</step> <interval>4</interval> <target>bluerov2</target>
    </currentForceUpdater>
  </sceneUpdater>
  <u:environment>
    <vehicle>bluerov2</vehicle> <period>0.1</period> <reference>offset</reference>
    <observation>positionError heading gravity linearVelocity angularVelocity</observation>
    <action> <topic>/bluerov2/thrusters</topic> </action>
    <reward>-offset</reward>
  </u:environment>
</benchmark>
"""
SUITE = """<suite>
  <name>small</name> <description>Two short tasks.</description>
  <split> <name>validation</name> <count>4</count> </split>
  <split> <name>training</name> <first>100</first> <count>4</count> </split>
  <track>
    <name>a</name> <description>camera</description> <source>virtualCamera</source>
  </track>
  <track> <name>c</name> </track>
  <task>
    <name>near-v1</name> <benchmark>near.xml</benchmark> <description>Stay near.</description>
    <failure>far</failure> <failure>missed</failure>
    <baseline>position-p</baseline> <control>nothing</control>
  </task>
  <task>
    <name>far-v1</name> <benchmark>far.xml</benchmark> <description>Stay somewhere.</description>
    <baseline>position-p</baseline> <baseline>position-pi</baseline>
    <control>nothing</control> <expert>position-lqr</expert>
  </task>
</suite>
"""


def write_suite(folder: Path) -> Path:
    """Write the suite and its benchmarks into a folder; return the path of the suite."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "near.xml").write_text(HOLD.replace("LIMIT", "0.4"))
    (folder / "far.xml").write_text(HOLD.replace("LIMIT", "3"))
    path = folder / "small.xml"
    path.write_text(SUITE)
    return path


def run_suite(suite: Path, out: Path, *words: str, status: int = 0) -> Path:
    """Run an entry in this process, which ends with an exit status; return its folder."""
    arguments = ["suite", "run", str(suite), "--workers", "0", "--out", str(out), *words]
    assert main(arguments) == status
    return out
