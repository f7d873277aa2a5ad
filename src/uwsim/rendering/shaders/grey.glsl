// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
// Needs: nothing.
// With the switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as in grey.py. Only the viewer's page sets it.
vec3 camera_colour(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
