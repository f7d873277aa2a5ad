// Provides: one triangle over the whole target, with the place of each texel in the open water, and constants of the pass.
// Needs: optics.glsl, open_water.glsl, blur_weight.glsl; the image of the surfaces; the switches of scattered.frag.glsl.
// llvmpipe reads flat varyings much faster than uniforms in each pixel.
#define VARYING out
#include "optics.glsl"
#include "open_water.glsl"
#include "blur_weight.glsl"
uniform sampler2D surface_image;
flat out ivec2 v_last;   // the last pixel of the image
flat out vec4[2] v_reach;
#ifndef WIDE
noperspective out vec2 v_water_place;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    ivec2 size = textureSize(surface_image, 0);
    v_last = size - 1;
    v_reach[0] = reach[0];
    v_reach[1] = reach[1];
    pass_on_table();
#ifndef WIDE
    vec2 texels = vec2((size + 1) / 2);  // of the target
    v_water_place = open_water_place((corner + 1.0) * texels / vec2(size));
#endif
}
