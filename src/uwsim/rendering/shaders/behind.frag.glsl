// Provides: a pixel that the backdrop fills: nothing, and clear.
// Needs: targets.glsl with COLOUR.
// Alpha tells them apart: surfaces and background have 1.
#include "targets.glsl"

void main() {
    colour_out = vec4(0.0);
}
