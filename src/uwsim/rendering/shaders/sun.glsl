// Provides: sunlit(colour, facing, mirrored, lit), the light leaving a surface in dry air.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sun that arrives, 0..1.
// POLISHED, for people: surfaces have a film of water, 0.3 max(R.E, 0)^32, and what the sun does not
// reach is lit by the water, in its hue.
// q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 [N.L > 0]): UWSim's image model, compatibility 3.9.
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
