// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
// Needs: nothing. Filled by physical/optics_block.py, where the same members are declared.
// Rays are in the camera frame (OpenGL axes), with z = -1, linear in gl_FragCoord.
#ifndef FAR
#define FAR 1e9
#endif
layout(std140) uniform Optics {
    vec4 absorption;       // rgb: a [1/m]; w: e0 of the whole field
    vec4 scattering;       // rgb: b [1/m]; w: k of the whole field
    vec4[2] reach;         // factors on the ranges of the levels of blur: blur_plan.py
    vec4 camera;           // y: exposure; z: middle range of the table of weights [m]
    vec4 sun_beam;         // rgb: irradiance of a level surface just below the surface by the sun
    vec4 sun_loss;         // rgb: its attenuation over depth [1/m]
    vec4 daylight_total;   // rgb: irradiance of a level surface just below the surface
    vec4 daylight_loss;    // rgb: its attenuation over depth [1/m]
    vec4 upwelling;        // rgb: share of the irradiance that comes up; w: cosine of the sun from the zenith
    vec4 phase_low;        // ln p as a polynomial of ((1 - cos) / 2)^(1/4): the lower four coefficients
    vec4 phase_high;       // the higher four
    vec4 ray_first;        // the ray at gl_FragCoord = 0
    vec4 ray_column;       // its change from column to column
    vec4 ray_row;          // its change from row to row
    vec4[4] lamp_optics;   // x: EE(half angle) - A; y: k_L; z: squared cosine of the half angle; w: 1 if it is below 90 degrees
};
