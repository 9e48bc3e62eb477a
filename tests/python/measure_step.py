#!/usr/bin/env python3
"""measure_step.py <libsinew_c_shared.so> <abi.txt>: prints the time of a step of one particle by the C function, called through
ctypes, and by the module. Not a test: tests assert no times."""
import ctypes
import pathlib
import re
import sys
import time

import sinew

ABI = pathlib.Path(sys.argv[2]).read_text(encoding="utf-8")
SIZES = {name: int(size) for name, size in re.findall(r"^struct (\w+) (\d+)$", ABI, re.M)}
TYPES = {name.replace("_", "").lower(): int(number) for name, number in re.findall(r"^SINEW_TYPE_(\w+) (\d+)$", ABI, re.M)}
library = ctypes.CDLL(sys.argv[1])


def default(name):
    """A description as the library fills it in."""
    class Bytes(ctypes.Structure):
        _fields_ = [("bytes", ctypes.c_uint32 * (SIZES[name] // 4))]
    made = Bytes()
    library.sinewSetDefaults(TYPES[name.removeprefix("Sinew").lower()], ctypes.byref(made), ctypes.c_size_t(ctypes.sizeof(made)))
    return made


def simulation():
    """The handle of a simulation of one particle, by the functions of the library."""
    device, scene, made = ctypes.c_uint64(), ctypes.c_uint64(), ctypes.c_uint64()
    particle = (ctypes.c_float * (SIZES["SinewParticle"] // 4))(0, 0, 0, 0, 0, 0, 1)
    settings = default("SinewSettings")
    results = [library.sinewCreateDevice(ctypes.byref(default("SinewDeviceRequest")), ctypes.byref(device)),
               library.sinewCreateScene(ctypes.byref(scene)),
               library.sinewAddParticles(scene, 1, ctypes.byref(particle), None),
               library.sinewCreateSimulation(device, scene, ctypes.byref(settings), ctypes.byref(made))]
    if any(results):
        sys.exit(f"the C functions fail: {results}")
    return made


def fastest(step, count=100, rounds=30):
    """The fastest of several rounds, since others use the machine too [us]."""
    best = 1e9
    for _ in range(rounds):
        began = time.perf_counter()
        for _ in range(count):
            step()
        best = min(best, (time.perf_counter() - began) / count)
    return 1e6 * best


scene = sinew.Scene()
scene.add_particles([[0, 0, 0]])
by_module = sinew.Simulation(sinew.Device(), scene)
handle, description = simulation(), default("SinewStep")
in_c = fastest(lambda: library.sinewStep(handle, ctypes.byref(description), 1))
in_python = fastest(by_module.step)
print(f"{in_c:.1f} us a step in C, {in_python:.1f} us by the module: {in_python - in_c:+.1f} us")
