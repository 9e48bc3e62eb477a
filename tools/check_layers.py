#!/usr/bin/env python3
"""Fails if an include points up a layer, if a rule of a single folder is broken, or if a file is too long."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Each layer may include itself and the layers in its list.
LAYERS = {
    "vk": [],
    "sim": ["vk"],
    "mesh": ["sim", "vk"],
    "scenes": ["mesh", "sim"],
    "app": ["mesh", "sim", "vk"],
}
# Finer rules inside a layer: (files, includes they may not have, why).
SIM_MAY_USE_VK = re.compile(r"src/sim/(gpu_\w+|simulation(_states?|_ring)?)\.(cpp|hpp)$")
PURE_VK = {"vk/spirv.hpp"}  # includes no Vulkan header
MESH_MAY_USE_SIM = {"sim/scene.hpp", "sim/bodies.hpp", "sim/counted.hpp"}
MESH_ON_DEVICE = "src/mesh/gpu/"  # the only part of mesh that sees Vulkan
GPU_MAY_USE_SIM = MESH_MAY_USE_SIM | {"sim/program.hpp"}  # passes and their barriers
# Folders of the viewer: each may include itself and those before it; files outside the folders may include all.
VIEWER_ROOMS = ["draw", "hands", "panels", "window", "pictures"]
LIMITS = {".cpp": 600, ".hpp": 600, ".h": 600, ".comp": 150, ".glsl": 150, ".vert": 150, ".frag": 150}
# Uniform blocks that are allowed. Lavapipe recompiles a shader when a uniform word used in a condition changes, so data that change with
# every step are in storage buffers. No condition uses a word of Frames.
UNIFORMS = {"Step", "Bounds", "Frame", "Frames"}
UNIFORM = re.compile(r"^layout\(std140[^)]*\)\s*uniform\s+(\w+)", re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.M)
STAGES = re.compile(r"vkCmdPipelineBarrier|VK_PIPELINE_STAGE_|VK_ACCESS_")


def complaints(path, text):
    name = path.relative_to(ROOT).as_posix()
    lines = text.count("\n")
    if lines > LIMITS[path.suffix]:
        yield f"{name}: {lines} lines, at most {LIMITS[path.suffix]}"
    if path.suffix in (".comp", ".glsl", ".vert", ".frag"):
        for block in UNIFORM.findall(text):
            if block not in UNIFORMS:
                yield f"{name}: {block} belongs in a storage buffer"
    if name.startswith("apps/viewer/") and name.split("/")[2] in VIEWER_ROOMS:
        room = VIEWER_ROOMS.index(name.split("/")[2])
        for include in INCLUDE.findall(text):
            parts = include.split("/")
            if include.endswith(".h"):  # shared with the kernels
                continue
            if parts[0] == "viewer" and (parts[1] not in VIEWER_ROOMS or VIEWER_ROOMS.index(parts[1]) > room):
                yield f"{name}: {VIEWER_ROOMS[room]} must not include {include}"
    if not name.startswith("src/"):
        return
    layer = name.split("/")[1]
    for include in INCLUDE.findall(text):
        head = include.split("/")[0]
        if head in LAYERS and head != layer and head not in LAYERS[layer]:
            yield f"{name}: {layer} must not include {include}"
        if layer == "sim" and head == "vk" and include not in PURE_VK and not SIM_MAY_USE_VK.search(name):
            yield f"{name}: only gpu_* and simulation may include {include}"
        isOnDevice = name.startswith(MESH_ON_DEVICE)
        allowed = GPU_MAY_USE_SIM if isOnDevice else MESH_MAY_USE_SIM
        if layer == "mesh" and head == "sim" and include not in allowed:
            yield f"{name}: mesh sees only {', '.join(sorted(allowed))}"
        if layer == "mesh" and not isOnDevice and (head == "vk" or include.startswith("mesh/gpu/")):
            yield f"{name}: only {MESH_ON_DEVICE} may include {include}"
        if head == "assimp" and not name.startswith("src/mesh/import"):
            yield f"{name}: only mesh/import includes assimp"
    if layer == "sim" and "/reference/" in name:
        for include in INCLUDE.findall(text):
            if include in ("layout.h", "kernels.hpp", "sim/compile.hpp") or include.startswith("sim/solvers"):
                yield f"{name}: the reference shares no code with the kernels ({include})"
    if layer in ("vk", "sim") and name != "src/vk/commands.cpp" and STAGES.search(text):
        yield f"{name}: only vk/commands names stages, accesses and barriers"


def uncalled(texts):
    """Uncalled functions of the table: a device without them would be rejected needlessly."""
    table = (ROOT / "src/vk/functions.inc").read_text(encoding="utf-8")
    called = set(re.findall(r"\bvk[A-Z]\w+", "\n".join(texts)))
    for name in re.findall(r"^SINEW_VK\w*\((\w+)\)", table, re.M):
        if name not in called:
            yield f"src/vk/functions.inc: {name} is called by nobody: leave it out"


def main():
    found, files, calling = [], 0, []
    for top in ("src", "apps", "tools", "tests", "shaders"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in LIMITS:
                files += 1
                text = path.read_text(encoding="utf-8")
                found += complaints(path, text)
                if top in ("src", "apps"):
                    calling.append(text)
    found += uncalled(calling)
    print("\n".join(found) if found else f"layers: {files} files, all arrows point down")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
