// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
