// Provides: the levels of blur after the first, each at a quarter of the resolution: the mean of 4 x 4 texels.
// Needs: the textures of the levels; the switch N_LEVELS, how many there are, 1 to 4.
// At the right and lower edge the last texels count several times.
uniform sampler2D level_0;
uniform sampler2D level_1;
uniform sampler2D level_2;
uniform sampler2D level_3;
layout(location = 0) out vec4[N_LEVELS] level_out;

vec4 mean_of(sampler2D level) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 corner = 4 * ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; ++i) sum += texelFetch(level, min(corner + ivec2(i % 4, i / 4), last), 0);
    return sum / 16.0;
}

void main() {
    level_out[0] = mean_of(level_0);
#if N_LEVELS > 1
    level_out[1] = mean_of(level_1);
#endif
#if N_LEVELS > 2
    level_out[2] = mean_of(level_2);
#endif
#if N_LEVELS > 3
    level_out[3] = mean_of(level_3);
#endif
}
