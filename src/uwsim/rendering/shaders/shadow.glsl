// Provides: sun_share(at), 0 in the sun's shadow to 1 in full sun.
// Needs: the shadow map; at = texture coordinates and depth of the point, 0..1.
// One hardware 2x2 comparison, or with the switch SOFT the mean of four; outside the map there is sun.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 at) {
    vec3 inside = step(abs(at - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, at + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, at) : 1.0;
#endif
}
