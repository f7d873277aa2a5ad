// Provides: as_taken(colour), the colour of a pixel as its camera gives it.
// Needs: nothing.
// The switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as grey.py has it. The page alone sets it.
vec3 as_taken(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
