// Provides: the varyings of a surface; VARYING is `out` in the vertex shader, `in` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, how many there are.
// Flat members carry the frame's constants: on llvmpipe a uniform costs far more to read per pixel.
VARYING vec3 v_position;  // camera frame [m]
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m]; z: depth below the water's surface; w: clip-space z [m]
flat VARYING vec3 v_base_colour;  // colour
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec3 v_attenuation;  // attenuation [1/m]
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#ifdef TEXTURED
VARYING vec2 v_uv;  // on the texture
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // texture coordinates and depth in the lamps' maps, times w
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // texture coordinates and depth in the projector's map, times w
#endif
#endif
