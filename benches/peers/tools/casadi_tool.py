"""CasADi: its own map over the points, or the C that it writes for one point, in a loop that is put around it."""

import os
from pathlib import Path

import formulas
import texts
from tools.native import C, compiled

POINTERS = ", ".join(f"const double *restrict c_{name}" for name in texts.COLUMNS)


def loop(call):
    """A function `widths` that makes this call for every point `i`; its results are in `a` and `b` then."""
    return f"""
void widths(size_t n, {POINTERS}, double *restrict out0, double *restrict out1) {{
#pragma omp parallel for simd
for (size_t i = 0; i < n; i++) {{
double a, b;
{call}
out0[i] = a;
out1[i] = b;
}}
}}
"""


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


class Casadi(C):
    """CasADi's function."""

    def __init__(self, job):
        import casadi

        symbols = [casadi.SX.sym(name) for name in texts.COLUMNS]
        values = texts.widths(job.loaded, CasadiNumbers(casadi), symbols)
        self.function = casadi.Function("point", symbols, casadi.cse(values))
        self.mapped, self.names, self.threads, self.generated = {}, [], job.threads, "flags" in job.options
        if self.generated:
            self.library, self.names = compiled(job, self.source_of(job))

    def source_of(self, job):
        # It writes into the current folder only.
        here = Path.cwd()
        os.chdir(job.folder)
        self.function.generate("point.c")
        os.chdir(here)
        inputs = ", ".join(f"c_{name} + i" for name in texts.COLUMNS)
        call = f"const double *in[] = {{{inputs}}};\ndouble *out[] = {{&a, &b}};\ncasadi_f0(in, out, 0, 0, 0);"
        # A function of its own would keep the loop from being vectorised.
        text = (job.folder / "point.c").read_text()
        text = text.replace("static int casadi_f0(", "static inline __attribute__((always_inline)) int casadi_f0(")
        return "#include <stddef.h>\n" + text + loop(call)

    def widths(self, columns, results):
        if self.generated:
            C.widths(self, columns, results)
            return
        count = results[0].size
        if count not in self.mapped:
            mapped = self.function.map(count) if self.threads == 1 else self.function.map(count, "thread", self.threads)
            self.mapped[count] = (mapped, *mapped.buffer())
        _, buffer, evaluate = self.mapped[count]
        for place, column in enumerate(columns):
            buffer.set_arg(place, memoryview(column))
        for place, result in enumerate(results):
            buffer.set_res(place, memoryview(result))
        evaluate()

