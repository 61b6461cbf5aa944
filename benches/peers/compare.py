"""Times this library and the other tools side by side, in one go, on the same inputs.

    python compare.py FOLDER MEASURE [--quick]

FOLDER holds what `export` and `measure` wrote or will write, MEASURE is the built program `measure`. Every tool is a
process of its own, which waits until it is its turn; in every round each tool runs each case once, so that what slows the
machine slows all of them. Before that every tool's results are held against this library's.
"""

import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

import report

HERE = Path(__file__).parent
OURS = "rotor"
TOOLS = ["numpy", "numexpr", "numba", "numba-staged", "jax", "jax-threads", "symjit", "casadi", "c"]
GRID_TOOLS = ["numpy", "numexpr", "numba", "numba-staged", "jax", "jax-threads", "c"]
CASES = {
    "widths_block": [tool for tool in TOOLS if tool != "numba-staged"],
    "widths_stream": [tool for tool in TOOLS if tool != "numba-staged"],
    "grid_sigma_phi": GRID_TOOLS,
    "max_over_phi": ["numba", "numba-staged", "c"],
}
OWN_CASES = ["grid_fill", "max_over_phi_whole", "physical_values", "physical_gradients", "widths_one_thread", "widths_two_threads"]
THREADED = {"jax-threads", "rotor-threads"}
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "NUMEXPR_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")}


class Process:
    """A program that answers a line for a line."""

    def __init__(self, name, command):
        cpu = max(os.sched_getaffinity(0))
        pin = None if name in THREADED else lambda: os.sched_setaffinity(0, {cpu})
        environment = os.environ | ({} if name in THREADED else ONE_THREAD)
        self.name = name
        self.child = subprocess.Popen(
            [str(part) for part in command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=pin,
            env=environment,
        )

    def ask(self, line):
        self.child.stdin.write(line + "\n")
        self.child.stdin.flush()
        answer = self.child.stdout.readline()
        if not answer:
            raise SystemExit(f"{self.name} stopped at `{line}`")
        return answer.strip()

    def close(self):
        self.child.stdin.close()
        self.child.wait()


def difference(found, expected):
    """The largest difference, relative to the result or to a hundredth of the largest where it is smaller."""
    worst = 0.0
    for a, b in zip(np.split(found, 2), np.split(expected, 2)):
        scale = np.maximum(np.abs(b), 0.01 * np.abs(b).max())
        worst = max(worst, float(np.max(np.abs(a - b) / scale)))
    return worst


def checked(processes, folder):
    """The tools' differences from this library's results, case by case; ends the program where one is too large."""
    differences = {}
    for case, tools in CASES.items():
        processes[OURS].ask(f"write {case} {folder / 'expected.f64'}")
        expected = np.fromfile(folder / "expected.f64")
        for tool in tools:
            processes[tool].ask(f"write {case} {folder / 'found.f64'}")
            found = np.fromfile(folder / "found.f64")
            worst = difference(found, expected)
            print(f"{case:16} {tool:14} differs by {worst:.1e}", flush=True)
            if not worst <= 1e-12:
                raise SystemExit(f"{tool} does not give the same answer in {case}")
            differences[f"{case} {tool}"] = worst
    return differences


def timed(processes, rounds):
    """Seconds of every run: by case, by tool."""
    plan = [(case, [OURS, *tools]) for case, tools in CASES.items()]
    plan += [(case, ["rotor-threads" if case == "widths_two_threads" else OURS]) for case in OWN_CASES]
    seconds = {case: {tool: [] for tool in tools} for case, tools in plan}
    for case, tools in plan:
        # One turn that is not counted warms caches and compiles what is compiled late.
        for turn in range(rounds[case] + 1):
            for tool in tools:
                took = float(processes[tool].ask(f"run {case}"))
                if turn:
                    seconds[case][tool].append(took)
        print(f"{case}: " + ", ".join(f"{tool} {statistics.median(s):.3g} s" for tool, s in seconds[case].items()), flush=True)
    return seconds


def versions():
    import importlib.metadata

    names = ["numpy", "sympy", "numexpr", "numba", "jax", "symjit", "casadi"]
    known = {name: importlib.metadata.version(name) for name in names}
    first = lambda command: subprocess.run(command, capture_output=True, text=True).stdout.splitlines()[0]
    return known | {"python": platform.python_version(), "gcc": first(["gcc", "--version"]), "rustc": first(["rustc", "--version"])}


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


def main(folder, measure, quick=False):
    folder = Path(folder)
    sizes = [400, 50, 2000] if quick else [4000, 2000, 10000]
    about = {"machine": machine(), "versions": versions(), "sizes": sizes, "quick": quick}
    processes = {OURS: Process(OURS, [measure, *sizes]), "rotor-threads": Process("rotor-threads", [measure, *sizes])}
    processes[OURS].ask(f"inputs {folder}")
    for tool in TOOLS:
        processes[tool] = Process(tool, [sys.executable, HERE / "worker.py", tool, folder, *sizes])
    about["differences"] = checked(processes, folder)
    few, many = (2, 5) if quick else (5, 30)
    rounds = {case: many for case in [*CASES, *OWN_CASES]}
    rounds |= {"grid_sigma_phi": few, "max_over_phi": few, "max_over_phi_whole": few, "grid_fill": few, "widths_stream": max(few, many // 3)}
    about["seconds"] = timed(processes, rounds)
    cases = [*CASES, *OWN_CASES]
    about["points"] = {case: int(processes[OURS].ask(f"points {case}")) for case in cases}
    for process in processes.values():
        process.close()
    (folder / "results.json").write_text(json.dumps(about, indent=1))
    report.write(about, HERE.parents[1] / "docs" if not quick else folder)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], "--quick" in sys.argv)
