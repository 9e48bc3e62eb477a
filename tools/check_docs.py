#!/usr/bin/env python3
"""Fails if a page names a file, folder, kernel or identifier that does not exist, if a link leads nowhere, if a page breaks a
rule of form (length, width, first words of sentences), or if comments do (first words, citations)."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Pages that explain, with limits of length and width.
PAGES = ["README.md"] + [f"docs/{name}.md" for name in (
    "overview", "step", "features", "contacts", "contact-lists", "self-contact", "contact-rules", "cutting", "skins", "import",
    "embedding", "packages", "c-and-python", "gallery", "viewer", "viewer-inside", "extending", "extending-viewer", "limits", "glossary")]
MOST_LINES, MOST_COLUMNS = 150, 110
# Pages of figures: limits of length and width for all but rows of tables. They name parts of Sinew that are gone, too.
FIGURES = ["docs/performance.md"] + sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs" / "performance").glob("*.md"))
MOST_LINES_OF_PERFORMANCE = 350  # the page of all figures of today, which is mostly tables
# Pages of reference, of any length and width.
REFERENCES = ["CHANGELOG.md"] + [f"docs/{name}.md" for name in ("scene-files", "report", "accuracy", "platforms")]
# The first words that no sentence of a page may have: a sentence names its subject first.
FIRST_WORDS = re.compile(r"(?:^|[.:;!?]\s+|\|\s+)(?:[*]+ ?)?(Of|What|Which|Likewise|Where|Who|As|The same)\b")
SOURCES = ("src", "include", "shaders", "apps", "tools", "tests", "python", "cmake", "scenes", "examples")
SUFFIXES = {".cpp", ".hpp", ".h", ".inc", ".comp", ".glsl", ".vert", ".frag", ".cmake", ".txt", ".toml", ".sh", ".py", ".json"}
FOLDERS = ["", "src/", "include/", "include/sinew/", "apps/viewer/", "docs/", "tests/", "src/mesh/", "tests/sim/collision/", "tests/scenes/",
           "tests/viewer/", "src/sim/", "shaders/glsl/"]
FOLDERS += [f"{folder.relative_to(ROOT).as_posix()}/" for top in ("src/sim", "shaders/glsl") for folder in (ROOT / top).iterdir()
            if folder.is_dir()]
# Rules for comments of these folders: the largest share that may begin with one of these words, and no citation of a document
# by a section, in brackets, that is not in the repository.
COMMENTED = ("src", "include", "shaders", "apps", "tools", "tests", "python", "examples")
MOST_UNCLEAR = 0.02
UNCLEAR_FIRST_WORDS = re.compile(r"(?:Of|What|Who|Whoever|Where|Which|Likewise)\b")
CITATION = re.compile(r"\((?:(?:methods|contacts|cases|lattice|cutting|skins|platform|reliability): |[a-z-]+: (?:[A-Z]\d?|\d[\d.]*)[,;)])")
PAGE = re.compile(r"[\w/-]+\.md\b")
# A comment of C++ or GLSL behind code: strings and characters come first, since they may hold slashes.
COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|(?<!\w)\'(?:\\.|[^\'\\])*\'|//[/!]?<?\s*(.*)')
SCRIPT_COMMENT = re.compile(r"^\s*#(?!!)\s*(.*)")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`]+)`")
PATH = re.compile(r"^[\w.-]+(?:/[\w.-]+)*/?$")
NAME = re.compile(r"[A-Za-z_]\w{3,}")


def isThere(path):
    """Whether a file or folder exists: relative to the root or to one of FOLDERS, with or without .hpp or .cpp."""
    return any((ROOT / (folder + path + ending)).exists() for folder in FOLDERS for ending in ("", ".hpp", ".cpp"))


def words():
    """Every identifier of the sources, and every file name without its ending."""
    found = set()
    files = [path for top in SOURCES for path in (ROOT / top).rglob("*") if path.suffix in SUFFIXES]
    for path in files + [ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json"]:
        if path.name in ("check_docs.py", "figures.py"):  # they name sources like pages do
            continue
        found.update(NAME.findall(path.read_text(encoding="utf-8", errors="replace")))
        found.add(path.stem)
    return found


def sentences(text):
    """Paragraphs, items, rows of tables and headings of a page, without code."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    text = re.sub(r"^(#+ .*)$", r"\1\n", text, flags=re.M)  # a heading is no part of the sentence below it
    text = CODE.sub("code", text)
    for block in re.split(r"\n\s*\n|\n(?=\s*[*|#]|\s*\d+\. )", text):
        yield " ".join(block.split()).lstrip("*# ")


def commentsOf(name, text):
    """Lines and texts of the comments in a source."""
    isScript = name.endswith((".py", ".sh", ".cmake", ".txt"))
    for i, line in enumerate(text.splitlines(), 1):
        matches = [SCRIPT_COMMENT.match(line)] if isScript else COMMENT.finditer(line)
        for comment in (match[1] for match in matches if match):
            if comment:
                yield i, comment


def commentComplaints(sources):
    """Complaints about the comments of `sources`, pairs of a name and a text."""
    count, unclear = 0, []
    for name, text in sources:
        for i, comment in commentsOf(name, text):
            count += 1
            if UNCLEAR_FIRST_WORDS.match(comment):
                unclear.append(f"{name}:{i}: {comment[:60]}")
            if CITATION.search(comment):
                yield f"{name}:{i}: cites a document that is not here: {comment[:60]}"
            for page in PAGE.findall(comment):
                if not isThere(page):
                    yield f"{name}:{i}: cites {page}, which is not there"
    if len(unclear) > MOST_UNCLEAR * count:
        yield (f"comments: {len(unclear)} of {count} begin with Of, What, Who, Whoever, Where, Which or Likewise, at most "
               f"{100 * MOST_UNCLEAR:g} %:\n  " + "\n  ".join(unclear[:20]))


def sources():
    """Names and texts of the sources whose comments are checked."""
    for path in sorted(path for top in COMMENTED for path in (ROOT / top).rglob("*")):
        if path.suffix in SUFFIXES - {".toml", ".json"} and path.is_file():
            yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8", errors="replace")


def sentenceComplaints(name, text):
    """Complaints about the links and the first words of sentences in a page."""
    folder = (ROOT / name).parent
    for target in LINK.findall(text):
        if "://" not in target and not (folder / target).exists():
            yield f"{name}: links to {target}, which is not there"
    for sentence in sentences(text):
        for first in FIRST_WORDS.findall(sentence):
            yield f"{name}: a sentence begins with \"{first}\": {sentence[:60]}"


def sizeComplaints(name, text, mostLines=MOST_LINES, hasWideTables=False):
    """Complaints about the length of a page and the width of its lines, without code."""
    lines = text.splitlines()
    if len(lines) > mostLines:
        yield f"{name}: {len(lines)} lines, at most {mostLines}"
    isCode = False
    for i, line in enumerate(lines, 1):
        isCode ^= line.startswith("```")
        if len(line) > MOST_COLUMNS and not isCode and not (hasWideTables and line.startswith("|")):
            yield f"{name}:{i}: {len(line)} columns, at most {MOST_COLUMNS}"


def complaints(name, text, known):
    """Complaints about the form of a page and the names in it."""
    yield from sizeComplaints(name, text)
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
    found = []
    for page in PAGES + FIGURES + REFERENCES:
        text = (ROOT / page).read_text(encoding="utf-8")
        found += sentenceComplaints(page, text)
        if page in FIGURES:
            found += sizeComplaints(page, text, MOST_LINES_OF_PERFORMANCE if page == FIGURES[0] else MOST_LINES, hasWideTables=True)
        if page in PAGES:
            found += complaints(page, text, known)
    for path in sorted((ROOT / "docs" / "images").glob("*.svg")):
        found += ofFigure(path, known)
    found += commentComplaints(sources())
    print("\n".join(found) if found else f"documents: {len(PAGES + FIGURES + REFERENCES)} pages and the comments keep the rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
