"""Pictures of the median run of a group: the trajectory beside the truth, and the relative error over time."""

import os
import sys

from .. import plots
from ..absolute_error import absolute_error
from ..errors import InputError
from ..relative_error import relative_error
from ..trajectory import read_trajectory


class Figures:
    """Collects the runs on one sequence; draw() writes NAME_trajectory.png and NAME_rpe.png of the one with the
    median ATE (the lower one of the two in the middle). Without a directory nothing happens. A picture that cannot
    be drawn is a warning: the numbers are what counts."""

    def __init__(self, directory, name, truth_path, title):
        self.directory = directory
        self.name = name
        self.truth_path = truth_path
        self.title = title
        self.runs = []

    def add(self, result, output_dir):
        if self.directory and not result["error"] and result.get("ate"):
            trajectory = read_trajectory(os.path.join(output_dir, "CameraTrajectory.txt"), need_rotation=True)
            self.runs.append((result["ate"]["rmse_m"], trajectory))

    def draw(self):
        if not self.runs:
            return
        _, estimate = sorted(self.runs, key=lambda run: run[0])[(len(self.runs) - 1) // 2]
        try:
            os.makedirs(self.directory, exist_ok=True)
            truth = read_trajectory(self.truth_path, need_rotation=True)
            plots.plot_trajectory(self._path("trajectory"), truth, estimate, absolute_error(truth, estimate), self.title)
            plots.plot_relative(self._path("rpe"), relative_error(truth, estimate, fixed_delta=True), self.title)
        except (InputError, OSError) as error:
            print(f"warning: no figure of {self.name}: {error}", file=sys.stderr)

    def _path(self, kind):
        return os.path.join(self.directory, f"{self.name}_{kind}.png")
