// Provides: through_water(lit, range, fog_range, depth), a surface's colour as seen by the camera.
// Needs: varyings.glsl, the switch NO_FOG where the density is 0; range along the ray, distance for the fog, depth below the surface [m].
// E = exp(-2 a r); lit E + w (1 - E exp(-0.001 depth)); then fog exp(-(f s)^2): compatibility 3.9.
vec3 through_water(vec3 lit, float range, float fog_range, float depth) {
    vec3 transmission = exp(v_attenuation * (-2.0 * range));
    float dimmed = exp(-0.001 * max(depth, 0.0));
    vec3 colour = transmission * (lit - v_water_colour.rgb * dimmed) + v_water_colour.rgb;
#ifdef NO_FOG
    return colour;
#else
    return mix(v_fog.rgb, colour, exp(-v_fog.w * fog_range * fog_range));
#endif
}
