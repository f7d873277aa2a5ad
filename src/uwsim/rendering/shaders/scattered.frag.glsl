// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
// Needs: optics.glsl, transmission.glsl, open_water.glsl; the image of the surfaces; the switches FIRST, the first level, and N_LEVELS.
// The first run is at half the resolution and for one level; its last output is the mean of J - B, with the mean range as alpha, or FAR.
// The second run has the switch WIDE, 2 or 4: it is that many times coarser, for all other levels, and reads that mean.
// J: radiance of a surface without water, B: of open water behind it. Pixels without a surface scatter nothing.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
#ifdef WIDE
layout(location = 0) out vec4[N_LEVELS] level_out;
#define EDGE WIDE
#else
layout(location = 0) out vec4[N_LEVELS + 1] level_out;
#define EDGE 2
#endif

void main() {
    ivec2 size = textureSize(surface_image, 0);
    ivec2 corner = EDGE * ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float ranges = 0.0;
    float count = 0.0;
    for (int i = 0; i < EDGE * EDGE; ++i) {
        vec4 texel = texelFetch(surface_image, min(corner + ivec2(i % EDGE, i / EDGE), size - 1), 0);
        float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
        sum += texel.rgb * is_surface;
        ranges += texel.a * is_surface;
        count += is_surface;
    }
    float range = ranges / max(count, 1.0);
#ifndef WIDE
    sum -= count * open_water(2.0 * gl_FragCoord.xy, vec2(size));
#endif
    vec3 excess = sum / float(EDGE * EDGE);
    for (int i = 0; i < N_LEVELS; ++i) {
        float level_reach = FIRST + i < 4 ? reach[FIRST + i] : camera.x;
        level_out[i] = vec4(weight(FIRST + i, level_reach * range) * excess, 0.0);
    }
#ifndef WIDE
    level_out[N_LEVELS] = vec4(excess, count > 0.0 ? range : FAR);
#endif
}
