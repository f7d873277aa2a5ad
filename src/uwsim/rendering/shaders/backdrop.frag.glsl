// Provides: a clear pixel, where the stored colour of the backdrop is copied later (backdrop.py).
// Needs: targets.glsl with COLOUR.
// Its alpha is 0; surfaces and the background have alpha 1.
#include "targets.glsl"

void main() {
    colour_out = vec4(0.0);
}
