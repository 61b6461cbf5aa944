"""Each tool's way to compute both widths, made from the same formulas.

A tool has `widths(columns, results)` for columns of points, and where it can `grid(rows, angles, results)` as one writes it
with it: rows of coefficients against a row of angles.
"""

import ctypes
import math
import subprocess
from types import SimpleNamespace

import numpy as np

import formulas
import op_counts

COLUMNS = ["beta", "gamma", "delta", "epsilon_1", "epsilon_12", "epsilon_2", "disk_asymmetry", "crack_angle"]
RESULTS = ["sir", "cir"]


class Arrays(formulas.Floats):
    """Formulas over NumPy's arrays; tables are columns that are given."""

    sqrt, sin, cos, tan, exp, ln, abs = np.sqrt, np.sin, np.cos, np.tan, np.exp, np.log, np.abs

    def __init__(self, tables):
        self.tables = tables

    def table(self, name, _):
        return self.tables[name]


def row_coefficients(loaded, rotor, depths, integrals):
    """The dimensionless numbers of a rotor for many crack depths, from the crack's integrals there."""
    names = ["sliding_integral", "tearing_integral", "opening_integral", "lateral_integral"]
    op = Arrays(dict(zip(names, integrals)))
    field = loaded.rotor()
    p = SimpleNamespace(**(rotor | {"crack_depth_ratio": depths}))
    compliance = field["crack_compliance"](op, p, 32.0)
    c = field["coefficients"](op, p, field["stiffness"](op, p, field["support_arm"](op, p), compliance))
    return [np.broadcast_to(getattr(c, name), depths.shape).copy() for name in COLUMNS[:7]]


def assignments(loaded):
    """Both widths after SymPy's CSE: names of temporaries with their expressions, and the two results."""
    op = op_counts.SymPy()
    symbols = [op.sympy.Symbol(name, real=True) for name in COLUMNS]
    c = SimpleNamespace(**dict(zip(COLUMNS, symbols)))
    field = loaded.rotor()
    results = [field["sir_width"](op, c), field["cir_width"](op, c)]
    # The tools' own printers know SymPy's absolute value.
    name = {"RealAbs": op.sympy.Abs, "RealSign": op.sympy.sign}
    results = [result.replace(lambda e: type(e).__name__ in name, lambda e: name[type(e).__name__](*e.args)) for result in results]
    return op.sympy, symbols, results


def python_lines(sympy, results):
    """The temporaries and results as lines of Python."""
    temporaries, reduced = sympy.cse(results, symbols=sympy.numbered_symbols("t"))
    lines = [f"{name} = {sympy.pycode(value)}" for name, value in temporaries]
    return lines, [sympy.pycode(value) for value in reduced]


class NumPy:
    """SymPy's lambdify with CSE."""

    def __init__(self, loaded):
        sympy, symbols, results = assignments(loaded)
        self.function = sympy.lambdify(symbols, results, "numpy", cse=True)

    def widths(self, columns, results):
        for result, value in zip(results, self.function(*columns)):
            result[...] = value

    def grid(self, rows, angles, results):
        self.widths([row[:, None] for row in rows] + [angles[None, :]], results)


class NumExpr(NumPy):
    """One evaluation for each temporary of SymPy's CSE."""

    def __init__(self, loaded):
        import numexpr

        numexpr.set_num_threads(1)
        self.numexpr = numexpr
        sympy, _, results = assignments(loaded)
        lines, reduced = python_lines(sympy, results)
        plain = lambda text: text.replace("math.", "")
        self.lines = [[plain(part) for part in line.split(" = ", 1)] for line in lines]
        self.reduced = [plain(text) for text in reduced]

    def widths(self, columns, results):
        known = dict(zip(COLUMNS, columns))
        for name, text in self.lines:
            known[name] = self.numexpr.evaluate(text, local_dict=known, global_dict={})
        for result, text in zip(results, self.reduced):
            self.numexpr.evaluate(text, local_dict=known, global_dict={}, out=result)


class Numba(NumPy):
    """A loop over SymPy's CSE, compiled with fastmath."""

    def __init__(self, loaded):
        import numba

        sympy, _, results = assignments(loaded)
        lines, reduced = python_lines(sympy, results)
        body = lines + [f"out{place}[AT] = {text}" for place, text in enumerate(reduced)]
        text = "def widths(" + ", ".join(f"c_{name}" for name in COLUMNS) + ", out0, out1):\n"
        text += "    for i in range(out0.shape[0]):\n"
        text += "".join(f"        {name} = c_{name}[i]\n" for name in COLUMNS)
        text += "".join("        " + line.replace("AT", "i") + "\n" for line in body)
        text += "def grid(" + ", ".join(f"c_{name}" for name in COLUMNS) + ", out0, out1):\n"
        text += "    for i in range(out0.shape[0]):\n"
        text += "".join(f"        {name} = c_{name}[i]\n" for name in COLUMNS[:7])
        text += "        for j in range(out0.shape[1]):\n            crack_angle = c_crack_angle[j]\n"
        text += "".join("            " + line.replace("AT", "i, j") + "\n" for line in body)
        scope = {"math": math}
        exec(text, scope)
        compiled = numba.njit(fastmath=True, error_model="numpy")
        self.by_columns, self.by_grid = compiled(scope["widths"]), compiled(scope["grid"])

    def widths(self, columns, results):
        self.by_columns(*columns, *results)

    def grid(self, rows, angles, results):
        self.by_grid(*rows, angles, *results)


class StagedByHand(Numba):
    """What an expert writes for a grid in Numba: a width is the root of two tables of the rows times two of the angles."""

    def __init__(self, loaded):
        import numba

        super().__init__(loaded)

        @numba.njit(fastmath=True, error_model="numpy")
        def grid(major, minor, cosine, sine, out):
            for i in range(out.shape[0]):
                p, q = major[i], minor[i]
                for j in range(out.shape[1]):
                    out[i, j] = math.sqrt(p * cosine[j] + q * sine[j])

        @numba.njit(fastmath=True, error_model="numpy")
        def greatest(major, minor, cosine, sine, out):
            for i in range(out.shape[0]):
                p, q, top = major[i], minor[i], 0.0
                for j in range(cosine.shape[0]):
                    top = max(top, p * cosine[j] + q * sine[j])
                out[i] = math.sqrt(top)

        self.staged, self.staged_greatest = grid, greatest

    def tables(self, rows):
        squares = []
        for angle in (0.0, math.pi / 2):
            at = [np.empty(len(rows[0])) for _ in RESULTS]
            self.widths(rows + [np.full(len(rows[0]), angle)], at)
            squares.append([width**2 for width in at])
        return list(zip(*squares))

    def grid(self, rows, angles, results):
        cosine, sine = np.cos(angles) ** 2, np.sin(angles) ** 2
        for (major, minor), result in zip(self.tables(rows), results):
            self.staged(major, minor, cosine, sine, result)

    def greatest(self, rows, angles, results):
        cosine, sine = np.cos(angles) ** 2, np.sin(angles) ** 2
        for (major, minor), result in zip(self.tables(rows), results):
            self.staged_greatest(major, minor, cosine, sine, result)


class Jax(NumPy):
    """SymPy's lambdify with CSE, compiled by XLA."""

    def __init__(self, loaded):
        import jax

        jax.config.update("jax_enable_x64", True)
        sympy, symbols, results = assignments(loaded)
        self.jax = jax
        self.function = jax.jit(sympy.lambdify(symbols, results, "jax", cse=True))
        self.held = {}

    def widths(self, columns, results):
        # The inputs are already where the tool wants them; its results stay where it leaves them.
        key = tuple(column.__array_interface__["data"][0] for column in columns) + (results[0].shape,)
        if key not in self.held:
            self.held[key] = [self.jax.numpy.asarray(column) for column in columns]
        self.found = self.jax.block_until_ready(self.function(*self.held[key]))

    def fetch(self, results):
        for result, value in zip(results, self.found):
            result[...] = np.asarray(value)


class Symjit(NumPy):
    """symjit's compiled function over arrays."""

    def __init__(self, loaded):
        import symjit

        sympy, symbols, results = assignments(loaded)
        self.function = symjit.compile_func(symbols, results, use_threads=False)

    def grid(self, rows, angles, results):
        for i in range(len(rows[0])):
            values = [np.full(len(angles), row[i]) for row in rows]
            self.widths(values + [angles], [result[i] for result in results])


class Casadi(Symjit):
    """CasADi's function, mapped over the points."""

    def __init__(self, loaded):
        import casadi

        self.casadi = casadi
        c = [casadi.SX.sym(name) for name in COLUMNS]
        op = CasadiNumbers(casadi)
        field = loaded.rotor()
        fields = SimpleNamespace(**dict(zip(COLUMNS, c)))
        values = [field["sir_width"](op, fields), field["cir_width"](op, fields)]
        self.function = casadi.Function("widths", c, casadi.cse(values))
        self.mapped = {}

    def widths(self, columns, results):
        count = results[0].size
        if count not in self.mapped:
            mapped = self.function.map(count)
            self.mapped[count] = (mapped, *mapped.buffer())
        _, buffer, evaluate = self.mapped[count]
        for place, column in enumerate(columns):
            buffer.set_arg(place, memoryview(column))
        for place, result in enumerate(results):
            buffer.set_res(place, memoryview(result))
        evaluate()


class CasadiNumbers(formulas.Floats):
    """Formulas over CasADi's symbols."""

    def __init__(self, casadi):
        self.casadi = casadi
        self.sqrt, self.sin, self.cos, self.tan = casadi.sqrt, casadi.sin, casadi.cos, casadi.tan
        self.exp, self.ln, self.abs = casadi.exp, casadi.log, casadi.fabs

    def partial(self, function, place, *arguments):
        variable = self.casadi.SX.sym("partial")
        held = list(arguments)
        held[place] = variable
        slope = self.casadi.jacobian(function(self, *held), variable)
        return self.casadi.substitute(slope, variable, arguments[place])


class C(Numba):
    """SymPy's CSE as C, by gcc -O3 -march=native -ffast-math."""

    flags = ["-O3", "-march=native", "-ffast-math"]

    def __init__(self, loaded, folder):
        sympy, _, results = assignments(loaded)
        temporaries, reduced = sympy.cse(results, symbols=sympy.numbered_symbols("t"))
        lines = [f"double {name} = {sympy.ccode(value)};" for name, value in temporaries]
        lines += [f"out{place}[AT] = {sympy.ccode(value)};" for place, value in enumerate(reduced)]
        pointers = ", ".join(f"const double *restrict c_{name}" for name in COLUMNS)
        pointers += ", double *restrict out0, double *restrict out1"
        load = [f"double {name} = c_{name}[i];" for name in COLUMNS]
        text = "#include <math.h>\n#include <stddef.h>\n"
        text += f"void widths(size_t n, {pointers}) {{\n  for (size_t i = 0; i < n; i++) {{\n    "
        text += "\n    ".join(load + [line.replace("AT", "i") for line in lines]) + "\n  }\n}\n"
        text += f"void grid(size_t n, size_t m, {pointers}) {{\n  for (size_t i = 0; i < n; i++) {{\n    "
        text += "\n    ".join(load[:7]) + "\n    for (size_t j = 0; j < m; j++) {\n      double crack_angle = c_crack_angle[j];\n      "
        text += "\n      ".join(line.replace("AT", "i * m + j") for line in lines) + "\n    }\n  }\n}\n"
        source, library = folder / "widths.c", folder / "libwidths.so"
        source.write_text(text)
        subprocess.run(["gcc", *self.flags, "-shared", "-fPIC", str(source), "-o", str(library), "-lm"], check=True)
        self.library = ctypes.CDLL(str(library))

    @staticmethod
    def pointers(arrays):
        return [array.ctypes.data_as(ctypes.c_void_p) for array in arrays]

    def widths(self, columns, results):
        self.library.widths(ctypes.c_size_t(results[0].size), *self.pointers(columns), *self.pointers(results))

    def grid(self, rows, angles, results):
        sizes = [ctypes.c_size_t(size) for size in results[0].shape]
        self.library.grid(*sizes, *self.pointers(rows + [angles]), *self.pointers(results))
