#!/usr/bin/env python3
"""check_symbols.py <include folder> <shared libraries...>: fails if the libraries export anything but what public headers mark with
SINEW_API, if a marked function is missing, or if a symbol has no version."""
import pathlib
import re
import subprocess
import sys

CLASS = re.compile(r"^(?:struct|class) SINEW_API (\w+)", re.M)
FUNCTION = re.compile(r"^SINEW_API [^;(]*?[\s*&](\w+)\(", re.M)
KIND = re.compile(r"^(?:typeinfo name for|typeinfo for|vtable for|guard variable for|non-virtual thunk to) ")


def marked(folder):
    """Qualified names of the classes and of the functions that headers mark."""
    classes, functions = set(), set()
    for header in sorted(folder.rglob("*.hpp")):
        text = header.read_text(encoding="utf-8")
        spaces = re.findall(r"^namespace ([\w:]+) \{", text, re.M)
        if not spaces:
            continue
        classes |= {f"{spaces[0]}::{name}" for name in CLASS.findall(text)}
        functions |= {f"{spaces[0]}::{name}" for name in FUNCTION.findall(text)}
    return classes, functions


def exported(library):
    """Demangled names of what a library exports, with their versions."""
    lines = subprocess.run(["nm", "-D", "-C", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    for line in lines.splitlines():
        address, kind, name = line.split(" ", 2)
        if kind != "A":  # the name of the version itself
            name, _, version = name.rpartition("@@")
            yield KIND.sub("", name), version


def is_public(name, classes, functions):
    plain = re.split(r"[(\[]", name, maxsplit=1)[0]  # without parameters
    return plain in functions or plain in classes or plain.rpartition("::")[0] in classes


def main():
    classes, functions = marked(pathlib.Path(sys.argv[1]))
    names, found = set(), []
    for library in sys.argv[2:]:
        for name, version in exported(library):
            names.add(name)
            if not version.startswith("SINEW_"):
                found.append(f"{library}: {name} has no version")
            if not is_public(name, classes, functions):
                found.append(f"{library}: {name} is exported, and no public header marks it")
    present = {re.split(r"[(\[]", name, maxsplit=1)[0] for name in names}
    found += [f"{name} is marked and not exported" for name in sorted(functions - present)]
    if len(functions) < 50 or len(classes) < 50:
        found.append(f"only {len(functions)} functions and {len(classes)} classes are marked")
    print("\n".join(found) if found else f"{len(names)} symbols are exported, all of them public")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
