// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: optics.glsl, transmission.glsl, open_water.glsl; the image of the surfaces; with SCATTERED, the sum of the
// levels; with PARTICLES, the image of the particles; the switches BLUR, and LINEAR for no curve.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
#ifdef SCATTERED
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(surface_image, 0);
    vec4 texel = texelFetch(surface_image, pixel, 0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(size));
    vec3 light = water;
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = direct(range) + weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    excess *= 1.0 - min(particles.a, 1.0);
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    light += textureLod(level_0, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_0, 0))), 0.0).rgb;
#endif
    vec3 value = clamp(light * camera.y, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(value, 1.0);
}
