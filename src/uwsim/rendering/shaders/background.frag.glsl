// Provides: pixels without a surface: the water's far colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The far colour is the limit of the water's image model at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#ifdef PHYSICAL
#include "optics.glsl"
#endif
#include "targets.glsl"

void main() {
#ifdef COLOUR
#ifdef PHYSICAL
    colour_out = vec4(0.0, 0.0, 0.0, FAR);
#else
    colour_out = vec4(camera_colour(background.rgb), 1.0);
#endif
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
