// Provides: through_water(lit, range, position), what is left of a colour at the camera.
// Needs: frame.glsl; range [m] along the ray; position in the camera frame [m].
// E = exp(-2 a r); lit E + w (1 - E exp(-0.001 depth)); then fog exp(-(f s)^2): compatibility 3.9.
vec3 through_water(vec3 lit, float range, vec3 position) {
    float depth = max(-(dot(up.xyz, position) + up.w), 0.0);
    vec3 left = exp(attenuation.rgb * (-2.0 * range));
    vec3 colour = lit * left + water_colour.rgb * (1.0 - left * exp(-0.001 * depth));
    float s = fog_distance.x * range - fog_distance.y * position.z + fog_distance.z;
    return mix(fog_colour.rgb, colour, exp(-fog_colour.w * s * s));
}
