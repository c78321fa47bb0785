"""The six numbers that every error is told by."""

import numpy as np


def summarize(values):
    """rmse, mean, median, std, min, max of a non-empty array, as plain floats; std is the population's."""
    values = np.asarray(values, dtype=float)
    return {
        "rmse": float(np.sqrt(np.mean(values**2))),
        "mean": float(np.mean(values)),
        "median": float(np.median(values)),
        "std": float(np.std(values)),
        "min": float(np.min(values)),
        "max": float(np.max(values)),
    }
