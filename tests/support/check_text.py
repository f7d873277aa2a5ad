"""Check a scene by the rules that open no other file."""

from __future__ import annotations

from pathlib import Path

from uwsim.checks.robots import robot_locations
from uwsim.checks.rule import Need
from uwsim.checks.scene.models import model_files, projectors
from uwsim.checks.subjects import CheckedScene
from uwsim.checks.table import SCENE_RULES
from uwsim.errors import Diagnostic
from uwsim.scene.reader import read_document
from uwsim.scene.xacro import parse_expanded
from uwsim.schema import Diagnostics

FILE_RULES = (robot_locations, projectors, model_files)


def check_text(path: Path) -> list[Diagnostic]:
    """Return the diagnostics of the reader and of the spec's rules for a scene without robots."""
    diagnostics = Diagnostics(path)
    document = parse_expanded(path)
    spec = read_document(document, diagnostics)
    assert spec is not None
    scene = CheckedScene(spec, (), document=document, diagnostics=diagnostics, parts=({}, {}))
    for rule in SCENE_RULES:
        if rule.in_check and rule.need is Need.SPEC and rule.find not in FILE_RULES:
            diagnostics.extend(rule.find(scene))
    return diagnostics.to_list()
