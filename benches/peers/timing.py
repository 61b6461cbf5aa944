"""Medians of runs that take turns, and the builds that are the fastest.

In every round each program runs the case once, so that what slows the machine slows all of them. A case in which a
program's spread is above `LARGEST_SPREAD` is measured again, `ATTEMPTS` times in all; of the attempts the one with the fewest
such programs counts, of equal ones that with the smallest largest spread. Rates play no part in that choice.
"""

import json
import statistics
import sys

import numpy as np

from builds import NAMES
from processes import Stopped

FORMS = ("written", "cos2phi")
OURS = "rotor"
# Half the distance of the quartiles over the median. The ratios that are asked for are stated to about a tenth.
LARGEST_SPREAD = 0.1
ATTEMPTS = 4
# How far results may be off those of this library. The other form loses half the digits near zero unstable points, of
# which some are among random inputs: what it is off by there is on the page.
TOLERANCES = {"written": 1e-12, "cos2phi": 1e-9}


def median_and_spread(seconds):
    median = statistics.median(seconds)
    if len(seconds) < 2:
        return median, 0.0
    lower, _, upper = statistics.quantiles(seconds, n=4)
    return median, (upper - lower) / 2 / median


def difference(found, expected):
    """The largest difference, relative to the result or to a hundredth of the largest where it is smaller."""
    worst = 0.0
    for a, b in zip(np.split(found, 2), np.split(expected, 2)):
        scale = np.maximum(np.abs(b), 0.01 * np.abs(b).max())
        worst = max(worst, float(np.max(np.abs(a - b) / scale)))
    return worst


def turns(case, programs, rounds):
    """Seconds of every run, by program."""
    seconds = {name: [] for name in programs}
    for _ in range(rounds):
        for name, process in programs.items():
            seconds[name].append(float(process.ask(f"run {case}")))
    return seconds


def steady_turns(case, programs, rounds, attempts):
    """The same, measured again while spreads are large; and how often it was measured."""
    # Not counted: what is compiled late, and memory that is seen for the first time.
    turns(case, programs, 1)
    best = None
    for attempt in range(1, attempts + 1):
        seconds = turns(case, programs, rounds)
        spreads = [median_and_spread(runs)[1] for runs in seconds.values()]
        rank = sum(spread > LARGEST_SPREAD for spread in spreads), max(spreads)
        if best is None or rank < best[0]:
            best = rank, seconds
        if best[0][0] == 0:
            break
    shown = ", ".join(f"{name} {statistics.median(runs):.3g} s" for name, runs in best[1].items())
    print(f"{case} (measured {attempt} times, {best[0][0]} not steady): {shown}", flush=True)
    return best[1], attempt


class Tuning:
    """Tries every build of a tool, and remembers which is the fastest for a case and a form."""

    def __init__(self, comparison, expected, rounds):
        self.comparison, self.expected, self.rounds = comparison, expected, rounds
        self.chosen, self.about = {}, []

    def tool(self, tool, builds, cases, threaded):
        """Tries the builds on these cases, which are all threaded or all not."""
        entries = [(build, form) for build in builds for form in FORMS]
        programs = {entry: self.comparison.worker(*entry, threaded) for entry in entries}
        usable = {}
        for entry, process in programs.items():
            if (reason := self.absence(process)) is not None:
                self.note(entry, threaded, reason=reason)
            else:
                usable[entry] = process
        for case in cases:
            self.case(tool, case, usable, threaded)
        if not threaded:
            for entry, process in usable.items():
                self.note(entry, threaded, vectors=json.loads(process.ask("vectors")))
        for process in programs.values():
            process.close()

    @staticmethod
    def absence(process):
        try:
            answer = process.line()
        except Stopped:
            return "it stopped as it was made"
        return None if answer == "ready" else answer.removeprefix("absent ")

    def note(self, entry, threaded, **what):
        build, form = entry
        about = {"tool": build.tool, "build": build.name, "form": form, "threaded": threaded} | what
        self.about.append(about)
        if "reason" in what:
            print(f"{NAMES[build.tool]}, {build.name}, {form}: {what['reason']}", file=sys.stderr, flush=True)

    def case(self, tool, case, usable, threaded):
        """Which build of those with the right results is the fastest, form by form."""
        right = {}
        for entry, process in list(usable.items()):
            file = self.comparison.folder / "found.f64"
            try:
                process.ask(f"write {case} {file}")
            except Stopped:
                self.note(entry, threaded, reason=f"it stopped in {case}")
                del usable[entry]
                continue
            off = difference(np.fromfile(file), self.expected(case))
            if off <= TOLERANCES[entry[1]]:
                right[entry] = process, off
            else:
                self.note(entry, threaded, reason=f"in {case} its results are off by {off:.1e}")
        seconds = turns(case, {entry: process for entry, (process, _) in right.items()}, self.rounds)
        for entry, runs in seconds.items():
            # What disturbs a run makes it longer: of few runs the shortest says most about a build.
            took = min(runs)
            self.note(entry, threaded, case=case, seconds=took, off=right[entry][1])
            usable[entry].ask("forget")
            key = case, tool, entry[1]
            if key not in self.chosen or took < self.chosen[key][1]:
                self.chosen[key] = entry, took
        shown = [f"{build.name} [{form}] {min(runs):.3g} s" for (build, form), runs in seconds.items()]
        print(f"{case}, {NAMES[tool]}:\n    " + "\n    ".join(shown), flush=True)
