// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows, or before them with SQUARE; with WIDER, the sum of the wider levels at half the
// resolution; with LAMPS, the number of lamps: veil_varyings.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With
// VEIL_ONLY there is no level. blurred.vert.glsl has the varyings.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
noperspective in vec2 v_wider_place;
#endif
#ifdef LAMPS
#define VARYING in
#define READS_VARYINGS
#include "veil_varyings.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
noperspective in vec2 v_ray;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#elif defined(SQUARE)
    vec3 sum = square_gaussian(level_0).rgb;
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += texture(level_1, v_wider_place).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec3 ray = normalize(vec3(v_ray, -1.0));
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
