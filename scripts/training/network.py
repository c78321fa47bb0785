"""A PyTorch network made from a Darknet .cfg: what the .cfg says is all there is to know about it."""

import torch
from torch import nn
from torch.nn import functional

from .config import read_config
from .head import check_activation, read_head

# As OpenCV's importer has it; with PyTorch's 1e-5 the exported network differs in the fourth digit.
BATCH_NORM_EPS = 1e-6
LEAKY_SLOPE = 0.1
PRIOR_LOGIT = -4.6  # objectness to begin with: one cell in a hundred has something
SINGLE_CLASS_LOGIT = 6.0
ACTIVATIONS = {
    "linear": nn.Identity,
    "logistic": nn.Sigmoid,
    "leaky": lambda: nn.LeakyReLU(LEAKY_SLOPE, inplace=True),
    "swish": nn.SiLU,
}


class Convolution(nn.Module):
    """[convolutional]: convolution, batch normalisation where asked for, activation."""

    def __init__(self, section, channels, raw):
        super().__init__()
        filters, size = section.integer("filters", lowest=1), section.integer("size", lowest=1)
        padding = size // 2 if section.integer("pad", 0) else section.integer("padding", 0)
        groups = section.integer("groups", 1, lowest=1)
        normalised = section.integer("batch_normalize", 0) == 1
        if channels % groups or filters % groups:
            section.fail(f"groups={groups} must divide {channels} channels and {filters} filters", "groups")
        self.convolution = nn.Conv2d(channels, filters, size, section.integer("stride", 1, lowest=1), padding,
                                     groups=groups, bias=not normalised)
        self.normalisation = nn.BatchNorm2d(filters, eps=BATCH_NORM_EPS, momentum=0.03) if normalised else None
        name = section.text("activation", "logistic")
        if name not in ACTIVATIONS:
            section.fail(f"activation={name}: known are {', '.join(sorted(ACTIVATIONS))}", "activation")
        self.activation = nn.Identity() if raw else ACTIVATIONS[name]()

    def forward(self, x):
        x = self.convolution(x)
        if self.normalisation is not None:
            x = self.normalisation(x)
        return self.activation(x)


class MaxPool(nn.Module):
    """[maxpool] as Darknet pads it: size - 1 cells in all, the smaller half in front."""

    def __init__(self, section):
        super().__init__()
        size, stride = section.integer("size", lowest=1), section.integer("stride", lowest=1)
        padding = section.integer("padding", size - 1)
        # Of an even size, 2/2's single cell at the end is never reached: sides are multiples of the stride.
        self.pad = (padding // 2, padding - padding // 2) if stride != size else (0, 0)
        self.pool = nn.MaxPool2d(size, stride)

    def forward(self, x):
        if any(self.pad):
            x = functional.pad(x, self.pad * 2, value=float("-inf"))
        return self.pool(x)


class Route(nn.Module):
    """[route]: earlier layers' channels one after the other, or one of their groups."""

    def __init__(self, section, layers, n_channels):
        super().__init__()
        self.layers = layers
        self.groups = section.integer("groups", 1, lowest=1)
        self.group = section.integer("group_id", 0)
        if n_channels % self.groups or self.group >= self.groups:
            section.fail("groups must divide the channels, group_id must be below groups", "groups")

    def forward(self, outputs):
        joined = torch.cat([outputs[i] for i in self.layers], 1) if len(self.layers) > 1 else outputs[self.layers[0]]
        return joined.chunk(self.groups, 1)[self.group] if self.groups > 1 else joined


class Network(nn.Module):
    """All layers of a .cfg. Raises InputError naming file and line for what it does not know."""

    def __init__(self, sections):
        super().__init__()
        self.net = sections[0]
        self.layers = nn.ModuleList()
        self.heads = []
        self._shapes = [(self.net.integer("channels", 3), 1)]  # channels, stride; of the input, then layer by layer
        for i, section in enumerate(sections[1:], 1):
            feeds_yolo = i + 1 < len(sections) and sections[i + 1].kind == "yolo"
            self._add(section, sections[i + 1] if feeds_yolo else None)
        if not self.heads:
            sections[-1].fail("is the last section, but there was no [yolo]")
        self._needed = {i for layer in self.layers if isinstance(layer, Route) for i in layer.layers}

    def input_size(self):
        """Width, height as the .cfg says, px."""
        return self.net.integer("width", lowest=1), self.net.integer("height", lowest=1)

    def stride(self):
        return max(stride for _, stride in self._shapes)

    def forward(self, pictures, features=False):
        """pictures: N, 3, rows, columns, R,G,B in [0, 1]. Returns per head the raw outputs N, anchors, 5 + classes,
        rows, columns; with features also what goes into each head's last convolution."""
        outputs, raw, inputs, heads = {}, [], [], iter(self.heads)
        x = before = pictures
        for i, layer in enumerate(self.layers):
            if layer is None:  # [yolo]
                n, _, height, width = x.shape
                head = next(heads)
                raw.append(x.view(n, len(head.anchors), -1, height, width))
                inputs.append(before)
                continue
            before, x = x, layer(outputs if isinstance(layer, Route) else x)
            if i in self._needed:
                outputs[i] = x
        return (raw, inputs) if features else raw

    def convolutions(self):
        """In the order of the .weights file."""
        return [layer for layer in self.layers if isinstance(layer, Convolution)]

    def head_convolutions(self):
        """Those before the [yolo] sections."""
        return [self.layers[i - 1] for i, layer in enumerate(self.layers) if layer is None]

    def _add(self, section, yolo):
        channels, stride = self._shapes[-1]
        if section.kind == "convolutional":
            layer = Convolution(section, channels, raw=yolo is not None)
            if yolo is not None:
                check_activation(section, yolo)
            shape = (layer.convolution.out_channels, stride * layer.convolution.stride[0])
        elif section.kind == "maxpool":
            layer = MaxPool(section)
            shape = (channels, stride * layer.pool.stride)
        elif section.kind == "upsample":
            factor = section.integer("stride", 2, lowest=1)
            layer = nn.Upsample(scale_factor=factor)
            shape = (channels, stride // factor)
        elif section.kind == "route":
            indices = [self._index(section, i) for i in section.integers("layers")]
            shapes = [self._shapes[i + 1] for i in indices]
            if len({s for _, s in shapes}) > 1:
                section.fail("joins layers of different sizes", "layers")
            n_channels = sum(c for c, _ in shapes)
            layer = Route(section, indices, n_channels)
            shape = (n_channels // layer.groups, shapes[0][1])
        elif section.kind == "yolo":
            layer = None
            shape = (channels, stride)
            self.heads.append(read_head(section, channels, stride))
        else:
            section.fail("is a kind of layer that is not supported")
        self.layers.append(layer)
        self._shapes.append(shape)

    def _index(self, section, index):
        here = len(self.layers)
        absolute = here + index if index < 0 else index
        if not 0 <= absolute < here:
            section.fail(f"there is no layer {index} before this one", "layers")
        return absolute


def build_network(config_path):
    return Network(read_config(config_path))


def initialise(network, generator):
    """Weights to start training from. The single class is no question: its score is held just below 1, and
    objectness alone decides; larger would widen the range that int8 has to cover."""
    for convolution in network.convolutions():
        weight = convolution.convolution.weight
        fan_in = weight[0].numel()
        with torch.no_grad():
            weight.normal_(0.0, (2.0 / fan_in) ** 0.5, generator=generator)
    for head, convolution in zip(network.heads, network.head_convolutions()):
        last = convolution.convolution
        with torch.no_grad():
            weight, bias = (t.view(len(head.anchors), 5 + head.n_classes, *t.shape[1:]) for t in (last.weight, last.bias))
            weight.mul_(0.1)
            bias.zero_()
            bias[:, 4] = PRIOR_LOGIT
            if head.n_classes == 1:
                weight[:, 5] = 0.0
                bias[:, 5] = SINGLE_CLASS_LOGIT

