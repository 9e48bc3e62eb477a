#!/usr/bin/env python3
"""mesh_table.py SINEW [--resolution N] [--repair none|weld|close] [--device D] [--surfaces] PATH...: the results of importing and filling meshes, as a Markdown table.

PATH is a mesh (OBJ, STL, PLY, glTF, GLB; OFF is rewritten as OBJ), a folder searched for them, or `broken`: meshes that this
script makes, each with one defect. The last lines, on stderr, count the meshes that were read, that are closed, and whose voxels
keep their volume within 1 %. With --surfaces the table names the surface of a cuttable body of each mesh, and the last line counts
them. The exit code is 1 if `sinew mesh` ended with neither a report nor one sentence.
"""
import argparse
import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SUFFIXES = {".obj", ".stl", ".ply", ".gltf", ".glb", ".off"}


def icosphere(rounds):
    """A unit sphere: vertices and 20 x 4^rounds triangles that face outwards."""
    g = (1 + math.sqrt(5)) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
              (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
             (9, 8, 1)]
    points = [scaled(p, 1 / math.dist(p, (0, 0, 0))) for p in points]
    for _ in range(rounds):
        middles, finer = {}, []

        def middle(a, b):
            key = (a, b) if a < b else (b, a)
            if key not in middles:
                sum_ = tuple(x + y for x, y in zip(points[a], points[b]))
                middles[key] = len(points)
                points.append(scaled(sum_, 1 / math.dist(sum_, (0, 0, 0))))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return points, faces


def torus(side):
    """A torus with 2 side^2 triangles that face outwards."""
    turns = [2 * math.pi * i / side for i in range(side)]
    points = [((1 + 0.4 * math.cos(v)) * math.cos(u), 0.4 * math.sin(v), (1 + 0.4 * math.cos(v)) * math.sin(u))
              for u in turns for v in turns]
    faces = []
    for i in range(side):
        for j in range(side):
            a, b = i * side + j, i * side + (j + 1) % side
            c, d = (i + 1) % side * side + j, (i + 1) % side * side + (j + 1) % side
            faces += [(a, b, c), (b, d, c)]
    return points, faces


def scaled(p, by):
    return tuple(by * x for x in p)


def write_obj(path, points, faces):
    with open(path, "w") as out:
        out.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in points)
        out.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def write_ply(path, points, faces):
    with open(path, "wb") as out:
        out.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                  f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        out.write(b"".join(struct.pack("<3f", *p) for p in points))
        out.write(b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def broken(folder):
    """Pairs of a defect and a file with it."""
    points, faces = icosphere(3)

    def obj(name, some_points, some_faces):
        path = folder / f"{name}.obj"
        write_obj(path, some_points, some_faces)
        return name, path

    yield obj("whole sphere, to compare", points, faces)
    yield obj("a twentieth of the triangles missing", points, [f for n, f in enumerate(faces) if n % 20])
    yield obj("open: without its top", points, [f for f in faces if min(points[i][1] for i in f) < 0.8])
    yield obj("inside out", points, [f[::-1] for f in faces])
    yield obj("every third triangle flipped", points, [f[::-1] if n % 3 == 0 else f for n, f in enumerate(faces)])
    other = [(x + 0.9, y, z) for x, y, z in points]
    yield obj("two spheres through each other", points + other, faces + [tuple(i + len(points) for i in f) for f in faces])
    flat = [(x, 1e-5 * y, z) for x, y, z in points]
    yield obj("flattened to 1e-5: slivers and no volume", flat, faces)
    needles = [(points[a], points[b], tuple((x + y) / 2 for x, y in zip(points[a], points[b]))) for a, b, c in faces[:200]]
    all_points, extra = list(points), []
    for corners in needles:
        extra.append(tuple(range(len(all_points), len(all_points) + 3)))
        all_points += corners
    yield obj("200 triangles with next to no area added", all_points, faces + extra)
    soup = [points[i] for f in faces for i in f]
    yield obj("every triangle with vertices of its own", soup, [tuple(range(3 * n, 3 * n + 3)) for n in range(len(faces))])
    yield obj("every triangle twice", points, faces + faces)
    yield obj("one triangle", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    yield obj("an index out of range", points, faces[:-1] + [(0, 1, len(points) + 5)])
    yield obj("a coordinate that is no number", [(float("nan"), 0, 0)] + points[1:], faces)
    for name, side in (("5.0 million triangles", 1580), ("5.1 million triangles", 1600)):
        path = folder / "large.ply"
        write_ply(path, *torus(side))
        yield name, path


def from_off(path, folder):
    """The mesh of an OFF file as OBJ; None if the file is not readable here."""
    words = " ".join(line.split("#")[0] for line in path.read_text(errors="replace").splitlines()).split()
    try:
        keyword = words.pop(0) if not words[0].lstrip("-").isdigit() else "OFF"
        if keyword not in ("OFF", "COFF", "NOFF"):
            return None
        vertices, count = int(words[0]), int(words[1])
        per = {"OFF": 3, "NOFF": 6, "COFF": 7}[keyword]
        at, points, faces = 3, [], []
        if per * vertices + count > len(words):  # more counted than the file has
            return None
        for _ in range(vertices):
            points.append(tuple(float(w) for w in words[at:at + 3]))
            at += per
        for _ in range(count):
            corners = int(words[at])
            faces.append(tuple(int(w) for w in words[at + 1:at + 1 + corners]))
            at += 1 + corners
    except (ValueError, IndexError):
        return None
    out = folder / (path.stem + ".obj")
    write_obj(out, points, faces)
    return out


def found(paths, folder):
    for path in paths:
        if path == "broken":
            yield from broken(folder)
            continue
        root = Path(path)
        files = sorted(p for p in root.rglob("*") if p.suffix.lower() in SUFFIXES) if root.is_dir() else [root]
        for file in files:
            name = str(file.relative_to(root)) if root.is_dir() else file.name
            yield name, from_off(file, folder) if file.suffix.lower() == ".off" else file


def row(arguments, name, path):
    """Cells of a row, and whether `sinew mesh` ended as expected."""
    if path is None:
        return [name, "OFF of a kind that this table does not read"], True
    command = [arguments.sinew, "mesh", str(path), "--resolution", str(arguments.resolution), "--json", "-"]
    if arguments.repair:
        command += ["--repair", arguments.repair]
    if arguments.device:
        command += ["--device", arguments.device]
    start = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, timeout=1800)
    seconds = time.monotonic() - start
    if done.returncode:
        said = done.stderr.strip().replace(str(path), "FILE").splitlines()
        errors = [line for line in said if line.startswith("error: ")]
        isSentence = done.returncode == 3 and len(errors) == 1
        return [name, f"refused: {errors[0][7:] if errors else said}"], isSentence
    report = json.loads(done.stdout)
    surface, voxels = report["surface"], report["voxels"]
    faults = [f"{surface[key]} {text}" for key, text in (
        ("boundary_edges", "open"), ("non_manifold_edges", "of three or more"), ("flipped_edges", "flipped"),
        ("degenerate_triangles", "without area"), ("duplicate_triangles", "twice")) if surface[key]]
    own = surface.get("volume")
    volume = voxels["volume"]
    isEven = not surface["flipped_edges"]
    ratio = f"{100 * (volume / abs(own) - 1):+.1f} %" if own and isEven else "–"
    return [name, f"{surface['triangles']:,}", "; ".join(faults) or "none", f"{own:.4g}" if own is not None else "–",
            f"{volume:.4g}", ratio, f"{voxels['hull']:,} + {voxels['core']:,}", f"{voxels['doubtful']:,}",
            f"{seconds:.2f}", repaired(report["repair"])], True


def surface(arguments, name, path, folder):
    """Cells of a row of --surfaces, and whether `sinew describe` ended as expected. The body has the place of its file."""
    if path is None:
        return [name, "not read"], True
    scene, mesh = folder / "surface.toml", folder / ("surface" + path.suffix)
    shutil.copy(path, mesh)
    scene.write_text(f'[[mesh]]\nfile = "{mesh.name}"\nresolution = {arguments.resolution}\ncuttable = true\n'
                     f'repair = "{arguments.repair or "close"}"\n')
    done = subprocess.run([arguments.sinew, "describe", str(scene)], capture_output=True, text=True, timeout=1800)
    mesh.unlink()
    if done.returncode:
        errors = [line[7:] for line in done.stderr.splitlines() if line.startswith("error: ")]
        return [name, "refused", errors[0] if errors else done.stderr], done.returncode == 3 and len(errors) == 1
    shown = [shown for sentence, shown in (("a closed surface half a voxel fine is shown in its place", "wrapped"),
                                           ("the faces of its voxels are shown in its place", "voxels"))
             if sentence in done.stderr]
    return [name, shown[0] if shown else "mesh"], True


def surfaces(arguments):
    print("| mesh | surface | |\n|---|---|---|")
    counts, areAllWell = {}, True
    with tempfile.TemporaryDirectory() as folder:
        for name, path in found(arguments.paths, Path(folder)):
            cells, isWell = surface(arguments, name, path, Path(folder))
            areAllWell = areAllWell and isWell
            counts[cells[1]] = counts.get(cells[1], 0) + 1
            print("| " + " | ".join(cells + [""] * (3 - len(cells))) + " |", flush=True)
    print(", ".join(f"{count} {shown}" for shown, count in sorted(counts.items())), file=sys.stderr)
    return 0 if areAllWell else 1


def repaired(report):
    """The repairs, as a cell of the table."""
    said = [f"{report[key]} {text}" for key, text in (
        ("joined_vertices", "joined"), ("split_edges", "split"), ("removed_triangles", "removed"), ("closed_holes", "closed"),
        ("turned_triangles", "turned"), ("turned_parts", "parts turned")) if report[key]]
    return "; ".join(said) or "none"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sinew")
    parser.add_argument("paths", nargs="+")
    parser.add_argument("--resolution", type=int, default=48)
    parser.add_argument("--repair", choices=("none", "weld", "close"))
    parser.add_argument("--device")
    parser.add_argument("--surfaces", action="store_true")
    arguments = parser.parse_args()
    if arguments.surfaces:
        return surfaces(arguments)
    print("| mesh | triangles | defects (edges; triangles) | volume | of voxels | difference | hull + core | doubtful | s | repairs |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    areAllWell = True
    read, closed, kept = 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name, path in found(arguments.paths, Path(folder)):
            cells, isWell = row(arguments, name, path)
            areAllWell = areAllWell and isWell
            print("| " + " | ".join(cells + [""] * (10 - len(cells))) + " |", flush=True)
            if len(cells) == 10:
                isClosed = not any(word in cells[2] for word in ("open", "of three", "flipped"))
                read, closed = read + 1, closed + isClosed
                kept += isClosed and cells[5] != "–" and abs(float(cells[5].split()[0])) <= 1
            if not isWell:
                print(f"not a sentence: {name}", file=sys.stderr)
    print(f"{read} read, {closed} closed and evenly oriented, {kept} of these keep their volume within 1 %", file=sys.stderr)
    return 0 if areAllWell else 1


if __name__ == "__main__":
    sys.exit(main())
