"""Ratios of paired runs: the same sequence with and without something."""

import numpy as np

BOOTSTRAP_DRAWS = 10000


def paired_ratios(runs, pair_keys, variant, reference):
    """{pair: ATE RMSE of the variant / that of the reference} over runs told apart by run["variant"] and paired by
    the values of pair_keys; None for a pair of which either run failed or has no ATE."""
    errors = {}
    for run in runs:
        ate = run.get("ate") if not run["error"] else None
        errors.setdefault(tuple(run[key] for key in pair_keys), {})[run.get("variant")] = ate and ate["rmse_m"]
    return {pair: _ratio(of.get(variant), of.get(reference)) for pair, of in errors.items()}


def identical(runs, pair_keys, variant, reference):
    """How many pairs have the same trajectory to the bit: what tells variant and reference apart had no effect."""
    hashes = {}
    for run in runs:
        if not run["error"] and run.get("trajectory_sha256"):
            hashes.setdefault(tuple(run[key] for key in pair_keys), {})[run.get("variant")] = run["trajectory_sha256"]
    return sum(of[variant] == of[reference] for of in hashes.values() if {variant, reference} <= set(of))


def _ratio(value, reference):
    return value / reference if value and reference else None


def geometric_mean(ratios):
    return float(np.exp(np.mean(np.log(ratios))))


def bootstrap_upper_bound(groups, level=0.95, draws=BOOTSTRAP_DRAWS, seed=0):
    """One-sided upper confidence bound of the geometric mean of all ratios (Efron 1979, percentile method). groups:
    sequences of ratios > 0; each is resampled on its own, because the groups (the presets) are chosen, not drawn."""
    generator = np.random.default_rng(seed)
    logs = [np.log(np.asarray(group, dtype=float)) for group in groups if len(group)]
    if not logs:
        raise ValueError("no ratios")
    sums = sum(group[generator.integers(0, len(group), (draws, len(group)))].sum(axis=1) for group in logs)
    return float(np.exp(np.quantile(sums / sum(map(len, logs)), level)))
