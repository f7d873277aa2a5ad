// Provides: weight(row, range), a share of the light of surfaces: row 0 is sharp light, row 1 + level that of a level of blur.
// Needs: the table of physical/blur_weights.py; VARYING is `out` in the vertex shader, which needs optics.glsl and calls pass_on_table();
// it is `in` in the fragment shader, with READS_VARYINGS. One linear look-up; a range r has the place r / (r + L).
uniform sampler2D weight_table;
flat VARYING vec4 v_table;  // x: L [m]; y, z: factor and offset from places to columns, 0..1; w: height of a row
#ifdef READS_VARYINGS
vec3 weight(int row, float range) {
    float place = range / (range + v_table.x);
    return texture(weight_table, vec2(place * v_table.y + v_table.z, (float(row) + 0.5) * v_table.w)).rgb;
}
#else
void pass_on_table() {
    vec2 size = vec2(textureSize(weight_table, 0));
    v_table = vec4(camera.z, (size.x - 1.0) / size.x, 0.5 / size.x, 1.0 / size.y);
}
#endif
