// Provides: pixels without a surface: the water's colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The limit of the water law at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#include "targets.glsl"

void main() {
#ifdef COLOUR
    colour_out = vec4(as_taken(background.rgb), 1.0);
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
