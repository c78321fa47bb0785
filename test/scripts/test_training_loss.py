"""Who answers for whom, and the gradients of the loss."""

import numpy as np
import pytest
from training_support import network, torch

from training.assignment import assign, worst_ratios
from training.boxes import complete_iou, overlaps, torch_iou
from training.head import Head
from training.imitation import Imitation
from training.loss import LossSettings, Targets, detection_loss, objectness_targets

HEAD = Head(8, ((16.0, 32.0), (32.0, 64.0)), 1, 2.0, True)


def rows(*values):
    return torch.tensor(values, dtype=torch.float32).reshape(-1, 4)


def places(assignment):
    return sorted(zip(assignment.anchor.tolist(), assignment.row.tolist(), assignment.column.tolist()))


def targets(boxes, ignored=()):
    return Targets(rows(*boxes), torch.zeros(len(boxes), dtype=torch.long), rows(*ignored),
                   torch.zeros(len(ignored), dtype=torch.long))


def test_centre_left_of_the_middle_takes_cell_and_neighbours():
    # 8-px cells: (42, 30) is in column 5 at a quarter, row 3 at three quarters.
    found, = assign([HEAD], rows([42, 30, 16, 32]), torch.zeros(1, dtype=torch.long), (96, 64), ratio=1.5)
    assert places(found) == [(0, 3, 4), (0, 3, 5), (0, 4, 5)]
    assert torch.equal(found.boxes, rows([42, 30, 16, 32]).expand(3, 4))


def test_every_fitting_anchor_is_taken_and_the_best_always():
    boxes, picture = rows([44, 28, 24, 48], [44, 28, 3, 60]), torch.tensor([0, 4])
    found, = assign([HEAD], boxes, picture, (96, 64), ratio=1.6)
    assert set(found.anchor[found.picture == 0].tolist()) == {0, 1}
    # 3 px wide: no anchor is within 1.6, the first is nearer (16 / 3 against 32 / 3).
    assert set(found.anchor[found.picture == 4].tolist()) == {0}
    np.testing.assert_allclose(worst_ratios(boxes[:, 2:], torch.tensor(HEAD.anchors))[1], [16 / 3, 32 / 3])


def test_neighbours_beyond_the_border_are_left_out():
    found, = assign([HEAD], rows([1, 1, 16, 32], [95, 63, 16, 32]), torch.tensor([0, 0]), (96, 64), ratio=1.5)
    assert places(found) == [(0, 0, 0), (0, 7, 11)]


def test_without_scale_only_the_centres_cell_answers():
    head = Head(8, ((16.0, 32.0),), 1, 1.0, True)
    found, = assign([head], rows([42, 30, 16, 32]), torch.tensor([0]), (96, 64))
    assert places(found) == [(0, 3, 5)]


def test_assigned_places_can_give_the_box_exactly():
    generator = np.random.default_rng(5)
    boxes = torch.tensor(np.column_stack([generator.uniform(0, (96, 64), (200, 2)),
                                          generator.uniform(12, 80, (200, 2))]), dtype=torch.float32)
    found, = assign([HEAD], boxes, torch.arange(200), (96, 64))
    cell = torch.stack([found.column, found.row], 1) * HEAD.stride
    share = ((found.boxes[:, :2] - cell) / HEAD.stride - 0.5) / HEAD.scale_xy + 0.5
    assert len(share) > 400 and share.min() >= 0 and share.max() <= 1
    size = found.boxes[:, 2:] / torch.tensor(HEAD.anchors)[found.anchor]
    inside = worst_ratios(boxes[:, 2:], torch.tensor(HEAD.anchors))[found.picture, found.anchor] < 3.0
    assert size[inside].max() < 4


def test_no_people_no_places():
    found, = assign([HEAD], rows(), torch.zeros(0, dtype=torch.long), (96, 64))
    assert len(found.anchor) == 0


def test_complete_iou_by_hand():
    one, other = rows([10, 10, 10, 20]), rows([15, 10, 10, 20])
    # Half of each is common; the box around both is 15 x 20; the aspects are the same.
    assert float(torch_iou(one, other)) == pytest.approx(1 / 3)
    assert float(complete_iou(one, other)) == pytest.approx(1 / 3 - 25 / (15**2 + 20**2))
    assert float(complete_iou(one, one)) == pytest.approx(1.0)
    wide = rows([10, 10, 20, 10])
    aspect = (2 / np.pi * (np.arctan(0.5) - np.arctan(2)))**2
    weight = aspect / (1 - 1 / 3 + aspect)
    assert float(complete_iou(one, wide)) == pytest.approx(1 / 3 - weight * aspect)


def test_numpy_and_torch_overlap_agree():
    generator = np.random.default_rng(1)
    corners = np.sort(generator.uniform(0, 50, (20, 2, 2)), 1).reshape(20, 4)
    centres = np.concatenate([(corners[:, :2] + corners[:, 2:]) / 2, corners[:, 2:] - corners[:, :2]], 1)
    theirs = torch_iou(torch.tensor(centres)[:, None], torch.tensor(centres)[None])
    np.testing.assert_allclose(overlaps(corners, corners), theirs, atol=1e-6)


def test_gradient_of_complete_iou():
    generator = torch.Generator().manual_seed(3)
    predicted = torch.rand(12, 4, generator=generator, dtype=torch.float64) * 8 + 4
    target = torch.rand(12, 4, generator=generator, dtype=torch.float64) * 8 + 4
    predicted.requires_grad_(True)
    complete_iou(predicted, target).sum().backward()
    # The aspect's weight counts as a constant (Zheng et al. 2020): the numeric gradient holds it too.
    with torch.no_grad():
        iou = torch_iou(predicted, target)
        aspect = aspect_term(predicted, target)
        weight = aspect / (1 - iou + aspect)
        for k in range(4):
            step = torch.zeros(4, dtype=torch.float64)
            step[k] = 1e-6
            ends = [complete_iou_with(predicted + sign * step, target, weight) for sign in (1, -1)]
            np.testing.assert_allclose(predicted.grad[:, k], (ends[0] - ends[1]) / 2e-6, atol=1e-6)


def aspect_term(predicted, target):
    return (2 / np.pi * (torch.atan(target[:, 2] / target[:, 3]) - torch.atan(predicted[:, 2] / predicted[:, 3])))**2


def complete_iou_with(predicted, target, weight):
    low = torch.minimum(predicted[:, :2] - predicted[:, 2:] / 2, target[:, :2] - target[:, 2:] / 2)
    high = torch.maximum(predicted[:, :2] + predicted[:, 2:] / 2, target[:, :2] + target[:, 2:] / 2)
    distance = ((predicted[:, :2] - target[:, :2])**2).sum(1) / ((high - low)**2).sum(1)
    return torch_iou(predicted, target) - distance - weight * aspect_term(predicted, target)


def raw_outputs(seed, heads=(HEAD,), size=(96, 64), dtype=torch.float32):
    generator = torch.Generator().manual_seed(seed)
    return [torch.randn(1, len(head.anchors), 6, size[1] // head.stride, size[0] // head.stride, generator=generator,
                        dtype=dtype) for head in heads]


def test_gradient_of_the_whole_loss():
    # Objectness asked of a positive follows its box's IoU as a constant; quality 0 leaves it out of the comparison.
    # All boxes of one aspect, and anchors too: CIoU's weight, another constant, is then nearly zero.
    settings = LossSettings(quality=0.0, box_weight=2.0)
    people = targets([[42, 30, 16, 32], [70, 20, 30, 60]], [[10, 50, 20, 20]])
    raw = raw_outputs(1)[0]
    raw[:, :, 2:4] = raw[:, :, 2:3] * 0.3
    raw.requires_grad_(True)
    loss, _ = detection_loss([raw], [HEAD], people, (96, 64), settings)
    loss.backward()
    generator = np.random.default_rng(2)
    touched = (raw.grad[0] != 0).nonzero().tolist()
    assert len(touched) > 100
    for index in [touched[i] for i in generator.choice(len(touched), 60, replace=False)]:
        if index[1] in (2, 3):
            continue  # width and height alone change the aspect
        values = []
        for sign in (1, -1):
            moved = raw.detach().clone()
            moved[(0, *index)] += sign * 1e-2
            values.append(float(detection_loss([moved], [HEAD], people, (96, 64), settings)[0]))
        assert (values[0] - values[1]) / 2e-2 == pytest.approx(float(raw.grad[(0, *index)]), rel=0.03, abs=2e-3)


def test_class_scores_get_no_gradient():
    raw = raw_outputs(4)[0].requires_grad_(True)
    detection_loss([raw], [HEAD], targets([[42, 30, 16, 32]]), (96, 64))[0].backward()
    assert torch.all(raw.grad[:, :, 5] == 0)


def test_pictures_without_people_push_objectness_down():
    raw = raw_outputs(4)[0].requires_grad_(True)
    loss, parts = detection_loss([raw], [HEAD], targets([]), (96, 64))
    loss.backward()
    assert parts["box"] == 0 and torch.all(raw.grad[:, :, 4] > 0) and torch.all(raw.grad[:, :, :4] == 0)


def test_a_place_that_found_somebody_by_itself_is_left_in_peace():
    boxes = torch.zeros(1, 2, 4, 8, 12)
    boxes[0, :, :, 2, 3] = torch.tensor([28.0, 20, 16, 32])
    boxes[0, :, :, 2, 4] = torch.tensor([32.0, 20, 16, 32])  # a quarter of a box beside: IoU 0.6
    boxes[0, :, :, 5, 5] = torch.tensor([80.0, 20, 16, 32])  # nobody there
    wanted, weight = objectness_targets(boxes, HEAD, targets([[28, 20, 16, 32]]), LossSettings(ignore_iou=0.65))
    assert torch.all(wanted == 0)
    assert weight[0, :, 2, 3].tolist() == [0, 0]
    assert weight.sum() == weight.numel() - 2


def test_places_in_unknown_areas_do_not_count():
    boxes = torch.ones(1, 2, 4, 8, 12)
    _, weight = objectness_targets(boxes, HEAD, targets([], [[16, 16, 16, 16]]), LossSettings())
    assert torch.all(weight[0, :, 1:3, 1:3] == 0)
    assert weight.sum() == weight.numel() - 8


def test_descending_makes_the_network_find_the_person():
    torch.manual_seed(0)
    raw = [values.requires_grad_(True) for values in raw_outputs(9)]
    optimizer = torch.optim.Adam(raw, lr=0.05)
    person = targets([[42, 30, 20, 50]])
    for _ in range(500):
        loss, parts = detection_loss(raw, [HEAD], person, (96, 64))
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    boxes, logits = HEAD.decode(raw[0].detach())
    scores = logits[0, :, 0].sigmoid()
    best = boxes[0].permute(0, 2, 3, 1)[scores == scores.max()][0]
    assert parts["iou"] > 0.97 and scores.max() > 0.95
    np.testing.assert_allclose(best, [42, 30, 20, 50], atol=0.5)
    assert (scores > 0.5).sum() == 6  # three cells, both anchors


def test_imitation_counts_where_the_teacher_is_sure():
    small = network()
    imitation = Imitation(small, 3, 1e-3, 1.0, "cpu")
    _, features = small(torch.rand(2, 3, 32, 64), features=True)
    assert [x.shape[1] for x in features] == [output.in_channels for output in imitation.outputs]
    soft = [torch.full((2, 3, *x.shape[2:]), -9.0) for x in features]
    calm = float(imitation.loss(features, soft))
    soft[0][0, :, 0, 0] = 9.0
    assert float(imitation.loss(features, soft)) > calm
    imitation.loss(features, soft).backward()
    assert all(output.weight.grad.abs().sum() > 0 for output in imitation.outputs)
    assert small.layers[0].convolution.weight.grad.abs().sum() > 0
