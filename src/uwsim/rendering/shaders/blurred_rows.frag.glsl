// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
