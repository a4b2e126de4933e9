#!/usr/bin/env python3
"""Runs the golden cases with two programs and compares all that they write, byte for byte.

    compare_programs.py OLD/bin/perilink NEW/bin/perilink
    compare_programs.py --base-results KEPT OLD/bin/perilink NEW/bin/perilink

With --base-results the results of the first program are kept and used again. Cases that changed or
have no result yet run with the first program, too. Exit status: 0 equal, 1 different, 2 misuse.
"""

import argparse
import concurrent.futures
import pathlib
import re
import shutil
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the folder of the sources stays as it is
import differences  # noqa: E402
import results  # noqa: E402

MOST_LINES = 3  # files named for a case that differs


MISUSE = 2  # exit status


def refuse(text):
    """Ends the program with a message."""
    print(f"compare_programs: {text}", file=sys.stderr)
    sys.exit(MISUSE)


def arguments():
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base", nargs="?", help="program whose results count")
    parser.add_argument("new", nargs="?", help="program that is compared; left out: the base")
    parser.add_argument("--all", action="store_true", help="long cases, too")
    parser.add_argument("--filter", default="", metavar="REGEX", help="only cases of these names")
    parser.add_argument("--jobs", "-j", type=int, default=2, metavar="N", help="runs at a time [2]")
    parser.add_argument("--list", action="store_true", help="print the names of the cases")
    parser.add_argument("--keep", metavar="DIR", help="keep the results of the new program here")
    parser.add_argument("--base-results", metavar="DIR", help="keep those of the base, use them")
    parser.add_argument("--threads", default="1", metavar="1,2,3",
                        help="further numbers of threads of the new program [1]")
    parser.add_argument("--tolerance", type=float, default=0.0, metavar="T",
                        help="for cases named iterative: relative difference of numbers [0]")
    parser.add_argument("--everywhere", action="store_true", help="the tolerance is for all cases")
    parser.add_argument("--messages", action="store_true", help="messages must be equal, too")
    parser.add_argument("--timeout", type=float, default=900, metavar="S", help="of a run [900]")
    options = parser.parse_args()
    if not (options.base or options.list):
        parser.error("name a program, or two")
    return options


class Comparison:
    """All runs of both programs and the lines of the report."""

    def __init__(self, options, scratch):
        self.options = options
        self.threads = [int(text) for text in options.threads.split(",")]
        self.base_home = pathlib.Path(options.base_results or scratch / "base").resolve()
        self.new_home = pathlib.Path(options.keep or scratch / "new").resolve()
        if self.base_home == self.new_home:
            refuse("--keep and --base-results name one folder")
        self.base, self.new = find_program(options.base), find_program(options.new or options.base)
        self.differ = self.messages = self.failed = 0

    def execute(self, case):
        """Runs a case with both programs and returns the text of the report, empty when equal."""
        base = results.Run(self.base_home, case, self.threads[0])
        if not (self.options.base_results and base.is_done()):
            base.execute(self.base, self.options.timeout)
        runs = [results.Run(self.new_home, case, count) for count in self.threads]
        for run in runs:
            run.execute(self.new, self.options.timeout)
        found = self.compare(base, runs[0], "")
        for run in runs[1:]:
            found += self.compare(runs[0], run, f"{run.threads} threads: ")
        lacking = results.missing_features(base)
        if not (self.options.keep or self.options.base_results):
            shutil.rmtree(base.folder, ignore_errors=True)
        if not self.options.keep:
            for run in runs:
                shutil.rmtree(run.folder, ignore_errors=True)
        return found, lacking

    def compare(self, left, right, label):
        """Returns the differences of two runs as pairs of a kind and a text."""
        tolerant = left.case.iterative or self.options.everywhere
        tolerance = self.options.tolerance if tolerant else 0.0
        found = []
        status = [run.load()["status"] for run in (left, right)]
        if status[0] != status[1]:
            found.append(("files", f"{label}exit status {status[0]} and {status[1]}"))
        different = differences.compare_folders(left.folder, right.folder, tolerance)
        different.sort(key=lambda each: each.file != "history.csv")
        found += [("files", label + str(each)) for each in different[:MOST_LINES]]
        if len(different) > MOST_LINES:
            found.append(("files", f"{label}and {len(different) - MOST_LINES} more files"))
        if left.messages() != right.messages():
            found.append(("messages", f"{label}messages differ"))
        return found

    def report(self, case, found, lacking):
        """Prints the line of a case that differs and counts it."""
        files = [text for kind, text in found if kind == "files"]
        messages = [text for kind, text in found if kind == "messages"]
        self.messages += bool(messages)
        self.failed += bool(lacking)
        if lacking:
            print(f"{case.name}: the base program does not show: {', '.join(lacking)}", flush=True)
        if files or (messages and self.options.messages):
            self.differ += 1
        if files or messages:
            print(f"{case.name}: {'; '.join(files + messages)}", flush=True)


def find_program(text):
    """Returns the absolute path of a program, or ends with a message."""
    path = pathlib.Path(text).resolve()
    if not path.is_file():
        refuse(f"there is no program {text}")
    return path


def chosen_cases(options):
    """Returns the cases that the options ask for."""
    wanted = re.compile(options.filter)
    return [
        each
        for each in results.all_cases()
        if wanted.search(each.name) and (options.all or not each.long)
    ]


def compare_all(options, cases, scratch):
    """Runs and compares all cases. Returns the exit status."""
    comparison = Comparison(options, scratch)
    for home in (comparison.base_home, comparison.new_home):
        results.write_inputs(home, cases)
    if not results.check_program(comparison.base_home, comparison.base):
        refuse(f"{options.base_results} holds results of another program than {options.base}")
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(max_workers=options.jobs) as pool:
        pending = {pool.submit(comparison.execute, each): each for each in cases}
        try:
            for done in concurrent.futures.as_completed(pending):
                comparison.report(pending[done], *done.result())
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    failed = f", {comparison.failed} not as their names say" if comparison.failed else ""
    print(
        f"{len(cases)} cases: {len(cases) - comparison.differ} equal, {comparison.differ} differ"
        f" ({time.monotonic() - start:.0f} s{failed}), {comparison.messages} messages differ"
    )
    return 1 if comparison.differ or comparison.failed else 0


def main():
    """Returns the exit status."""
    options = arguments()
    cases = chosen_cases(options)
    if options.list:
        for each in cases:
            print(each.name)
        return 0
    if not cases:
        refuse("no case has such a name")
    with tempfile.TemporaryDirectory(prefix="golden_") as scratch:
        return compare_all(options, cases, pathlib.Path(scratch))


if __name__ == "__main__":
    sys.exit(main())
