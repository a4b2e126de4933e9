#!/usr/bin/env python3
"""Kills runs of the golden cases at random moments and takes them up again with --resume.

    resume_programs.py BUILD/bin/perilink [--kills N] [--filter REGEX] [--seed N]

Every file of the results must have the bytes of a run that was never stopped. Exit status: 0 equal,
1 different, 2 misuse.
"""

import argparse
import concurrent.futures
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the folder of the sources stays as it is
import differences  # noqa: E402
import results  # noqa: E402

NO_STATE = re.compile(r'(?m)^type = "elastic"')  # such runs are not saved


def arguments():
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=3, metavar="N", help="of each run [3]")
    parser.add_argument("--filter", default="", metavar="REGEX", help="only cases of these names")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the moments [1]")
    parser.add_argument("--jobs", "-j", type=int, default=2, metavar="N", help="runs at a time [2]")
    return parser.parse_args()


def with_checkpoints(case, rows):
    """Returns the case with a checkpoint after so many rows."""
    line = f"checkpoint_every = {rows}\n"
    text = case.text
    if "\n[output]\n" in text:
        text = text.replace("\n[output]\n", f"\n[output]\n{line}", 1)
    else:
        text += f"\n[output]\n{line}"
    return results.Case(case.name, case.group, text, case.shows, case.options)


class Killing:
    """Runs of one case below a folder: one to its end, one that is killed."""

    def __init__(self, home, program, case, kills, seed):
        self.home, self.program, self.case, self.kills = home, program, case, kills
        self.random = random.Random(f"{seed} {case.name}")
        self.killed = 0

    def start(self, out, *options):
        """Starts a run."""
        command = [self.program, "run", f"cases/{self.case.name}.toml", "--threads", "1"]
        command += self.case.options
        return subprocess.Popen(
            command + ["--out", out, "--quiet", *options],
            cwd=self.home,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def execute(self):
        """Returns the differences as texts; None where the case does not run."""
        begin = time.monotonic()
        status = self.start("whole/" + self.case.name).wait()
        seconds = time.monotonic() - begin
        if status == 2:
            return None
        out = "killed/" + self.case.name
        for _ in range(self.kills):
            run = self.start(out, "--resume")
            try:
                run.wait(self.random.uniform(0.0, seconds))
            except subprocess.TimeoutExpired:
                run.kill()
                self.killed += 1
            run.wait()
        end = self.start(out, "--resume").wait()
        found = [] if end == status else [f"exit status {status} and {end}"]
        pair = [self.home / "whole" / self.case.name, self.home / out]
        return found + [str(each) for each in differences.compare_folders(*pair)]


def main():
    """Returns the exit status."""
    options = arguments()
    program = pathlib.Path(options.program).resolve()
    if not program.is_file():
        print(f"resume_programs: there is no program {options.program}", file=sys.stderr)
        return 2
    rows = random.Random(options.seed)
    wanted = re.compile(options.filter)
    cases = [
        with_checkpoints(each, rows.choice([2, 5, 20, 80]))
        for each in results.all_cases()
        if wanted.search(each.name) and not each.long and not NO_STATE.search(each.text)
    ]
    different = runs = kills = 0
    with tempfile.TemporaryDirectory(prefix="resume_") as scratch:
        home = pathlib.Path(scratch)
        results.write_inputs(home, cases)
        killings = [Killing(home, program, each, options.kills, options.seed) for each in cases]
        with concurrent.futures.ThreadPoolExecutor(max_workers=options.jobs) as pool:
            for killing, found in zip(killings, pool.map(Killing.execute, killings)):
                runs += found is not None
                kills += killing.killed
                different += bool(found)
                if found:
                    print(f"{killing.case.name}: {'; '.join(found[:4])}", flush=True)
    print(f"{runs} runs, {kills} kills: {runs - different} equal, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
