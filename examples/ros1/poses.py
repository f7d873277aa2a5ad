"""Compute with poses, without ROS: quaternions are (x, y, z, w)."""

import math


def multiply(a, b):
    """Return the product a * b: the rotation b, then a."""
    x1, y1, z1, w1 = a
    x2, y2, z2, w2 = b
    return (
        w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
        w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
        w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
        w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
    )


def quaternion(roll, pitch, yaw):
    """Return the quaternion of Rx Ry Rz, the order of UWSim's programs [rad]."""
    x = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    y = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
    z = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    return multiply(multiply(x, y), z)


def rotate(q, vector):
    """Rotate a vector by q."""
    x, y, z, w = q
    return multiply(multiply(q, (*vector, 0.0)), (-x, -y, -z, w))[:3]


def interpolate(a, b, share):
    """Interpolate from a (share 0) to b (share 1) on the shorter arc (slerp)."""
    cosine = sum(p * q for p, q in zip(a, b, strict=True))
    if cosine < 0.0:
        b, cosine = tuple(-p for p in b), -cosine
    angle = math.acos(min(cosine, 1.0))
    if angle < 1e-6:
        return b
    weight_a, weight_b = math.sin((1 - share) * angle), math.sin(share * angle)
    quaternion_sum = [
        (weight_a * p + weight_b * q) / math.sin(angle) for p, q in zip(a, b, strict=True)
    ]
    return tuple(quaternion_sum)


def read(pose):
    """Return position and quaternion of a geometry_msgs/Pose."""
    p, q = pose.position, pose.orientation
    return (p.x, p.y, p.z), (q.x, q.y, q.z, q.w)


def write(pose, position, orientation):
    """Set position and quaternion of a geometry_msgs/Pose."""
    p, q = pose.position, pose.orientation
    p.x, p.y, p.z = position
    q.x, q.y, q.z, q.w = orientation
