// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, surface_varyings.glsl, waves.glsl, open_water.glsl without the switch ABOVE, sky.glsl with it; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#define VARYING out
#include "surface_varyings.glsl"
#include "waves.glsl"
#ifndef ABOVE
#include "open_water.glsl"
out vec3 v_open_water;  // behind the surface; even enough to be interpolated
#endif
#ifdef ABOVE
#include "sky.glsl"
out vec4 v_haze;   // rgb: the sky at the horizon behind the air; a: the share of light that air leaves
out vec3 v_water;  // open water below the surface, even enough to be interpolated
#endif
in vec2 vertex;
out vec3 v_offset;
#if defined(WAVES) && WAVES > 1
flat out vec4 v_finer;    // xy: texture coordinates of the camera in the finer grid; z: 1 / edge [1/m]; w: its roughness
flat out vec4 v_coarser;  // those of the coarser grid
flat out ivec2 v_layers;  // their layers, or -1 for none
out float v_level;
#endif
#ifdef RIPPLES
out vec3 v_fades;  // xy: factors on the slopes of ripples; z: variance of the slopes that are left out
#endif

void main() {
    pass_on_surface();
    float variance;
    vec4 wave = waves_at(vertex, 0.0, variance);
    v_offset = vec3(vertex, wave.x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
    vec3 towards = normalize(v_offset);
    // the face of a wave may be seen at a smaller angle than the still surface
    float incidence = min(abs(dot(towards, normalize(vec3(-wave.yz, 1.0)))), max(abs(towards.z), 0.02));
    float footprint = length(v_offset) * air.z / clamp(incidence, 0.02, 1.0);
#if defined(WAVES) && WAVES > 1
    v_level = grid_level(vertex, footprint);
    int finer = int(v_level);
    v_layers = ivec2(finer < WAVES ? finer : -1, finer + 1 < WAVES ? finer + 1 : -1);
    v_finer = finer < WAVES ? vec4(grids[finer].xyz, roughness[finer]) : vec4(0.0, 0.0, 0.0, bounds.y);
    v_coarser = finer + 1 < WAVES ? vec4(grids[finer + 1].xyz, roughness[finer + 1]) : vec4(0.0, 0.0, 0.0, bounds.y);
#endif
#ifdef RIPPLES
    v_fades.z = 0.0;
    v_fades.xy = find_fades(footprint, v_fades.z);
#endif
#ifdef ABOVE
    v_haze = vec4(sky_in(vec3(towards.xy, -1.0)), exp(-air.x * length(v_offset)));
    v_water = water_in(refract(towards, vec3(0.0, 0.0, 1.0), 1.0 / air.y));
#else
    vec2 place = gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5;
    v_open_water = open_water(clamp(place, 0.0, 1.0) * image_size.xy, image_size.xy);
#endif
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
