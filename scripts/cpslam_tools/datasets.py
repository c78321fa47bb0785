"""The public RGB-D sequences the scripts know by name: where they come from and which camera took them."""

import collections
import re

from .errors import InputError

TUM_URL = "https://cvg.cit.tum.de/rgbd/dataset"
BONN_URL = "https://www.ipb.uni-bonn.de/html/projects/rgbd_dynamic2019"

# Camera paths of each kind of fr3 sequence with people, in the paper's order.
PEOPLE_PATHS = ("static", "xyz", "rpy", "halfsphere")
TUM_PAPER = tuple(f"rgbd_dataset_freiburg3_{kind}_{path}" for kind in ("sitting", "walking") for path in PEOPLE_PATHS)
BONN_PAPER = tuple(f"rgbd_bonn_{name}" for name in ("crowd", "crowd2", "crowd3", "synchronous", "synchronous2"))
PAPER = TUM_PAPER + BONN_PAPER
# Sequences without people, or with other movers, that go well with those.
OTHERS = tuple(f"rgbd_dataset_freiburg{name}" for name in (
    "1_desk", "1_desk2", "1_room", "1_rpy", "1_xyz", "2_desk", "2_desk_with_person", "2_xyz",
    "3_long_office_household", "3_nostructure_texture_near_withloop")) + tuple(f"rgbd_bonn_{name}" for name in (
        "moving_nonobstructing_box", "moving_nonobstructing_box2", "person_tracking", "person_tracking2"))

# name: the folder's; path: of the archive below the server's root; settings: file below Examples/RGB-D.
Dataset = collections.namedtuple("Dataset", "name server path settings")


def find_dataset(name):
    """The sequence of this name: the folder's (rgbd_dataset_freiburg3_walking_xyz, rgbd_bonn_crowd), or short
    (fr3_walking_xyz, bonn_crowd, crowd). TUM and Bonn sequences that are not in the lists above are known as well,
    by the way these two name their files."""
    full = _full_name(name)
    match = re.fullmatch(r"rgbd_dataset_freiburg([123])_\w+", full)
    if match:
        camera = match.group(1)
        return Dataset(full, TUM_URL, f"freiburg{camera}/{full}.tgz", f"TUM{camera}.yaml")
    if re.fullmatch(r"rgbd_bonn_\w+", full):
        return Dataset(full, BONN_URL, f"{full}.zip", "Bonn.yaml")
    raise InputError(f"no sequence '{name}' is known: --list names them; others must be called "
                     "rgbd_dataset_freiburgN_... or rgbd_bonn_...")


def _full_name(name):
    short = re.fullmatch(r"(?:fr|freiburg)([123])_(\w+)", name)
    if short:
        return f"rgbd_dataset_freiburg{short.group(1)}_{short.group(2)}"
    for prefix in ("rgbd_", "rgbd_bonn_"):
        if prefix + name in BONN_PAPER + OTHERS:
            return prefix + name
    return name
