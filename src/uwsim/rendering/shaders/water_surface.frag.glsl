// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, waves.glsl, sky.glsl, fresnel.glsl; open_water.glsl from below, transmission.glsl from above;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range.
// From below: sky refracted, open water reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#ifdef ABOVE
#include "transmission.glsl"
#else
#include "open_water.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
const float FOAM_START = 0.35;  // downward acceleration over gravity: surface/surface_pass.py
const float FOAM_END = 0.5;
#endif

#ifdef ABOVE
// True if a body under water is before a point, by at most a thickness; then texel is its pixel.
bool meets_body(vec3 offset, float range, float thickness, ivec2 size, out vec4 texel) {
    vec4 clip = clip_from_offset * vec4(offset, 1.0);
    ivec2 pixel = ivec2((clip.xy / clip.w * 0.5 + 0.5) * vec2(size));
    texel = texelFetch(surface_image, clamp(pixel, ivec2(0), size - 1), 0);
    float distance = length(offset);
    return texel.a > range && texel.a < distance && texel.a > distance - thickness && eye.x + offset.z * texel.a / distance < 0.0;
}

// Light of the water and of bodies in it below a point of the surface, in the direction of refraction. The refracted ray is followed
// within the picture: 8 depths, each 1.8 times the one before, then the depth between the last two.
vec3 refracted_light(float range, vec3 direction, vec4 texel, ivec2 size) {
    vec3 water = water_in(direction);
    float fall = 1.0 / max(-direction.z, 0.1);
    float before = 0.0;
    float way = 0.2 * fall;
    bool is_met = false;
    for (int i = 0; i < 8 && !is_met; ++i) {
        is_met = meets_body(v_offset + way * direction, range, max(way, 1.0), size, texel);
        if (!is_met) {
            before = way;
            way *= 1.8;
        }
    }
    if (!is_met) return water;
    vec4 seen = texel;
    for (int i = 0; i < 4; ++i) {
        float middle = 0.5 * (before + way);
        if (meets_body(v_offset + middle * direction, range, max(way, 1.0), size, texel)) {
            way = middle;
            seen = texel;
        } else {
            before = middle;
        }
    }
    return mix(water, seen.rgb, whole_field(way));
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, vec4 texel, ivec2 size) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec3 light = share * sky_in(mirrored);
    vec3 half_way = normalize(sky_sun.xyz - towards);
    float steep = max(half_way.z, 0.05);
    float spread = variance + 0.0625 * sky_sun.w * sky_sun.w + 0.0625 * air.z * air.z;
    vec2 apart = half_way.xy / -steep - normal.xy / -normal.z;
    float facets = exp(-0.5 * dot(apart, apart) / spread) / (2.0 * PI * spread);
    float glint = reflectance(max(-dot(half_way, towards), 0.0), 1.0 / air.y) * PI * facets;
    light += sky_sun_light.rgb * (glint / (4.0 * max(cosine, 0.05) * steep * steep * steep * steep));
    vec3 refracted = refract(towards, normal, 1.0 / air.y);
    return light + (1.0 - share) / (air.y * air.y) * refracted_light(range, refracted, texel, size);
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
    vec3 light = light_above(towards, range, normal, variance, texel, textureSize(surface_image, 0));
#ifdef FOAM
    light = mix(light, 0.5 * lit, foam);
#endif
    light_out = vec4(through_air(light, towards, range), 0.0);
#else
    vec3 light = light_below(towards, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + open_water(gl_FragCoord.xy, image_size.xy), range);
#endif
}
