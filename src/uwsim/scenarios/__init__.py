"""Scenarios made from the log of a mission: a scene, a benchmark and a recording."""

from __future__ import annotations

from .make_scenario import Scenario, make_scenario
from .request import DEFAULT_SCENE, Levels, ScenarioRequest

__all__ = ["DEFAULT_SCENE", "Levels", "Scenario", "ScenarioRequest", "make_scenario"]
