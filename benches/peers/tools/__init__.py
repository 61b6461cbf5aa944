"""Each tool's way to compute both widths, made from the same formulas.

A tool is made from a `Job` and has `widths(columns, results)` for columns of points; some have `grid(rows, angles, results)`
for rows of coefficients against a row of angles, and `greatest(rows, angles, results)`. `vectors()` names the vector
functions that its code calls, where that can be seen.
"""

import importlib
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

KINDS = {
    "numpy": "arrays.NumPy",
    "numexpr": "arrays.NumExpr",
    "jax": "arrays.Jax",
    "symjit": "arrays.Symjit",
    "numba": "loops.Numba",
    "numba-staged": "loops.StagedNumba",
    "c": "native.C",
    "c-staged": "native.StagedC",
    "casadi": "casadi_tool.Casadi",
    "symforce": "native.C",
}


class Absent(Exception):
    """A tool that this machine does not have."""


@dataclass(frozen=True)
class Job:
    """What a tool is made from."""

    loaded: ModuleType
    form: str
    folder: Path
    options: dict
    threads: int


def made(kind, job):
    module, name = KINDS[kind].split(".")
    try:
        return getattr(importlib.import_module(f"tools.{module}"), name)(job)
    except ImportError as error:
        raise Absent(str(error)) from error
