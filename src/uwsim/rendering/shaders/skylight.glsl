// Provides: skylight(normal, share), the light of sun and sky on a surface in air, and of the sea below it.
// Needs: surface_block.glsl; the unit normal in the camera frame; share = 0 in the sun's shadow to 1.
// The sky and the sea count as even; the sea reflects 6 % of the light.
vec3 skylight(vec3 normal, float share) {
    vec3 upright = mat3(world_from_ray) * normal;
    vec3 level = sky_light.rgb + sky_sun_light.rgb * sky_sun.z;
    return sky_sun_light.rgb * (max(dot(upright, sky_sun.xyz), 0.0) * share)
        + sky_light.rgb * (0.5 + 0.5 * upright.z) + level * (0.03 - 0.03 * upright.z);
}
