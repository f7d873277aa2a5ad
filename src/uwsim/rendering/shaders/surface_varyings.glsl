// Provides: numbers of the block Surface as flat varyings; VARYING is `out` in the vertex shader, `in` in the fragment shader.
// Needs: surface_block.glsl; the switches WAVES, RIPPLES and FOAM. In the fragment shader, include it before waves.glsl and sky.glsl:
// their names of members of the block then are these varyings. llvmpipe reads them much faster than uniforms in each pixel.
flat VARYING vec4 v_air;
flat VARYING vec4 v_sky_sun;
flat VARYING vec4 v_sky_sun_light;
flat VARYING vec4 v_water_light;
flat VARYING vec4 v_numbers;  // x: height of the camera above the still surface [m]; yz: width and height of the image [px]
flat VARYING vec3[3] v_clip;  // the rows x, y and w of clip_from_offset
#if defined(WAVES) && WAVES == 1
flat VARYING vec4[1] v_grids;
flat VARYING vec4 v_roughness;
#endif
#ifdef RIPPLES
flat VARYING vec4 v_ripples;
flat VARYING vec4 v_ripple_origin;
flat VARYING vec4 v_ripple_turn;
#endif
#ifdef FOAM
flat VARYING vec4 v_sky_light;
#endif
#ifdef READS_VARYINGS
#define air v_air
#define sky_sun v_sky_sun
#define sky_sun_light v_sky_sun_light
#define water_light v_water_light
#if defined(WAVES) && WAVES == 1
#define grids v_grids
#define roughness v_roughness
#endif
#define ripples v_ripples
#define ripple_origin v_ripple_origin
#define ripple_turn v_ripple_turn
#define sky_light v_sky_light
#else
void pass_on_surface() {
    v_air = air;
    v_sky_sun = sky_sun;
    v_sky_sun_light = sky_sun_light;
    v_water_light = water_light;
    v_numbers = vec4(eye.x, image_size.xy, 0.0);
    v_clip[0] = vec3(clip_from_offset[0].x, clip_from_offset[1].x, clip_from_offset[2].x);
    v_clip[1] = vec3(clip_from_offset[0].y, clip_from_offset[1].y, clip_from_offset[2].y);
    v_clip[2] = vec3(clip_from_offset[0].w, clip_from_offset[1].w, clip_from_offset[2].w);
#if defined(WAVES) && WAVES == 1
    v_grids[0] = grids[0];
    v_roughness = roughness;
#endif
#ifdef RIPPLES
    v_ripples = ripples;
    v_ripple_origin = ripple_origin;
    v_ripple_turn = ripple_turn;
#endif
#ifdef FOAM
    v_sky_light = sky_light;
#endif
}
#endif
