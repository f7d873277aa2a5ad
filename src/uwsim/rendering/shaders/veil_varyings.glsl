// Provides: the numbers of the lamps and of the water for lamp_veil.glsl as flat varyings.
// Needs: VARYING, `out` in the vertex shader, which needs optics.glsl and lamps.glsl and calls pass_on_lamps(), and `in` in the fragment
// shader, with READS_VARYINGS; the switch LAMPS. llvmpipe reads flat varyings much faster than uniforms in each pixel.
flat VARYING vec4[LAMPS] v_lamp_position;  // xyz: camera frame [m]; w: cosine at the edge of the cone
flat VARYING vec4[LAMPS] v_lamp_axis;      // xyz: along the beam; w: factor from cosines inside the edge to 0..1
flat VARYING vec4[LAMPS] v_lamp_cone;      // x: squared cosine of the half angle; y: 1 if it is below 90 degrees; z: place of the camera along the axis [m]; w: squared distance of the camera [m2]
flat VARYING vec4[LAMPS] v_lamp_strength;  // rgb: b times intensity; w: share of the light that is sent to the camera, 0..1
flat VARYING vec3 v_veil_loss;             // c - 0.97 b [1/m]
flat VARYING vec4 v_phase_low;             // these are of optics.glsl
flat VARYING vec4 v_phase_high;
#ifndef READS_VARYINGS
void pass_on_lamps() {
    v_veil_loss = absorption.rgb + 0.03 * scattering.rgb;
    v_phase_low = phase_low;
    v_phase_high = phase_high;
    for (int i = 0; i < LAMPS; ++i) {
        vec3 to_lamp = lamp_position[i].xyz;
        float square = dot(to_lamp, to_lamp);
        float along = dot(to_lamp, lamp_axis[i].xyz);  // the beam goes the other way
        float cosine = along / max(sqrt(square), 1e-3);
        v_lamp_position[i] = lamp_position[i];
        v_lamp_axis[i] = vec4(-lamp_axis[i].xyz, lamp_axis[i].w);
        v_lamp_cone[i] = vec4(lamp_optics[i].z, lamp_optics[i].w, along, square);
        v_lamp_strength[i] = vec4(scattering.rgb * lamp_light[i].rgb, lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0);
    }
}
#endif
