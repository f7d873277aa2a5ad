"""The error for options of the original UWSim: it names the corresponding command of uwsim.

.. code-block:: text

    uwsim --configfile cirs.xml --dataPath DIR --disableShaders
"""

from __future__ import annotations

import shlex
from collections.abc import Collection, Sequence

from ..errors import BadSetting

OCEAN_OPTIONS = (
    *("--windx", "--windy", "--windSpeed", "--reflectionDamping", "--waveScale"),
    *("--choppyFactor", "--crestFoamHeight", "--oceanSurfaceHeight"),
)
"""The options whose value is an element of ``<oceanState>``."""
WINDOW_OPTIONS = ("--resw", "--resh")
"""The options whose value is an element of ``<simParams>``."""
FLAG_OPTIONS = (
    *("--disableShaders", "--disableTextures", "--freeMotion", "--fullScreen"),
    *("--isNotChoppy", "--debugPhysics"),
)
"""The options without a counterpart, most of which concern the window of the original UWSim."""
SCENE, BENCHMARK, FOLDER, DEPTH = "--configfile", "--benchmark", "--dataPath", "--depth"
DEFAULT_SCENE = "cirs"
"""The scene that the original UWSim opens by default."""


def reject_old_options(arguments: Sequence[str], commands: Collection[str]) -> None:
    """Raise BadSetting, which names the corresponding command, for an option of the original UWSim.

    Args:
        arguments: the words of the command line.
        commands: the names of the commands of uwsim.
    """
    names = [word.partition("=")[0] for word in arguments]
    old_names = (SCENE, FOLDER, *OCEAN_OPTIONS, *WINDOW_OPTIONS, *FLAG_OPTIONS)
    given_names = [name for name in names if name in old_names]
    if arguments and arguments[0] not in commands and (given_names or BENCHMARK in names):
        raise BadSetting(_present_command(list(arguments)))
    if given_names:
        texts = dict.fromkeys(f"{name}: {_present_option(name)}" for name in given_names)
        raise BadSetting(f"an option of the original UWSim. {'; '.join(texts)}.")


def _present_option(name: str) -> str:
    if name == SCENE:
        return "now the scene is an argument, as in uwsim run FILE"
    if name == FOLDER:
        return "now --data-path DIR"
    if name in FLAG_OPTIONS:
        return "now there is none"
    return f"now {' '.join(_setting(name, 'VALUE'))}"


def _setting(name: str, value: str) -> list[str]:
    element = "simParams" if name in WINDOW_OPTIONS else "oceanState"
    return ["--set", f"{element}.{name.removeprefix('--')}={value}"]


def _present_command(arguments: list[str]) -> str:
    scene, benchmark = DEFAULT_SCENE, ""
    options: list[str] = []
    omitted_words: list[str] = []
    while arguments:
        word = arguments.pop(0)
        name, has_value, value = word.partition("=")
        if name not in (SCENE, BENCHMARK, FOLDER, DEPTH, *OCEAN_OPTIONS, *WINDOW_OPTIONS):
            omitted_words.append(word)
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
    if omitted_words:
        ending += f". Options without a counterpart: {' '.join(omitted_words)}"
    return (
        "these are options of the original UWSim. The command is now: "
        f"{shlex.join(command)}{ending}."
    )
