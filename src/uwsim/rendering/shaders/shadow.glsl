// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight; with HULLS, sky_share(map_point, scale).
// Needs: the shadow map; map_point = texture coordinates and depth of a point in it, 0..1.
// One hardware comparison of 2 x 2 texels, or with the switch SOFT the mean of four; points outside the map are lit.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 map_point) {
    vec3 inside = step(abs(map_point - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, map_point + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, map_point) : 1.0;
#endif
}

#ifdef HULLS
// The share of diffuse light that hulls let through, by eight rays along the sun's, up to 2 m beside the point.
// scale = texture coordinates and depth of the map for each metre. The rays begin on a cone of 45 degrees above the point.
float sky_share(vec3 map_point, vec2 scale) {
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        float radius = 2.0 * sqrt((float(i) + 0.5) / 8.0);
        float angle = 2.3999632 * float(i);
        vec3 offset = radius * vec3(scale.x * cos(angle), scale.x * sin(angle), -scale.y);
        sum += sun_share(map_point + offset);
    }
    return sum / 8.0;
}
#endif
