// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows; with WIDER, the sum of the wider levels at half the resolution; with LAMPS,
// the number of lamps: optics.glsl, lamps.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With VEIL_ONLY there
// is no level.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
#endif
#ifdef LAMPS
#include "optics.glsl"
#include "lamps.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += textureLod(level_1, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_1, 0))), 0.0).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec2 pixel = 2.0 * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
