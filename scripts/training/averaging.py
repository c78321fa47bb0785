"""A network whose weights are the moving average of another's (EMA)."""

import copy
import math

import torch


class Average:
    def __init__(self, network, decay=0.9990, settle=400):
        """decay: per step, reached gradually over about `settle` steps."""
        self.network = copy.deepcopy(network).eval().requires_grad_(False)
        self.steps = 0
        self._decay, self._settle = decay, settle

    @torch.no_grad()
    def update(self, network):
        self.steps += 1
        keep = self._decay * (1 - math.exp(-self.steps / self._settle))
        current = network.state_dict()
        for name, value in self.network.state_dict().items():
            if value.dtype.is_floating_point:
                value.mul_(keep).add_(current[name].to(value.device), alpha=1 - keep)
            else:
                value.copy_(current[name])
