"""Both widths as text in Python or C, and the numbers of a grid's rows.

Three texts: what SymPy's CSE makes of the formulas (`sympy`), what SymForce prints as C++ (`symforce`), and the formulas
as they stand, operation by operation, each repeated one once (`equations`), which is what a person would write who has
the paper's named quantities before them.
"""

import math
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


def widths(loaded, op, values):
    """Both widths over what the tool at hand computes with."""
    field, c = loaded.rotor(), SimpleNamespace(**dict(zip(COLUMNS, values)))
    return [field["sir_width"](op, c), field["cir_width"](op, c)]


def expressions(loaded):
    """SymPy, its symbols of the columns, and both widths over them."""
    op = op_counts.SymPy()
    symbols = [op.sympy.Symbol(name, real=True) for name in COLUMNS]
    results = widths(loaded, op, symbols)
    # The tools' own printers know SymPy's absolute value.
    name = {"RealAbs": op.sympy.Abs, "RealSign": op.sympy.sign}
    results = [result.replace(lambda e: type(e).__name__ in name, lambda e: name[type(e).__name__](*e.args)) for result in results]
    return op.sympy, symbols, results


def text(loaded, kind, language):
    """Assignments to temporaries, as pairs of name and expression, and the expressions of both results."""
    if kind == "equations":
        op = Operations()
        results = widths(loaded, op, [Operand(op, name) for name in COLUMNS])
        absolute = {"c": "fabs", "python": "abs"}[language]
        return [(name, value.replace("fabs", absolute)) for value, name in op.names.items()], [result.text for result in results]
    if kind == "symforce":
        return symforce_text(loaded)
    sympy, _, results = expressions(loaded)
    temporaries, reduced = sympy.cse(results, symbols=sympy.numbered_symbols("t"))
    printed = sympy.ccode if language == "c" else lambda value: sympy.pycode(value).replace("math.", "")
    return [(str(name), printed(value)) for name, value in temporaries], [printed(value) for value in reduced]


def symforce_text(loaded):
    """The body of the function that SymForce's generator prints as C++."""
    op = op_counts.SymForce()
    from symforce.codegen import CppConfig, codegen_util
    from symforce.values import Values

    symbols = [op.symbol(name, False) for name in COLUMNS]
    results = [op.sf.S(value) for value in widths(loaded, op, symbols)]
    inputs = Values(**dict(zip(COLUMNS, symbols)))
    printed = codegen_util.print_code(inputs, Values(**dict(zip(RESULTS, results))), {}, CppConfig())
    lines = [(str(name), value) for name, value in printed.intermediate_terms]
    return lines, [value for group in printed.dense_terms for _, value in group.terms]


class Operand:
    """A number in a text under way: a name or a literal."""

    def __init__(self, op, text):
        self.op, self.text = op, text

    def joined(self, sign, other):
        return self.op.named(f"{self.text} {sign} {self.op.operand(other).text}")

    def __add__(self, other):
        return self.joined("+", other)

    def __sub__(self, other):
        return self.joined("-", other)

    def __mul__(self, other):
        return self.joined("*", other)

    def __truediv__(self, other):
        return self.joined("/", other)

    def __radd__(self, other):
        return self.op.operand(other) + self

    def __rsub__(self, other):
        return self.op.operand(other) - self

    def __rmul__(self, other):
        return self.op.operand(other) * self

    def __rtruediv__(self, other):
        return self.op.operand(other) / self

    def __neg__(self):
        return self.op.named(f"-{self.text}")


class Operations(formulas.Floats):
    """Formulas as operations with a name each."""

    def __init__(self):
        self.names = {}

    def named(self, expression):
        name = self.names.setdefault(expression, f"t{len(self.names)}")
        return Operand(self, name)

    def operand(self, value):
        return value if isinstance(value, Operand) else Operand(self, repr(float(value)))

    def number(self, text):
        return self.operand(formulas.Floats.number(text))

    def sqrt(self, value):
        return self.named(f"sqrt({value.text})")

    def sin(self, value):
        return self.named(f"sin({value.text})")

    def cos(self, value):
        return self.named(f"cos({value.text})")

    def abs(self, value):
        return self.named(f"fabs({value.text})")

    def powi(self, base, exponent):
        if exponent == 1:
            return base
        half = self.powi(base, exponent // 2)
        return half * half * base if exponent % 2 else half * half

    def partial(self, function, place, *arguments):
        """A derivative by hand: of the whirl frequency equation H G − γ² by ω or Ω, the one that the widths take."""
        if function.__name__ != "f_n" or place > 1:
            raise SystemExit(f"the partial {place} of {function.__name__} is not written out in texts.py")
        omega, speed, c = arguments
        h = 1.0 - omega * omega
        if place == 1:
            return h * (c.beta * omega)
        g = c.delta - omega * omega + c.beta * speed * omega
        return h * (c.beta * speed - 2.0 * omega) - 2.0 * omega * g


def squares(by_widths, rows):
    """The squares of both widths at the angles 0 and 90°, for each row of a grid: from them any other angle's follow as
    square(0) cos² + square(90°) sin². `by_widths` is a tool's function of columns and results."""
    found = []
    for angle in (0.0, math.pi / 2):
        at = [np.empty(len(rows[0])) for _ in RESULTS]
        by_widths(rows + [np.full(len(rows[0]), angle)], at)
        found.append([width**2 for width in at])
    return list(zip(*found))


def stages(form, by_widths, rows, angles):
    """What a person who stages a grid by hand computes before its points: a pair of numbers for each row and result, and a
    pair of tables of the angles. With the form `cos2phi` the second table is all ones."""
    pairs = squares(by_widths, rows)
    if form == "written":
        return pairs, (np.cos(angles) ** 2, np.sin(angles) ** 2)
    return [(0.5 * (a - b), 0.5 * (a + b)) for a, b in pairs], (np.cos(2.0 * angles), None)
