"""The subcommands of train_detector.py."""

import argparse
import json
import os

import cv2
import numpy as np
import torch

from cpslam_tools.errors import InputError

from .anchors import find_anchors, training_sizes
from .checkpoint import read_checkpoint
from .cutouts import load_cutouts
from .network import build_network
from .pictures import PictureStore
from .progress import Report
from .samples import Samples, Source
from .scenes import SceneMaker
from .schedule import Schedule, parse_sizes
from .simulated import simulate
from .sources import read_source, split_option
from .teacher import Teacher
from .trainer import CHECKPOINT, Trainer, TrainerSettings
from .weights import save_weights


def run(arguments, description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    add_train(commands.add_parser("train", help="train, or go on with an interrupted training"))
    add_anchors(commands.add_parser("anchors", help="print anchors for the training boxes"))
    add_export(commands.add_parser("export", help="write the averaged weights of a checkpoint"))
    add_simulate(commands.add_parser("simulate", help="make training pictures with simulate_tum"))
    options = parser.parse_args(arguments)
    return options.run(options)


def add_data(parser):
    parser.add_argument("--data", action="append", required=True, metavar="DIR[=SHARE]",
                        help="pictures with boxes: a YOLO-format folder, a simulate_tum folder or a CrowdHuman "
                             "annotation_*.odgt beside its Images/; SHARE (default 1): how often it is drawn from, "
                             "relative to the others; may be given several times")
    parser.add_argument("--boxes", choices=("visible", "full"), default="visible",
                        help="CrowdHuman: around what is seen of a person, or around all of it (default %(default)s)")
    parser.add_argument("--prefer", action="append", default=[], metavar="PREFIX=FACTOR",
                        help="how often pictures are drawn whose name begins so, relative to the others")
    parser.add_argument("--seed", type=int, default=1)


def add_train(parser):
    add_data(parser)
    parser.add_argument("--cfg", required=True, help="the network")
    parser.add_argument("--output", required=True, help="folder for checkpoints, weights and curves")
    parser.add_argument("--validate", metavar="DIR", help="YOLO-format folder whose val.txt is measured; default: the "
                        "first --data")
    parser.add_argument("--cutouts", metavar="DIR", help="RGBA pictures of people to be put on top")
    parser.add_argument("--teacher", metavar="ONNX", help="YOLOX network whose scores of all its classes are soft "
                        "labels")
    parser.add_argument("--pictures", type=int, default=300000, help="to be seen in all (default %(default)s)")
    parser.add_argument("--sizes", default="0:192,0.45:256,0.7:320,0.9:416", help="SHARE:PX,...: from which share of the "
                        "training on pictures are how large, give or take a stride (default %(default)s)")
    parser.add_argument("--hold", type=float, default=0.0, help="share of the training after which the learning rate "
                        "begins to fall (default %(default)s: a whole cosine)")
    parser.add_argument("--batch", type=int, default=8, help="pictures per step (default %(default)s: with "
                        "few pictures in all, many small steps learn more)")
    parser.add_argument("--rate", type=float, default=1.5e-3, help="highest learning rate (default %(default)s)")
    parser.add_argument("--decay", type=float, default=0.02, help="weight decay (default %(default)s)")
    parser.add_argument("--warm-up", type=int, default=3000, help="pictures (default %(default)s)")
    parser.add_argument("--validate-every", type=int, default=8000, help="pictures (default %(default)s)")
    parser.add_argument("--validation-size", type=int, default=416, help="px (default %(default)s)")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="for PyTorch (default: the cores)")
    parser.add_argument("--workers", type=int, default=1, help="processes that make pictures (default %(default)s)")
    parser.add_argument("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    parser.add_argument("--resume", nargs="?", const="", metavar="CHECKPOINT",
                        help="go on from here; without a name, and by default where there is one, from the output's")
    parser.set_defaults(run=train)


def add_anchors(parser):
    add_data(parser)
    parser.add_argument("--count", type=int, default=9)
    parser.add_argument("--size", type=int, default=416, help="the network's input, px (default %(default)s)")
    parser.set_defaults(run=anchors)


def add_export(parser):
    parser.add_argument("--cfg", required=True)
    parser.add_argument("--checkpoint", required=True)
    parser.add_argument("--weights", required=True, help="file to write")
    parser.set_defaults(run=export)


def add_simulate(parser):
    parser.add_argument("--program", default="build/release/bin/simulate_tum", help="default %(default)s")
    parser.add_argument("--output", required=True, help="folder to be written, in YOLO format")
    parser.add_argument("--count", type=int, default=400, help="of pictures (default %(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    parser.set_defaults(run=simulated)


def train(options):
    torch.set_num_threads(options.threads)
    cv2.setNumThreads(1)
    network = build_network(options.cfg)
    records, sources = gather(options)
    first = split_option(options.data[0])[0]
    checked = read_source(options.validate or first, "val", options.boxes)
    os.makedirs(options.output, exist_ok=True)
    report = Report()
    report.say(f"{len(records)} pictures to train on, {sum(len(r.boxes) for r in records)} people; {len(checked)} to "
               "check with")
    maker = SceneMaker(records, PictureStore(records), load_cutouts(options.cutouts) if options.cutouts else [])
    schedule = Schedule(options.pictures, options.warm_up, options.hold, parse_sizes(options.sizes, network.stride()),
                        network.stride(), options.seed)
    settings = TrainerSettings(options.output, options.batch, options.rate, options.decay, options.validate_every,
                               options.validation_size, options.workers, options.device, options.seed)
    teacher = Teacher(options.teacher, [head.stride for head in network.heads]) if options.teacher else None
    trainer = Trainer(network, Samples(maker, sources, options.seed), (checked, PictureStore(checked)), schedule,
                      settings, report, teacher)
    checkpoint = options.resume or os.path.join(options.output, CHECKPOINT)
    if options.resume is not None or os.path.exists(checkpoint):
        trainer.resume(checkpoint)
        report.say(f"going on from {checkpoint} at {trainer.n_pictures} pictures")
    if not trainer.run():
        report.say(f"stopped at {trainer.n_pictures} pictures; the same command goes on")
        return 1
    return 0


def gather(options):
    """The records of all --data, and a Source for each."""
    records, sources = [], []
    for text in options.data:
        path, share = split_option(text)
        found = read_source(path, "train", options.boxes)
        chances = np.array([factor(record.name(), options.prefer) for record in found])
        if chances.sum() <= 0:
            raise InputError(f"--prefer leaves nothing of {path}")
        sources.append(Source(share, np.arange(len(records), len(records) + len(found)), chances / chances.sum()))
        records += found
    return records, sources


def factor(name, preferences):
    for text in preferences:
        prefix, value = split_option(text)
        if name.startswith(prefix):
            return value
    return 1.0


def anchors(options):
    records, _ = gather(options)
    records = [record for record in records if factor(record.name(), options.prefer) > 0]
    sizes = [cv2.imread(record.path).shape[1::-1] for record in records]
    generator = np.random.default_rng(options.seed)
    boxes = training_sizes(records, sizes, options.size, generator)
    found, mean = find_anchors(boxes, options.count, generator)
    print("anchors=" + ", ".join(f"{width:.0f},{height:.0f}" for width, height in found))
    print(f"# mean IoU with the best anchor: {mean:.3f} over {len(boxes)} boxes")


def export(options):
    network = build_network(options.cfg)

    def restore(state):
        network.load_state_dict(state["average"])
        return json.loads(state["progress"])["n_pictures"]

    n_pictures = read_checkpoint(options.checkpoint, "cpu", restore)
    save_weights(network, options.weights, n_pictures)
    print(f"{options.weights}: after {n_pictures} pictures")


def simulated(options):
    report = Report()
    count = simulate(options.program, options.output, options.count, options.seed, report.say)
    report.say(f"{count} of {options.count} pictures in {options.output}")
