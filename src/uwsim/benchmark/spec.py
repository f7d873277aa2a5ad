"""The contents of a benchmark file: `BenchmarkSpec`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ..scene.variation import DISTRIBUTIONS, VariationSpec
from ..schema import Spec, element
from .environment import EnvironmentSpec
from .measures import MeasureSpec
from .triggers import TriggerSpec
from .updaters import SceneUpdaterSpec, chain

MAX_TASK_DURATION = 600.0
"""The duration after which a level without an interval ends with the status ``timeout`` [s]."""


@dataclass(frozen=True, kw_only=True)
class FunctionSpec(Spec):
    """The ``<function>`` element: the score as a function of the measures."""

    text: str = element(text=True)
    """An expression whose variables are the names of measures (`uwsim.base.expression`)."""
    publish_result: bool = element(default=False, attribute=True)
    """True if results are published during the run."""
    publish_rate: float = element(default=0.1, attribute=True, minimum=0.0)
    """The shortest time between two messages with results [s]; a period, in spite of its name."""


@dataclass(frozen=True, kw_only=True)
class BenchmarkSpec(Spec):
    """The contents of a benchmark file; equal files have equal specs."""

    measures: tuple[MeasureSpec, ...]
    """The measures, in the order of the file, which is also the order of the result's columns."""
    start_on: TriggerSpec
    """The trigger of the first level."""
    stop_on: TriggerSpec
    """The trigger that ends a level before its interval is over."""
    function: FunctionSpec
    """The score."""
    scene_updater: SceneUpdaterSpec
    """The outermost scene updater, which changes the scene from level to level."""
    scene: str | None = element(default=None, attribute=True, namespaced=True)
    """The scene file, relative to the folder of this file; None: ``--scene`` names the scene."""
    algorithm: str | None = element(default=None, attribute=True, namespaced=True)
    """The algorithm under test, unless `--algorithm` names another."""
    plugin: tuple[str, ...] = element(default=(), attribute=True, namespaced=True)
    """The plugins (files with a user's measures, triggers, updaters or algorithms), separated by
    blanks, relative to the folder of this file. `uwsim check` does not run these plugins, but only
    those named with ``--plugin``."""
    mode: Literal["sequential", "independent"] | None = element(
        default=None, attribute=True, namespaced=True
    )
    """The execution of the levels; None: sequential."""
    prelude: bool = element(default=True, attribute=True, namespaced=True)
    """True if an independent level begins with a prelude: 1 s at the initial values of the
    updaters, and 1 s in which these change to the values of the level. Otherwise the values of the
    level hold from the first image on."""
    compatibility: tuple[str, ...] = element(default=(), attribute=True, namespaced=True)
    """The compatibility quirks, behaviours of the original UWSim to reproduce, separated by blanks
    (`uwsim.base.compatibility`); ``uwsim`` selects all of them except ``visual-frames``."""
    patience: float | None = element(
        default=None, attribute=True, namespaced=True, exclusive_minimum=0.0
    )
    """The timeout for the start trigger, in simulation time [s]; None: 10 s."""
    timestep: float | None = element(
        default=None, attribute=True, namespaced=True, exclusive_minimum=0.0, maximum=0.02
    )
    """The length of a physics step [s]; None: 0.002 s."""
    vary: tuple[VariationSpec, ...] = element(namespaced=True, choice=DISTRIBUTIONS, default=())
    """The values of scene updaters that are drawn at random for each seed. ``u:path`` begins with
    the name of the updater, as in ``currentForceUpdater.timeOffset``."""
    environments: tuple[EnvironmentSpec, ...] = element("environment", namespaced=True, default=())
    """The observations, actions and reward of a policy, one for each vehicle that has a policy;
    empty: the benchmark is no learning environment."""
    path: str = field(default="", compare=False, metadata={"path": True})
    """The path of the file as given by the user."""

    @property
    def environment(self) -> EnvironmentSpec | None:
        """The environment of the first vehicle that has a policy; None if there is none."""
        return self.environments[0] if self.environments else None

    @property
    def parts(self) -> tuple[MeasureSpec | TriggerSpec | SceneUpdaterSpec, ...]:
        """All measures, triggers and updaters of the file."""
        triggers = [trigger for spec in self.measures for trigger in (spec.start_on, spec.stop_on)]
        updaters = chain(self.scene_updater)
        return (*self.measures, *triggers, self.start_on, self.stop_on, *updaters)
