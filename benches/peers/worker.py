"""One tool, computing what it is asked for on standard input: the counterpart of the program `measure`.

    python worker.py TOOL FOLDER GRID DEPTHS ANGLES

`run CASE` answers with the seconds of one run, `write CASE FILE` runs it and writes its results.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

import formulas
import tools

BLOCK, STREAM, REPEATS = 4096, 1 << 20, 32


def read(folder, name, columns):
    return list(np.fromfile(folder / f"{name}.f64").reshape(columns, -1))


def tool_named(name, loaded, folder):
    makers = {
        "numpy": tools.NumPy,
        "numexpr": tools.NumExpr,
        "numba": tools.Numba,
        "numba-staged": tools.StagedByHand,
        "jax": tools.Jax,
        "jax-threads": tools.Jax,
        "symjit": tools.Symjit,
        "casadi": tools.Casadi,
    }
    return tools.C(loaded, folder) if name == "c" else makers[name](loaded)


class Worker:
    def __init__(self, name, folder, grid, depths, angles):
        loaded = formulas.module(folder)
        self.tool = tool_named(name, loaded, folder)
        self.columns = read(folder, "columns", 8)
        rotor = json.loads((folder / "rotor.json").read_text())
        self.rows, self.angles = {}, {}
        for grid_name in ("grid", "max"):
            (at,) = read(folder, f"{grid_name}_depths", 1)
            integrals = read(folder, f"{grid_name}_integrals", 4)
            self.rows[grid_name] = tools.row_coefficients(loaded, rotor, at, integrals)
            (self.angles[grid_name],) = read(folder, f"{grid_name}_angles", 1)
        shapes = {
            "widths_block": BLOCK,
            "widths_stream": STREAM,
            "grid_sigma_phi": (grid, grid),
            "max_over_phi": depths,
        }
        self.shapes, self.kept = shapes, {}

    def results(self, case):
        if case not in self.kept:
            self.kept = {case: [np.zeros(self.shapes[case]) for _ in tools.RESULTS]}
        return self.kept[case]

    def run(self, case):
        getattr(self, case)(self.results(case))

    def widths_block(self, results):
        block = [column[:BLOCK] for column in self.columns]
        for _ in range(REPEATS):
            self.tool.widths(block, results)

    def widths_stream(self, results):
        self.tool.widths(self.columns, results)

    def grid_sigma_phi(self, results):
        self.tool.grid(self.rows["grid"], self.angles["grid"], results)

    def max_over_phi(self, results):
        rows, angles = self.rows["max"], self.angles["max"]
        if hasattr(self.tool, "greatest"):
            self.tool.greatest(rows, angles, results)
            return
        at = [np.empty((1, len(angles))) for _ in results]
        for i in range(len(rows[0])):
            self.tool.grid([row[i : i + 1] for row in rows], angles, at)
            if hasattr(self.tool, "fetch"):
                self.tool.fetch(at)
            for result, width in zip(results, at):
                result[i] = width.max()

    def write(self, case, file):
        self.run(case)
        results = self.results(case)
        if hasattr(self.tool, "fetch"):
            self.tool.fetch(results)
        np.concatenate([result.ravel() for result in results]).tofile(file)


def main(name, folder, *sizes):
    worker = Worker(name, Path(folder), *map(int, sizes))
    for line in sys.stdin:
        match line.split():
            case ["run", case]:
                start = time.perf_counter()
                worker.run(case)
                print(f"{time.perf_counter() - start:e}", flush=True)
            case ["write", case, file]:
                worker.write(case, file)
                print("done", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
