"""The page of a comparison."""

import json
import sys
from pathlib import Path

import chart
from accuracy import DISTANCES
from builds import NAMES
from timing import ATTEMPTS, LARGEST_SPREAD, OURS, TOLERANCES, median_and_spread

TITLES = {
    "widths_block": "both widths from the 8 dimensionless columns, blocks of 4096 points",
    "widths_stream": "the same on 2^20 points from memory",
    "grid_sigma_phi": "both widths over a grid of crack depth × angle of the physical rotor, results in memory",
    "max_over_phi": "greatest widths over the angle for each crack depth, no output array",
    "widths_stream_threads": "2^20 points from memory, all processors",
    "grid_sigma_phi_threads": "the grid, all processors",
}
FORMS = {"written": "as written", "cos2phi": "cos 2φ"}
LEVELS = {"avx512": "Packs of 512 bits (AVX-512)", "avx2": "Packs of 256 bits (AVX2)"}


def rows(level, case):
    """Each program's name, form, seconds and spread, the fastest first."""
    found = []
    for program, seconds in level["seconds"][case].items():
        tool, _, form = program.partition(" ")
        if tool != "fill":
            found.append((tool, form, *median_and_spread(seconds)))
    return sorted(found, key=lambda row: row[2])


def best_of(level, case, tools=None):
    """The fastest other program of these tools: its row."""
    return next((row for row in rows(level, case) if row[0] != OURS and (tools is None or row[0] in tools)), None)


def ours(level, case):
    return next(row for row in rows(level, case) if row[0] == OURS)


def program(level, case, name):
    """The row of a program by its name as it was timed."""
    return (name, "", *median_and_spread(level["seconds"][case][name]))


def ratio(over, under):
    """Seconds over seconds, unless one of them is not steady."""
    if over is None or max(over[3], under[3]) > LARGEST_SPREAD:
        return None
    return over[2] / under[2]


def shown_name(tool, form):
    return "this library" if tool == OURS else f"{NAMES[tool]}, {FORMS[form]}"


def numbered(level):
    """The builds of each tool in the order in which they were tried."""
    found = {}
    for about in level["tuning"]:
        names = found.setdefault(about["tool"], [])
        if about["build"] not in names:
            names.append(about["build"])
    return found


def digits(error):
    return "no number" if error is None else f"{error:.0e}"


def case_table(level, case):
    """A case's table: rates, ratios, spreads, builds; and digits near zero unstable points where they were looked at."""
    points, mine, numbers = level["points"][case], ours(level, case), numbered(level)
    near = level["near"].get(case)
    head = ["", "million points/s", "this library is … times as fast", "spread", "build"]
    head += [f"off by, at {distance:.0e}" for distance in DISTANCES] if near else []
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for tool, form, seconds, spread in rows(level, case):
        build = ""
        if tool != OURS:
            build = str(numbers[tool].index(level["chosen"][f"{case} {tool} {form}"]) + 1)
        mark = " †" if spread > LARGEST_SPREAD else ""
        cells = [shown_name(tool, form), f"{points / seconds / 1e6:.1f}", f"{seconds / mine[2]:.2f}", f"±{100 * spread:.0f} %{mark}", build]
        cells += [digits(error) for error in near[tool if tool == OURS else f"{tool} {form}"]] if near else []
        lines.append("| " + " | ".join(cells) + " |")
    return [*lines, "", headline(level, case), ""]


def headline(level, case):
    """The ratio to the best of all others, or why there is none."""
    best = best_of(level, case)
    name = shown_name(*best[:2])
    found = ratio(best, ours(level, case))
    if found is None:
        return f"No ratio to the best other, {name}: one of both was not steady."
    return f"**{found:.2f} times as fast as the best other: {name}.**"


def scan_table(level):
    """`rotor scan` to Parquet beside writing the columns alone."""
    lines = ["| | million points/s | of writing alone | spread |", "|---|---|---|---|"]
    titles = {"scan_parquet": "one thread", "scan_parquet_threads": "all processors"}
    for case, title in titles.items():
        alone = program(level, case, "alone")
        for name, row in ((f"`rotor scan -o map.parquet`, {title}", ours(level, case)), ("the same columns written alone (pyarrow)", alone)):
            mark = " †" if row[3] > LARGEST_SPREAD else ""
            rate = level["points"][case] / row[2] / 1e6
            lines.append(f"| {name} | {rate:.1f} | {alone[2] / row[2]:.2f} | ±{100 * row[3]:.0f} %{mark} |")
    return [*lines, ""]


def losses(level):
    """What was faster than this library, case by case."""
    found = []
    for case, title in TITLES.items():
        mine = ours(level, case)
        for tool, form, seconds, _ in rows(level, case):
            if tool != OURS and seconds < mine[2]:
                found.append(f"- {title}: {shown_name(tool, form)} is {mine[2] / seconds:.2f} times as fast.")
    return [*(found or ["Nowhere."]), ""]


def bars(level):
    """What is asked for: its name, whether more or less is better, the bound, what was measured."""
    grid = ours(level, "grid_sigma_phi")
    whole = ours(level, "max_over_phi_whole")
    steady = whole[3] <= LARGEST_SPREAD
    return [
        ("blocks of 4096 points, over the best other", ">=", 1.5, ratio(best_of(level, "widths_block"), ours(level, "widths_block"))),
        ("2^20 points from memory, over the best other", ">=", 1.3, ratio(best_of(level, "widths_stream"), ours(level, "widths_stream"))),
        ("grid, over filling the same memory", ">=", 0.85, ratio(program(level, "grid_sigma_phi", "fill"), grid)),
        ("grid, over Numba staged by hand", ">=", 1.5, ratio(best_of(level, "grid_sigma_phi", ["numba-staged"]), grid)),
        ("`rotor scan` to Parquet, over writing its columns alone", ">=", 0.7, ratio(program(level, "scan_parquet", "alone"), ours(level, "scan_parquet"))),
        ("maximum over the angle for 100 000 depths, 1e9 points/s", ">=", 1.0, level["points"]["max_over_phi_whole"] / whole[2] / 1e9 if steady else None),
        ("gradients by all 12 inputs, in values", "<=", 3.0, ratio(ours(level, "physical_gradients"), ours(level, "physical_values"))),
        ("two threads over one", ">=", 1.8, ratio(ours(level, "widths_one_thread"), ours(level, "widths_two_threads"))),
    ]


def bars_table(level):
    lines = ["| ratio | asked | measured | |", "|---|---|---|---|"]
    for name, sense, bound, found in bars(level):
        measured = "not steady" if found is None else f"{found:.2f}"
        met = "" if found is None else "met" if (found >= bound) == (sense == ">=") else "**missed**"
        lines.append(f"| {name} | {'≥' if sense == '>=' else '≤'} {bound} | {measured} | {met} |")
    return [*lines, ""]


def tuning_tables(level):
    """What was tried for each tool, with the rates of its first case, both forms, and the vector functions in it."""
    lines = []
    for tool, names in numbered(level).items():
        abouts = [about for about in level["tuning"] if about["tool"] == tool and not about["threaded"]]
        case = next((about["case"] for about in abouts if "case" in about), None)
        title = f"shortest run in {case}, million points/s" if case else "it could not be tried"
        lines += [f"**{NAMES[tool]}** ({title})", "", "| | build | as written | cos 2φ | vector functions |", "|---|---|---|---|---|"]
        for number, name in enumerate(names, 1):
            mine = [about for about in abouts if about["build"] == name]
            cells = [tried(mine, case, form, level["points"]) for form in FORMS]
            vectors = sorted({vector for about in mine for vector in about.get("vectors", [])})
            lines.append(f"| {number} | {name} | {cells[0]} | {cells[1]} | {', '.join(f'`{vector}`' for vector in vectors)} |")
        lines.append("")
    return lines


def tried(abouts, case, form, points):
    """The rate of a build that was tried, or why there is none."""
    for about in abouts:
        if about["form"] == form and about.get("case") == case and "seconds" in about:
            return f"{points[case] / about['seconds'] / 1e6:.1f}"
    return next((about["reason"] for about in abouts if about["form"] == form and "reason" in about), "")


def head(about):
    machine, versions, sizes = about["machine"], about["versions"], about["sizes"]
    return (Path(__file__).parent / "performance.md").read_text().format(
        machine=f"{machine['processor']} ({machine['family']}; {machine['instructions']}), {machine['cpus']} processors, "
        f"{machine['memory_gib']} GiB, {machine['system']}; load before the run {machine['load_at_start']:.1f}",
        versions=", ".join(f"{name} {version.removeprefix(name + ' ')}" for name, version in versions.items()),
        rows=sizes[0],
        depths=sizes[1],
        angles=sizes[2],
        spread=f"{100 * LARGEST_SPREAD:.0f}",
        attempts=1 if about["quick"] else ATTEMPTS,
        written=TOLERANCES["written"],
        cos2phi=TOLERANCES["cos2phi"],
        without=""
        if len(about["levels"]) > 1
        else "The processor has no AVX-512: everything is measured with packs of 256 bits alone.\n",
    )


def markdown(about):
    lines = [head(about)]
    for level in about["levels"]:
        lines += [f"## {LEVELS[level['level']]}", "", "### What is asked for", "", *bars_table(level)]
        lines += ["### Where this library is slower", "", *losses(level)]
        for case, title in TITLES.items():
            lines += [f"### {title[0].upper() + title[1:]}", "", *case_table(level, case)]
        lines += ["### `rotor scan` to a file, the whole process", "", *scan_table(level)]
        lines += ["### What was tried", "", *tuning_tables(level)]
    return "\n".join(lines)


def write(about, folder):
    pictures = folder / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    level = about["levels"][0]
    panels = []
    for case, title in TITLES.items():
        shown = [(shown_name(*row[:2]), level["points"][case] / row[2] / 1e6, row[0] == OURS) for row in rows(level, case)]
        panels.append((title, shown))
    chart.draw(panels, [pictures / "performance.svg", pictures / "performance.png"])
    text = markdown(about)
    (folder / "performance.md").write_text(text)
    print(text)


if __name__ == "__main__":
    write(json.loads(Path(sys.argv[1]).read_text()), Path(sys.argv[2]))
