#!/usr/bin/env python3
"""kernel_costs.py TABLE.csv | --check: makes tools/sinew/predict/kernels.csv from the table that the test GpuCompiler writes:

    SINEW_KERNEL_TABLE=FOLDER build/release/bin/test_gpu_compiler --gtest_filter=*NAVI21
    tools/kernel_costs.py FOLDER/kernels_NAVI21.csv

A line a kernel; of its specialisations the median one by latency, as a scene uses few of them.
--check fails if a kernel of src/sim/CMakeLists.txt has no line, or a line no kernel. The test's scenes must then use the kernel.
"""
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGET = ROOT / "tools/sinew/predict/kernels.csv"

HEADING = """# Costs of each kernel on NAVI21 (RDNA 2) in waves of 32, as Mesa 22.3's compiler ACO estimates them; made by
# tools/kernel_costs.py. waves: that fit into a SIMD, of 32; latency: of one wave [cycles]; issue: cycles of a SIMD a wave
kernel,waves,latency,issue
"""


def built():
    """Names of the kernels that src/sim/CMakeLists.txt lists: files, and variants that have a name of their own."""
    text = (ROOT / "src/sim/CMakeLists.txt").read_text()
    sources, variants = text[text.index("add_kernels(sinew_sim "):].split("VARIANTS", 1)
    return {pathlib.PurePath(path).stem for path in re.findall(r"\S+\.comp", sources)} | set(re.findall(r'"(\w+):', variants))


def check():
    lines = [line for line in TARGET.read_text().splitlines() if not line.startswith("#")]
    known = {line.split(",")[0] for line in lines[1:]}
    complaints = [f"{TARGET.relative_to(ROOT)}: no line for the kernel {name}: see the head of tools/kernel_costs.py"
                  for name in sorted(built() - known)]
    complaints += [f"{TARGET.relative_to(ROOT)}: no kernel is called {name}" for name in sorted(known - built())]
    print("\n".join(complaints) if complaints else f"kernels: {len(known)} have costs")
    return 1 if complaints else 0


def make(table):
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    kernels = {}
    for row in rows:
        kernels.setdefault(row["kernel"], []).append(
            [int(row[column]) for column in ("latency", "waves a SIMD", "inverse throughput")])
    with TARGET.open("w") as file:
        file.write(HEADING)
        for name, found in sorted(kernels.items()):
            latency, waves, issue = sorted(found)[len(found) // 2]
            file.write(f"{name},{waves},{max(latency, 1)},{max(issue, 1)}\n")


if sys.argv[1] == "--check":
    sys.exit(check())
make(sys.argv[1])
