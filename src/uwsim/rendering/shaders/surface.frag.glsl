// Provides: colour, range and id of a surface seen through water, whichever are asked for.
// Needs: between.glsl, instance.glsl, sun.glsl, water.glsl, shadow.glsl, lamplight.glsl, targets.glsl.
// The switch OPACITY is 1..254 of 255, or not there: opaque; the renderer blends.
// lit -> attenuation -> fog, on stored values; noise and 8 bit come later (noise.py).
#define BETWEEN in
#include "between.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#include "sun.glsl"
#include "water.glsl"
#ifdef TEXTURED
uniform sampler2D base_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#endif

void main() {
#if defined(COLOUR) || defined(RANGE)
    float range = length(position);
#endif
#ifdef COLOUR
    vec3 colour = base;
#ifdef TEXTURED
    colour *= texture(base_map, place).rgb;
#endif
    float unit = inversesqrt(max(dot(normal, normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
    float facing = along.x * unit;
    float mirrored = (along.y - 2.0 * facing * unit * dot(normal, position)) / range;
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(shadow_place);
#endif
#ifdef FOG_CLIP
    float fog_range = along.w;
#else
    float fog_range = range;
#endif
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#ifdef LAMPS
    dry += lamplight(colour, normal * unit);
#endif
#ifdef AIR
    float deeper = max(along.z, sunk);
    float wet = clamp(deeper / max(deeper - min(along.z, sunk), 1e-6), 0.0, 1.0);
    fog_range *= wet;
    float water_range = range * wet;
#else
    float water_range = range;
#endif
#ifdef OPACITY
    float opacity = float(OPACITY) / 255.0;
#else
    float opacity = 1.0;
#endif
    colour_out = vec4(through_water(dry, water_range, fog_range, along.z), opacity);
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
