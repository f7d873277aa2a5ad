// Provides: the block Clouds: the ranges of the layers in which clouds of sediment are stored; LOSS_SHARE.
// Needs: nothing. Filled by physical/cloud_pass.py, where the same members are declared.
// A thick cloud in the light of a lamp is as bright as one of the optical depth 1 / LOSS_SHARE whose light is scattered once.
#define LOSS_SHARE 0.1
layout(std140) uniform Clouds {
    vec4 cloud_layers;  // x: first range [m]; y: step from layer to layer [m]
    vec4 cloud_colour;  // rgb: albedo of a thick cloud in daylight
};
