"""Reads Darknet .cfg files. What a section means is network.py's business."""

from dataclasses import dataclass, field

from cpslam_tools.errors import InputError


@dataclass
class Section:
    """One "[kind]" with its "key=value" lines. The getters raise InputError naming file and line."""
    path: str
    line: int
    kind: str
    values: dict = field(default_factory=dict)  # key: (text, line)

    def fail(self, what, key=None):
        line = self.values[key][1] if key in self.values else self.line
        raise InputError(f"{self.path}:{line}: [{self.kind}] {what}")

    def text(self, key, fallback=None):
        if key in self.values:
            return self.values[key][0]
        if fallback is None:
            self.fail(f"{key}= is missing")
        return fallback

    def integer(self, key, fallback=None, lowest=0):
        return self._number(key, self.text(key, None if fallback is None else str(fallback)), int, lowest)

    def real(self, key, fallback=None, lowest=0.0):
        return self._number(key, self.text(key, None if fallback is None else str(fallback)), float, lowest)

    def integers(self, key):
        return [self._number(key, item, int, None) for item in self._items(key)]

    def reals(self, key):
        return [self._number(key, item, float, None) for item in self._items(key)]

    def _items(self, key):
        return [item.strip() for item in self.text(key).strip().rstrip(",").split(",")]

    def _number(self, key, text, convert, lowest):
        try:
            value = convert(text)
        except ValueError:
            self.fail(f"{key}={text} is not a number", key)
        if lowest is not None and not value >= lowest:
            self.fail(f"{key}={text} is below {lowest}", key)
        return value


def read_config(path):
    """The file's sections, [net] first."""
    try:
        with open(path, encoding="utf-8") as file:
            return parse_config(file.read(), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: {getattr(error, 'strerror', error)}") from None


def parse_config(text, path):
    sections = []
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.split("#")[0].split(";")[0].strip()
        if not line:
            continue
        if line.startswith("[") and line.endswith("]"):
            sections.append(Section(path, number, line[1:-1].strip()))
            continue
        key, equals, value = (part.strip() for part in line.partition("="))
        if not equals or not key:
            raise InputError(f"{path}:{number}: expected [section] or key=value, found '{line}'")
        if not sections:
            raise InputError(f"{path}:{number}: '{line}' stands before the first [section]")
        if key in sections[-1].values:
            raise InputError(f"{path}:{number}: {key}= stands twice in one section")
        sections[-1].values[key] = (value, number)
    if not sections or sections[0].kind not in ("net", "network"):
        raise InputError(f"{path}: a network begins with [net]")
    return sections
