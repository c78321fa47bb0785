"""Shared parts of CP-SLAM's scripts: trajectories, their errors, plots and benchmarks."""
