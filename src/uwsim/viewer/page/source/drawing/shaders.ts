// The shaders of uwsim.rendering, compiled for WebGL 2, as in uwsim.rendering.program.
import backgroundFragment from "../../../../rendering/shaders/background.frag.glsl";
import backgroundVertex from "../../../../rendering/shaders/background.vert.glsl";
import daylight from "../../../../rendering/shaders/daylight.glsl";
import frame from "../../../../rendering/shaders/frame.glsl";
import grey from "../../../../rendering/shaders/grey.glsl";
import instance from "../../../../rendering/shaders/instance.glsl";
import lamplight from "../../../../rendering/shaders/lamplight.glsl";
import lamps from "../../../../rendering/shaders/lamps.glsl";
import material from "../../../../rendering/shaders/material.glsl";
import optics from "../../../../rendering/shaders/optics.glsl";
import projection from "../../../../rendering/shaders/projection.glsl";
import projector from "../../../../rendering/shaders/projector.glsl";
import shadowFragment from "../../../../rendering/shaders/shadow.frag.glsl";
import shadow from "../../../../rendering/shaders/shadow.glsl";
import shadowVertex from "../../../../rendering/shaders/shadow.vert.glsl";
import sun from "../../../../rendering/shaders/sun.glsl";
import surfaceFragment from "../../../../rendering/shaders/surface.frag.glsl";
import surfaceVertex from "../../../../rendering/shaders/surface.vert.glsl";
import targets from "../../../../rendering/shaders/targets.glsl";
import varyings from "../../../../rendering/shaders/varyings.glsl";
import water from "../../../../rendering/shaders/water.glsl";

const FILES: Record<string, string> = {
  "background.frag.glsl": backgroundFragment,
  "background.vert.glsl": backgroundVertex,
  "daylight.glsl": daylight,
  "frame.glsl": frame,
  "grey.glsl": grey,
  "instance.glsl": instance,
  "lamplight.glsl": lamplight,
  "lamps.glsl": lamps,
  "material.glsl": material,
  "optics.glsl": optics,
  "projection.glsl": projection,
  "projector.glsl": projector,
  "shadow.frag.glsl": shadowFragment,
  "shadow.glsl": shadow,
  "shadow.vert.glsl": shadowVertex,
  "sun.glsl": sun,
  "surface.frag.glsl": surfaceFragment,
  "surface.vert.glsl": surfaceVertex,
  "targets.glsl": targets,
  "varyings.glsl": varyings,
  "water.glsl": water,
};

const SHADER_HEADER = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
`;
/** The binding of each uniform block. */
export const BLOCKS: Record<string, number> = { Frame: 0, Instance: 1, Lamps: 2, Projector: 3 };
/** The texture unit of each sampler. */
export const UNITS: Record<string, number> = {
  base_map: 0,
  shadow_map: 1,
  lamp_maps: 2,
  projector_map: 3,
  projector_pattern: 4,
};
/** The location of each attribute. */
export const ATTRIBUTES: Record<string, number> = { vertex: 0, vertex_normal: 1, uv: 2, tint: 3 };

/** The preprocessor macros of a program, by name. */
export type Switches = Record<string, number>;

/** The programs that have been compiled so far. */
export class Programs {
  private readonly programs = new Map<string, WebGLProgram>();

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Return the program EFFECT.vert.glsl, EFFECT.frag.glsl with some macros. */
  get(effect: string, switches: Switches): WebGLProgram {
    const key = effect + JSON.stringify(switches);
    let program = this.programs.get(key);
    if (!program) this.programs.set(key, (program = build(this.gl, effect, switches)));
    return program;
  }
}

/** Return the text of a shader file with its `#include` lines replaced; each file is included once. */
function source(file: string, includes: Set<string>): string {
  if (includes.has(file)) return "";
  includes.add(file);
  const text = FILES[file];
  if (text === undefined) throw new Error(`no shader file ${file}`);
  return text.replace(/^#include "([\w.]+)"$/gm, (_, name: string) => source(name, includes));
}

/** Compile and link a program. */
function build(gl: WebGL2RenderingContext, effect: string, switches: Switches): WebGLProgram {
  const defines = Object.entries(switches).map(([name, value]) => `#define ${name} ${value}\n`);
  const program = gl.createProgram();
  for (const [kind, end] of [
    [gl.VERTEX_SHADER, "vert"],
    [gl.FRAGMENT_SHADER, "frag"],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, SHADER_HEADER + defines.join("") + source(`${effect}.${end}.glsl`, new Set()));
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  for (const [name, location] of Object.entries(ATTRIBUTES)) gl.bindAttribLocation(program, location, name);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    const logs = (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`${effect}: ${gl.getProgramInfoLog(program)} ${logs.join(" ")}`);
  }
  gl.useProgram(program);
  for (const [name, binding] of Object.entries(BLOCKS)) {
    const index = gl.getUniformBlockIndex(program, name);
    if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, index, binding);
  }
  for (const [name, unit] of Object.entries(UNITS))
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  return program;
}
