#!/usr/bin/env python3
"""Fails when a page names a file, folder, kernel or identifier that does not exist, when a link leads nowhere, or when a page
leaves the form of the house: length, width, first words of sentences."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Pages that explain: at most so many lines and columns.
PAGES = ["README.md"] + [f"docs/{name}.md" for name in (
    "overview", "step", "features", "contacts", "contact-lists", "self-contact", "contact-rules", "cutting", "skins", "import",
    "embedding", "viewer", "viewer-inside", "extending", "limits", "glossary")]
MOST_LINES, MOST_COLUMNS = 150, 110
# A sentence says its subject first.
FIRST_WORDS = re.compile(r"(?:^|[.:;!?]\s+|\|\s+)(?:[*]+ ?)?(Of|What|Which|Likewise|Where|Who|As|The same)\b")
SOURCES = ("src", "shaders", "apps", "tools", "tests", "cmake", "scenes")
SUFFIXES = {".cpp", ".hpp", ".h", ".inc", ".comp", ".glsl", ".vert", ".frag", ".cmake", ".txt", ".toml", ".sh", ".py", ".json"}
FOLDERS = ("", "src/", "src/sim/", "apps/viewer/", "shaders/glsl/", "docs/", "tests/", "src/mesh/", "src/sim/solvers/", "src/sim/collision/",
           "tests/sim/collision/", "tests/scenes/", "tests/viewer/")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`]+)`")
PATH = re.compile(r"^[\w.-]+(?:/[\w.-]+)*/?$")
NAME = re.compile(r"[A-Za-z_]\w{3,}")


def isThere(path):
    """A file or folder of that name, from the root or from a folder that pages leave out; .hpp and .cpp may be left out."""
    return any((ROOT / (folder + path + ending)).exists() for folder in FOLDERS for ending in ("", ".hpp", ".cpp"))


def words():
    """Every identifier of the sources, and the stems of their files."""
    found = set()
    files = [path for top in SOURCES for path in (ROOT / top).rglob("*") if path.suffix in SUFFIXES]
    for path in files + [ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json"]:
        if path.name in ("check_docs.py", "figures.py"):  # they speak of the sources as pages do
            continue
        found.update(NAME.findall(path.read_text(encoding="utf-8", errors="replace")))
        found.add(path.stem)
    return found


def sentences(text):
    """Text without blocks of code and without code in a line, a paragraph, item or row of a table at a time."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    text = CODE.sub("code", text)
    for block in re.split(r"\n\s*\n|\n(?=\s*[*|#]|\s*\d+\. )", text):
        yield " ".join(block.split()).lstrip("*# ")


def complaints(name, known):
    text = (ROOT / name).read_text(encoding="utf-8")
    folder = (ROOT / name).parent
    lines = text.splitlines()
    if len(lines) > MOST_LINES:
        yield f"{name}: {len(lines)} lines, at most {MOST_LINES}"
    isCode = False
    for i, line in enumerate(lines, 1):
        isCode ^= line.startswith("```")
        if len(line) > MOST_COLUMNS and not isCode:
            yield f"{name}:{i}: {len(line)} columns, at most {MOST_COLUMNS}"
    for target in LINK.findall(text):
        if "://" not in target and not (folder / target).exists():
            yield f"{name}: links to {target}, which is not there"
    for sentence in sentences(text):
        for first in FIRST_WORDS.findall(sentence):
            yield f"{name}: a sentence begins with \"{first}\": {sentence[:60]}"
    prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for code in CODE.findall(prose):
        if "/" in code and PATH.match(code) and not code.startswith(("out/", "build/")):
            if not isThere(code):
                yield f"{name}: `{code}` is not there"
        elif re.match(r"^[\w-]+\.(cpp|hpp|h|glsl|comp|vert|frag|py|sh|md|toml|inc)$", code):
            if not isThere(code):
                yield f"{name}: `{code}` is not there"
        else:
            for word in NAME.findall(code):
                if word not in known:
                    yield f"{name}: `{code}`: nothing is called {word}"


def ofFigure(path, known):
    for text in re.findall(r"<text[^>]*>([^<]*)</text>", path.read_text(encoding="utf-8")):
        for word in re.findall(r"\w+_\w+", text):
            if word not in known:
                yield f"docs/images/{path.name}: nothing is called {word}"


def main():
    known = words()
    found = [complaint for page in PAGES for complaint in complaints(page, known)]
    for path in sorted((ROOT / "docs" / "images").glob("*.svg")):
        found += ofFigure(path, known)
    print("\n".join(found) if found else f"documents: {len(PAGES)} pages, all that they name is there")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
