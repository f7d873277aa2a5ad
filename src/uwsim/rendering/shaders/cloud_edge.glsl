// Provides: CLOUD_EDGE, the edge of a texel of the textures of clouds [px].
// Needs: nothing. physical/cloud_pass.py has the same number.
// Clouds are smooth, and their layers keep them apart from surfaces.
#define CLOUD_EDGE 8
