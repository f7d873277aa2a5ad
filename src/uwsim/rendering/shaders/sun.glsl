// Provides: sunlit(colour, facing, mirrored, lit), the light leaving a surface in dry air.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sun that arrives, 0..1.
// q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 [N.L > 0]): UWSim's image model, compatibility 3.9.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
