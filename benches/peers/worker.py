"""One tool, computing what it is asked for on standard input: the counterpart of the program `measure`.

    python worker.py TOOL FORM OPTIONS THREADS FOLDER SCRATCH GRID DEPTHS ANGLES

First it says `ready`, or `absent` and why. Then `run CASE` answers with the seconds of one run, `write CASE FILE` runs it
and writes its results, `near FORM ROTORS ANGLES FILE` computes the rotors and angles of two files, `vectors` names the
vector functions that are called, `forget` lets go of the results.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

import formulas
import texts
import tools

BLOCK, STREAM, REPEATS = 4096, 1 << 20, 32
PAGE, LINE = 4096, 64
# As for this library: each column begins with a line of a page of its own, results with those from 0 on, inputs with those
# behind them, so that no tool's time depends on where a heap puts its columns.
FIRST_INPUT = 26


def placed(shape, line):
    """Zeros that begin with this line of a page."""
    count = int(np.prod(shape))
    memory = np.zeros(count + 2 * PAGE // 8)
    start = -memory.ctypes.data % PAGE + line * LINE % PAGE
    return memory[start // 8 :][:count].reshape(shape)


def read(file, columns):
    """The columns of a file, as inputs."""
    found = []
    for number, column in enumerate(np.fromfile(file).reshape(columns, -1)):
        found.append(placed(column.shape, FIRST_INPUT + number))
        found[-1][...] = column
    return found


class Worker:
    def __init__(self, tool, loaded, folder, sizes):
        grid, depths, _ = sizes
        self.tool, self.folder = tool, folder
        rotor = json.loads((folder / "rotor.json").read_text())
        self.columns = read(folder / "columns.f64", 8)
        self.rows, self.angles = {}, {}
        for name in ("grid", "max"):
            (at,) = read(folder / f"{name}_depths.f64", 1)
            integrals = read(folder / f"{name}_integrals.f64", 4)
            self.rows[name] = texts.row_coefficients(loaded, rotor, at, integrals)
            (self.angles[name],) = read(folder / f"{name}_angles.f64", 1)
        self.shapes = {"widths_block": BLOCK, "widths_stream": STREAM, "grid_sigma_phi": (grid, grid), "max_over_phi": depths}
        self.kept = {}

    def results(self, case):
        if case not in self.kept:
            self.kept = {case: [placed(self.shapes[case], place) for place in range(len(texts.RESULTS))]}
        return self.kept[case]

    def run(self, case):
        # What runs on all processors is the same work.
        case = case.removesuffix("_threads")
        results = self.results(case)
        match case:
            case "widths_block":
                block = [column[:BLOCK] for column in self.columns]
                for _ in range(REPEATS):
                    self.tool.widths(block, results)
            case "widths_stream":
                self.tool.widths(self.columns, results)
            case "grid_sigma_phi":
                self.tool.grid(self.rows["grid"], self.angles["grid"], results)
            case "max_over_phi":
                self.tool.greatest(self.rows["max"], self.angles["max"], results)
        return results

    def written(self, results, file):
        if hasattr(self.tool, "fetch"):
            self.tool.fetch(results)
        np.concatenate([result.ravel() for result in results]).tofile(file)

    def near(self, form, rotors, angles, file):
        rotors, (angles,) = read(rotors, 7), read(angles, 1)
        shape = (len(rotors[0]), len(angles))
        results = [np.zeros(shape) for _ in texts.RESULTS]
        if form == "grid":
            self.tool.grid(rotors, angles, results)
        else:
            columns = [np.repeat(column, len(angles)) for column in rotors] + [np.tile(angles, len(rotors[0]))]
            results = [result.ravel() for result in results]
            self.tool.widths(columns, results)
        self.written(results, file)

    def answer(self, line):
        match line.split():
            case ["run", case]:
                start = time.perf_counter()
                self.run(case)
                return f"{time.perf_counter() - start:e}"
            case ["write", case, file]:
                self.written(self.run(case), file)
            case ["near", *rest]:
                self.near(*rest)
            case ["vectors"]:
                return json.dumps(self.tool.vectors())
            case ["forget"]:
                self.kept = {}
        return "done"


def main(tool, form, options, threads, folder, scratch, *sizes):
    folder, scratch = Path(folder), Path(scratch)
    scratch.mkdir(parents=True, exist_ok=True)
    # Where the grid's rows come from; its text does not change them.
    loaded = formulas.module(folder)
    job = tools.Job(formulas.module(folder, form), form, scratch, json.loads(options), int(threads))
    try:
        worker = Worker(tools.made(tool, job), loaded, folder, [int(size) for size in sizes])
    except tools.Absent as reason:
        print("absent", " ".join(str(reason).split()), flush=True)
        return
    print("ready", flush=True)
    for line in sys.stdin:
        print(worker.answer(line), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
