// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour: stored values 0..1. Range: along the ray [m], inf: no surface. Id 0: no surface.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
