"""Tools that take whole arrays."""

import numpy as np

import texts


class NumPy:
    """SymPy's lambdify with CSE."""

    def __init__(self, job):
        sympy, symbols, results = texts.expressions(job.loaded)
        self.function = sympy.lambdify(symbols, results, "numpy", cse=True)

    def vectors(self):
        return []

    def widths(self, columns, results):
        for result, value in zip(results, self.function(*columns)):
            result[...] = value

    def grid(self, rows, angles, results):
        self.widths([row[:, None] for row in rows] + [angles[None, :]], results)


class NumExpr(NumPy):
    """One evaluation for each temporary of SymPy's CSE."""

    def __init__(self, job):
        import numexpr

        numexpr.set_num_threads(job.threads)
        self.numexpr = numexpr
        self.lines, self.reduced = texts.text(job.loaded, "sympy", "python")

    def widths(self, columns, results):
        known = dict(zip(texts.COLUMNS, columns))
        for name, text in self.lines:
            known[name] = self.numexpr.evaluate(text, local_dict=known, global_dict={})
        for result, text in zip(results, self.reduced):
            self.numexpr.evaluate(text, local_dict=known, global_dict={}, out=result)


class Jax(NumPy):
    """SymPy's lambdify with CSE, compiled by XLA. Its inputs are already where the tool wants them; its results stay where
    it leaves them."""

    def __init__(self, job):
        import jax

        jax.config.update("jax_enable_x64", True)
        sympy, symbols, results = texts.expressions(job.loaded)
        self.jax = jax
        self.function = jax.jit(sympy.lambdify(symbols, results, "jax", cse=True))
        self.held = {}

    def widths(self, columns, results):
        key = tuple(column.__array_interface__["data"][0] for column in columns) + (results[0].shape,)
        if key not in self.held:
            self.held[key] = [self.jax.numpy.asarray(column) for column in columns]
        self.found = self.jax.block_until_ready(self.function(*self.held[key]))

    def fetch(self, results):
        for result, value in zip(results, self.found):
            result[...] = np.asarray(value)


class Symjit(NumPy):
    """symjit's compiled function, run on matrices of the caller's own arrays: its call operator would make new ones."""

    def __init__(self, job):
        import symjit
        from symjit.engine import Matrix

        _, symbols, results = texts.expressions(job.loaded)
        self.function = symjit.compile_func(symbols, results, use_threads=job.threads > 1, opt_level=3, **job.options)
        self.matrix = Matrix

    def widths(self, columns, results):
        with self.matrix() as states, self.matrix() as found:
            for column in columns:
                states.add_row(column)
            for result in results:
                found.add_row(result)
            self.function.compiler.execute_matrix(states, found)
