"""Differences between two folders of results, byte for byte, and how large their numbers are apart.
"""

import base64
import json
import re
import struct
import zlib

# Entries of summary.json that describe the clock, the memory, the threads, the program and files.
NOT_COMPARED = {
    "seconds",
    "particle_steps_per_second",
    "peak_memory_bytes",
    "threads",
    "version",
    "commit",
    "mesh_checksum",
}
# Texts of summary.json that the program prints too: they are compared as messages.
TEXTS = {"reason", "notes", "doubts", "warnings"}
# Files that hold wall time or messages, or the state of a run with its times.
SKIPPED = {"timing.csv", "log.txt", "checkpoint.bin"}
# Numbers that are round-off themselves or count steps to a tolerance. A tolerance passes over them,
# and a report names them only where nothing else differs.
ROUND_OFF = re.compile(
    r"(^|[./])(residual|largest_residual|energy_error|solution_error|smallest_pivot"
    r"|displacement_error|sum row|iterations|residual_after|moment_after|factor_bytes)\b"
)
NUMBER = re.compile(r"^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$|^-?(inf|nan)$")


class Difference:
    """One file that differs. apart: largest |a - b| over the largest number of its column."""

    def __init__(self, file, text, apart=None, where=""):
        self.file, self.text, self.apart, self.where = file, text, apart, where

    def __str__(self):
        if self.apart is None:
            return f"{self.file}: {self.text}"
        return f"{self.file}: {self.text}, largest {self.apart:.2g} ({self.where})"


def summary_bytes(data):
    """Returns summary.json without NOT_COMPARED and TEXTS, or the data if it is no JSON."""
    try:
        summary = json.loads(data)
    except ValueError:
        return data
    kept = {key: value for key, value in summary.items() if key not in NOT_COMPARED}
    return json.dumps(without_texts(kept), indent=1).encode()


def without_texts(value):
    """Returns a JSON value without the entries of TEXTS at any depth."""
    if isinstance(value, dict):
        return {key: without_texts(v) for key, v in value.items() if key not in TEXTS}
    return [without_texts(v) for v in value] if isinstance(value, list) else value


def files_of(folder):
    """Returns the names of compared files with their bytes; none where the folder is missing."""
    if not folder.is_dir():
        return {}
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and path.name not in SKIPPED:
            data = path.read_bytes()
            found[name] = summary_bytes(data) if path.name == "summary.json" else data
    return found


def compare_folders(base, new, tolerance=0.0):
    """Returns a list of Difference. tolerance: numbers of any file may be so far apart."""
    left, right = files_of(base), files_of(new)
    result = [Difference(name, "only of the base program") for name in left if name not in right]
    result += [Difference(name, "only of the new program") for name in right if name not in left]
    for name in left:
        if name not in right or left[name] == right[name]:
            continue
        difference = explain(name, left[name], right[name], tolerance > 0)
        if difference.apart is None or difference.apart > tolerance:
            result.append(difference)
    return result


# ------------------------------------------------------------------ numbers of files


def explain(name, left, right, pass_over_round_off):
    """Returns the Difference of two files, with numbers where their layout is equal."""
    try:
        pair = [columns_of(name, data) for data in (left, right)]
    except (ValueError, KeyError, IndexError, struct.error, zlib.error) as error:
        return Difference(name, f"bytes differ ({error})")
    if pair[0] is None:
        return Difference(name, first_line(left, right))
    shapes = [[(key, len(values)) for key, values in columns.items()] for columns in pair]
    if shapes[0] != shapes[1]:
        rows = [max((length for key, length in shape), default=0) for shape in shapes]
        return Difference(name, f"rows or columns differ ({rows[0]} and {rows[1]} rows)")
    keys = [key for key, values in pair[0].items() if values != pair[1][key]]
    physical = [key for key in keys if not ROUND_OFF.search(key)]
    if physical or pass_over_round_off:
        return largest_of(name, physical, *pair)
    if keys:
        return largest_of(name, keys, *pair, "only round-off, ")
    return Difference(name, "bytes differ, numbers do not")


def first_line(left, right):
    """Returns a text with the first line in which two files differ."""
    lines = [data.decode(errors="replace").split("\n") for data in (left, right)]
    for number, (one, other) in enumerate(zip(*lines), 1):
        if one != other:
            return f"line {number}: '{one[:60]}' and '{other[:60]}'"
    return "one is longer than the other"


def largest_of(name, keys, left, right, label=""):
    """Returns the Difference of the columns named by keys, which have equal shapes."""
    count, apart, where = 0, 0.0, ""
    for key in keys:
        values, others = left[key], right[key]
        scale = max((abs(v) for v in values + others if is_finite(v)), default=0.0)
        for row, (a, b) in enumerate(zip(values, others), 1):
            if a == b or (a != a and b != b):
                continue
            if not (is_finite(a) and is_finite(b)):
                return Difference(name, f"'{a}' and '{b}' in {key}, row {row}")
            count += 1
            if abs(a - b) > apart * scale:
                apart, where = abs(a - b) / scale, f"{key}, row {row}: {a!r} and {b!r}"
    return Difference(name, f"{label}{count} numbers differ", apart, where)


def is_finite(value):
    """Returns whether a value is a number of finite size."""
    return isinstance(value, float) and value - value == 0.0


def cell(text):
    """Returns a cell of a table as number where it is one."""
    return float(text) if NUMBER.match(text) else text


def columns_of(name, data):
    """Returns a dictionary of columns of a file, None where it is plain text."""
    if name.endswith(".csv"):
        return csv_columns(data.decode())
    if name.endswith(".json"):
        return dict(json_columns("", json.loads(data)))
    if name.endswith(".vtu"):
        return vtu_columns(data.decode())
    return None


def csv_columns(text):
    """Returns the columns of a table. The row `sum` of reactions is a column of its own."""
    lines = [line.split(",") for line in text.splitlines()]
    head = lines[0]
    columns = {title: [] for title in head}
    for line in lines[1:]:
        if len(line) != len(head):
            raise ValueError("rows of several lengths")
        if line[0] == "sum":
            columns.update((f"sum row/{key}", [cell(v)]) for key, v in zip(head, line))
            continue
        for title, value in zip(head, line):
            columns[title].append(cell(value))
    return columns


def json_columns(path, value):
    """Yields (path, [value]) for the leaves of a JSON value."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from json_columns(f"{path}.{key}" if path else key, inner)
    elif isinstance(value, list):
        for number, inner in enumerate(value):
            yield from json_columns(f"{path}[{number}]", inner)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, [float(value)]
    else:
        yield path, [value if isinstance(value, str) else repr(value)]


# ------------------------------------------------------------------ fields

ARRAY = re.compile(r"<DataArray ([^>]*)>([^<]*)</DataArray>")
LETTERS = {"Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B", "Float32": "f"}


def vtu_columns(text):
    """Returns the arrays of a compressed .vtu file, one column for each component."""
    columns = {}
    for number, (attributes, content) in enumerate(ARRAY.findall(text)):
        named = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
        values = array_values(content.strip(), LETTERS[named["type"]])
        width = int(named.get("NumberOfComponents", 1))
        title = named.get("Name", "points")
        for part in range(width):
            key = f"{title} {part}" if width > 1 else title
            if key in columns:
                key = f"{key} of array {number}"
            columns[key] = [float(v) for v in values[part::width]]
    return columns


def array_values(content, letter):
    """Returns the numbers of a DataArray: a header of sizes and compressed blocks, both base64."""
    if not content:
        return []
    blocks = struct.unpack("<Q", base64.b64decode(content[:12])[:8])[0]
    header_bytes = 8 * (3 + blocks)
    letters = (header_bytes + 2) // 3 * 4
    sizes = struct.unpack(f"<{3 + blocks}Q", base64.b64decode(content[:letters]))[3:]
    packed = base64.b64decode(content[letters:])
    data, start = b"", 0
    for size in sizes:
        data += zlib.decompress(packed[start : start + size])
        start += size
    return struct.unpack(f"<{len(data) // struct.calcsize(letter)}{letter}", data)
