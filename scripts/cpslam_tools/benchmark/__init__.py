"""Runs rgbd_tum over sequences, modes and repeats, and tells the results as Markdown and JSON."""
