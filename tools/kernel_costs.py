#!/usr/bin/env python3
"""kernel_costs.py TABLE.csv: makes tools/sinew/predict/kernels.csv from the table that the test GpuCompiler writes:

    SINEW_KERNEL_TABLE=FOLDER build/release/bin/test_gpu_compiler --gtest_filter=*NAVI21
    tools/kernel_costs.py FOLDER/kernels_NAVI21.csv

A line a kernel; of its specialisations the median one by latency, as a scene uses few of them.
"""
import csv
import pathlib
import sys

HEADING = """# Costs of each kernel on NAVI21 (RDNA 2) in waves of 32, as Mesa 22.3's compiler ACO estimates them; made by
# tools/kernel_costs.py. waves: that fit into a SIMD, of 32; latency: of one wave [cycles]; issue: cycles of a SIMD a wave
kernel,waves,latency,issue
"""

with open(sys.argv[1], newline="") as file:
    rows = list(csv.DictReader(file))
kernels = {}
for row in rows:
    kernels.setdefault(row["kernel"], []).append(
        [int(row[column]) for column in ("latency", "waves a SIMD", "inverse throughput")])
target = pathlib.Path(__file__).parent / "sinew/predict/kernels.csv"
with target.open("w") as file:
    file.write(HEADING)
    for name, found in sorted(kernels.items()):
        latency, waves, issue = sorted(found)[len(found) // 2]
        file.write(f"{name},{waves},{max(latency, 1)},{max(issue, 1)}\n")
