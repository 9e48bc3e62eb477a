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
    "capi": ["scenes", "mesh", "sim", "vk"],
}
# The rooms of the core, lowest first, as src/sim/CMakeLists.txt lists them; the reference, which shares no code with them, is last.
ROOMS = re.findall(r"^sinew_room\((\w+)", (ROOT / "src/sim/CMakeLists.txt").read_text(encoding="utf-8"), re.M) + ["reference"]
# Rooms whose names are part of their namespaces; what the others declare is in sinew::sim.
SPACES = {"lattice", "forces", "events", "constraints", "rigid", "grabs", "fields", "motions", "sleep", "collision", "stiffness", "levels", "surface", "cutting", "solvers", "reference"}
# Rooms that see Vulkan.
VULKAN_ROOMS = {"device", "simulation"}
PURE_VK = {"sinew/vk/spirv.hpp", "sinew/vk/shader_code.hpp"}  # include no Vulkan header
MESH_MAY_USE_SIM = {"sinew/scene.hpp", "sinew/bodies.hpp", "sim/core/counted.hpp"}
MESH_ON_DEVICE = "src/mesh/gpu/"  # the only part of mesh that sees Vulkan
GPU_MAY_USE_SIM = MESH_MAY_USE_SIM | {"sim/program/program.hpp"}  # passes and their barriers
# Rooms of the shader files: those of the core, below them what all share, above them those of mesh and viewer.
SHADER_ROOMS = ["common"] + ROOMS[:-1] + ["mesh", "viewer"]
# Folders of the viewer: each may include itself and those before it. The files beside them may include all.
VIEWER_ROOMS = ["render", "document", "layers", "input", "tools", "ui", "capture", "jobs", "player"]
VIEWER_TOP = {"main", "interactive", "headless", "headless_times"}
SHOWS_PROGRAM = "apps/viewer/jobs/gauges.cpp"  # the panel of the step program; no other file includes compile, program, simulation or device
LIMITS = {".cpp": 600, ".hpp": 600, ".h": 600, ".comp": 150, ".glsl": 150, ".vert": 150, ".frag": 150}
# Uniform blocks that are allowed. Lavapipe recompiles a shader when a uniform word used in a condition changes, so data that change with
# every step are in storage buffers. Planes never change.
UNIFORMS = {"Step", "Bounds", "Frame", "Planes"}
UNIFORM = re.compile(r"^layout\(std140[^)]*\)\s*uniform\s+(\w+)", re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.M)
STAGES = re.compile(r"vkCmdPipelineBarrier|VK_PIPELINE_STAGE_|VK_ACCESS_")


NAMESPACE = re.compile(r"^namespace (sinew::sim(?:::\w+)*) \{", re.M)
DECLARES = re.compile(r'^#include "sinew/(?!scene|ranges|vk/)', re.M)
DECLARATIONS = re.compile(r"^namespace [\w:]+ \{\n(?:(?:struct|class) \w+;\n)+\}.*$", re.M)


def room_complaints(name, text):
    """Rooms of src/sim: their includes lead down, and their namespaces follow them."""
    parts = name.split("/")
    if len(parts) < 4 or parts[2] not in ROOMS:
        yield f"{name}: stands in no room of src/sim/CMakeLists.txt"
        return
    room = parts[2]
    for include in INCLUDE.findall(text):
        target = include.split("/")
        if target[0] == "sim" and (len(target) < 3 or target[1] not in ROOMS or ROOMS.index(target[1]) > ROOMS.index(room)):
            yield f"{name}: {room} must not include {include}"
        if target[0] == "vk" or (include.startswith("sinew/vk/") and include not in PURE_VK and room not in VULKAN_ROOMS):
            yield f"{name}: only {' and '.join(sorted(VULKAN_ROOMS))} may include {include}"
    isPublic = name.endswith(".cpp") and bool(DECLARES.search(text))  # may define what a public header declares
    space = f"sinew::sim::{room}" if room in SPACES else "sinew::sim"
    for found in NAMESPACE.findall(DECLARATIONS.sub("", text)):
        inner = found.split("::")[2:3]
        isOwn = found == space or found.startswith(f"{space}::") and (room in SPACES or inner[0] not in ROOMS)
        if not isOwn and not (isPublic and found == "sinew::sim"):
            yield f"{name}: {found} is not the namespace of {room}"


def public_complaints(name, text):
    """Public headers include each other and nothing else of ours."""
    for include in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M):
        isAbove = name.startswith("include/sinew/vk/") and not include.startswith("sinew/vk/") and include != "sinew/export.hpp"
        if isAbove or not include.startswith("sinew/") or not (ROOT / "include" / include).exists():
            yield f"{name}: a public header must not include {include}"


def shader_complaints(name, text):
    """Shader files include what is in their room or in one below."""
    parts = name.split("/")
    if len(parts) != 4 or parts[2] not in SHADER_ROOMS:
        yield f"{name}: stands in no room of the shader files"
        return
    for include in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M):
        target = include.split("/")[0]
        if target not in SHADER_ROOMS or SHADER_ROOMS.index(target) > SHADER_ROOMS.index(parts[2]):
            yield f"{name}: {parts[2]} must not include {include}"


def complaints(path, text):
    name = path.relative_to(ROOT).as_posix()
    lines = text.count("\n")
    if lines > LIMITS[path.suffix]:
        yield f"{name}: {lines} lines, at most {LIMITS[path.suffix]}"
    if path.suffix in (".comp", ".glsl", ".vert", ".frag"):
        for block in UNIFORM.findall(text):
            if block not in UNIFORMS:
                yield f"{name}: {block} belongs in a storage buffer"
    isTop = name.count("/") == 2 and path.stem in VIEWER_TOP
    if name.startswith("apps/viewer/") and not isTop and name.split("/")[2] not in VIEWER_ROOMS:
        yield f"{name}: stands in no folder of the viewer"
    elif name.startswith("apps/viewer/") and name.count("/") > 2:
        room = VIEWER_ROOMS.index(name.split("/")[2])
        for include in INCLUDE.findall(text):
            parts = include.split("/")
            if include.endswith(".h"):  # shared with the kernels
                continue
            if parts[0] == "viewer" and (parts[1] not in VIEWER_ROOMS or VIEWER_ROOMS.index(parts[1]) > room):
                yield f"{name}: {VIEWER_ROOMS[room]} must not include {include}"
    for include in INCLUDE.findall(text) if name.startswith("apps/") and name != SHOWS_PROGRAM else []:
        if include.startswith(("sim/compile/", "sim/program/", "sim/simulation/", "sim/device/")):
            yield f"{name}: only {SHOWS_PROGRAM} may include {include}"
    if name.startswith("tools/sinew/") and (ROOT / "include" / name[len("tools/"):]).exists():
        yield f"{name}: a public header has that name"
    if name.startswith("include/"):
        yield from public_complaints(name, text)
    if name.startswith("shaders/"):
        yield from shader_complaints(name, text)
    if name.startswith("src/sim/"):
        yield from room_complaints(name, text)
    if not name.startswith("src/"):
        return
    layer = name.split("/")[1]
    for include in INCLUDE.findall(text):
        head = include.split("/")[0]
        if head == "sinew":  # a public header, of vk or of sim
            head = "vk" if include.startswith("sinew/vk/") else "sim"
        if head in LAYERS and head != layer and head not in LAYERS[layer]:
            yield f"{name}: {layer} must not include {include}"
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
            if include.startswith(("common/", "sim/")) and not include.startswith("sim/reference/") or include == "kernels.hpp":
                yield f"{name}: the reference shares no code with the kernels ({include})"
    if layer in ("vk", "sim") and name != "src/vk/commands.cpp" and STAGES.search(text):
        yield f"{name}: only vk/commands names stages, accesses and barriers"


def uncalled(texts):
    """Uncalled functions of the table: a device without them would be rejected needlessly."""
    table = (ROOT / "include/sinew/vk/functions.inc").read_text(encoding="utf-8")
    called = set(re.findall(r"\bvk[A-Z]\w+", "\n".join(texts)))
    for name in re.findall(r"^SINEW_VK\w*\((\w+)\)", table, re.M):
        if name not in called:
            yield f"include/sinew/vk/functions.inc: {name} is called by nobody: leave it out"


def main():
    found, files, calling = [], 0, []
    for top in ("include", "src", "apps", "tools", "tests", "shaders"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in LIMITS:
                files += 1
                text = path.read_text(encoding="utf-8")
                found += complaints(path, text)
                if top in ("include", "src", "apps"):
                    calling.append(text)
    found += uncalled(calling)
    print("\n".join(found) if found else f"layers: {files} files, all arrows point down")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
