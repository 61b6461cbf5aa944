"""Times this library and the other tools side by side, in one go, on the same inputs.

    python compare.py FOLDER PROGRAMS [--quick]

FOLDER holds what `export` and `measure` wrote or will write, PROGRAMS the built programs `measure` and `rotor`. Every tool
is a process of its own, which waits until it is its turn. First each tool's builds are tried, in both forms of the text;
the fastest of those with the right results is then timed beside this library.
"""

import json
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

import accuracy
import builds
import report
import timing
from processes import Comparison

HERE = Path(__file__).parent
SINGLE = ["numpy", "numexpr", "numba", "jax", "symjit", "casadi", "symforce", "c"]
CASES = {
    "widths_block": SINGLE,
    "widths_stream": SINGLE,
    "grid_sigma_phi": ["numpy", "numexpr", "numba", "jax", "symforce", "c", "numba-staged", "c-staged"],
    "max_over_phi": ["numba", "symforce", "c", "numba-staged", "c-staged"],
}
THREADED_CASES = {
    "widths_stream_threads": ["numexpr", "numba", "jax", "symjit", "casadi", "symforce", "c"],
    "grid_sigma_phi_threads": ["numba", "jax", "symforce", "c", "numba-staged", "c-staged"],
}
# Cases of this library alone, and its process: pinned to one processor, or with all.
OWN_CASES = {
    "max_over_phi_whole": False,
    "physical_values": False,
    "physical_gradients": False,
    "widths_one_thread": False,
    "widths_two_threads": True,
}
# How often each case is run: long ones less often. `few` and `many` differ between a real and a quick comparison.
LONG = {"grid_sigma_phi", "grid_sigma_phi_threads", "max_over_phi", "max_over_phi_whole", "scan_parquet", "scan_parquet_threads"}


class Filling:
    """This library's process, asked to fill the grid's memory in place of computing it."""

    def __init__(self, library):
        self.library = library

    def ask(self, _):
        return self.library.ask("run grid_fill")


class Level:
    """The comparison at one level of instructions."""

    def __init__(self, comparison, quick):
        self.comparison, self.quick = comparison, quick
        self.few, self.many = (3, 5) if quick else (9, 30)
        self.attempts = 1 if quick else timing.ATTEMPTS
        self.library = {threaded: comparison.library(threaded) for threaded in (False, True)}
        self.library[False].ask(f"inputs {comparison.folder}")
        self.places = accuracy.written(comparison.folder)
        self.about = {"level": comparison.level, "seconds": {}, "attempts": {}, "points": {}, "near": {}}
        self.known = {}

    def expected(self, case):
        """This library's results, of one thread."""
        if case not in self.known:
            file = self.comparison.folder / "expected.f64"
            self.library[False].ask(f"write {case.removesuffix('_threads')} {file}")
            self.known = {case: np.fromfile(file)}
        return self.known[case]

    def rounds(self, case):
        return self.few if case in LONG else self.many

    def tuned(self):
        """Every tool's builds, tried."""
        tuning = timing.Tuning(self.comparison, self.expected, 1 if self.quick else 7)
        for tool, tried in builds.builds(self.comparison.level, self.comparison.has_avx512).items():
            for cases, threaded in ((CASES, False), (THREADED_CASES, True)):
                wanted = [case for case, tools in cases.items() if tool in tools]
                if wanted:
                    tuning.tool(tool, tried, wanted, threaded)
        self.known = {}
        self.about["tuning"] = tuning.about
        self.about["chosen"] = {f"{case} {tool} {form}": entry[0].name for (case, tool, form), (entry, _) in tuning.chosen.items()}
        return tuning.chosen

    def compared(self, chosen):
        """Each tool's best builds beside this library, case by case."""
        for cases, threaded in ((CASES, False), (THREADED_CASES, True)):
            for case, tools in cases.items():
                programs = {timing.OURS: self.library[threaded]}
                for tool in tools:
                    for form in timing.FORMS:
                        if (case, tool, form) in chosen:
                            entry, _ = chosen[case, tool, form]
                            programs[f"{tool} {form}"] = self.comparison.worker(*entry, threaded)
                others = [process for name, process in programs.items() if name != timing.OURS]
                for process in others:
                    # It was ready as its builds were tried.
                    process.line()
                if case == "grid_sigma_phi":
                    programs["fill"] = Filling(self.library[threaded])
                self.timed(case, programs)
                self.near(case, programs)
                for process in others:
                    process.close()

    def timed(self, case, programs):
        seconds, attempts = timing.steady_turns(case, programs, self.rounds(case), self.attempts)
        self.about["seconds"][case], self.about["attempts"][case] = seconds, attempts

    def near(self, case, programs):
        """The digits that the two single-threaded forms keep near zero unstable points."""
        form = {"widths_block": "columns", "grid_sigma_phi": "grid"}.get(case)
        if form:
            folder = self.comparison.folder
            found = {name: accuracy.largest_errors(process, form, self.places, folder) for name, process in programs.items() if name != "fill"}
            self.about["near"][case] = found

    def own(self):
        """This library's own cases, and the whole of `rotor scan` beside writing its columns alone."""
        for case, threaded in OWN_CASES.items():
            self.timed(case, {timing.OURS: self.library[threaded]})
        for threaded in (False, True):
            case = "scan_parquet_threads" if threaded else "scan_parquet"
            file = self.comparison.folder / "scan.parquet"
            scan = self.comparison.scan(file, threaded)
            scan.ask("")
            alone = self.comparison.writer(file)
            self.timed(case, {timing.OURS: scan, "alone": alone})
            alone.close()
            self.about["points"][case] = self.comparison.sizes[0] ** 2

    def run(self):
        self.compared(self.tuned())
        self.own()
        for case in [*CASES, *THREADED_CASES, *OWN_CASES]:
            self.about["points"][case] = int(self.library[False].ask(f"points {case}"))
        for process in self.library.values():
            process.close()
        return self.about


def versions(folder):
    """What was compared, as each says itself."""
    import importlib.metadata

    names = ["numpy", "sympy", "symforce", "numexpr", "numba", "jax", "symjit", "casadi", "pyarrow"]
    known = {name: importlib.metadata.version(name) for name in names}
    listed = subprocess.run([folder / "python-svml/bin/python", "-m", "pip", "list", "--format=json"], capture_output=True, text=True)
    svml = {package["name"]: package["version"] for package in json.loads(listed.stdout)}
    known["numba with SVML"] = f"{svml['numba']} (intel-cmplr-lib-rt {svml['intel-cmplr-lib-rt']})"
    for name in (builds.GCC, builds.CLANG, "rustc"):
        found = shutil.which(name) and subprocess.run([name, "--version"], capture_output=True, text=True).stdout.splitlines()
        known[name] = found[0] if found else "not there"
    return known | {"python": platform.python_version(), "glibc": platform.libc_ver()[1]}


def machine():
    """What the machine is, as it says itself."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    of = lambda key: next((line.split(":", 1)[1].strip() for line in lines if line.startswith(key)), "unknown")
    flags = of("flags").split()
    wide = [flag for flag in ("avx2", "fma", "avx512f") if flag in flags]
    memory = next(line for line in Path("/proc/meminfo").read_text().splitlines() if line.startswith("MemTotal"))
    return {
        "processor": of("model name"),
        "family": f"family {of('cpu family')}, model {of('model')}".replace("\t", ""),
        "instructions": ", ".join(wide),
        "cpus": os.cpu_count(),
        "memory_gib": round(int(memory.split()[1]) / 2**20),
        "system": f"{platform.system()} {platform.machine()}",
        "load_at_start": os.getloadavg()[0],
    }


def main(folder, programs, quick=False):
    folder, programs = Path(folder).resolve(), Path(programs).resolve()
    shutil.rmtree(folder / "scratch", ignore_errors=True)
    sizes = [400, 50, 2000] if quick else [4000, 2000, 10000]
    about = {"machine": machine(), "versions": versions(folder), "sizes": sizes, "quick": quick, "levels": []}
    has_avx512 = "avx512f" in about["machine"]["instructions"]
    for level in ["avx512", "avx2"] if has_avx512 else ["avx2"]:
        print(f"=== {level}", flush=True)
        about["levels"].append(Level(Comparison(folder, programs, sizes, level, has_avx512), quick).run())
        (folder / "results.json").write_text(json.dumps(about, indent=1))
    report.write(about, HERE.parents[1] / "docs" if not quick else folder)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], "--quick" in sys.argv)
