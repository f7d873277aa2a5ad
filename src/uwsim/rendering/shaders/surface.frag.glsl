// Provides: colour, range and id of a surface seen through water, whichever are asked for.
// Needs: frame.glsl, instance.glsl, sun.glsl, water.glsl, shadow.glsl, targets.glsl.
// lit -> attenuation -> fog, on stored values; noise and 8 bit come later (noise.py).
#include "frame.glsl"
#include "instance.glsl"
#include "targets.glsl"

in vec3 position;
#ifdef COLOUR
#include "sun.glsl"
#include "water.glsl"
in vec3 surface_normal;
flat in vec3 surface_tint;
#ifdef TEXTURED
uniform sampler2D base_map;
in vec2 surface_uv;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
in vec3 shadow_place;
#endif
#endif

void main() {
#if defined(COLOUR) || defined(RANGE)
    float range = length(position);
#endif
#ifdef COLOUR
    vec3 base = surface_tint;
#ifdef TEXTURED
    base *= texture(base_map, surface_uv).rgb;
#endif
    vec3 outward = normalize(gl_FrontFacing ? surface_normal : -surface_normal);
#ifdef SHADOWS
    float lit = sun_share(shadow_place);
#else
    float lit = 1.0;
#endif
    vec3 dry = sunlit(base, outward, position / -range, lit);
    colour_out = vec4(through_water(dry, range, position), 1.0);
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
