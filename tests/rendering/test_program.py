"""Shader files: includes, and that nothing undeclared slips through."""

from __future__ import annotations

import moderngl
import pytest

from uwsim.errors import NoGraphics
from uwsim.rendering import program
from uwsim.rendering.context import create_context
from uwsim.rendering.frame import FRAME
from uwsim.rendering.instance import INSTANCE
from uwsim.rendering.program import Block, build, source
from uwsim.rendering.renderer import SAMPLERS, Renderer

PLACES = {"COLOUR": 0, "SHADOWS": 1, "TEXTURED": 1}


@pytest.fixture
def context() -> moderngl.Context:
    context = create_context()
    yield context
    context.release()


def test_an_include_is_put_in_once() -> None:
    text = source("surface.vert.glsl")
    assert "#include" not in text
    assert text.count("uniform Frame {") == 1


@pytest.mark.parametrize("file", sorted(p.name for p in program.SHADERS.iterdir()))
def test_every_shader_says_what_it_provides_and_needs(file: str) -> None:
    head = (program.SHADERS / file).read_text(encoding="utf-8").splitlines()[:3]
    assert head[0].startswith("// Provides: ")
    assert head[1].startswith("// Needs: ")
    assert head[2].startswith("// ")


def test_a_uniform_that_nobody_declares_is_an_error(context: moderngl.Context) -> None:
    with pytest.raises(RuntimeError, match="no block declares the uniform 'shadow_map'"):
        build(
            context,
            "surface",
            defines=PLACES,
            blocks=(FRAME, INSTANCE),
            samplers={"base_map": SAMPLERS["base_map"]},
        )


def test_a_block_declared_in_another_order_is_an_error(context: moderngl.Context) -> None:
    members = dict(reversed(FRAME.members.items()))
    with pytest.raises(RuntimeError, match="block Frame is not what the program declares"):
        build(
            context,
            "surface",
            defines=PLACES,
            blocks=(Block("Frame", 0, members), INSTANCE),
            samplers=SAMPLERS,
        )


def test_no_graphics_says_in_one_line_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(**settings: object) -> None:
        raise Exception("libEGL.so not loaded")

    monkeypatch.setattr(moderngl, "create_context", refuse)
    with pytest.raises(NoGraphics, match="apt-get install libegl1 libgl1 libgl1-mesa-dri") as why:
        Renderer()
    assert "\n" not in str(why.value)
