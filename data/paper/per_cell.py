#!/usr/bin/env python3
"""Times per cell: the mean time of drawn flights over their mean length, and over the cells of the unit lattice that
they cross: in the mean over directions 4 / pi to a unit of length in 2D, 3 / 2 in 3D. Reads files of
`lorentz bench --csv`."""
import csv
import math
import sys

print("scene,engine,radius,flights,path_mean,ns_per_length,ns_per_cell")
for name in sys.argv[1:]:
    for row in csv.DictReader(open(name)):
        if row["difficulty"] != "drawn" or not row["ns_mean"]:
            continue
        per_length = float(row["ns_mean"]) / float(row["path_mean"])
        cells = {"square": 4 / math.pi, "cubic": 1.5}[row["scene"]]
        print(f"{row['scene']},{row['engine']},{row['radius']},{row['queries']},{row['path_mean']},"
              f"{per_length:.4g},{per_length / cells:.4g}")
