"""Trains one-class Darknet YOLO detectors; ../train_detector.py is its command line, models/README.md the recipe."""
