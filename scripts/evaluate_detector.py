#!/usr/bin/python3
"""Precision, recall and average precision of person detectors, run by detect_people, which is the detector of rgbd_tum.

On one of: pictures with YOLO-format labels (a list such as val.txt, or a folder with images/ and labels/), a MOTChallenge
sequence (--mot: coverage is the share of the people found, accuracy the share of the boxes that are right), a TUM-format
sequence with reference boxes (--sequence, --reference: also for how long large people were overlooked). Boxes are clipped to
their picture; a box is right when it overlaps somebody (IoU) by --iou whom no more confident box found. AP is the area under
the envelope of the precision-recall curve down to --floor; recall and precision are those at --threshold. Several --model and
--sizes are compared; --int8 runs each in 8-bit integers as well, picture by picture in turns with floats, so that their
times compare.

  evaluate_detector.py val.txt --model yc.cfg yc.weights --model other.cfg other.weights --sizes 256,320,416 --int8 pictures/
  evaluate_detector.py --sequence bonn_crowd --reference person_boxes.txt --draw differences --output results
  evaluate_detector.py --mot MOT20-02 --every 10
"""

import argparse
import os
import re

from cpslam_tools import errors, output
from cpslam_tools.benchmark import machine
from cpslam_tools.benchmark.programs import Programs
from cpslam_tools.detection import detector_runs, drawings, evaluation, ground_truth, report

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pictures", nargs="?", metavar="PICTURES", help="list or folder of pictures with YOLO-format labels")
    parser.add_argument("--mot", metavar="DIR", help="MOTChallenge sequence: seqinfo.ini, gt/gt.txt, img1/")
    parser.add_argument("--sequence", metavar="DIR", help="TUM-format sequence (rgb.txt)")
    parser.add_argument("--reference", metavar="FILE", help="its person_boxes.txt")
    parser.add_argument("--model", nargs=2, action="append", default=[], metavar=("CFG", "WEIGHTS"),
                        help="Darknet network; may be given several times (default: the one that comes with CP-SLAM)")
    parser.add_argument("--boxes", action="append", default=[], metavar="FILE",
                        help="with --sequence: boxes found before, for instance by rgbd_tum --save-boxes, beside or instead of "
                        "networks")
    parser.add_argument("--sizes", type=input_sizes, default=[None], metavar="W[xH],...",
                        help="input sizes to try (default: each network's own)")
    parser.add_argument("--int8", metavar="DIR", help="also in 8-bit integers, calibrated on the pictures in this folder")
    parser.add_argument("--classes", metavar="CLASSES", help="the networks' classes that are people, as detect_people takes "
                        "them (default 0)")
    parser.add_argument("--label-classes", type=whole_numbers, default=[0], metavar="N,...",
                        help="the labels' classes that are people (default 0)")
    parser.add_argument("--threshold", type=unit_interval, default=detector_runs.DEFAULT_CONFIDENCE,
                        help="confidence for recall and precision (default: rgbd_tum's, %(default)s)")
    parser.add_argument("--floor", type=unit_interval, default=0.01, help="least confidence for AP (default 0.01)")
    parser.add_argument("--iou", type=unit_interval, default=0.5, help="least overlap of a right box (default 0.5)")
    parser.add_argument("--nms", type=unit_interval, help="overlap above which the weaker of two boxes goes (default: rgbd_tum's)")
    parser.add_argument("--min-visibility", type=float, default=0.0, metavar="V",
                        help="with --mot: people less visible need not be found (default 0: all count)")
    parser.add_argument("--every", type=positive, default=1, metavar="N", help="only every Nth picture")
    parser.add_argument("--threads", type=positive, metavar="N", help="OpenCV's threads (default: its own choice)")
    parser.add_argument("--output", metavar="DIR", help="write results.json and precision_recall.png there")
    parser.add_argument("--draw", metavar="DIR", help="draw the pictures that differ, a folder a run: people green (missed: "
                        "yellow, not counting: grey), detections blue (wrong: red)")
    parser.add_argument("--build-dir", default=os.path.join(ROOT, "build", "release"))
    options = parser.parse_args(arguments)
    if sum(source is not None for source in (options.pictures, options.mot, options.sequence)) != 1:
        raise errors.InputError("give one of PICTURES, --mot DIR and --sequence DIR; see --help")
    if (options.reference is None) != (options.sequence is None):
        raise errors.InputError("--sequence DIR and --reference FILE go together")
    if options.boxes and not options.sequence:
        raise errors.InputError("--boxes goes with --sequence DIR")
    return options


def input_sizes(text):
    sizes = text.split(",")
    if not all(re.fullmatch(r"\d+(x\d+)?", size) for size in sizes):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form 256,320x256")
    return sizes


def whole_numbers(text):
    return [int(part) for part in text.split(",")]


def unit_interval(text):
    value = float(text)
    if not 0 < value <= 1:
        raise argparse.ArgumentTypeError("must lie in (0, 1]")
    return value


def positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value


def read_pictures(options):
    if options.mot:
        pictures = ground_truth.read_mot(options.mot, options.min_visibility)
    elif options.sequence:
        pictures = ground_truth.read_sequence(options.sequence, options.reference)
    else:
        pictures = ground_truth.read_yolo(options.pictures, options.label_classes)
    return pictures[::options.every]


def all_runs(options, pictures):
    """Every network at every size, then the recorded boxes."""
    program = Programs(options.build_dir).path("detect_people")
    passed_on = ["--confidence", f"{options.floor:g}"]
    for name, value in (("--nms", options.nms), ("--classes", options.classes), ("--detector-threads", options.threads)):
        passed_on += [name, str(value)] if value is not None else []
    detector = detector_runs.Detector(program, passed_on, options.int8)
    runs = []
    for model in options.model or ([] if options.boxes else [None]):
        for size in options.sizes:
            runs += detector.run(pictures, model, size)
    return runs + [detector_runs.recorded_run(path, pictures) for path in options.boxes]


def evaluate(options, pictures, run):
    scenes = evaluation.scenes(pictures, run, options.iou)
    if not scenes:
        raise errors.InputError("none of the pictures could be read")
    result = {"network": run.network, "input": run.input_size, "numbers": run.numbers, "n_pictures": len(scenes),
              "detection_ms": run.detection_ms, "time_ratio": run.time_ratio,
              "all": evaluation.score(scenes, options.threshold),
              "sizes": {size: evaluation.score_of_size(scenes, size, options.threshold, options.iou) for size in evaluation.SIZES},
              "recalls": evaluation.recall_of_pictures(scenes, options.threshold),
              "misses": evaluation.long_misses(scenes, options.threshold) if options.sequence else None}
    if options.draw:
        name = re.sub(r"[^\w.-]+", "_", f"{run.network}_{run.input_size.replace(' ', '')}_{run.numbers}")
        folder = os.path.join(options.draw, name)
        result["drawn"] = f"{folder}/: {drawings.draw_differences(folder, scenes, options.threshold)} pictures that differ"
    return result


def main(arguments):
    options = parse(arguments)
    pictures = read_pictures(options)
    if options.output:
        output.make_folder(options.output)
    runs = all_runs(options, pictures)
    results = [evaluate(options, pictures, run) for run in runs]
    print(report.tables(results, options.threshold, options.iou, is_mot=bool(options.mot)))
    for result in results:
        if result["misses"] is not None:
            print("", *report.miss_lines(result), sep="\n")
    for result in results:
        if "drawn" in result:
            print(result["drawn"])
    if options.output:
        document = {"source": options.pictures or options.mot or options.sequence, "iou": options.iou, "floor": options.floor,
                    "threshold": options.threshold, "machine": machine.describe(ROOT),
                    "results": [report.as_json(result) for result in results]}
        output.write_json(os.path.join(options.output, "results.json"), document)
        report.plot_curves(os.path.join(options.output, "precision_recall.png"), results, options.threshold)


if __name__ == "__main__":
    errors.run(main)
