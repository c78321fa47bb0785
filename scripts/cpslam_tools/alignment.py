"""Rigid alignment of two point sets, rotation and translation without scale (Horn 1987, in its SVD form)."""

import numpy as np


def align_rigidly(source, target):
    """The rotation (3, 3) and translation (3,) that minimise sum |target - (rotation source + translation)|^2.

    source, target: (n, 3), n >= 1. A set that lies on a line or in a point leaves the rotation about it free;
    one of the minimisers is returned.
    """
    source_mean = source.mean(axis=0)
    target_mean = target.mean(axis=0)
    covariance = (target - target_mean).T @ (source - source_mean)
    u, _, vt = np.linalg.svd(covariance)
    # A reflection fits better than any rotation when the sets are flat or noisy: turn the weakest axis back.
    mirror = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ mirror @ vt
    return rotation, target_mean - rotation @ source_mean
