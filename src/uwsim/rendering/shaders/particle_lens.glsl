// Provides: the block ParticleLens, the lens through which particles are seen.
// Needs: nothing. Filled by physical/particle_pass.py, where the same members are declared.
// A lens with the aperture A, focused at the distance F, blurs a point at r by A |1/r - 1/F|.
layout(std140) uniform ParticleLens {
    vec4 particle_lens;  // x: radius of the aperture [m]; y: 1 / distance of the focus [1/m]; z: least radius of an image [px]
};
