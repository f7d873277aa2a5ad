// Provides: the requested outputs; COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour 0..1 stored value; range [m] along the ray, inf = nothing; id 0 = nothing.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
