// Provides: colour, range and id of a surface seen through water, whichever are requested.
// Needs: varyings.glsl, instance.glsl, sun.glsl, water.glsl, grey.glsl, shadow.glsl, lamplight.glsl, projection.glsl, targets.glsl, material.glsl.
// The switch ALPHA_TEST is the alpha of holes, 1..255 of 255. EMISSION and EMISSION_MAP add emitted light, under PHYSICAL only.
// The switch MIRROR leaves out what is above the still surface (2), or below it (1): surface/mirror_view.py.
// The switch OPACITY is 1..254 of 255; without it the surface is opaque. The renderer blends.
// Light, then attenuation, then fog, on stored values; noise and conversion to 8 bit follow in noise.py.
#define VARYING in
#include "varyings.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#ifdef PHYSICAL
#include "optics.glsl"
#include "daylight.glsl"
#ifdef SKY
#include "surface_block.glsl"
#include "skylight.glsl"
#endif
#else
#include "sun.glsl"
#include "water.glsl"
#endif
#include "grey.glsl"
#if defined(NORMAL_MAP) || defined(MICROFACET)
#include "material.glsl"
#endif
#ifdef EMISSION_MAP
uniform sampler2D emission_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#ifdef PROJECTOR
#include "projector.glsl"
#include "projection.glsl"
#endif
#endif
#if defined(TEXTURED) && (defined(COLOUR) || defined(ALPHA_TEST))
uniform sampler2D base_map;
#endif

void main() {
#ifdef ALPHA_TEST
    vec4 base = texture(base_map, v_uv);
    if (base.a < float(ALPHA_TEST) / 255.0) discard;
#endif
#if defined(COLOUR) || defined(RANGE)
    float range = length(v_position);
#endif
#ifdef MIRROR
    if (v_terms.z * (float(MIRROR) - 1.5) < 0.0) discard;
#endif
#ifdef COLOUR
    vec3 colour = v_base_colour;
#ifdef ALPHA_TEST
    colour *= base.rgb;
#elif defined(TEXTURED)
    colour *= texture(base_map, v_uv).rgb;
#endif
    float unit = inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
#ifdef NORMAL_MAP
    vec3 normal = mapped_normal(v_normal * unit);
    float facing = dot(normal, v_sun);
#else
    vec3 normal = v_normal * unit;
    float facing = v_terms.x * unit;
#endif
#ifdef PHYSICAL
    colour = albedo_of(colour);
#ifdef NORMAL_MAP
    float upward = dot(normal, v_up);
#else
    float upward = v_terms.w * unit;
#endif
#elif defined(NORMAL_MAP)
    float mirrored = (v_terms.y - 2.0 * facing * dot(normal, v_position)) / range;
#else
    float mirrored = (v_terms.y - 2.0 * facing * unit * dot(v_normal, v_position)) / range;
#endif
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(v_shadow_uv);
#ifdef HULLS
    sky_arrival = sky_share(v_shadow_uv, v_shadow_scale);
#endif
#endif
#if defined(PHYSICAL) && defined(CAUSTICS)
    focus_beam(v_terms.z);
#endif
#ifdef FOG_CLIP
    float fog_range = v_terms.w;
#else
    float fog_range = range;
#endif
#ifdef MICROFACET
    prepare_material(colour, normal, v_terms.z);
    vec3 dry = material_daylight(normal, facing, upward, lit, v_terms.z);
#elif defined(PHYSICAL)
    vec3 dry = colour * daylight(facing, upward, lit, v_terms.z);
#else
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#endif
#ifdef SKY
    if (v_terms.z < 0.0) dry = colour * skylight(normal, lit);
#endif
#ifdef LAMPS
    dry += lamplight(colour, normal);
#endif
#ifdef PROJECTOR
    dry = projected(dry, colour, normal);
#endif
#ifdef EMISSION
    vec3 emitted = v_emission;
#ifdef EMISSION_MAP
    emitted *= albedo_of(texture(emission_map, v_uv).rgb);
#endif
    dry += emitted;
#endif
#ifdef AIR
    float deeper = max(v_terms.z, v_camera_depth);
    float wet = clamp(deeper / max(deeper - min(v_terms.z, v_camera_depth), 1e-6), 0.0, 1.0);
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
#ifdef PHYSICAL
#ifdef OPACITY
    colour_out = vec4(dry, opacity);
#else
    colour_out = vec4(dry, water_range);  // the water follows in whole images: physical/development.py
#endif
#else
    colour_out = vec4(camera_colour(through_water(dry, water_range, fog_range, v_terms.z)), opacity);
#endif
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
