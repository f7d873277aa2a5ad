// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
// Needs: varyings.glsl; the switch NO_FOG if the fog density is 0; range: along the ray in water, fog_range: distance in
// the fog, depth: below the water's surface [m].
// lit E + w (1 - E exp(-0.001 depth)) with E = exp(-2 a range), then fog with exp(-(f fog_range)^2): see water.py.
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
