// Provides: the block Surface, the numbers of the water's surface, the sky and the air.
// Needs: nothing. Filled by surface/surface_block.py, where the same members are declared.
// Offsets are positions in W minus that of the camera [m].
layout(std140) uniform Surface {
    mat4 clip_from_offset;
    mat4 world_from_ray;   // rotation: W from the camera frame (OpenGL axes)
    vec4 eye;              // x: height of the camera above the still surface [m]; y: near plane [m]; w: number of grids
    vec4[4] grids;         // for each grid: xy: texture coordinates of the camera; z: 1 / edge [1/m]; w: spacing [m]
    vec4 roughness;        // variance of the slopes that each grid leaves out
    vec4 ripples;          // x: factor on the slopes of a tile; y: their variance; z: 1 / edge of the tile [1/m]; w: its spacing [m]
    vec4 ripple_origin;    // xy: camera in the tile [m]
    vec4 ripple_turn;      // xy: camera in the turned, smaller tile [m]; zw: cosine and sine of its turn over its size
    vec4 bounds;           // x: greatest elevation of waves [m]; y: variance of their slopes along one axis
    vec4 sky_sun;          // xyz: towards the sun above the water, W; w: its angular radius [rad]
    vec4 sky_sun_light;    // rgb: irradiance of a surface that faces the sun; w: cosine of the refracted sun from the zenith
    vec4 sky_light;        // rgb: irradiance of a level surface by the sky
    vec4 water_light;      // rgb: radiance of the open water from below the surface, even
    vec4 image_size;       // xy: width and height [px]
    vec4 air;              // x: attenuation of air [1/m]; y: refractive index of water; z: angle of a pixel [rad]
};
