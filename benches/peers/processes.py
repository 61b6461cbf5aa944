"""The programs that take turns: each answers a line for a line."""

import json
import os
import subprocess
import sys
import time
import zlib
from pathlib import Path

HERE = Path(__file__).parent
THREAD_VARIABLES = ("OMP_NUM_THREADS", "NUMEXPR_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS")


class Stopped(Exception):
    """A program that ended before it answered."""


class Process:
    """A program; on one thread and one processor, the same for all, unless it is threaded."""

    def __init__(self, command, threaded=False, environment=None):
        self.environment = surroundings(threaded) | (environment or {})
        self.child = subprocess.Popen(
            [str(part) for part in command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=None if threaded else pinned,
            env=self.environment,
        )

    def line(self):
        answer = self.child.stdout.readline()
        if not answer:
            raise Stopped
        return answer.strip()

    def ask(self, line):
        try:
            self.child.stdin.write(line + "\n")
            self.child.stdin.flush()
        except BrokenPipeError as error:
            raise Stopped from error
        return self.line()

    def close(self):
        self.child.stdin.close()
        self.child.wait()


def pinned():
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def surroundings(threaded):
    return os.environ | ({} if threaded else {name: "1" for name in THREAD_VARIABLES})


class Command:
    """A command that is run from its start to its end each time that it is asked for."""

    def __init__(self, arguments, threaded, environment):
        self.arguments, self.threaded = [str(part) for part in arguments], threaded
        self.environment = surroundings(threaded) | environment

    def ask(self, _):
        start = time.perf_counter()
        subprocess.run(
            self.arguments,
            check=True,
            env=self.environment,
            preexec_fn=None if self.threaded else pinned,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        return f"{time.perf_counter() - start:e}"

    def close(self):
        pass


class Comparison:
    """Where the files are, the sizes, and the level at which all programs compute."""

    def __init__(self, folder, programs, sizes, level, has_avx512):
        self.folder, self.programs, self.sizes = folder, programs, sizes
        self.level, self.has_avx512 = level, has_avx512
        self.forced = {"LANES_LEVEL": "avx2"} if level == "avx2" else {}

    def library(self, threaded=False):
        return Process([self.programs / "measure", *self.sizes], threaded, self.forced)

    def worker(self, build, form, threaded=False):
        """A tool's process, not yet known to be ready."""
        python = self.folder / build.python / "bin" / "python"
        named = f"{self.level} {build} {form} {threaded}"
        scratch = self.folder / "scratch" / f"{build.tool}-{zlib.crc32(named.encode()):08x}"
        threads = len(os.sched_getaffinity(0)) if threaded else 1
        command = [python, HERE / "worker.py", build.tool, form, json.dumps(build.options), threads, self.folder, scratch, *self.sizes]
        # SVML comes as a Python package: for clang by its folder, for Numba, which looks for it itself, on the path.
        svml = str(self.folder / "python-svml" / "lib")
        found = {"SVML": svml} | ({"LD_LIBRARY_PATH": svml} if build.python == "python-svml" else {})
        return Process(command, threaded, found | build.environment)

    def writer(self, file):
        """The process that writes the columns of a file of `rotor scan` alone."""
        return Process([sys.executable, HERE / "columns_alone.py", file])

    def scan(self, file, threaded):
        """`rotor scan` as one types it, over the grid of the comparison."""
        last = self.sizes[0]
        axes = [f"crack.depth_ratio=0.02:0.4:{last}", f"crack.angle=0deg:180deg:{last}"]
        varied = [part for axis in axes for part in ("--vary", axis)]
        threads = [] if threaded else ["--threads", "1"]
        command = [self.programs / "rotor", "scan", *varied, "--quantity", "sir_width,cir_width", *threads, "-o", file]
        return Command(command, threaded, self.forced)
