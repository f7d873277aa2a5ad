// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1); with SQUARE, square_gaussian(level).
// Needs: the switches RADIUS [texels] and SPREAD, a thousand times the standard deviation [texels].
// Outside the level its edge is continued.
vec4 gaussian(sampler2D level, ivec2 step_) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(level, texel, 0);
#if RADIUS > 0
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    float total = 1.0;
    for (int i = 1; i <= RADIUS; ++i) {
        float weight = exp(-rate * float(i * i));
        sum += weight * (texelFetch(level, clamp(texel - i * step_, ivec2(0), last), 0)
            + texelFetch(level, clamp(texel + i * step_, ivec2(0), last), 0));
        total += 2.0 * weight;
    }
    sum /= total;
#endif
    return sum;
}

#ifdef SQUARE
// The Gaussian along rows and columns in one pass, for small levels.
vec4 square_gaussian(sampler2D level) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    vec4 sum = vec4(0.0);
    float total = 0.0;
    for (int i = -RADIUS; i <= RADIUS; ++i) {
        float row_weight = exp(-rate * float(i * i));
        total += row_weight;
        for (int j = -RADIUS; j <= RADIUS; ++j)
            sum += row_weight * exp(-rate * float(j * j)) * texelFetch(level, clamp(texel + ivec2(j, i), ivec2(0), last), 0);
    }
    return sum / (total * total);
}
#endif
