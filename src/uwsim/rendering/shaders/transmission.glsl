// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), a share of scattered light.
// Needs: optics.glsl; the table of physical/blur_weights.py: row 0 is sharp light, row 1 + level that of a level of blur.
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
