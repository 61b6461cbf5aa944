"""The chart of a comparison."""

# Height in inches of a bar with its gap, and of a panel's title and axis.
BAR, PANEL = 0.17, 0.6


def rate(millions):
    """Three digits, or all before the point."""
    return f"{millions:.0f}" if millions >= 100 else f"{millions:.3g}"


def draw(panels, files):
    """A panel for each title with its bars: name, million points per second, whether it is this library's."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "rotor"
    from matplotlib import pyplot, ticker

    heights = [len(rows) * BAR + PANEL for _, rows in panels]
    figure, axes = pyplot.subplots(len(panels), 1, figsize=(8, sum(heights)), layout="constrained", height_ratios=heights)
    longest = max(row[1] for _, rows in panels for row in rows)
    for axis, (title, rows) in zip(axes, panels):
        rows = rows[::-1]
        colours = ["#0072b2" if own else "#999999" for *_, own in rows]
        bars = axis.barh([name for name, *_ in rows], [millions for _, millions, _ in rows], color=colours)
        axis.bar_label(bars, labels=[rate(millions) for _, millions, _ in rows], padding=3, fontsize=7)
        axis.set_xscale("log")
        # All bars start at a million points per second; the longest of any panel ends before the axis does.
        axis.set_xlim(1.0, 2.5 * longest)
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(ticker.NullFormatter())
        axis.spines[["top", "right"]].set_visible(False)
        axis.set_title(title, fontsize=9, loc="left")
        axis.tick_params(labelsize=7)
    axes[-1].set_xlabel("million points per second")
    for file in files:
        figure.savefig(file, dpi=120, metadata={"Date": None} if file.suffix == ".svg" else None)
