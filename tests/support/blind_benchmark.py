"""A short benchmark without cameras, whose levels take little time."""

from pathlib import Path

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml"
    u:algorithm="nothing">
  <measures>
    <time> <name>taskTime</name> </time>
    <distance> <name>path</name> <target>girona500</target> <log>0.05</log> </distance>
  </measures>
  <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
  <function>taskTime</function>
  <sceneUpdater>
    <repeat> <iterations>LEVELS</iterations> <interval>0.1</interval> </repeat>
  </sceneUpdater>
</benchmark>
"""


def write_blind_benchmark(folder: Path, levels: int) -> Path:
    """Write the benchmark; return its file."""
    path = folder / "blind.xml"
    path.write_text(BENCHMARK.replace("LEVELS", str(levels)))
    return path
