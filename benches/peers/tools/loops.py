"""Loops that Numba compiles."""

import math
import os
import re

import texts


def chosen_features(options):
    """Names the instructions that Numba may use, before it is imported: those of AVX2 alone, or packs of 512 bits, which
    LLVM avoids by itself on some processors."""
    import llvmlite.binding

    features = llvmlite.binding.get_host_cpu_features().flatten().split(",")
    if options.get("features") == "avx2":
        os.environ["NUMBA_CPU_NAME"] = "haswell"
        features = ["-" + name[1:] if "avx512" in name else name for name in features]
    elif options.get("features") == "wide":
        features.append("-prefer-256-bit")
    os.environ["NUMBA_CPU_FEATURES"] = ",".join(features)


def source(lines, results):
    """The loops over columns, over a grid, and of the greatest widths over the angles. A row's part of the text is moved
    out of the inner loop by the compiler, as is what does not depend on the point."""
    arguments = ", ".join(f"c_{name}" for name in texts.COLUMNS)
    assigned = lambda indent, names, at: "".join(f"{' ' * indent}{name} = c_{name}[{at}]\n" for name in names)
    body = lambda indent: "".join(f"{' ' * indent}{name} = {value}\n" for name, value in lines)
    head = lambda name: f"def {name}({arguments}, out0, out1):\n    for i in prange(out0.shape[0]):\n"
    angles = "        for j in range(c_crack_angle.shape[0]):\n" + assigned(12, ["crack_angle"], "j") + body(12)
    stored = lambda indent, at: "".join(f"{' ' * indent}out{place}[{at}] = {value}\n" for place, value in enumerate(results))
    greatest = "".join(f"            top{place} = max(top{place}, {value})\n" for place, value in enumerate(results))
    text = head("widths") + assigned(8, texts.COLUMNS, "i") + body(8) + stored(8, "i")
    text += head("grid") + assigned(8, texts.COLUMNS[:7], "i") + angles + stored(12, "i, j")
    text += head("greatest") + assigned(8, texts.COLUMNS[:7], "i") + "        top0 = top1 = 0.0\n" + angles + greatest
    return text + "        out0[i] = top0\n        out1[i] = top1\n"


class Numba:
    """The loops, compiled with fastmath."""

    def __init__(self, job):
        if "features" in job.options:
            chosen_features(job.options)
        import numba

        if job.options.get("svml") and not numba.config.USING_SVML:
            raise ImportError("Numba does not find SVML")
        if job.threads > 1:
            numba.set_num_threads(job.threads)
        self.form = job.form
        self.compiled = numba.njit(fastmath=True, error_model="numpy", parallel=job.threads > 1)
        scope = {"prange": numba.prange, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos}
        exec(source(*texts.text(job.loaded, job.options["text"], "python")), scope)
        self.loops = {name: self.compiled(scope[name]) for name in ("widths", "grid", "greatest")}

    def vectors(self):
        assembly = "".join(text for loop in self.loops.values() for text in loop.inspect_asm().values())
        return sorted(set(re.findall(r"__svml_\w+|_ZGV\w+", assembly)))

    def widths(self, columns, results):
        self.loops["widths"](*columns, *results)

    def grid(self, rows, angles, results):
        self.loops["grid"](*rows, angles, *results)

    def greatest(self, rows, angles, results):
        self.loops["greatest"](*rows, angles, *results)


class StagedNumba(Numba):
    """What an expert writes for a grid in Numba: constants of each row, tables of the angles, a root for each point."""

    def __init__(self, job):
        super().__init__(job)
        import numba

        prange, two = numba.prange, job.form == "written"

        def grid(first, second, along, across, out):
            for i in prange(out.shape[0]):
                p, q = first[i], second[i]
                for j in range(out.shape[1]):
                    # Near 0 the difference of the one table's form may be below it.
                    out[i, j] = math.sqrt(p * along[j] + q * across[j] if two else max(p * along[j] + q, 0.0))

        def greatest(first, second, along, across, out):
            for i in prange(out.shape[0]):
                p, q, top = first[i], second[i], 0.0
                for j in range(along.shape[0]):
                    top = max(top, p * along[j] + q * across[j] if two else p * along[j] + q)
                out[i] = math.sqrt(top)

        self.loops |= {"staged": self.compiled(grid), "staged greatest": self.compiled(greatest)}

    def staged(self, loop, rows, angles, results):
        pairs, (along, across) = texts.stages(self.form, self.widths, rows, angles)
        for (first, second), result in zip(pairs, results):
            self.loops[loop](first, second, along, along if across is None else across, result)

    def grid(self, rows, angles, results):
        self.staged("staged", rows, angles, results)

    def greatest(self, rows, angles, results):
        self.staged("staged greatest", rows, angles, results)
