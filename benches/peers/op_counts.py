"""Operation counts of SymPy, SymForce and wrenfold on the corpus, as a table.

    python op_counts.py FOLDER TABLE.csv

FOLDER is what `cargo run -p rotor-benches --bin export` wrote. Every tool gets the same formulas, translated from the
Rust source; each tool's code is run and compared with the Rust side's numbers before it is counted.
"""

import csv
import importlib.metadata
import math
import sys
from types import SimpleNamespace

import counting
import formulas


class Base:
    """What all symbolic tools share."""

    tool = None

    def constant(self, name):
        if name in formulas.CONSTANTS:
            return self.pi() * self.number(str(formulas.CONSTANTS[name]))
        if name == "LN_10":
            return self.ln(self.number("10"))
        raise KeyError(name)

    def powi(self, base, exponent):
        return base**exponent

    def struct(self, **fields):
        return SimpleNamespace(**fields)

    def partial(self, function, place, *arguments):
        variable = self.symbol(f"partial_{place}", False)
        held = list(arguments)
        held[place] = variable
        return self.replaced(self.derivative(function(self, *held), variable), variable, arguments[place])

    @staticmethod
    def rational(text):
        from fractions import Fraction

        return Fraction(text.replace("_", ""))


class SymPy(Base):
    tool = "sympy"

    def __init__(self):
        import sympy

        self.sympy = sympy
        self.sqrt, self.sin, self.cos, self.tan = sympy.sqrt, sympy.sin, sympy.cos, sympy.tan
        self.exp, self.ln, self.abs = sympy.exp, sympy.log, self.absolute_value(sympy)

    @staticmethod
    def absolute_value(sympy):
        """The absolute value of a real number: SymPy's own takes roots for complex where it can't prove otherwise."""

        class RealSign(sympy.Function):
            def fdiff(self, argindex=1):
                return sympy.S.Zero

        class RealAbs(sympy.Function):
            def fdiff(self, argindex=1):
                return RealSign(self.args[0])

        return RealAbs

    def pi(self):
        return self.sympy.pi

    def number(self, text):
        value = self.rational(text)
        return self.sympy.Rational(value.numerator, value.denominator)

    def symbol(self, name, positive):
        return self.sympy.Symbol(name, positive=True) if positive else self.sympy.Symbol(name, real=True)

    def derivative(self, expression, symbol):
        return self.sympy.diff(expression, symbol)

    def replaced(self, expression, symbol, value):
        return expression.subs(symbol, value)

    def codes(self, symbols, outputs):
        """The code of the outputs after CSE, with and without SymPy's own optimizations before it."""
        for optimizations in (None, "basic"):
            temporaries, results = self.sympy.cse(
                outputs, symbols=self.sympy.numbered_symbols("_t"), optimizations=optimizations
            )

            def printed(value):
                functions = {"RealAbs": "abs", "RealSign": "sign", "sign": "sign"}
                return self.sympy.pycode(value, user_functions=functions)

            lines = [f"{name} = {printed(value)}" for name, value in temporaries]
            lines += [f"_o{place} = {printed(value)}" for place, value in enumerate(results)]
            yield "\n".join(lines)


class SymForce(Base):
    tool = "symforce"

    def __init__(self):
        import symforce

        symforce.set_epsilon_to_number()
        import symforce.symbolic as sf

        self.sf = sf
        self.sqrt, self.sin, self.cos, self.tan = sf.sqrt, sf.sin, sf.cos, sf.tan
        self.exp, self.ln, self.abs = sf.exp, sf.log, sf.Abs

    def pi(self):
        return self.sf.pi

    def number(self, text):
        value = self.rational(text)
        return self.sf.Rational(value.numerator, value.denominator)

    def symbol(self, name, positive):
        return self.sf.Symbol(name, positive=True) if positive else self.sf.Symbol(name)

    def derivative(self, expression, symbol):
        return self.sf.S(expression).diff(symbol)

    def replaced(self, expression, symbol, value):
        return self.sf.S(expression).subs(symbol, value)

    def codes(self, symbols, outputs):
        """The body of the function that SymForce's generator prints for Python."""
        from symforce.codegen import PythonConfig, codegen_util
        from symforce.values import Values

        inputs = Values(**{str(symbol): symbol for symbol in symbols})
        results = Values(**{f"_o{place}": self.sf.S(value) for place, value in enumerate(outputs)})
        printed = codegen_util.print_code(inputs, results, {}, PythonConfig())
        lines = [f"{name} = {value}" for name, value in printed.intermediate_terms]
        for group in printed.dense_terms:
            lines += [f"{name} = {value}" for name, value in group.terms]
        yield "\n".join(lines)


class Wrenfold(Base):
    tool = "wrenfold"

    def __init__(self):
        from wrenfold import sym

        self.sym = sym
        self.sqrt, self.sin, self.cos, self.tan = sym.sqrt, sym.sin, sym.cos, sym.tan
        self.exp, self.ln, self.abs = sym.exp, sym.log, sym.abs

    def pi(self):
        return self.sym.pi

    def number(self, text):
        value = self.rational(text)
        # Its rationals are 64 bits wide, also those of powers.
        if value.denominator > 10**4:
            return self.sym.float_constant(float(value))
        return self.sym.rational(value.numerator, value.denominator)

    def powi(self, base, exponent):
        return self.sym.pow(base, exponent)

    def symbol(self, name, positive):
        return self.sym.symbols(name, positive=True) if positive else self.sym.symbols(name, real=True)

    def derivative(self, expression, symbol):
        return expression.diff(symbol)

    def replaced(self, expression, symbol, value):
        return expression.subs(symbol, value)

    def codes(self, symbols, outputs):
        """The functions that wrenfold generates for Python, by several numbers of its factorization passes."""
        import wrenfold as wf

        description = wf.FunctionDescription("formula")
        scalar = wf.type_info.ScalarType(wf.type_info.NumericType.Float)
        inputs = [(symbol, description.add_input_argument(str(symbol), scalar)) for symbol in symbols]
        for place, value in enumerate(outputs):
            description.add_output_argument(f"_o{place}", False, value.subs(inputs))
        for passes in (0, 1, 2, 4, 8):
            parameters = wf.OptimizationParams()
            parameters.factorization_passes = passes
            definition = wf.transpile(description, parameters)
            yield wf.PythonGenerator().generate(definition)


def names(description):
    return {symbol["name"]: "".join(c if c.isalnum() else "_" for c in symbol["name"]).strip("_") for symbol in description["symbols"]}


def run(code, numbers):
    """The results of a tool's code at the point."""
    import numpy

    scope = {"math": math, "numpy": numpy, "np": numpy, "sign": numpy.sign, **numbers}
    exec(code, scope)
    if "formula" in scope:
        return [float(value) for value in numpy.atleast_1d(scope["formula"](**numbers))]
    count = sum(1 for name in scope if name.startswith("_o"))
    return [float(scope[f"_o{place}"]) for place in range(count)]


def check(tool, description, found, expected):
    for place, (a, b) in enumerate(zip(found, expected, strict=True)):
        if abs(a - b) > 1e-9 * max(abs(b), 1e-6):
            raise SystemExit(f"{tool} differs on {description['name']}[{place}]: {a} beside {b}")


def counted(op, loaded, description):
    """The tool's counts of value, and of value and gradient, of the cheapest code it has."""
    plain = names(description)
    symbols = {
        symbol["name"]: op.symbol(plain[symbol["name"]], symbol["positive"]) for symbol in description["symbols"]
    }
    values = formulas.call(loaded, description, op, symbols)
    slopes = [op.derivative(value, symbols[by]) for value in values for by in description["by"]]
    numbers = {plain[symbol["name"]]: symbol["value"] for symbol in description["symbols"]}
    for form, outputs in (("value", values), ("gradient", values + slopes)):
        best = None
        for code in op.codes(list(symbols.values()), outputs):
            found = run(code, numbers)
            check(op.tool, description, found, description["expected"][: len(outputs)])
            counts = counting.count(code)
            if best is None or counting.weight(counts) < counting.weight(best):
                best = counts
        yield form, best


def main(folder, table):
    loaded, described = formulas.module(folder), formulas.descriptions(folder)
    with open(table, "w", newline="") as file:
        columns = ["field", "formula", "form", "tool", "version", *counting.KINDS]
        writer = csv.DictWriter(file, fieldnames=columns, lineterminator="\n")
        writer.writeheader()
        for make in (Wrenfold, SymForce, SymPy):
            op = make()
            version = importlib.metadata.version(op.tool)
            for description in described:
                for form, counts in counted(op, loaded, description):
                    row = {"field": description["field"], "formula": description["name"], "form": form}
                    row |= {"tool": op.tool, "version": version}
                    writer.writerow(row | {kind: counts[kind] for kind in counting.KINDS})
                file.flush()
                print(op.tool, description["name"], flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
