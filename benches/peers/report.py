"""The table and the chart of a comparison."""

import json
import statistics
import sys
from pathlib import Path

TITLES = {
    "widths_block": "both widths from the 8 dimensionless columns, blocks of 4096 points",
    "widths_stream": "the same on 2^20 points from memory",
    "grid_sigma_phi": "both widths over a grid of crack depth × angle of the physical rotor, results in memory",
    "max_over_phi": "greatest widths over the angle for each crack depth, no output array",
}
NAMES = {
    "rotor": "this library",
    "numpy": "NumPy (lambdify, CSE)",
    "numexpr": "numexpr",
    "numba": "Numba (fastmath)",
    "numba-staged": "Numba, tables by hand",
    "jax": "JAX, one thread",
    "jax-threads": "JAX, all threads",
    "symjit": "symjit",
    "casadi": "CasADi map",
    "c": "C by gcc -O3 -march=native -ffast-math",
}


def quartiles(seconds):
    """Median and half the distance of the quartiles over it."""
    median = statistics.median(seconds)
    lower, _, upper = statistics.quantiles(seconds, n=4) if len(seconds) > 1 else (median, median, median)
    return median, (upper - lower) / 2 / median


def table(about, case):
    """Rows of the table: tool, points per second, ratio of this library's rate to it, spread."""
    points = about["points"][case]
    seconds = about["seconds"][case]
    ours = statistics.median(seconds["rotor"])
    rows = []
    for tool in sorted(seconds, key=lambda tool: statistics.median(seconds[tool])):
        median, spread = quartiles(seconds[tool])
        rows.append((NAMES[tool], points / median, median / ours, spread))
    return rows


def median(about, case, tool="rotor"):
    return statistics.median(about["seconds"][case][tool])


def best(about, case, tools=None):
    """The fastest other tool's seconds, of those on one thread."""
    seconds = about["seconds"][case]
    tools = tools or [tool for tool in seconds if tool not in {"rotor", "jax-threads"}]
    return min(statistics.median(seconds[tool]) for tool in tools)


def bars(about):
    """What is asked for, what was measured."""
    fill, grid = median(about, "grid_fill"), median(about, "grid_sigma_phi")
    as_written = [tool for tool in about["seconds"]["grid_sigma_phi"] if tool in {"numpy", "numexpr", "numba", "jax", "c"}]
    greatest = about["points"]["max_over_phi_whole"] / median(about, "max_over_phi_whole")
    two = median(about, "widths_two_threads", "rotor-threads")
    return [
        ("blocks of 4096 points, over the best other tool", "≥ 1.4", best(about, "widths_block") / median(about, "widths_block")),
        ("2^20 points from memory, over the best other tool", "≥ 1.1", best(about, "widths_stream") / median(about, "widths_stream")),
        ("grid, over filling the same memory", "≥ 0.85", fill / grid),
        ("grid, over Numba with tables by hand", "≥ 0.9", best(about, "grid_sigma_phi", ["numba-staged"]) / grid),
        ("grid, over the best tool as written", "≥ 10", best(about, "grid_sigma_phi", as_written) / grid),
        ("maximum over the angle for 100 000 depths, 1e9 points/s", "≥ 1.0", greatest / 1e9),
        ("gradients by all 12 inputs, in values", "≤ 3", median(about, "physical_gradients") / median(about, "physical_values")),
        ("two threads over one", "≥ 1.8", median(about, "widths_one_thread") / two),
    ]


def markdown(about):
    machine, versions, sizes = about["machine"], about["versions"], about["sizes"]
    lines = [
        "# Performance",
        "",
        "Written by `cargo xtask peers`: this library and other tools, one after the other in every round, on the same inputs,",
        "each held against this library's results to 1e-12 first. One thread unless the table says otherwise.",
        "",
        f"Machine: {machine['processor']} ({machine['family']}; {machine['instructions']}), {machine['cpus']} CPUs,",
        f"{machine['memory_gib']} GiB, {machine['system']}; load before the run {machine['load_at_start']:.1f}, which other work on the",
        "machine may have changed in its course: see the spreads.",
        "",
        "Versions: " + ", ".join(f"{name} {version.removeprefix(name + ' ')}" for name, version in versions.items()) + ".",
        "",
        f"Grid of {sizes[0]} × {sizes[0]}; maximum over {sizes[2]} angles for {sizes[1]} depths.",
        "",
        "![Rates](pictures/performance.svg)",
        "",
    ]
    for case, title in TITLES.items():
        lines += [f"## {title[0].upper() + title[1:]}", "", "| | million points/s | this library is … times as fast | spread |", "|---|---|---|---|"]
        for name, rate, ratio, spread in table(about, case):
            lines.append(f"| {name} | {rate / 1e6:.1f} | {ratio:.2f} | ±{100 * spread:.0f} % |")
        lines.append("")
    lines += ["## What is asked for", "", "| ratio | asked | measured |", "|---|---|---|"]
    lines += [f"| {name} | {asked} | {found:.2f} |" for name, asked, found in bars(about)]
    lines += ["", "Rate: points over the median of the runs. Spread: half the distance of the quartiles over the median. JAX's results stay",
              "in its own memory; every other tool writes where this library writes.", ""]
    return "\n".join(lines)


def rate(millions):
    """Three digits, or all before the point."""
    return f"{millions:.0f}" if millions >= 100 else f"{millions:.3g}"


def chart(about, files):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "rotor"
    from matplotlib import pyplot, ticker

    figure, axes = pyplot.subplots(len(TITLES), 1, figsize=(8, 11), layout="constrained")
    longest = max(row[1] / 1e6 for case in TITLES for row in table(about, case))
    for axis, (case, title) in zip(axes, TITLES.items()):
        rows = table(about, case)[::-1]
        colours = ["#0072b2" if row[0] == NAMES["rotor"] else "#999999" for row in rows]
        bars = axis.barh([row[0] for row in rows], [row[1] / 1e6 for row in rows], color=colours)
        axis.bar_label(bars, labels=[rate(row[1] / 1e6) for row in rows], padding=3, fontsize=8)
        axis.set_xscale("log")
        # All bars start at a million points per second; the longest of any chart ends before the axis does.
        axis.set_xlim(1.0, 2.5 * longest)
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(ticker.NullFormatter())
        axis.spines[["top", "right"]].set_visible(False)
        axis.set_title(title, fontsize=9, loc="left")
        axis.tick_params(labelsize=8)
    axes[-1].set_xlabel("million points per second")
    for file in files:
        figure.savefig(file, dpi=120, metadata={"Date": None} if file.suffix == ".svg" else None)


def write(about, folder):
    pictures = folder / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    chart(about, [pictures / "performance.svg", pictures / "performance.png"])
    text = markdown(about)
    (folder / "performance.md").write_text(text)
    print(text)


if __name__ == "__main__":
    write(json.loads(Path(sys.argv[1]).read_text()), Path(sys.argv[2]))
