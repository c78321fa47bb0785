"""Everything a training needs to go on, in a file."""

import os
import pickle

import torch

from cpslam_tools.errors import InputError


def write_checkpoint(state, path):
    """Through a temporary file, so that an interruption leaves the old one."""
    torch.save(state, f"{path}.tmp")
    os.replace(f"{path}.tmp", path)


def read_checkpoint(path, device, restore):
    """Hands the file's dictionary to restore(); what goes wrong there too becomes one InputError. Nothing in the file
    is run: tensors, numbers, texts and their containers only."""
    try:
        return restore(torch.load(path, map_location=device, weights_only=True))
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from None
    except (RuntimeError, KeyError, ValueError, TypeError, AttributeError, EOFError, pickle.UnpicklingError) as error:
        what = " ".join(str(error).split())[:160]
        raise InputError(f"{path} is no checkpoint of this network: {what}") from None
