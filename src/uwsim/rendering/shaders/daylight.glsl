// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
// Needs: varyings.glsl with PHYSICAL; facing = N.L; up_cosine = N.up; share = 0 in the sun's shadow to 1; depth below the surface [m].
// physical/daylight_field.py, physical/transfer_curve.py: the sun's beam, with CAUSTICS focused by waves; diffuse light from above, light from below.
// With CAUSTICS, call focus_beam(depth) before; with HULLS, sky_arrival is the share of diffuse light from above that arrives.
#ifdef CAUSTICS
#include "caustics.glsl"
vec3 beam_gain;
void focus_beam(float depth) {
    float excess = caustic_excess(v_caustic_place, depth, v_caustic_depths, v_swell_frame);
    beam_gain = 1.0 + exp(v_caustic_loss * -max(depth, 0.0)) * excess;
}
#endif
#ifdef HULLS
float sky_arrival = 1.0;
#else
const float sky_arrival = 1.0;
#endif
vec3 daylight(float facing, float up_cosine, float share, float depth) {
    float z = max(depth, 0.0);
    vec3 total = v_daylight_total * exp(v_daylight_loss * -z);
    vec3 level = min(v_sun_beam.rgb * exp(v_sun_loss * -z), total);
    vec3 diffuse = total - level;
#ifdef CAUSTICS
    level *= beam_gain;
#endif
    return level * (max(facing, 0.0) * share / v_sun_beam.w)
        + diffuse * ((0.5 + 0.5 * up_cosine) * sky_arrival) + v_upwelling * total * (0.5 - 0.5 * up_cosine);
}

vec3 albedo_of(vec3 stored) {
    vec3 root = sqrt(stored);
    return stored * (0.0982065878 + root * (-0.2653148210 + root * (0.7011382242 + root * (0.5186992531 - 0.0527292441 * root))));
}
