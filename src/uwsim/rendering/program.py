"""Compilation of shader files into programs, with includes, switches and a check of uniforms."""

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
    "vec4[2]": (np.float32, (2, 4)),
    "vec4[4]": (np.float32, (4, 4)),
    "mat4[4]": (np.float32, (4, 4, 4)),
}

_INCLUDE = re.compile(r'^#include "([\w.]+)"$', re.MULTILINE)
_BLOCK = re.compile(r"uniform (\w+) \{(.*?)\n\};", re.DOTALL)
_MEMBER = re.compile(r"^\s*([\w\[\]]+) (\w+);", re.MULTILINE)


class Block:
    """A uniform block (std140), as a numpy record that can be copied into its buffer.

    Args:
        name: the name of the block in the shaders.
        binding: the binding point.
        members: the type of each member, in the order of the shaders: ``vec4``, ``uvec4``, ``mat4``
            or an array of four, so that std140 needs no padding.
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
    vertex: str | None = None,
) -> moderngl.Program:
    """Compile ``effect.vert.glsl`` and ``effect.frag.glsl`` and connect every uniform.

    Args:
        context: the context of the program.
        effect: the name of the pair of shader files.
        defines: the preprocessor switches and their values.
        blocks: the uniform blocks that the shaders use; others are allowed.
        samplers: the texture unit of each sampler that the shaders may use.
        vertex: the name of the vertex shader; None: that of the effect.

    Raises:
        RuntimeError: the shaders use a uniform that is not in ``blocks`` or ``samplers``, or
            declare a block with other members.
    """
    head = VERSION + "".join(f"#define {name} {value}\n" for name, value in defines.items())
    vertices, fragments = source(f"{vertex or effect}.vert.glsl"), source(f"{effect}.frag.glsl")
    program = context.program(vertex_shader=head + vertices, fragment_shader=head + fragments)
    shader_members = {name: _members(body) for name, body in _BLOCK.findall(vertices + fragments)}
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
