"""Learning from a teacher's soft labels: extra outputs beside the heads, thrown away after training."""

import torch
from torch import nn

SCALE = 3.0  # logits per unit of the extra outputs
START = -2.0  # most scores of most places are near zero
INTEREST = 9.0  # how much more a place counts where the teacher is sure of something


class Imitation(nn.Module):
    """A 1 x 1 convolution on what goes into each head's last layer (Ba and Caruana 2014: logits by least squares)."""

    def __init__(self, network, n_channels, rate, weight, device):
        super().__init__()
        inputs = [layer.convolution.in_channels for layer in network.head_convolutions()]
        self.outputs = nn.ModuleList(nn.Conv2d(n, n_channels, 1) for n in inputs).to(device)
        for output in self.outputs:
            nn.init.constant_(output.bias, START)
        self.optimizer = torch.optim.AdamW(self.parameters(), lr=rate, betas=(0.9, 0.99), weight_decay=0.0)
        self._weight = weight

    def loss(self, features, soft):
        """features: per head; soft: per head the teacher's logits."""
        total = 0.0
        for output, x, logits in zip(self.outputs, features, soft):
            logits = logits.float()
            weight = 1 + INTEREST * (logits[:, :1].sigmoid() * logits[:, 1:].sigmoid().amax(1, keepdim=True))
            error = (output(x.float()) - logits / SCALE).square().mean(1, keepdim=True)
            total = total + (error * weight).sum() / weight.sum()
        return self._weight * total / len(self.outputs)
