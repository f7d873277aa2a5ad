// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sunlight that arrives, 0..1. N: normal,
// L: direction to the sun, R: direction of the mirrored sunlight, E: direction to the camera.
// With the switch POLISHED: surfaces are glossy, 0.3 max(R.E, 0)^32, and in the shade ambient light has the
// water's hue.
// Else UWSim's image model: q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 where N.L > 0), with light rate q, surface
// colour C, and the ambient, diffuse and specular light Ia, Id, Is.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
#ifdef POLISHED
    vec3 hue = v_water_colour.rgb / max(max(v_water_colour.r, v_water_colour.g), max(v_water_colour.b, 1e-3));
    vec3 ambient = v_lights.w * mix(0.8 + 0.35 * hue, vec3(1.0), reached);
    float narrow = glint * glint * glint * glint;
    narrow *= narrow;
    narrow *= narrow;
    narrow *= narrow;
    vec3 film = v_lights.rgb * (0.3 * narrow * reached);
    return colour * (ambient + v_lights.rgb * (facing * reached)) + film;
#endif
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
