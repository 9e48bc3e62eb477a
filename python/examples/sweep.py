#!/usr/bin/env python3
"""Sweeps the stiffness of a clamped beam: time against error of its sag for several numbers of substeps. Writes sweep.csv, and
sweep.svg if matplotlib is there."""
import csv
import sys
import time

import numpy as np

import sinew

MODULI = (2e4, 6e4, 2e5)  # [Pa]
SUBSTEPS = (4, 8, 16, 32, 64)


def beam(modulus):
    """A beam of 0.4 m x 0.1 m x 0.1 m that is fixed at one end, with damping so that it comes to rest."""
    scene = sinew.Scene()
    scene.add_lattice(cells=(8, 2, 2), spacing=0.05, young_modulus=modulus)
    scene.add_fixed(np.arange(scene.particle_count)[::9])  # x = 0: the first node of each row of nine
    return scene


def sag(device, modulus, substeps):
    """How far the free end hangs down after 2 s [m], and the time of a step [ms]."""
    simulation = sinew.Simulation(device, beam(modulus), sinew.Settings(substeps=substeps))
    start = simulation.positions[8::9, 1].mean()
    simulation.step(1)  # drivers may compile at the first one
    began = time.perf_counter()
    heights = []
    for _ in range(120):
        simulation.step(1)
        heights.append(simulation.positions[8::9, 1].mean())
    spent = time.perf_counter() - began
    return float(start - np.mean(heights)), 1e3 * spent / 120


def main():
    device = sinew.Device()
    rows = []
    for modulus in MODULI:
        exact, _ = sag(device, modulus, 256)
        for substeps in SUBSTEPS:
            value, milliseconds = sag(device, modulus, substeps)
            rows.append((modulus, substeps, milliseconds, abs(value - exact) / exact))
            print("E = %7.0f Pa, %3d substeps: %6.3f ms a step, error of the mean sag %.2e" % rows[-1])
    with open("sweep.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("young_modulus_Pa", "substeps", "ms_per_step", "relative_error"), *rows])
    try:
        import matplotlib
    except ImportError:
        print("wrote sweep.csv; with matplotlib there would be a plot")
        return 0
    matplotlib.use("svg")
    from matplotlib import pyplot
    for modulus in MODULI:
        points = [row[2:] for row in rows if row[0] == modulus]
        pyplot.loglog(*zip(*points), marker="o", label=f"{modulus:g} Pa")
    pyplot.xlabel("time of a step [ms]")
    pyplot.ylabel("relative error of the mean sag")
    pyplot.legend(title="Young's modulus")
    pyplot.savefig("sweep.svg")
    print("wrote sweep.csv and sweep.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
