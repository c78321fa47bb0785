"""Judging person detectors: ground truths, matching, precision and recall, and runs of detect_people."""
