// Provides: what the vertices of a surface hand to its pixels; BETWEEN is out there and in here.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, and LAMPS, how many there are.
// Flat members carry the frame's constants: on llvmpipe a uniform costs far more to read in a pixel.
BETWEEN vec3 position;  // camera frame [m]
#ifdef COLOUR
BETWEEN vec3 normal;    // camera frame, any length
BETWEEN vec4 along;     // x: N.L |N|; y: P.L [m]; z: depth below the water's surface; w: clip-space z [m]
flat BETWEEN vec3 base;     // colour
flat BETWEEN vec4 lights;   // rgb: sunlight; w: ambient
flat BETWEEN vec4 veil;     // rgb: water colour; w: specular
flat BETWEEN vec3 losses;   // attenuation [1/m]
flat BETWEEN vec4 mist;     // rgb: fog colour; w: density squared [1/m2]
#ifdef TEXTURED
BETWEEN vec2 place;         // on the texture
#endif
#ifdef AIR
flat BETWEEN float sunk;    // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
BETWEEN vec3 shadow_place;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
BETWEEN vec4[LAMPS] on_lamp_map;  // texture coordinates and depth in the lamps' maps, times w
#endif
#endif
