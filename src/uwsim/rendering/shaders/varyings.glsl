// Provides: the varyings of a surface; VARYING is `out` in the vertex shader, `in` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
VARYING vec3 v_position;  // camera frame [m]
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m] (L: to the sun, P: position); z: depth below the water's surface [m]; w: clip-space z [m], PHYSICAL: N.up |N|
flat VARYING vec3 v_base_colour;  // colour of the mesh
flat VARYING vec3 v_attenuation;  // attenuation of rgb [1/m]
#ifdef PHYSICAL
flat VARYING vec4 v_sun_beam;  // these are sun_beam, sun_loss ... of optics.glsl; w: upwelling.w
flat VARYING vec3 v_sun_loss;
flat VARYING vec3 v_daylight_total;
flat VARYING vec3 v_daylight_loss;
flat VARYING vec3 v_upwelling;
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef TEXTURED
VARYING vec2 v_uv;  // texture coordinates
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
