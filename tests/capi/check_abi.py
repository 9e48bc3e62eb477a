#!/usr/bin/env python3
"""check_abi.py <folder of headers> <shared library> <golden file> <C compiler> <Vulkan headers> [--write [--new-version]]: fails if
sizes and offsets of the structs of the headers in C, their constants or the symbols that the library exports are not those of
the golden file. --write renews it after additions that programs of the former header live with; --new-version allows changes
that programs must be compiled anew for, with another version of the library file."""
import difflib
import pathlib
import re
import subprocess
import sys
import tempfile

HEADERS = ["sinew.h", "sinew_world.h", "sinew_query.h", "sinew_events.h", "sinew_motions.h"]
STRUCT = re.compile(r"^typedef struct (\w+) \{\n(.*?)^\} \1;", re.M | re.S)
MEMBERS = re.compile(r"^[\w *]+?[\w*]\s+\**(\w+(?:\[\d+\])?(?:, ?\**\w+(?:\[\d+\])?)*)$")
CONSTANT = re.compile(r"(?:^\s+|[{,] )(SINEW_\w+) = -?\d+", re.M)
FUNCTION = re.compile(r"^SINEW_C_API [\w ]+[\s*]+(sinew\w+)\(", re.M)


def members(body):
    body = re.sub(r"//.*", "", body)
    for declaration in filter(None, (part.strip() for part in body.split(";"))):
        found = MEMBERS.match(" ".join(declaration.split()))
        if not found:
            sys.exit(f"check_abi.py does not understand: {declaration}")
        for name in found[1].split(","):
            yield re.sub(r"[*\s]|\[\d+\]", "", name)


def layout(headers, text, compiler, vulkan):
    """Lines on structs and constants, printed by a C program."""
    lines = [f'#include "sinew/{name}"' for name in HEADERS] + ["#include <stdio.h>", "int main(void) {"]
    structs = STRUCT.findall(text)
    if len(structs) != len(re.findall(r"^typedef struct", text, re.M)):
        sys.exit("check_abi.py does not find every struct")
    for name, body in structs:
        lines.append(f'printf("struct {name} %zu\\n", sizeof({name}));')
        lines += [f'printf("  {member} %zu\\n", offsetof({name}, {member}));' for member in members(body)]
    lines += [f'printf("{name} %d\\n", (int){name});' for name in CONSTANT.findall(text)]
    lines += ["return 0;", "}"]
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder) / "abi.c", pathlib.Path(folder) / "abi"
        source.write_text("\n".join(lines) + "\n", encoding="utf-8")
        subprocess.run([compiler, "-std=c11", "-Werror", f"-I{headers.parent}", "-idirafter", vulkan, source, "-o", program], check=True)
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


def structs(lines):
    """The size and the members, with offsets, of each struct in lines of layout()."""
    found = {}
    for line in lines:
        words = line.split()
        if words[0] == "struct":
            found[words[1]] = (int(words[2]), [])
        elif line.startswith("  "):
            found[list(found)[-1]][1].append((words[0], int(words[1])))
    return found


def changes(former, now, sizes):
    """Complaints about changes, between lines of layout() and symbols, that a program compiled with the former header does not
    live with. `sizes` is the text of src/capi/sizes.hpp, which lists the sizes of former headers."""
    for line in former:
        if not line.startswith(("struct ", " ")) and line not in now:
            yield f"{line} of the former header is gone or changed"
    now_structs = structs(now)
    for name, (size, old) in structs(former).items():
        new_size, new = now_structs.get(name, (0, []))
        added = new[len(old):]
        if new[:len(old)] != old or (not added and new_size != size):
            yield f"{name}: members of the former header are gone, moved or changed"
        elif added and old[0][0] != "size":
            yield f"{name} has no size: as an element of arrays it must not grow"
        elif added and added[0][1] != size:
            yield f"{name}::{added[0][0]} begins at {added[0][1]}, and must begin at {size}, where the struct ended"
        elif added and f"offsetof({name}, {added[0][0]})" not in sizes:
            yield f"formerSizes of src/capi/sizes.hpp lacks offsetof({name}, {added[0][0]})"


def main():
    folder, library, golden = (pathlib.Path(argument) for argument in sys.argv[1:4])
    text = "".join((folder / name).read_text(encoding="utf-8") for name in HEADERS)
    output = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    exported = sorted(line.split()[2] for line in output.splitlines() if line.split()[1] != "A")
    declared = sorted(f"{name}@@SINEW_C_0.1" for name in FUNCTION.findall(text))
    found = list(difflib.unified_diff(declared, exported, "declared", "exported", lineterm="", n=0))
    lines = layout(folder, text, sys.argv[4], sys.argv[5]) + exported
    sizes = (folder.parents[1] / "src/capi/sizes.hpp").read_text(encoding="utf-8")
    refused = [] if "--new-version" in sys.argv else list(changes(golden.read_text(encoding="utf-8").splitlines(), lines, sizes))
    found += refused
    if "--write" in sys.argv and not refused:
        golden.write_text("\n".join(lines) + "\n", encoding="utf-8")
    found += difflib.unified_diff(golden.read_text(encoding="utf-8").splitlines(), lines, str(golden), "now", lineterm="", n=1)
    print("\n".join(found) if found else f"{len(exported)} functions and {len(lines) - len(exported)} sizes, offsets and constants are as recorded")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
