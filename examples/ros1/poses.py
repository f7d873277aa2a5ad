"""Poses for the programs of this folder, without ROS: quaternions are (x, y, z, w)."""

import math


def times(a, b):
    """The rotation b, then a: a * b."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def quaternion(roll, pitch, yaw):
    """Rx Ry Rz, the order of the original's programs [rad]."""
    x = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    y = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
    z = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    return times(times(x, y), z)


def rotated(q, vector):
    """A vector turned by q."""
    x, y, z, w = q
    return times(times(q, (*vector, 0.0)), (-x, -y, -z, w))[:3]


def between(a, b, share):
    """The rotation a share of the way from a to b, by the shorter one (slerp)."""
    cosine = sum(p * q for p, q in zip(a, b, strict=True))
    if cosine < 0.0:
        b, cosine = tuple(-p for p in b), -cosine
    angle = math.acos(min(cosine, 1.0))
    if angle < 1e-6:
        return b
    first, second = math.sin((1 - share) * angle), math.sin(share * angle)
    mixed = [(first * p + second * q) / math.sin(angle) for p, q in zip(a, b, strict=True)]
    return tuple(mixed)


def read(pose):
    """Position and quaternion of a geometry_msgs/Pose."""
    p, q = pose.position, pose.orientation
    return (p.x, p.y, p.z), (q.x, q.y, q.z, q.w)


def write(pose, position, orientation):
    """Set a geometry_msgs/Pose."""
    p, q = pose.position, pose.orientation
    p.x, p.y, p.z = position
    q.x, q.y, q.z, q.w = orientation
