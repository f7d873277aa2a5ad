// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: blur_weight.glsl with BLUR, else optics.glsl and transmission.glsl; open_water.glsl, grey.glsl, developed.vert.glsl; the image of
// the surfaces; with SCATTERED, the sum of the levels; with PARTICLES, the image of the particles; with SHAFTS, the edge of a texel [px],
// that of the shafts; the switches DRY for an image without water before the surfaces, LINEAR for no curve, LIGHT for no exposure either.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#define VARYING in
#define READS_VARYINGS
#include "optics.glsl"
#include "open_water.glsl"
#include "grey.glsl"
#ifdef BLUR
#include "blur_weight.glsl"
#else
#include "transmission.glsl"
#endif
uniform sampler2D surface_image;
flat in float v_exposure;
noperspective in vec2 v_water_place;
#ifdef SCATTERED
noperspective in vec2 v_level_place;
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
#ifdef SHAFTS
noperspective in vec2 v_shaft_place;
uniform sampler2D shaft_image;
#endif
#ifdef CLOUDS
#include "clouds.glsl"
#include "cloud_edge.glsl"
uniform sampler2D cloud_layers_map;
uniform sampler2D cloud_lamplight_map;
uniform sampler2D cloud_daylight_map;

vec3 through_clouds(vec3 light, vec3 water, float range) {
    vec2 place = gl_FragCoord.xy / (float(CLOUD_EDGE) * vec2(textureSize(cloud_layers_map, 0)));
    vec4 layers = textureLod(cloud_layers_map, place, 0.0);
    vec4 lamplight = textureLod(cloud_lamplight_map, place, 0.0);
    vec3 daylight = textureLod(cloud_daylight_map, place, 0.0).rgb;
    vec4 shares = clamp((range - cloud_layers.x) / cloud_layers.y - vec4(0.0, 0.0, 1.0, 2.0), 0.0, 1.0);
    float depth = layers.x + dot(shares.yzw, layers.yzw - layers.xyz);
    vec3 mean = 1.0 / max(vec3(lamplight.a), 1e-6);
    vec3 veil = mean * lamplight.rgb * ((1.0 - exp(-LOSS_SHARE * depth)) / LOSS_SHARE);
    return mix(water + mean * daylight, light, exp(-depth)) + veil;
}
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 texel = texelFetch(surface_image, pixel, 0);
#ifdef DRY
    vec3 light = texel.rgb;
#else
    vec3 water = texture(open_water_map, v_water_place).rgb;
    vec3 light = water;
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    float seen = 1.0 - min(particles.a, 1.0);
#else
    const float seen = 1.0;
#endif
#ifdef SHAFTS
    light += seen * texture(shaft_image, v_shaft_place).rgb;
#endif
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    excess *= seen;
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    vec3 scattered = texture(level_0, v_level_place).rgb;
#ifdef PARTICLES
    // what dark surfaces take from the water is behind the particles; the veil is mostly in front of them
    scattered = max(scattered, 0.0) + seen * min(scattered, 0.0);
#endif
    light += scattered;
#endif
#ifdef CLOUDS
    light = through_clouds(light, water, is_surface > 0.5 ? range : FAR);
#endif
#endif
#ifdef LIGHT
    colour_out = vec4(light, 1.0);
#else
    vec3 value = clamp(light * v_exposure, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(camera_colour(value), 1.0);
#endif
}
