// Provides: whole_field(range), the share of a wide target's light that arrives.
// Needs: optics.glsl.
// Formula: optics/transmission.py.
vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}
