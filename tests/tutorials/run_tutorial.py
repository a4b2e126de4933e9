"""Does what a tutorial says, in an empty folder, and compares what the commands print.

usage: run_tutorial.py PROGRAM PAGE.md [--draw] [--show]

A page consists of text and blocks of code:
- A block below "... `name.toml`:" is written to that file; after "Add" it goes to its end. A block
  below "From `meshes/name.toml`:" must stand in that file.
- Of a block "console", lines that begin with "$ " are run; they must succeed. The other lines must be
  printed, in this order; "..." stands for any text, or any lines.
- The title of a picture names the file that the commands draw: ![words](images/a.svg "results/a.svg").
  Of several files, as of "fields_*.svg", it is the one with the largest number.

Numbers agree within TOLERANCE. Results do not depend on threads. No printed digit changed with other
kernels of the BLAS, or with a modulus larger by 1e-8: the tolerance leaves room for other processors.
`--draw` renews the pictures of the page, `--show` prints all output.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOLERANCE = 0.001
# Other versions of gmsh place other vertices.
TOLERANCES = {"l_panel": 0.03}
LARGEST_PICTURE = 60_000  # bytes

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", re.IGNORECASE)


class Failure(Exception):
    pass


def blocks(lines):
    """Yields (language, line before, line number, text) of every fenced block."""
    before, start = "", None
    for number, line in enumerate(lines, 1):
        if line.startswith("```"):
            if start is None:
                start = (line[3:].strip(), before, number)
                body = []
            else:
                yield (*start, "".join(text + "\n" for text in body))
                start = None
        elif start is not None:
            body.append(line)
        elif line.strip():
            before = line
    if start is not None:
        raise Failure(f"line {start[2]}: the block does not end")


def agrees(expected, printed, tolerance):
    """Whether two lines have the same words, and numbers within the relative tolerance."""
    pattern = re.escape(NUMBER.sub("\0", " ".join(expected.split()))).replace(r"\.\.\.", ".*?")
    found = re.fullmatch(pattern.replace("\0", f"({NUMBER.pattern})"), " ".join(printed.split()),
                         re.IGNORECASE)
    if not found:
        return False
    pairs = zip(NUMBER.findall(expected), found.groups(), strict=True)
    return all(abs(float(a) - float(b)) <= tolerance * abs(float(a)) for a, b in pairs)


class Tutorial:
    def __init__(self, page, folder, environment, show):
        self.page, self.folder, self.environment, self.show = page, folder, environment, show
        self.lines = page.read_text(encoding="utf-8").splitlines()
        self.tolerance = TOLERANCES.get(page.stem, TOLERANCE)
        self.commands = 0

    def run(self):
        for language, before, number, text in blocks(self.lines):
            if language == "console":
                self.run_commands(number, text)
            else:
                self.take_file(before, number, text)
        if not self.commands:
            raise Failure("the page has no command")

    def take_file(self, before, number, text):
        names = re.findall(r"`([\w/]+\.(?:toml|py|geo))`", before)
        if not before.endswith(":") or not names:
            raise Failure(f"line {number}: no line before the block names its file")
        if before.startswith("From "):
            if text not in (ROOT / names[-1]).read_text(encoding="utf-8"):
                raise Failure(f"line {number}: this does not stand in {names[-1]}")
            return
        with open(self.folder / names[-1], "a" if "Add to " in before else "w",
                  encoding="utf-8") as file:
            file.write(text)

    def run_commands(self, number, text):
        printed = []
        for number, line in enumerate(text.splitlines(), number + 1):
            if line.startswith("$ "):
                printed = self.output_of(number, line[2:])
            elif line != "...":
                while printed and not agrees(line, printed[0], self.tolerance):
                    printed.pop(0)
                if not printed:
                    raise Failure(f"line {number}: this is not printed: {line}")
                printed.pop(0)

    def output_of(self, number, command):
        self.commands += 1
        end = subprocess.run(["sh", "-c", command], cwd=self.folder, env=self.environment,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, encoding="utf-8", check=False)
        if self.show:
            print("$", command, "\n", end.stdout, sep="")
        if end.returncode != 0:
            raise Failure(f"line {number}: exit status {end.returncode}: {command}\n{end.stdout}")
        return end.stdout.splitlines()

    def check_pictures(self, draw):
        for name, source in re.findall(r'!\[[^]]*\]\((\S+) "(\S+)"\)', "\n".join(self.lines)):
            drawn = sorted(self.folder.glob(source), key=lambda path: (len(path.name), path.name))
            if not drawn:
                raise Failure(f"{name}: no command draws {source}")
            if draw:
                shutil.copy(drawn[-1], self.page.parent / name)
            if not (self.page.parent / name).is_file():
                raise Failure(f"{name} is missing: --draw makes it")
            if (self.page.parent / name).stat().st_size > LARGEST_PICTURE:
                raise Failure(f"{name} exceeds {LARGEST_PICTURE} bytes")


def environment_of(program, folder):
    """Puts the program, and this Python as python3, first in the search path."""
    folder.mkdir()
    for name, path in {"perilink": program, "python3": sys.executable}.items():
        (folder / name).write_text(f"#!/bin/sh\nexec '{path}' \"$@\"\n")
        (folder / name).chmod(0o755)
    return dict(os.environ, PATH=f"{folder}{os.pathsep}{os.environ['PATH']}")


def main(program, page, *options):
    page = Path(page).resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "reader"
        folder.mkdir()
        for name in ("meshes", "verification"):
            (folder / name).symlink_to(ROOT / name)
        environment = environment_of(Path(program).resolve(), Path(temporary) / "bin")
        tutorial = Tutorial(page, folder, environment, "--show" in options)
        try:
            tutorial.run()
            tutorial.check_pictures("--draw" in options)
        except Failure as failure:
            sys.exit(f"{page.name}: {failure}")
    print(f"{page.name}: {tutorial.commands} commands")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
