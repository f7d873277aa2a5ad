// Provides: the rectangle around a lump of a cloud of sediment.
// Needs: frame.glsl, optics.glsl; four vertices for each instance: its centre, width, and optical depth through its centre.
// Three widths around the centre; the whole image if the camera is inside.
#include "optics.glsl"
#include "cloud_edge.glsl"
uniform sampler2D surface_image;
in vec4 place;   // xyz: centre, camera frame [m]; w: width sigma [m]
in float depth;  // optical depth along a whole ray through the centre
flat out vec4 v_place;
flat out float v_depth;

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    v_place = place;
    v_depth = depth;
    float ahead = -place.z;
    float reach_of_lump = 3.0 * place.w;
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    if (ahead < -reach_of_lump) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    } else if (ahead < 1.5 * reach_of_lump) {
        gl_Position = vec4(corner, 0.0, 1.0);
    } else {
        vec2 slope = place.xy / ahead - ray_first.xy;
        float row = slope.y / ray_row.y;
        vec2 pixel = vec2((slope.x - row * ray_row.x) / ray_column.x, row);
        float focal = inversesqrt(abs(ray_column.x * ray_row.y));
        float stretch = 1.0 + length(place.xy) / ahead;  // off the axis the outline is longer
        float radius = stretch * focal * reach_of_lump / sqrt(ahead * ahead - reach_of_lump * reach_of_lump);
        gl_Position = vec4(2.0 * (pixel + radius * corner) / size - 1.0, 0.0, 1.0);
    }
}
