"""The bundled algorithms under test: trackers, controllers, pilots and a grasping algorithm.

They communicate with the simulation by topics and services only, as third-party algorithms do.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping

from ..base.interrupts import is_user_interrupt
from ..bus import Algorithm
from ..errors import BadSetting, did_you_mean, type_and_text
from .autopilot_missions import AutopilotPath, AutopilotStation
from .control import PI, Feedforward, P
from .control.formation import FormationP, FormationPI
from .control.nothing import SilentAlgorithm
from .control.reach import Reach, ReachProportional
from .direct import Esm, InverseCompositional, SsdEsm
from .docking import (
    Docking,
    DockingGirona,
    DockingGironaUsbl,
    DockingGironaUsblProportional,
    DockingUsbl,
    DockingUsblProportional,
    Homing,
    HomingLineOfSight,
)
from .ecc import Ecc
from .frozen import FrozenTracker
from .grasp import Grasp, GraspBlindClose, GraspP, GraspTruth
from .inspection.net_inspection import NetInspection, NetInspectionFixed
from .orb import Orb
from .panel import Plug, PlugRigid, PlugTruth, Valve, ValveRigid, ValveTruth
from .pilot import Pilot
from .pipe.cable_camera import CableCamera, CableNoMemory
from .pipe.camera_line import PipeCamera, PipeCameraProportional
from .pipe.observed_line import PipeFollowing, PipeStraight
from .policy import is_policy
from .position import PositionP, PositionPI
from .position_lqr import PositionLQR
from .predictive import DobMpc, Mpc
from .scripted import ScriptedPilot
from .search import Search, SearchCamera, SearchSonar, SearchTruth
from .survey.bottom_survey import Survey, SurveyNoDvl, SurveyTruth
from .team.relay import RelayHold, RelayShuttle
from .team.rendezvous import RendezvousPredict, RendezvousPursuit, RendezvousWait
from .teleoperation.operators import OperatorContinuous, OperatorPredict, OperatorWait
from .tracker_node import merge_parameters

__all__ = ["ALGORITHMS", "check_parameters", "load_algorithm", "summary"]

ALGORITHMS: dict[str, type[Algorithm]] = {
    "autopilot-path": AutopilotPath,
    "autopilot-station": AutopilotStation,
    "cable-camera": CableCamera,
    "cable-no-memory": CableNoMemory,
    "dob-mpc": DobMpc,
    "docking": Docking,
    "docking-girona": DockingGirona,
    "docking-girona-usbl": DockingGironaUsbl,
    "docking-girona-usbl-p": DockingGironaUsblProportional,
    "docking-usbl": DockingUsbl,
    "docking-usbl-p": DockingUsblProportional,
    "ecc": Ecc,
    "esm": Esm,
    "feedforward": Feedforward,
    "formation-p": FormationP,
    "formation-pi": FormationPI,
    "frozen": FrozenTracker,
    "grasp": Grasp,
    "grasp-blind-close": GraspBlindClose,
    "grasp-p": GraspP,
    "grasp-truth": GraspTruth,
    "homing": Homing,
    "homing-los": HomingLineOfSight,
    "ic": InverseCompositional,
    "mpc": Mpc,
    "net-inspection": NetInspection,
    "net-inspection-fixed": NetInspectionFixed,
    "nothing": SilentAlgorithm,
    "operator-continuous": OperatorContinuous,
    "operator-predict": OperatorPredict,
    "operator-wait": OperatorWait,
    "orb": Orb,
    "p": P,
    "pi": PI,
    "pilot": Pilot,
    "pipe-camera": PipeCamera,
    "pipe-camera-p": PipeCameraProportional,
    "pipe-following": PipeFollowing,
    "pipe-straight": PipeStraight,
    "plug": Plug,
    "plug-rigid": PlugRigid,
    "plug-truth": PlugTruth,
    "position-lqr": PositionLQR,
    "position-p": PositionP,
    "position-pi": PositionPI,
    "reach": Reach,
    "reach-p": ReachProportional,
    "relay-hold": RelayHold,
    "relay-shuttle": RelayShuttle,
    "rendezvous-predict": RendezvousPredict,
    "rendezvous-pursuit": RendezvousPursuit,
    "rendezvous-wait": RendezvousWait,
    "scripted": ScriptedPilot,
    "search": Search,
    "search-camera": SearchCamera,
    "search-sonar": SearchSonar,
    "search-truth": SearchTruth,
    "ssd-esm": SsdEsm,
    "survey": Survey,
    "survey-no-dvl": SurveyNoDvl,
    "survey-truth": SurveyTruth,
    "valve": Valve,
    "valve-rigid": ValveRigid,
    "valve-truth": ValveTruth,
}
"""The bundled algorithms by name, in alphabetical order."""


def summary(algorithm: type[Algorithm]) -> str:
    """Return the first line of an algorithm's docstring."""
    return (algorithm.__doc__ or "").strip().partition("\n")[0]


def load_algorithm(name: str, table: Mapping[str, type[Algorithm]] = ALGORITHMS) -> type[Algorithm]:
    """Return the class of an algorithm.

    Args:
        name: a name in ``table``, or ``module:Class`` for a third-party algorithm.
        table: the classes of algorithms by name.

    Raises:
        BadSetting: there is no such algorithm; the error message lists the valid names.
    """
    if ":" not in name:
        if name not in table:
            raise BadSetting(
                f"No algorithm is called {name!r}.{did_you_mean(name, table)} "
                f"Known: {', '.join(table)}; or your own as module:Class or in a --plugin."
            )
        return table[name]
    module_name, _, class_name = name.partition(":")
    try:
        module = importlib.import_module(module_name)
    except BaseException as error:  # SystemExit of a script, too
        if is_user_interrupt(error):
            raise
        raise BadSetting(
            f"Algorithm {name!r}: the module {module_name!r} cannot be imported: "
            f"{type_and_text(error)}. (PYTHONPATH=. finds the files of this folder.)"
        ) from error
    algorithm = getattr(module, class_name, None)
    if not isinstance(algorithm, type):
        classes = [key for key, value in vars(module).items() if isinstance(value, type)]
        raise BadSetting(
            f"Algorithm {name!r}: the module {module_name!r} has no class {class_name!r}."
            f"{did_you_mean(class_name, classes)}"
        )
    if not callable(getattr(algorithm, "start", None)) and not is_policy(algorithm):
        raise BadSetting(
            f"Algorithm {name!r}: the class has no method start(node), and no __call__ of a policy."
        )
    return algorithm


def check_parameters(algorithm: type[Algorithm], parameters: Mapping[str, float | str]) -> None:
    """Check the user's parameters of an algorithm before it starts.

    They are compared with the class's ``PARAMETERS``, and passed to its method
    ``check_parameters``, if the class has them. ``latency_s`` is a parameter of the bus and always
    valid.

    Raises:
        BadSetting: the name of a parameter is unknown, or a value is invalid.
    """
    defaults = getattr(algorithm, "PARAMETERS", None)
    if isinstance(defaults, Mapping):
        own_parameters = {name: parameters[name] for name in parameters if name != "latency_s"}
        merge_parameters(defaults, own_parameters)
    check = getattr(algorithm, "check_parameters", None)
    if callable(check):
        check(parameters)
