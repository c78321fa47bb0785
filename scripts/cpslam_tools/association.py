"""One-to-one association of two lists of stamps, closest pairs first."""

import heapq


def associate_stamps(first, second, offset=0.0, max_difference=0.02):
    """Pairs (i, j) of indices with |first[i] - (second[j] + offset)| < max_difference, in the order of first.

    The closest pair of all is taken, then the closest of what is left, and so on; of equally close pairs the one
    with the earlier first, then the earlier second stamp. Each list holds every stamp once, in any order.

    The closest pair is always made of neighbours on the time line, so a list of neighbours and a heap do it in
    O(n log n), however large max_difference is.
    """
    line = sorted([(stamp, 0, i) for i, stamp in enumerate(first)] +
                  [(stamp + offset, 1, j) for j, stamp in enumerate(second)])
    before = list(range(-1, len(line) - 1))
    after = list(range(1, len(line) + 1))
    alive = [True] * len(line)
    heap = []

    def offer(left, right):
        if left < 0 or right >= len(line) or line[left][1] == line[right][1]:
            return
        difference = line[right][0] - line[left][0]
        if difference < max_difference:
            a, b = (left, right) if line[left][1] == 0 else (right, left)
            heapq.heappush(heap, (difference, line[a][0], line[b][0], left, right))

    for position in range(len(line) - 1):
        offer(position, position + 1)
    pairs = []
    while heap:
        _, _, _, left, right = heapq.heappop(heap)
        if not (alive[left] and alive[right]):
            continue
        alive[left] = alive[right] = False
        a, b = (left, right) if line[left][1] == 0 else (right, left)
        pairs.append((a, line[a][2], line[b][2]))
        outer_left, outer_right = before[left], after[right]
        if outer_left >= 0:
            after[outer_left] = outer_right
        if outer_right < len(line):
            before[outer_right] = outer_left
        offer(outer_left, outer_right)
    return [(i, j) for _, i, j in sorted(pairs)]
