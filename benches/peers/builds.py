"""How each tool is tuned: the builds that are tried, of which the fastest is taken for each case and form.

A level is `avx512` or `avx2`: the widest packs that code may use. On a processor with AVX-512 everything is measured at
both, and what is built at `avx2` is kept to it.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True, eq=False)
class Build:
    """A way to have a tool compute."""

    tool: str
    name: str
    options: dict = field(default_factory=dict)
    environment: dict = field(default_factory=dict)
    # The Python environment: the newest Numba's wheels have no SVML, so an older one has an environment of its own.
    python: str = "python"


NAMES = {
    "numpy": "NumPy",
    "numexpr": "numexpr",
    "numba": "Numba",
    "numba-staged": "Numba, grid staged by hand",
    "jax": "JAX",
    "symjit": "symjit",
    "casadi": "CasADi",
    "symforce": "SymForce, its C++",
    "c": "C",
    "c-staged": "C, grid staged by hand",
}

TEXTS = {"equations": "the equations' text", "sympy": "SymPy's CSE", "symforce": "SymForce's text"}

GCC = "gcc"
# The newest in Debian 12; it knows the vector functions of glibc (libmvec) and of Intel (SVML).
CLANG = "clang-19"

FAST = ["-O3", "-ffast-math"]
# Vectorised square roots and calls without -ffast-math: no errno, no traps; sums keep their order, products may be fused.
STRICT = ["-O3", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=fast"]
# gcc makes one call `sincos` of the sine and cosine of one angle, of which there is no function of packs.
APART = ["-fdisable-tree-sincos"]
SVML = ["-fveclib=SVML"]



def c(tool, compiler, flags, text, **options):
    """A build by a C compiler, named by what tells it from the others."""
    name = f"`{compiler} {' '.join(flags)}`"
    if tool == "c":
        name += f", {TEXTS[text]}"
    return Build(tool, name, options | {"compiler": compiler, "flags": flags, "text": text})


def c_builds(target, widths):
    """For C: both compilers, with and without -ffast-math, each library of vector functions, each width of packs."""
    plain = [*FAST, target]
    found = [c("c", GCC, plain, "sympy", pragmas=False)]
    for width in widths:
        wide = [f"-mprefer-vector-width={width}"]
        found += [
            c("c", GCC, [*plain, *wide, *APART], "equations"),
            c("c", GCC, [*STRICT, target, *wide, *APART], "equations", declared=True),
            c("c", CLANG, [*plain, *wide, *SVML], "equations"),
            c("c", CLANG, [*plain, *wide, *SVML], "sympy"),
        ]
    # clang knows libmvec's functions of 4 numbers, not those of 8.
    narrow = "-mprefer-vector-width=256"
    found += [
        c("c", CLANG, [*plain, narrow, "-fveclib=libmvec"], "equations"),
        c("c", CLANG, [*STRICT, target, narrow, "-fveclib=libmvec"], "equations"),
        c("c", CLANG, [*plain, narrow, "-fveclib=libmvec"], "sympy"),
    ]
    return found


def symforce_builds(target, widths):
    """The C++ that SymForce prints, by clang with each library, and by g++."""
    narrow = "-mprefer-vector-width=256"
    as_cpp = {"language": "cpp"}
    found = [
        c("symforce", "g++", [*FAST, target, narrow], "symforce", **as_cpp),
        c("symforce", "clang++-19", [*FAST, target, narrow, "-fveclib=libmvec"], "symforce", **as_cpp),
    ]
    for width in widths:
        flags = [*FAST, target, f"-mprefer-vector-width={width}", *SVML]
        found.append(c("symforce", "clang++-19", flags, "symforce", **as_cpp))
    return found


def staged_c_builds(target, widths):
    found = []
    for width in widths:
        for compiler in (GCC, CLANG):
            flags = [*FAST, target, f"-mprefer-vector-width={width}"]
            found.append(c("c-staged", compiler, flags, "equations"))
    past = [*FAST, target, "-DPAST_CACHES"]
    return [*found, c("c-staged", CLANG, past, "equations")]


def numba_builds(tool, wide, native):
    """The newest Numba, and the last one whose wheels have SVML, with each text."""
    features = {} if native else {"features": "avx2"}
    found = [Build(tool, "0.68, fastmath, SymPy's CSE", {"text": "sympy"} | features)]
    texts = ["equations"] if tool == "numba-staged" else ["equations", "sympy"]
    for text in texts:
        for packs in ([{}, {"features": "wide"}] if wide else [features]):
            width = ", 512 bits" if packs.get("features") == "wide" else ""
            name = f"0.61 with SVML, fastmath{width}, {TEXTS[text]}"
            found.append(Build(tool, name, {"text": text, "svml": True} | packs, python="python-svml"))
    return found


def jax_builds(wide, native):
    flags = "" if native else " --xla_cpu_max_isa=AVX2"
    found = [("as it is", ""), ("fast math", "--xla_cpu_enable_fast_math=true")]
    if wide:
        found.append(("512 bits", "--xla_cpu_prefer_vector_width=512"))
    return [Build("jax", name, environment={"XLA_FLAGS": (flag + flags).strip()}) for name, flag in found]


def symjit_builds(wide):
    found = [Build("symjit", "opt_level=3, own arrays")]
    if wide:
        found.append(Build("symjit", "opt_level=3, own arrays, enable_simd512", {"enable_simd512": True}))
    return found


def casadi_builds(target):
    flags = [*FAST, target, "-fno-semantic-interposition"]
    generated = lambda compiler, more: Build(
        "casadi",
        f"its C by `{compiler} {' '.join([*FAST, target, *more])}`",
        {"compiler": compiler, "flags": [*flags, *more]},
    )
    return [
        Build("casadi", "its map"),
        generated(GCC, []),
        generated(CLANG, ["-mprefer-vector-width=256", "-fveclib=libmvec"]),
    ]


def builds(level, machine_has_avx512):
    """All builds at a level."""
    wide = level == "avx512"
    native = wide or not machine_has_avx512
    widths = [256, 512] if wide else [256]
    target = "-march=native" if native else "-march=haswell"
    # What NumPy's own loops may not use where packs are kept to AVX2.
    numpy = {} if native else {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL"}
    found = [
        Build("numpy", "lambdify with CSE", environment=numpy),
        Build("numexpr", "an evaluation for each temporary of SymPy's CSE"),
        *numba_builds("numba", wide, native),
        *numba_builds("numba-staged", wide, native),
        *jax_builds(wide, native),
        *symjit_builds(wide),
        *casadi_builds(target),
        *symforce_builds(target, widths),
        *c_builds(target, widths),
        *staged_c_builds(target, widths),
    ]
    by_tool = {}
    for build in found:
        by_tool.setdefault(build.tool, []).append(build)
    return by_tool
