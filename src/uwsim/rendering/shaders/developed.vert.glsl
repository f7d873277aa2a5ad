// Provides: one triangle over the whole image, with the place of each pixel in coarser textures, and constants of the pass.
// Needs: optics.glsl, open_water.glsl; with BLUR, blur_weight.glsl; the textures and the switches of developed.frag.glsl.
// llvmpipe reads flat varyings much faster than uniforms in each pixel.
#define VARYING out
#include "optics.glsl"
#include "open_water.glsl"
#ifdef BLUR
#include "blur_weight.glsl"
#endif
uniform sampler2D surface_image;
flat out float v_exposure;
noperspective out vec2 v_water_place;
#ifdef SCATTERED
noperspective out vec2 v_level_place;
uniform sampler2D level_0;
#endif
#ifdef SHAFTS
noperspective out vec2 v_shaft_place;
uniform sampler2D shaft_image;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    vec2 share = 0.5 * corner + 0.5;
    v_exposure = camera.y;
    v_water_place = open_water_place(share);
#ifdef BLUR
    pass_on_table();
#endif
#ifdef SCATTERED
    v_level_place = share * vec2(textureSize(surface_image, 0)) / (2.0 * vec2(textureSize(level_0, 0)));
#endif
#ifdef SHAFTS
    v_shaft_place = share * vec2(textureSize(surface_image, 0)) / (float(SHAFTS) * vec2(textureSize(shaft_image, 0)));
#endif
}
