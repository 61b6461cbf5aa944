"""Reads the tables that `cargo xtask readers` has let `rotor` write, with each tool that people read tables with.

Arguments: the folder with grid.{parquet,arrow,csv,npy}, reduced.{...} and evaluated.{...}.

Each tool must see the same columns, the same numbers bit by bit, and nulls where a quantity does not exist.
"""

import json
import sys
from pathlib import Path

import duckdb
import numpy
import pandas
import polars
import pyarrow
import pyarrow.csv
import pyarrow.feather
import pyarrow.ipc
import pyarrow.parquet

folder = Path(sys.argv[1])
NAMES = ["disk_polar_inertia", "crack_angle", "sir_width", "cir_width"]


def path(name):
    return str(folder / name)


# What Python itself reads is what the others are held against.
lines = (folder / "grid.csv").read_text().splitlines()
assert lines[0].split(",") == NAMES, lines[0]
expected = [[float(cell) if cell else None for cell in line.split(",")] for line in lines[1:]]
missing = sum(row[3] is None for row in expected)
assert len(expected) == 3 * 181 and missing == 181, (len(expected), missing)


def same(tool, rows):
    rows = [[None if value is None or value is pandas.NA else float(value) for value in row] for row in rows]
    assert rows == expected, f"{tool} reads other numbers"
    print(f"{tool}: {len(rows)} rows, {missing} nulls")


def of_frame(frame):
    assert list(frame.columns) == NAMES, frame.columns
    return frame.astype(object).where(frame.notna(), None).values.tolist()


same("pandas, parquet", of_frame(pandas.read_parquet(path("grid.parquet"))))
same("pandas, arrow", of_frame(pandas.read_feather(path("grid.arrow"))))
same("pandas, csv", of_frame(pandas.read_csv(path("grid.csv"), float_precision="round_trip")))
same("polars, parquet", polars.read_parquet(path("grid.parquet")).rows())
same("polars, arrow", polars.read_ipc(path("grid.arrow"), memory_map=False).rows())
same("polars, csv", polars.read_csv(path("grid.csv")).rows())
same("pyarrow, parquet", zip(*pyarrow.parquet.read_table(path("grid.parquet")).to_pydict().values()))
same("pyarrow, arrow", zip(*pyarrow.feather.read_table(path("grid.arrow")).to_pydict().values()))
same("pyarrow, csv", zip(*pyarrow.csv.read_csv(path("grid.csv")).to_pydict().values()))
same("duckdb, parquet", duckdb.sql(f"select * from '{path('grid.parquet')}'").fetchall())
same("duckdb, csv", duckdb.sql(f"select * from '{path('grid.csv')}'").fetchall())
with pyarrow.ipc.open_file(path("grid.arrow")) as reader:
    grid = reader.read_all()
    same("duckdb, arrow", duckdb.sql("select * from grid").fetchall())

# NumPy has no nulls: a column of booleans says what exists.
array = numpy.load(path("grid.npy"), allow_pickle=False)
columns = [array[name].tolist() for name in NAMES]
columns[3] = [value if exists else None for value, exists in zip(columns[3], array["cir_width_exists"])]
assert array["sir_width_exists"].all()
assert array.dtype.fields["crack_angle"][2] == "crack_angle [rad]", array.dtype
same("numpy, npy", zip(*columns))

# Axes and units are in the files that can hold them.
for name, schema in [
    ("parquet", pyarrow.parquet.read_schema(path("grid.parquet"))),
    ("arrow", pyarrow.feather.read_table(path("grid.arrow")).schema),
]:
    about = json.loads(schema.metadata[b"rotor"])
    assert [axis["length"] for axis in about["axes"]] == [3, 181], about
    assert about["axes"][1]["inputs"][0]["unit"] == "rad", about
    assert about["rotor"]["crack_model"] == "support-arm", about
    assert schema.field("disk_polar_inertia").metadata[b"unit"] == "kg m²".encode(), name
    assert schema.field("cir_width").nullable and not schema.field("crack_angle").nullable, name

# The long table of reductions: texts, numbers and nulls together.
reduced = [
    pandas.read_parquet(path("reduced.parquet")),
    pandas.read_feather(path("reduced.arrow")),
    polars.read_csv(path("reduced.csv")).to_pandas(),
    pandas.DataFrame(numpy.load(path("reduced.npy"), allow_pickle=False)),
]
for frame in reduced:
    widest = frame[(frame["reduction"] == "max:crack_angle") & (frame["quantity"] == "cir_width")]
    assert len(widest) == 3 and widest["value"].isna().sum() == 1, frame
print(f"reductions: {len(reduced[0])} rows in every format")
