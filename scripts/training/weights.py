"""Darknet .weights files: a header, then the floats of all convolutions in the order of the .cfg."""

import os
import struct

import numpy as np
import torch

from cpslam_tools.errors import InputError

VERSION = (0, 2, 5)  # since 0.2 the number of pictures seen has 64 bits
HEADER = struct.Struct("<iiiq")


def tensors(network):
    """Per convolution: bias, then with batch normalisation scale, mean and variance, then the filter taps."""
    for layer in network.convolutions():
        norm = layer.normalisation
        if norm is None:
            yield layer.convolution.bias
        else:
            yield from (norm.bias, norm.weight, norm.running_mean, norm.running_var)
        yield layer.convolution.weight


def save_weights(network, path, n_pictures):
    """Through a temporary file, so that a reader never sees half a file."""
    temporary = f"{path}.tmp"
    with open(temporary, "wb") as file:
        file.write(HEADER.pack(*VERSION, n_pictures))
        for tensor in tensors(network):
            file.write(tensor.detach().cpu().numpy().astype("<f4").tobytes())
    os.replace(temporary, path)


def load_weights(network, path):
    """Returns the number of pictures the header says were seen. Raises InputError when the sizes differ."""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from None
    expected = HEADER.size + 4 * sum(tensor.numel() for tensor in tensors(network))
    if len(content) != expected:
        raise InputError(f"{path} has {len(content)} bytes, the network's weights take {expected}")
    n_pictures = HEADER.unpack_from(content)[3]
    values, at = np.frombuffer(content, "<f4", offset=HEADER.size), 0
    with torch.no_grad():
        for tensor in tensors(network):
            tensor.copy_(torch.from_numpy(values[at:at + tensor.numel()].copy()).view_as(tensor))
            at += tensor.numel()
    return n_pictures
