"""How long a person was overlooked: reference boxes linked over time, and the longest stretch without a detection."""

import collections

import numpy as np

from .boxes import overlaps

LEAST_OVERLAP = 0.3  # of a person's boxes in successive pictures
LONGEST_GAP_S = 0.5  # without a reference box; whoever comes back later is somebody else

# A box of a person: picture's index, box's index in it.
Sighting = collections.namedtuple("Sighting", "picture box")
# end_s: when the person was found, or has gone.
Miss = collections.namedtuple("Miss", "begin_s end_s sightings")


def link(stamps, boxes):
    """Lists of Sightings, one list a person. boxes: an array (n, 4) per stamp. Overlap with where the person was last
    decides, best pairs first."""
    people = []
    for index, (stamp, current) in enumerate(zip(stamps, boxes)):
        recent = [person for person in people if stamp - stamps[person[-1].picture] <= LONGEST_GAP_S]
        last = np.array([boxes[person[-1].picture][person[-1].box] for person in recent]).reshape(-1, 4)
        overlap = overlaps(last, current)
        unlinked = set(range(len(current)))
        while overlap.size and overlap.max() >= LEAST_OVERLAP:
            person, box = np.unravel_index(np.argmax(overlap), overlap.shape)
            recent[person].append(Sighting(index, int(box)))
            unlinked.discard(int(box))
            overlap[person, :] = overlap[:, box] = -1.0
        people += [[Sighting(index, box)] for box in sorted(unlinked)]
    return people


def misses(stamps, boxes, found, counts):
    """Every stretch in which a person who counts was not found, longest first. found, counts: per stamp a bool array (n,).
    It lasts from the first picture without to the next one with, or until the person has gone or no longer counts."""
    interval = float(np.median(np.diff(stamps))) if len(stamps) > 1 else 0.0
    result = []
    for person in link(stamps, boxes):
        missed = []
        for sighting in [*person, None]:
            if sighting and counts[sighting.picture][sighting.box] and not found[sighting.picture][sighting.box]:
                missed.append(sighting)
            elif missed:
                end = stamps[sighting.picture] if sighting else stamps[missed[-1].picture] + interval
                result.append(Miss(stamps[missed[0].picture], end, missed))
                missed = []
    return sorted(result, key=lambda miss: miss.begin_s - miss.end_s)
