// Provides: the radiance of a lamp that the camera sees, and its range.
// Needs: optics.glsl, targets.glsl with COLOUR; the outputs of lamp_point.vert.glsl. The renderer adds radiance and replaces range.
// pi I lobe / (d^2 Omega) with the solid angle Omega of a pixel, divided among the four pixels around the lamp.
#include "optics.glsl"
#include "targets.glsl"
flat in vec3 v_position;
flat in vec3 v_axis;
flat in vec4 v_light;
flat in float v_steepness;

void main() {
    float range = max(length(v_position), 0.01);
    float cosine = dot(v_axis, v_position) / range;
    float share = v_light.w > -1.0 ? clamp((cosine - v_light.w) * v_steepness, 0.0, 1.0) : 1.0;
    vec2 slope = v_position.xy / -v_position.z - ray_first.xy;
    float row = slope.y / ray_row.y;
    float column = (slope.x - row * ray_row.x) / ray_column.x;
    vec2 weight = max(1.0 - abs(gl_FragCoord.xy - vec2(column, row)), 0.0);
    float part = weight.x * weight.y * share * share * (3.0 - 2.0 * share);
    if (part <= 0.0) discard;
    float axis_cosine = -v_position.z / range;
    float solid_angle = axis_cosine * axis_cosine * axis_cosine * abs(ray_column.x * ray_row.y);
    colour_out = vec4(v_light.rgb * (3.14159265 * part / (range * range * solid_angle)), range);
}
