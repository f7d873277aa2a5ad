// Provides: the varyings of a surface; VARYING is `out` in the vertex shader, `in` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps; those of material.glsl.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
#if defined(TEXTURED) || defined(NORMAL_MAP) || defined(FINISH_MAP) || defined(EMISSION_MAP)
#define HAS_UV
#endif
VARYING vec3 v_position;  // camera frame [m]
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
VARYING vec2 v_uv;  // texture coordinates
#endif
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
#ifdef CAUSTICS
VARYING vec2 v_caustic_place;  // where the sun's beam to the point enters the water [tiles]
flat VARYING vec4 v_caustic_depths;  // these are of caustics_block.glsl
flat VARYING vec4 v_swell_frame;
flat VARYING vec3 v_caustic_loss;
#endif
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef NORMAL_MAP
VARYING vec4 v_tangent;  // xyz: camera frame; w: 1, or -1 where the texture is mirrored
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
flat VARYING vec3 v_sun;  // towards the sun, camera frame
flat VARYING vec3 v_up;  // W's z axis, camera frame
flat VARYING vec3 v_finish;  // x: roughness; y: share of metal; z: scale of the normal map
#endif
#ifdef EMISSION
flat VARYING vec3 v_emission;  // emitted radiance
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#ifdef HULLS
VARYING vec2 v_shadow_scale;  // texture coordinates and depth of the shadow map for each metre
#endif
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#if defined(PHYSICAL) && LAMPS <= 2 && !defined(GL_ES)  // browsers guarantee fewer varyings
#define FLAT_LAMPS
flat VARYING vec4[LAMPS] v_lamp_position;  // these are lamp_position, lamp_axis and lamp_light of lamps.glsl
flat VARYING vec4[LAMPS] v_lamp_axis;
flat VARYING vec3[LAMPS] v_lamp_light;
flat VARYING vec3[LAMPS] v_lamp_loss;  // attenuation of the way from the lamp of the length d: exp(-d (loss + spread sqrt(d)))
flat VARYING vec3[LAMPS] v_lamp_spread;
#endif
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
