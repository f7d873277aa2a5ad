// The shaders of uwsim.rendering, compiled for WebGL 2, as in uwsim.rendering.program.
import backgroundFragment from "../../../../rendering/shaders/background.frag.glsl";
import backgroundVertex from "../../../../rendering/shaders/background.vert.glsl";
import blurWeight from "../../../../rendering/shaders/blur_weight.glsl";
import blurredFragment from "../../../../rendering/shaders/blurred.frag.glsl";
import blurredRowsFragment from "../../../../rendering/shaders/blurred_rows.frag.glsl";
import blurredVertex from "../../../../rendering/shaders/blurred.vert.glsl";
import caustics from "../../../../rendering/shaders/caustics.glsl";
import causticsBlock from "../../../../rendering/shaders/caustics_block.glsl";
import daylight from "../../../../rendering/shaders/daylight.glsl";
import cloudFragment from "../../../../rendering/shaders/cloud.frag.glsl";
import cloudVertex from "../../../../rendering/shaders/cloud.vert.glsl";
import cloudEdge from "../../../../rendering/shaders/cloud_edge.glsl";
import clouds from "../../../../rendering/shaders/clouds.glsl";
import developedFragment from "../../../../rendering/shaders/developed.frag.glsl";
import developedVertex from "../../../../rendering/shaders/developed.vert.glsl";
import frame from "../../../../rendering/shaders/frame.glsl";
import gaussian from "../../../../rendering/shaders/gaussian.glsl";
import grey from "../../../../rendering/shaders/grey.glsl";
import instance from "../../../../rendering/shaders/instance.glsl";
import lampPointFragment from "../../../../rendering/shaders/lamp_point.frag.glsl";
import lampPointVertex from "../../../../rendering/shaders/lamp_point.vert.glsl";
import lampVeil from "../../../../rendering/shaders/lamp_veil.glsl";
import lamplight from "../../../../rendering/shaders/lamplight.glsl";
import lamps from "../../../../rendering/shaders/lamps.glsl";
import lightShaftsFragment from "../../../../rendering/shaders/light_shafts.frag.glsl";
import material from "../../../../rendering/shaders/material.glsl";
import openWater from "../../../../rendering/shaders/open_water.glsl";
import optics from "../../../../rendering/shaders/optics.glsl";
import projection from "../../../../rendering/shaders/projection.glsl";
import projector from "../../../../rendering/shaders/projector.glsl";
import reducedFragment from "../../../../rendering/shaders/reduced.frag.glsl";
import scatteredFragment from "../../../../rendering/shaders/scattered.frag.glsl";
import scatteredVertex from "../../../../rendering/shaders/scattered.vert.glsl";
import screenVertex from "../../../../rendering/shaders/screen.vert.glsl";
import shadowFragment from "../../../../rendering/shaders/shadow.frag.glsl";
import shadow from "../../../../rendering/shaders/shadow.glsl";
import shadowVertex from "../../../../rendering/shaders/shadow.vert.glsl";
import sun from "../../../../rendering/shaders/sun.glsl";
import surfaceFragment from "../../../../rendering/shaders/surface.frag.glsl";
import surfaceVertex from "../../../../rendering/shaders/surface.vert.glsl";
import targets from "../../../../rendering/shaders/targets.glsl";
import transmission from "../../../../rendering/shaders/transmission.glsl";
import varyings from "../../../../rendering/shaders/varyings.glsl";
import veilVaryings from "../../../../rendering/shaders/veil_varyings.glsl";
import water from "../../../../rendering/shaders/water.glsl";
import particleFragment from "../../../../rendering/shaders/particle.frag.glsl";
import particleVertex from "../../../../rendering/shaders/particle.vert.glsl";
import particleLens from "../../../../rendering/shaders/particle_lens.glsl";
import airFragment from "../../../../rendering/shaders/air.frag.glsl";
import foam from "../../../../rendering/shaders/foam.glsl";
import fresnel from "../../../../rendering/shaders/fresnel.glsl";
import sky from "../../../../rendering/shaders/sky.glsl";
import skylight from "../../../../rendering/shaders/skylight.glsl";
import surfaceBlock from "../../../../rendering/shaders/surface_block.glsl";
import surfaceVaryings from "../../../../rendering/shaders/surface_varyings.glsl";
import waterSurfaceFragment from "../../../../rendering/shaders/water_surface.frag.glsl";
import waterSurfaceVertex from "../../../../rendering/shaders/water_surface.vert.glsl";
import waves from "../../../../rendering/shaders/waves.glsl";
import presentedFragment from "./presented.frag.glsl";
import presentedVertex from "./presented.vert.glsl";
import waveGridFragment from "../water/surface/wave_grid.frag.glsl";

const FILES: Record<string, string> = {
  "background.frag.glsl": backgroundFragment,
  "background.vert.glsl": backgroundVertex,
  "blur_weight.glsl": blurWeight,
  "blurred.frag.glsl": blurredFragment,
  "blurred_rows.frag.glsl": blurredRowsFragment,
  "blurred.vert.glsl": blurredVertex,
  "caustics.glsl": caustics,
  "caustics_block.glsl": causticsBlock,
  "cloud.frag.glsl": cloudFragment,
  "cloud.vert.glsl": cloudVertex,
  "cloud_edge.glsl": cloudEdge,
  "clouds.glsl": clouds,
  "daylight.glsl": daylight,
  "developed.frag.glsl": developedFragment,
  "developed.vert.glsl": developedVertex,
  "frame.glsl": frame,
  "gaussian.glsl": gaussian,
  "grey.glsl": grey,
  "instance.glsl": instance,
  "lamp_point.frag.glsl": lampPointFragment,
  "lamp_point.vert.glsl": lampPointVertex,
  "lamp_veil.glsl": lampVeil,
  "lamplight.glsl": lamplight,
  "lamps.glsl": lamps,
  "light_shafts.frag.glsl": lightShaftsFragment,
  "material.glsl": material,
  "open_water.glsl": openWater,
  "optics.glsl": optics,
  "particle.frag.glsl": particleFragment,
  "particle.vert.glsl": particleVertex,
  "particle_lens.glsl": particleLens,
  "presented.frag.glsl": presentedFragment,
  "presented.vert.glsl": presentedVertex,
  "projection.glsl": projection,
  "projector.glsl": projector,
  "reduced.frag.glsl": reducedFragment,
  "scattered.frag.glsl": scatteredFragment,
  "scattered.vert.glsl": scatteredVertex,
  "screen.vert.glsl": screenVertex,
  "shadow.frag.glsl": shadowFragment,
  "shadow.glsl": shadow,
  "shadow.vert.glsl": shadowVertex,
  "sun.glsl": sun,
  "surface.frag.glsl": surfaceFragment,
  "surface.vert.glsl": surfaceVertex,
  "targets.glsl": targets,
  "transmission.glsl": transmission,
  "varyings.glsl": varyings,
  "veil_varyings.glsl": veilVaryings,
  "water.glsl": water,
  "air.frag.glsl": airFragment,
  "foam.glsl": foam,
  "fresnel.glsl": fresnel,
  "sky.glsl": sky,
  "skylight.glsl": skylight,
  "surface_block.glsl": surfaceBlock,
  "surface_varyings.glsl": surfaceVaryings,
  "water_surface.frag.glsl": waterSurfaceFragment,
  "water_surface.vert.glsl": waterSurfaceVertex,
  "waves.glsl": waves,
  "wave_grid.frag.glsl": waveGridFragment,
};

const SHADER_HEADER = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
#define noperspective
`;
/** The binding of each uniform block. */
export const BLOCKS: Record<string, number> = { Frame: 0, Instance: 1, Lamps: 2, Projector: 3, Optics: 4, Caustics: 5, Surface: 7, ParticleLens: 9, Clouds: 10 };
/** The texture unit of each sampler. */
export const UNITS: Record<string, number> = {
  base_map: 0,
  shadow_map: 1,
  lamp_maps: 2,
  projector_map: 3,
  projector_pattern: 4,
  open_water_map: 5,
  weight_table: 6,
  level_0: 7,
  level_1: 8,
  level_2: 9,
  level_3: 10,
  level_4: 15,
  level_5: 16,
  surface_image: 17,
  normal_map: 11,
  finish_map: 12,
  emission_map: 13,
  reflectance_table: 14,
  particle_image: 18,
  wave_grids: 19,
  wave_grid: 20,
  ripple_tile: 21,
  hemispheres: 22,
  factors_x: 23,
  factors_y: 24,
  cloud_layers_map: 25,
  cloud_lamplight_map: 26,
  cloud_daylight_map: 27,
  caustic_maps: 28,
  swell_map: 29,
  shaft_image: 30,
  mirror_image: 31,
};
/** The location of each attribute. */
export const ATTRIBUTES: Record<string, number> = {
  vertex: 0, vertex_normal: 1, uv: 2, tint: 3, tangent: 4, finish: 5, emission: 6, place: 8, extent: 9, traits: 10, depth: 11,
};

/** The preprocessor macros of a program, by name. */
export type Switches = Record<string, number | string>;

/** The programs that have been compiled so far. */
export class Programs {
  private readonly programs = new Map<string, WebGLProgram>();

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Return the program VERTEX.vert.glsl, EFFECT.frag.glsl with some macros. */
  get(effect: string, switches: Switches, vertex = effect): WebGLProgram {
    const key = effect + JSON.stringify(switches);
    let program = this.programs.get(key);
    if (!program) this.programs.set(key, (program = build(this.gl, effect, switches, vertex)));
    return program;
  }
}

/** Return the text of a shader file with its `#include` lines replaced; each file is included once. */
function source(file: string, includes: Set<string>): string {
  if (includes.has(file)) return "";
  includes.add(file);
  const text = FILES[file];
  if (text === undefined) return `#error no shader file ${file}`; // it has no effect behind a switch that is not set
  return text.replace(/^#include "([\w.]+)"$/gm, (_, name: string) => source(name, includes));
}

/** Compile and link a program. */
function build(gl: WebGL2RenderingContext, effect: string, switches: Switches, vertex: string): WebGLProgram {
  const defines = Object.entries(switches).map(([name, value]) => `#define ${name} ${value}\n`);
  const program = gl.createProgram();
  for (const [kind, file] of [
    [gl.VERTEX_SHADER, `${vertex}.vert.glsl`],
    [gl.FRAGMENT_SHADER, `${effect}.frag.glsl`],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, SHADER_HEADER + defines.join("") + source(file, new Set()));
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
