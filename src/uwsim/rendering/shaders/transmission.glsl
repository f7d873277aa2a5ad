// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), the share of scattered light that
// is sharp (row 0) or blurred by a level (row 1 + level).
// Needs: optics.glsl; the table of physical/blur_weights.py.
// Direct light is neither absorbed nor scattered; the whole field is that of a wide target. Formulas: optics/transmission.py.
uniform sampler2D weight_table;

vec3 direct(float range) {
    return exp((absorption.rgb + scattering.rgb) * -range);
}

vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}

vec3 weight(int row, float range) {
    vec2 size = vec2(textureSize(weight_table, 0));
    float share = range / (range + camera.z);
    return textureLod(weight_table, vec2((share * (size.x - 1.0) + 0.5) / size.x, (float(row) + 0.5) / size.y), 0.0).rgb;
}
