"""Writes the columns of a Parquet file alone: what `rotor scan` would take if its numbers cost nothing.

    python columns_alone.py FILE

The columns are read once; each `run` answers with the seconds in which they are written, beside the file, with the same
row groups, compression and dictionaries.
"""

import sys
import time

import pyarrow.parquet


def main(file):
    table = pyarrow.parquet.read_table(file)
    about = pyarrow.parquet.ParquetFile(file).metadata.row_group(0)
    columns = [about.column(place) for place in range(about.num_columns)]
    settings = {
        "row_group_size": about.num_rows,
        "compression": "none" if columns[0].compression == "UNCOMPRESSED" else columns[0].compression.lower(),
        "use_dictionary": [column.path_in_schema for column in columns if column.has_dictionary_page],
        "write_statistics": all(column.is_stats_set for column in columns),
    }
    for line in sys.stdin:
        start = time.perf_counter()
        pyarrow.parquet.write_table(table, f"{file}.alone", **settings)
        print(f"{time.perf_counter() - start:e}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
