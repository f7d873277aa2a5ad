"""Compile shader files into programs, with includes, switches and a check of the uniforms."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

import moderngl
import numpy as np

SHADERS = Path(__file__).parent / "shaders"
VERSION = "#version 330 core\n"

_SIZES = {
    "vec4": (np.float32, (4,)),
    "uvec4": (np.uint32, (4,)),
    "mat4": (np.float32, (4, 4)),
    "vec4[4]": (np.float32, (4, 4)),
    "mat4[4]": (np.float32, (4, 4, 4)),
}

_INCLUDE = re.compile(r'^#include "([\w.]+)"$', re.MULTILINE)
_BLOCK = re.compile(r"uniform (\w+) \{(.*?)\n\};", re.DOTALL)
_MEMBER = re.compile(r"^\s*([\w\[\]]+) (\w+);", re.MULTILINE)


class Block:
    """The uniform block of a shader: its members in the order of the shader.

    Members are ``vec4``, ``uvec4``, ``mat4`` or four of a kind, so that std140 needs no padding.
    """

    def __init__(self, name: str, binding: int, members: Mapping[str, str]) -> None:
        self.name, self.binding, self.members = name, binding, dict(members)
        self.dtype = np.dtype([(member, *_SIZES[kind]) for member, kind in members.items()])


def source(name: str) -> str:
    """Return the text of a shader file with its includes expanded, each file at most once."""
    included_files: set[str] = set()

    def put_in(match: re.Match[str]) -> str:
        return expand(match[1])

    def expand(file: str) -> str:
        if file in included_files:
            return ""
        included_files.add(file)
        return _INCLUDE.sub(put_in, (SHADERS / file).read_text(encoding="utf-8"))

    return expand(name)


def build(
    context: moderngl.Context,
    effect: str,
    *,
    defines: Mapping[str, int],
    blocks: Iterable[Block],
    samplers: Mapping[str, int],
) -> moderngl.Program:
    """Compile ``effect.vert.glsl`` and ``effect.frag.glsl`` and connect every uniform.

    Args:
        context: The context of the program.
        effect: Name of the pair of shader files.
        defines: Preprocessor switches and their values.
        blocks: The uniform blocks of the effect; at least those that it uses.
        samplers: Texture unit of each sampler it may use.

    Raises:
        RuntimeError: the shader uses a uniform that no block declares, or declares a block
            otherwise than the program that fills it.
    """
    head = VERSION + "".join(f"#define {name} {value}\n" for name, value in defines.items())
    vertex, fragment = source(f"{effect}.vert.glsl"), source(f"{effect}.frag.glsl")
    program = context.program(vertex_shader=head + vertex, fragment_shader=head + fragment)
    shader_members = {name: _members(body) for name, body in _BLOCK.findall(vertex + fragment)}
    blocks_by_name = {block.name: block for block in blocks}
    for name in program:
        uniform = program[name]
        if isinstance(uniform, moderngl.UniformBlock):
            block = blocks_by_name.get(name)
            if block is None or shader_members.get(name) != list(block.members.items()):
                raise RuntimeError(f"{effect}: block {name} is not what the program declares")
            uniform.binding = block.binding
        elif isinstance(uniform, moderngl.Uniform):
            if name not in samplers:
                raise RuntimeError(f"{effect}: no block declares the uniform {name!r}")
            uniform.value = samplers[name]
    return program


def _members(body: str) -> list[tuple[str, str]]:
    return [(name, kind) for kind, name in _MEMBER.findall(body)]
