"""Runs of a program: the inputs of all cases, one run, and what its results show."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess

import bodies
import case_text
import mesh_bodies
import options
import space_cases
import thin_bodies

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Cases of meshes/ that take longer than about 20 s: only with --all.
LONG = {  # with settings that end a run early: that much of it is compared each time
    "meshes/block_refined": ["stop.broken_bonds=300"],
    "meshes/brazilian_disc": ["analysis.duration=0.002", "analysis.ramp_time=0.001"],
    "meshes/dog_bone": ["analysis.duration=0.002", "analysis.ramp_time=0.001"],
    "meshes/l_panel": ["stop.displacement=0.13"],
    "meshes/l_panel_fine": ["stop.displacement=0.07"],
    "meshes/notched_prism": ["stop.displacement=0.03"],
    "meshes/sheared_plate": ["stages[2].displacement=0.004"],
    "meshes/splm_compression": ["analysis.duration=0.002", "analysis.ramp_time=0.001"],
}


class Case:
    """A case: its name, its group, its text, features that its results must show, options."""

    def __init__(self, name, group, text, shows=(), options=()):
        self.name, self.group, self.text, self.shows = name, group, text, shows
        self.options = options
        self.iterative = "iterative" in name

    @property
    def long(self):
        return self.name in LONG


def small_cases():
    """Returns the cases of the tables."""
    known = {**bodies.BODIES, **mesh_bodies.MESH_BODIES, **thin_bodies.THIN_BODIES}
    found = []
    for name, body, names, shows, more in space_cases.CASES:
        text = case_text.CaseText().add(known[body])
        for option in names:
            text.add(options.OPTIONS[option])
        found.append(Case(name, "small", f"# {name}\n{text.add(more)}", shows))
    return found


def file_cases(folder, group):
    """Returns the cases that stand in files of a folder."""
    return [
        Case(f"{group}/{path.stem}", group, path.read_text())
        for path in sorted((ROOT / folder).glob("*.toml"))
    ]


def shortened(case):
    """Returns the beginning of a long case."""
    text = f"# ends early: {', '.join(LONG[case.name])}\n{case.text}"
    settings = LONG[case.name]
    if "fields_times" in text:
        settings = [*settings, "output.fields_times=[0.001]"]
    options = [f"--set={setting}" for setting in settings]
    return Case(f"{case.name}_begun", case.group, text, (), options)


def all_cases():
    """Returns every case, small ones first."""
    found = small_cases()
    examples = file_cases("meshes", "meshes")
    found += examples
    found += [shortened(each) for each in examples if each.long]
    found += file_cases("tests/cli/malformed/bases", "bases")
    found += file_cases("tests/fuzz/corpus", "fuzz")
    names = [each.name for each in found]
    if len(names) != len(set(names)):
        raise ValueError("two cases have one name")
    return found


def write_inputs(home, cases):
    """Writes cases and meshes below a folder. Paths of a case are the same for every program."""
    for folder in ("cases/meshes", "cases/fuzz"):
        (home / folder).mkdir(parents=True, exist_ok=True)
    for path in sorted((ROOT / "meshes").iterdir()):
        if path.suffix in (".msh", ".geo"):
            copy_if_new(path, home / "cases/meshes" / path.name)
    copy_if_new(ROOT / "tests/fuzz/corpus_mesh/square.msh", home / "cases/fuzz/plate.msh")
    for each in cases:
        path = home / f"cases/{each.name}.toml"
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text() != each.text:
            path.write_text(each.text)


def copy_if_new(source, target):
    """Copies a file unless the target has its bytes."""
    if not target.exists() or target.read_bytes() != source.read_bytes():
        shutil.copyfile(source, target)


def check_program(home, program):
    """Returns whether kept results are those of a program. Notes the program in a new folder."""
    note = home / "program.sha256"
    digest = hashlib.sha256(program.read_bytes()).hexdigest()
    if not note.exists():
        note.write_text(digest)
    return note.read_text() == digest


class Run:
    """The results of one run below a home folder: files, exit status and messages."""

    def __init__(self, home, case, threads):
        self.home, self.case, self.threads = home, case, threads
        self.folder = home / f"results_{threads}/{case.name}"
        self.record = home / f"results_{threads}/{case.name}.run.json"

    def is_done(self):
        """Returns whether the run is kept, of the text that the case has now."""
        return self.record.exists() and self.load()["text"] == self.case.text

    def load(self):
        """Returns the record: status, messages, seconds and the text of the case."""
        return json.loads(self.record.read_text())

    def execute(self, program, timeout):
        """Runs a program and writes the record."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.record.unlink(missing_ok=True)
        self.folder.parent.mkdir(parents=True, exist_ok=True)
        out = self.folder.relative_to(self.home)
        command = [program, "run", f"cases/{self.case.name}.toml", "--out", out]
        command += ["--threads", str(self.threads), *self.case.options]
        environment = {**os.environ, "OMP_NUM_THREADS": str(self.threads)}
        before = os.times()
        try:
            end = subprocess.run(
                command,
                cwd=self.home,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                timeout=timeout,
            )
            status, texts = end.returncode, (end.stdout, end.stderr)
        except subprocess.TimeoutExpired:
            status, texts = f"longer than {timeout} s", (b"", b"")
        record = {
            "status": status,
            "seconds": os.times().elapsed - before.elapsed,
            "out": texts[0].decode(errors="replace"),
            "err": texts[1].decode(errors="replace"),
            "text": self.case.text,
        }
        self.record.write_text(json.dumps(record, indent=1))

    def messages(self):
        """Returns what the program printed, without times, rates, memory and folders."""
        record = self.load()
        return normalised(record["out"] + "\n--- stderr\n" + record["err"])


CHANGING = [
    (re.compile(r"results_\d+/"), "results/"),
    (re.compile(r"(?m)^.*, [\w ]+ (so far|left)$\n?"), ""),  # progress, by the clock
    (re.compile(r"/[\w./-]*/(cases|results)/"), r"\1/"),
    (re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(\.\d+)?"), "TIME"),
    (re.compile(r"\b\d+(\.\d+)?(e[+-]?\d+)? ?(s|ms|min|h|MB|GB|kB)\b"), "N"),
    (re.compile(r" ?\([^()]*/s\)"), ""),
    (re.compile(r"\b\d+ threads?\b"), "threads"),
]


def normalised(text):
    """Returns a text without what changes from run to run."""
    for pattern, replacement in CHANGING:
        text = pattern.sub(replacement, text)
    return "\n".join(line.rstrip() for line in text.splitlines())


# ------------------------------------------------------------------ what results show


def history_of(folder):
    """Returns the columns of history.csv as lists of numbers."""
    lines = [line.split(",") for line in (folder / "history.csv").read_text().splitlines()]
    return {title: [float(line[k]) for line in lines[1:]] for k, title in enumerate(lines[0])}


def reaches(column, value):
    """Returns a test of whether a column of the history reaches a value."""
    return lambda history, summary, folder: max(history.get(column, [0])) >= value


SHOWN = {
    "broken": lambda history, summary, folder: summary["broken_bonds"] > 0,
    "yield": lambda history, summary, folder: summary["yield_events"] > 0,
    "cracked": lambda history, summary, folder: summary["cracked_particles"] > 0,
    "plastic": lambda history, summary, folder: summary["plastic_energy"] > 0,
    "dissipated": lambda history, summary, folder: summary["dissipated_energy"] > 0,
    "release": lambda history, summary, folder: summary["conversions"] > 0,
    "missed": lambda history, summary, folder: summary["late_conversions"] > 0,
    "freed": lambda history, summary, folder: summary["freed_energy"] > 0,
    "bars": lambda history, summary, folder: any(folder.glob("bars_*.csv")),
    "stages": lambda history, summary, folder: len(history["stage"]) > 0
    and history["stage"][-1] == len(summary["stages"])
    and len(summary["stages"]) > 1,
    "batches": reaches("events", 2),
    "side_change": reaches("side_change", 1),
    "avalanche": reaches("avalanche", 1),
}


def missing_features(run):
    """Returns the features of `shows` that results lack, or a bad exit status."""
    status = run.load()["status"]
    if status == 2 and run.case.group in ("bases", "fuzz"):
        return []  # the case is there for its refusal
    if status != 0:
        return [f"exit status {status}"]
    try:
        summary = json.loads((run.folder / "summary.json").read_text())
        history = history_of(run.folder)
        return [word for word in run.case.shows if not SHOWN[word](history, summary, run.folder)]
    except (OSError, ValueError, LookupError) as error:
        return [f"results that can be read ({error!r})"]
