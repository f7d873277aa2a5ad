// Provides: the radiance and the range in water of the water's surface, from below, or with the switch ABOVE from above.
// Needs: optics.glsl, surface_block.glsl, surface_varyings.glsl, waves.glsl, sky.glsl, fresnel.glsl, foam.glsl; transmission.glsl from above and for MIRROR;
// without the switch DIRECT, the image of the surfaces, whose alpha is the whole range; the switch MIRROR for the image of bodies that a still surface mirrors,
// or BODIES_ABOVE to look for them in the picture.
// From below: sky refracted, open water and bodies reflected; the water before it follows in whole images (physical/development.py), which
// takes the open water B behind it away. From above: sky reflected, the water and the bodies in it refracted. See surface_pass.py.
#include "optics.glsl"
#include "surface_block.glsl"
#define VARYING in
#define READS_VARYINGS
#include "surface_varyings.glsl"
#include "waves.glsl"
#include "sky.glsl"
#include "fresnel.glsl"
#if defined(ABOVE) || defined(MIRROR)
#include "transmission.glsl"
#endif
#ifndef DIRECT
uniform sampler2D surface_image;
#endif
in vec3 v_offset;
#ifdef ABOVE
in vec4 v_haze;
in vec3 v_water;
#else
in vec3 v_open_water;
#endif
#if defined(WAVES) && WAVES > 1
flat in vec4 v_finer;
flat in vec4 v_coarser;
flat in ivec2 v_layers;
in float v_level;
#endif
#ifdef RIPPLES
in vec3 v_fades;
#endif
out vec4 light_out;
const float PI = 3.14159265;
#ifdef FOAM
#include "foam.glsl"
#endif

vec3 clip_of(vec3 offset) {
    return vec3(dot(v_clip[0], offset), dot(v_clip[1], offset), dot(v_clip[2], offset));
}

vec2 place_of(vec3 clip) {
    return clip.xy / max(clip.z, 1e-3) * 0.5 + 0.5;
}

#ifdef MIRROR
uniform sampler2D mirror_image;

vec4 mirror_texel(vec2 place) {
    vec2 size = vec2(textureSize(mirror_image, 0));
    return texelFetch(mirror_image, ivec2(clamp(vec2(place.x, 1.0 - place.y) * size, vec2(0.0), size - 1.0)), 0);
}

// The body that a reflected ray meets, or FAR: its radiance and the way to it. The image is that of a still surface
// (surface/mirror_view.py); the way to the body there, or to one near by, is that along the ray.
vec4 mirrored_body(vec3 direction, float range) {
    vec2 here = gl_FragCoord.xy / v_numbers.yz;
    float way = mirror_texel(here).a - range;
    way = way < 0.5 * FAR ? max(way, 0.1) : 6.0;
    vec3 point = v_offset + way * direction;
    vec2 place = place_of(clip_of(vec3(point.xy, -2.0 * v_numbers.x - point.z)));
    vec4 seen = mirror_texel(place);
    seen.a = seen.a < 0.5 * FAR ? max(seen.a - range, 0.1) : FAR;
    return seen;
}
#endif

#if defined(ABOVE) && defined(BODIES_ABOVE)
// Follow a reflected ray within the picture to a body above the still surface: six distances, each 2.2 times the one before,
// then two halvings. Return its radiance and the way to it, or FAR.
vec4 followed_body(vec3 direction, float range) {
    vec3 here = clip_of(v_offset);
    vec3 change = clip_of(direction);
    float first = 0.0;
    float way = 0.25 / max(abs(direction.z), 0.1);
    float met = FAR;
    ivec2 pixel = ivec2(0);
    for (int i = 0; i < 8; ++i) {
        vec3 clip = here + way * change;
        vec2 place = clip.xy / clip.z * 0.5 + 0.5;
        if (clip.z <= 0.0 || place != clamp(place, 0.0, 1.0)) break;  // it does not come back
        ivec2 there = ivec2(clamp(place, 0.0, 0.9999) * v_numbers.yz);
        float body_range = texelFetch(surface_image, there, 0).a;
        vec3 offset = v_offset + way * direction;
        float distance = length(offset);
        bool is_seen = body_range < distance && body_range > distance - max(way, 1.0) && v_numbers.x + offset.z * body_range / distance > 0.0;
        if (is_seen) {
            met = way;
            pixel = there;
        }
        if (met < FAR) {
            if (!is_seen) first = way;
            way = 0.5 * (first + met);
            if (i >= 7) break;
        } else {
            first = way;
            if (i >= 5) break;
            way *= 2.2;
        }
    }
    return vec4(met < FAR ? texelFetch(surface_image, pixel, 0).rgb : vec3(0.0), met);
}
#endif

#ifdef ABOVE
// The body that a refracted ray meets, or FAR: its radiance and the way to it. It is looked for at the depth of the
// body behind the surface, then where the body found there is. Hidden bodies are replaced by that behind the surface.
vec4 refracted_body(vec3 direction, vec3 towards, float range, vec4 straight) {
    vec3 here = clip_of(v_offset);
    vec3 change = clip_of(direction);
    float steep = max(-direction.z, 0.2);
    bool has_straight = straight.a < 0.5 * FAR;
    float way = has_straight ? max(straight.a - range, 0.0) * max(-towards.z, 0.0) / steep : 3.0;
    vec4 seen = vec4(straight.rgb, has_straight ? way : FAR);
    for (int i = 0; i < 2; ++i) {
        vec2 place = place_of(here + way * change);
        vec4 body = texelFetch(surface_image, ivec2(clamp(place, 0.0, 0.9999) * v_numbers.yz), 0);
        vec3 point = v_offset + way * direction;
        float distance = length(point);
        float height = point.z / distance;
        if (body.a < range || body.a > 0.5 * FAR || v_numbers.x + height * body.a > 0.0) break;
        way = max(way + (body.a - distance) * max(-height, 0.05) / steep, 0.0);
        // Towards the edges of the picture, outside of which nothing is known, the body behind the surface replaces it.
        vec2 inside = min(place, 1.0 - place);
        float known = has_straight ? clamp(12.0 * min(inside.x, inside.y), 0.0, 1.0) : 1.0;
        seen = vec4(mix(straight.rgb, body.rgb, known), way);
    }
    return seen;
}

vec3 light_above(vec3 towards, float range, vec3 normal, float variance, vec4 straight) {
    float cosine = max(-dot(towards, normal), 0.0);
    float share = reflectance(sqrt(min(cosine * cosine + 0.5 * variance, 1.0)), 1.0 / air.y);
    vec3 mirrored = reflect(towards, normal);
    mirrored = normalize(vec3(mirrored.xy, abs(mirrored.z) + 0.5 * sqrt(variance)));
    vec3 above = sky_in(mirrored);
#if defined(MIRROR) || defined(BODIES_ABOVE)
#ifdef MIRROR
    vec4 reflected = mirrored_body(mirrored, range);
#else
    vec4 reflected = followed_body(mirrored, range);
#endif
    if (reflected.a < 0.5 * FAR) above = reflected.rgb;
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
    vec3 below = v_water;
    vec4 body = refracted_body(refracted, towards, range, straight);
    if (body.a < 0.5 * FAR) below = mix(below, body.rgb, whole_field(body.a));
    return light + (1.0 - share) / (air.y * air.y) * below;
}

#else
// In the window the open water that is reflected counts as even, so one look-up is enough.
vec3 light_below(vec3 towards, float range, vec3 normal, float variance) {
    float cosine = clamp(dot(towards, normal), 1e-3, 1.0);
    float share = reflectance(cosine, air.y);
    vec3 refracted = refract(towards, -normal, air.y);
    vec3 mirrored = reflect(towards, normal);
    bool is_window = share < 1.0;
    vec3 direction = is_window ? vec3(refracted.xy, max(refracted.z, 0.0)) : vec3(mirrored.xy, abs(mirrored.z));
    vec3 light = hemisphere(direction, is_window ? 0.0 : 1.0);
    if (!is_window) {
#ifdef MIRROR
        vec4 body = mirrored_body(vec3(mirrored.xy, -abs(mirrored.z)), range);
        if (body.a < 0.5 * FAR) light = mix(light, body.rgb, whole_field(body.a));
#endif
        return light;
    }
    float slant = dot(refracted, normal);
    float turn = (air.y * cosine - slant) / max(slant, 0.15);
    light += sun_in(refracted, turn * turn * variance + 0.5 * air.z * air.z);
    return (1.0 - share) * air.y * air.y * light + share * water_light.rgb;
}
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity; variance of the slopes that are left out.
vec4 waves_here(out float variance) {
#if defined(WAVES) && WAVES > 1
    float share = smoothstep(0.5, 1.0, v_level - float(v_layers.x < 0 ? WAVES : v_layers.x));
    variance = mix(v_finer.w, v_coarser.w, share);
    vec4 wave = vec4(0.0);
    if (v_layers.x >= 0) wave = (1.0 - share) * textureLod(wave_grids, vec3(v_finer.xy + v_offset.xy * v_finer.z, float(v_layers.x)), 0.0);
    if (share > 0.0 && v_layers.y >= 0) wave += share * textureLod(wave_grids, vec3(v_coarser.xy + v_offset.xy * v_coarser.z, float(v_layers.y)), 0.0);
    return wave;
#else
    return waves_at(v_offset.xy, 0.0, variance);
#endif
}

void main() {
    float range = length(v_offset);
#ifndef DIRECT
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    if (texel.a < range) discard;
#endif
    vec3 towards = v_offset / range;
    float variance;
    vec4 wave = waves_here(variance);
    vec2 slope = wave.yz;
#ifdef RIPPLES
    if (v_fades.x > 0.0) slope += ripples_at(v_offset.xy, v_fades.xy);
    variance += v_fades.z;
#endif
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef FOAM
#ifdef RIPPLES
    vec2 foam_place = ripple_origin.xy + v_offset.xy;
#else
    vec2 foam_place = v_offset.xy;
#endif
    float foam = 0.9 * foam_cover(wave.w, foam_place, range * air.z / clamp(abs(towards.z), 0.02, 1.0));
    vec3 lit = sky_light.rgb + sky_sun_light.rgb * max(dot(normal, sky_sun.xyz), 0.0);
#endif
#ifdef ABOVE
    vec3 light = light_above(towards, range, normal, variance, texel);
#ifdef FOAM
    light = mix(light, (0.3 + 0.25 * foam) * lit, foam);  // thick foam is whiter than thin foam
#endif
    light_out = vec4(mix(v_haze.rgb, light, v_haze.a), 0.0);
#else
    vec3 light = light_below(towards, range, normal, variance);
#ifdef FOAM
    light = mix(light, 0.3 * lit, foam);
#endif
    light_out = vec4(light + v_open_water, range);
#endif
}
