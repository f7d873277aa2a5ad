// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, surface_varyings.glsl, waves.glsl, sky.glsl, fresnel.glsl; transmission.glsl from above;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range; the switch BODIES_ABOVE if one may be mirrored.
// From below: sky refracted, open water reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#define VARYING in
#define READS_VARYINGS
#include "surface_varyings.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#ifdef ABOVE
#include "transmission.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
#ifndef ABOVE
in vec3 v_open_water;
#endif
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
const float FOAM_START = 0.35;  // downward acceleration over gravity: surface/surface_pass.py
const float FOAM_END = 0.5;
#endif

#ifdef ABOVE
// Follow a ray from a point of the surface within the picture to a body above (side 1) or below (side -1) the still surface: six
// distances, each 2.2 times the one before, then two halvings. Return the way to the body, or 0; seen is its pixel. Below, the border of the picture is continued.
float follow(vec3 direction, float side, float range, ivec2 size, out vec4 seen) {
    vec4 here = clip_from_offset * vec4(v_offset, 1.0);
    vec4 change = clip_from_offset * vec4(direction, 0.0);
    float first = 0.0;
    float way = 0.25 / max(abs(direction.z), 0.1);
    float met = 0.0;
    ivec2 pixel = ivec2(0);
    for (int i = 0; i < 8; ++i) {
        vec4 clip = here + way * change;
        vec2 place = clip.xy / clip.w * 0.5 + 0.5;
        if (side > 0.0 && (clip.w <= 0.0 || place != clamp(place, 0.0, 1.0))) break;  // it does not come back
        ivec2 there = ivec2(clamp(place, 0.0, 0.9999) * vec2(size));
        float body_range = texelFetch(surface_image, there, 0).a;
        vec3 offset = v_offset + way * direction;
        float distance = length(offset);
        bool is_seen = clip.w > 0.0 && body_range > range * (0.5 - 0.5 * side)
            && body_range < distance && body_range > distance - max(way, 1.0) && side * (eye.x + offset.z * body_range / distance) > 0.0;
        if (is_seen) {
            met = way;
            pixel = there;
        }
        if (met > 0.0) {
            if (!is_seen) first = way;
            way = 0.5 * (first + met);
            if (i >= 7) break;
        } else {
            first = way;
            if (i >= 5) break;
            way *= 2.2;
        }
    }
    seen = met > 0.0 ? texelFetch(surface_image, pixel, 0) : vec4(0.0);
    return met;
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, ivec2 size) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec4 seen;
    vec3 above = sky_in(mirrored);
#ifdef BODIES_ABOVE
    if (follow(mirrored, 1.0, range, size, seen) > 0.0) above = seen.rgb;
#endif
    vec3 light = share * above;
    vec3 half_way = normalize(sky_sun.xyz - towards);
    float steep = max(half_way.z, 0.05);
    float spread = variance + 0.0625 * sky_sun.w * sky_sun.w + 0.0625 * air.z * air.z;
    vec2 apart = half_way.xy / -steep - normal.xy / -normal.z;
    float facets = exp(-0.5 * dot(apart, apart) / spread) / (2.0 * PI * spread);
    float glint = reflectance(max(-dot(half_way, towards), 0.0), 1.0 / air.y) * PI * facets;
    light += sky_sun_light.rgb * (glint / (4.0 * max(cosine, 0.05) * steep * steep * steep * steep));
    vec3 refracted = refract(towards, normal, 1.0 / air.y);
    vec3 below = water_in(refracted);
    float met = follow(refracted, -1.0, range, size, seen);
    if (met > 0.0) below = mix(below, seen.rgb, whole_field(met));
    return light + (1.0 - share) / (air.y * air.y) * below;
}

#else
// In the window the open water that is reflected counts as even, so one look-up is enough.
vec3 light_below(vec3 towards, vec3 normal, float variance) {
    float cosine = clamp(dot(towards, normal), 1e-3, 1.0);
    float share = reflectance(cosine, air.y);
    vec3 refracted = refract(towards, -normal, air.y);
    vec3 mirrored = reflect(towards, normal);
    bool is_window = share < 1.0;
    vec3 direction = is_window ? vec3(refracted.xy, max(refracted.z, 0.0)) : vec3(mirrored.xy, abs(mirrored.z));
    vec3 light = hemisphere(direction, is_window ? 0.0 : 1.0);
    if (!is_window) return light;
    float slant = dot(refracted, normal);
    float turn = (air.y * cosine - slant) / max(slant, 0.15);
    light += sun_in(refracted, turn * turn * variance + 0.5 * air.z * air.z);
    return (1.0 - share) * air.y * air.y * light + share * water_light.rgb;
}
#endif

void main() {
    float range = length(v_offset);
#ifndef DIRECT
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    if (texel.a < range) discard;
#endif
    vec3 towards = v_offset / range;
    float variance;
    float footprint = range * air.z / clamp(abs(towards.z), 0.02, 1.0);
    vec4 wave = waves_at(v_offset.xy, footprint, variance);
    vec2 slope = wave.yz;
#ifdef RIPPLES
    slope += add_ripples(v_offset.xy, footprint, variance);
#endif
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef FOAM
    float streaks = 0.0;
#ifdef RIPPLES
    streaks = foam_pattern(v_offset.xy, footprint);
#endif
    float foam = 0.9 * smoothstep(FOAM_START, FOAM_END, wave.w + streaks);
    vec3 lit = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
#endif
#ifdef ABOVE
    vec3 light = light_above(towards, range, normal, variance, textureSize(surface_image, 0));
#ifdef FOAM
    light = mix(light, 0.5 * lit, foam);
#endif
    light_out = vec4(through_air(light, towards, range), 0.0);
#else
    vec3 light = light_below(towards, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + v_open_water, range);
#endif
}
