// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1).
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
