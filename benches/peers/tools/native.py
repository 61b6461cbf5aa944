"""C, as a compiler makes it."""

import ctypes
import os
import re
import subprocess
from pathlib import Path

import texts
from tools import Absent

HERE = Path(__file__).parent
# gcc and clang vectorise a sine or cosine only where they know a function of packs for it; these are glibc's.
DECLARED = "#pragma omp declare simd notinbranch\ndouble cos(double);\n#pragma omp declare simd notinbranch\ndouble sin(double);\n"


def svml():
    """The folder of Intel's vector mathematics, which comes as a Python package."""
    folder = Path(os.environ["SVML"])
    if not (folder / "libsvml.so").exists():
        raise Absent("libsvml.so is not there")
    return folder


def compiled(job, source):
    """The source as a loaded library, and the vector functions that it calls."""
    options = job.options
    flags = list(options["flags"])
    # With several threads the loops are shared out as the pragmas say; else the same pragmas only ask for packs.
    if options.get("pragmas", True):
        flags.append("-fopenmp" if job.threads > 1 else "-fopenmp-simd")
    if "-fveclib=SVML" in flags:
        place = svml()
        flags += [f"-L{place}", f"-Wl,-rpath,{place}", "-lsvml", "-lirc", "-lintlc"]
    file, made = job.folder / f"source.{options.get('language', 'c')}", job.folder / "library.so"
    file.write_text(source)
    command = [options["compiler"], str(file), *flags, "-shared", "-fPIC", "-o", str(made), "-lmvec", "-lm"]
    try:
        subprocess.run(command, check=True, capture_output=True, text=True)
    except FileNotFoundError as error:
        raise Absent(f"{options['compiler']} is not there") from error
    except subprocess.CalledProcessError as error:
        raise Absent(error.stderr.strip().splitlines()[-1]) from error
    symbols = subprocess.run(["nm", "-D", str(made)], capture_output=True, text=True).stdout
    names = re.findall(r"\b(_ZGV\w+|__svml_\w+|sincos)\b", symbols)
    return ctypes.CDLL(str(made)), sorted(set(names))


def pointers(arrays):
    return [array.ctypes.data_as(ctypes.c_void_p) for array in arrays]


def sizes(*numbers):
    return [ctypes.c_size_t(number) for number in numbers]


def source(lines, results, declared):
    """The loops over columns, over a grid, and of the greatest widths over the angles."""
    columns = ", ".join(f"const double *restrict c_{name}" for name in texts.COLUMNS)
    columns += ", double *restrict out0, double *restrict out1"
    load = lambda names, at: "".join(f"double {name} = c_{name}[{at}];\n" for name in names)
    body = "".join(f"double {name} = {value};\n" for name, value in lines)
    stored = lambda at: "".join(f"out{place}[{at}] = {value};\n" for place, value in enumerate(results))
    row = "for (size_t i = 0; i < n; i++) {\n" + load(texts.COLUMNS[:7], "i")
    angle = "for (size_t j = 0; j < m; j++) {\n" + load(["crack_angle"], "j") + body
    greatest = "".join(f"double w{p} = {value};\ntop{p} = w{p} > top{p} ? w{p} : top{p};\n" for p, value in enumerate(results))
    return f"""#include <math.h>
#include <stddef.h>
#ifdef __cplusplus
#include <cmath>
#define restrict __restrict
using Scalar = double;
extern "C" {{
#endif
{DECLARED if declared else ""}
void widths(size_t n, {columns}) {{
#pragma omp parallel for simd
for (size_t i = 0; i < n; i++) {{
{load(texts.COLUMNS, "i")}{body}{stored("i")}}}
}}
void grid(size_t n, size_t m, {columns}) {{
#pragma omp parallel for
{row}#pragma omp simd
{angle}{stored("i * m + j")}}}
}}
}}
void greatest(size_t n, size_t m, {columns}) {{
{row}double top0 = 0.0, top1 = 0.0;
#pragma omp simd reduction(max : top0, top1)
{angle}{greatest}}}
out0[i] = top0;
out1[i] = top1;
}}
}}
#ifdef __cplusplus
}}
#endif
"""


class C:
    """A text as loops in C; SymForce's in C++."""

    def __init__(self, job):
        self.form = job.form
        lines, results = texts.text(job.loaded, job.options["text"], "c")
        self.library, self.names = compiled(job, self.source(lines, results, job.options.get("declared")))

    @staticmethod
    def source(lines, results, declared):
        return source(lines, results, declared)

    def vectors(self):
        return self.names

    def widths(self, columns, results):
        self.library.widths(*sizes(results[0].size), *pointers(columns), *pointers(results))

    def grid(self, rows, angles, results):
        self.library.grid(*sizes(*results[0].shape), *pointers([*rows, angles]), *pointers(results))

    def greatest(self, rows, angles, results):
        self.library.greatest(*sizes(len(rows[0]), len(angles)), *pointers([*rows, angles]), *pointers(results))


class StagedC(C):
    """What an expert writes for a grid in C: constants of each row, tables of the angles, a root for each point, and packs
    that go past the caches where the build asks for it."""

    @staticmethod
    def source(lines, results, declared):
        return source(lines, results, declared) + (HERE / "staged.c").read_text()

    def staged(self, name, rows, angles, results):
        pairs, (along, across) = texts.stages(self.form, self.widths, rows, angles)
        tables = [along] if across is None else [along, across]
        function = getattr(self.library, f"{name}_{len(tables)}")
        for pair, result in zip(pairs, results):
            function(*sizes(len(rows[0]), len(angles)), *pointers([*pair, *tables, result]))

    def grid(self, rows, angles, results):
        self.staged("staged_grid", rows, angles, results)

    def greatest(self, rows, angles, results):
        self.staged("staged_greatest", rows, angles, results)
