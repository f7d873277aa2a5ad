"""Options of the original UWSim, which its scripts use: the error names today's command.

.. code-block:: text

    uwsim --configfile cirs.xml --dataPath DIR --disableShaders
"""

from __future__ import annotations

import shlex
from collections.abc import Collection, Sequence

from ..errors import BadSetting

OF_OCEAN = (
    *("--windx", "--windy", "--windSpeed", "--reflectionDamping", "--waveScale"),
    *("--choppyFactor", "--crestFoamHeight", "--oceanSurfaceHeight"),
)
"""Options with a value that ``<oceanState>`` has, too."""
OF_WINDOW = ("--resw", "--resh")
"""Options with a value that ``<simParams>`` has, too."""
FLAGS = (
    *("--disableShaders", "--disableTextures", "--freeMotion", "--fullScreen"),
    *("--isNotChoppy", "--debugPhysics"),
)
"""Options without a counterpart: of the original's window, most of them."""
SCENE, BENCHMARK, FOLDER, DEPTH = "--configfile", "--benchmark", "--dataPath", "--depth"
DEFAULT_SCENE = "cirs"
"""What the original opens without a scene."""


def refuse_old_options(arguments: Sequence[str], commands: Collection[str]) -> None:
    """Raise BadSetting, which names today's command, where an option of the original is given.

    Args:
        arguments: the words of the command line.
        commands: names of today's commands.
    """
    names = [word.partition("=")[0] for word in arguments]
    known = (SCENE, FOLDER, *OF_OCEAN, *OF_WINDOW, *FLAGS)
    found = [name for name in names if name in known]
    if arguments and arguments[0] not in commands and (found or BENCHMARK in names):
        raise BadSetting(_todays_command(list(arguments)))
    if found:
        replaced = "; ".join(dict.fromkeys(f"{name}: {_todays_option(name)}" for name in found))
        raise BadSetting(f"an option of the original UWSim. {replaced}.")


def _todays_option(name: str) -> str:
    """Describe what an option of the original is called today."""
    if name == SCENE:
        return "today the scene has no option, as in uwsim run FILE"
    if name == FOLDER:
        return "today --data-path DIR"
    if name in FLAGS:
        return "there is none today"
    return f"today {' '.join(_setting(name, 'VALUE'))}"


def _setting(name: str, value: str) -> list[str]:
    element = "simParams" if name in OF_WINDOW else "oceanState"
    return ["--set", f"{element}.{name.removeprefix('--')}={value}"]


def _todays_command(arguments: list[str]) -> str:
    """Describe the command that replaces a command line of the original."""
    scene, benchmark = DEFAULT_SCENE, ""
    options: list[str] = []
    left_out: list[str] = []
    while arguments:
        word = arguments.pop(0)
        name, has_value, value = word.partition("=")
        if name not in (SCENE, BENCHMARK, FOLDER, DEPTH, *OF_OCEAN, *OF_WINDOW):
            left_out.append(word)
            continue
        if not has_value:
            value = arguments.pop(0) if arguments else "..."
        if name == SCENE:
            scene = value
        elif name == BENCHMARK:
            benchmark = value
        else:
            options += ["--data-path", value] if name == FOLDER else _setting(name, value)
    if benchmark:
        command = ["uwsim", "bench", benchmark, "--scene", scene, *options]
    else:
        command = ["uwsim", "run", scene, *options]
    ending = "" if benchmark else "; --ros1 or --ros2 connects it to ROS, --view shows it"
    if left_out:
        ending += f". There is none today of: {' '.join(left_out)}"
    return (
        "these are options of the original UWSim. Today's command is: "
        f"{shlex.join(command)}{ending}."
    )
