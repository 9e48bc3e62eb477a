#!/usr/bin/env python3
"""Draws a picture of each shipped scene without a window, and writes the page that shows them.

  tools/gallery.py            draws docs/images/scenes/*.png and writes docs/gallery.md; takes about ten minutes on two cores
  tools/gallery.py SCENE...   draws those alone, and writes the page
  tools/gallery.py --check    fails if the page differs from what the scene files say, or a picture is missing or superfluous

[gallery] of a scene file says which moment a picture shows, and where on the page it stands. Needs the release build, and
imagemagick to make small files.
"""
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
VIEWER = ROOT / "build" / "release" / "bin" / "sinew-viewer"
PICTURES = ROOT / "docs" / "images" / "scenes"
PAGE = ROOT / "docs" / "gallery.md"
WITHOUT = "drop_mesh"  # has no body of its own
LAST = 1001  # after each place that a scene file may name
SIZE, DRAWN = (480, 270), (960, 540)  # pixels of a picture; it is drawn larger, so that edges are smooth
COLORS = 200
MOST_BYTES = 2_500_000  # all pictures together
OPTIONS = {
    "organ_draped": ["--replay", ROOT / "tools" / "first_minute.input"],  # its incision
    "beam_stiff": ["--show", "strain"],  # its motion is small
    "chain": ["--show", "particles"],  # its links are lines of one pixel
}

HEAD = """# Gallery

`tools/gallery.py` draws these pictures from the scene files, without a window. A scene opens with
`build/release/bin/sinew-viewer scenes/NAME.toml`. Heavy scenes are slower than real time on a CPU.
"""
MORE = """
## More
"""
STUDIES = """
## For studies and tests
`sinew study` measures solvers on these scenes, or tests use them.
"""


def scenes():
    """Names, first sentences and contents of the scene files, those with a place in the list first."""
    found = []
    for file in sorted((ROOT / "scenes").glob("*.toml")):
        if file.stem == WITHOUT:
            continue
        text = file.read_text(encoding="utf-8")
        comment = []
        for line in text.splitlines():
            if not line.startswith("#"):
                break
            comment.append(line.lstrip("# "))
        sentence = " ".join(comment).split(". ")[0].rstrip(".") + "."
        found.append((file.stem, sentence, tomllib.loads(text)))
    return sorted(found, key=lambda one: one[2].get("gallery", {}).get("order", LAST))


def part(name, sentence, scene):
    """The part of the page on one scene."""
    mark = " *(heavy)*" if scene.get("gallery", {}).get("heavy") else ""
    text = "\n".join(textwrap.wrap(f"**[{name}](../scenes/{name}.toml)**{mark}: {sentence}", 110, break_on_hyphens=False))
    return f"\n{text}\n![{name}](images/scenes/{name}.png)\n"


def page(all_scenes):
    group = lambda scene: "study" if scene.get("gallery", {}).get("study") else "first" if "order" in scene.get("gallery", {}) else "more"
    parts = lambda name: "".join(part(*one) for one in all_scenes if group(one[2]) == name)
    return HEAD + parts("first") + MORE + parts("more") + STUDIES + parts("study")


def draw(name, scene):
    """Draws the moment that a scene file names."""
    frame = round(scene.get("gallery", {}).get("time", 0) / scene.get("dt", 1 / 60))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([VIEWER, ROOT / "scenes" / f"{name}.toml", "--headless", "--no-validation", "--out", folder, "--picture-frames",
                        str(frame), "--size", "{}x{}".format(*DRAWN), *OPTIONS.get(name, [])], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["convert", pathlib.Path(folder) / f"frame_{frame:04}.png", "-strip", "-filter", "box", "-resize",
                        "{}x{}".format(*SIZE), "-dither", "FloydSteinberg", "-colors", str(COLORS), "-define",
                        "png:compression-level=9", f"PNG8:{PICTURES / name}.png"], check=True)


def complaints(all_scenes):
    if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != page(all_scenes):
        yield "docs/gallery.md differs from what the scene files say: run tools/gallery.py"
    wanted, present = {name for name, _, _ in all_scenes}, {file.stem for file in PICTURES.glob("*.png")}
    for name in sorted(wanted ^ present):
        yield f"docs/images/scenes/{name}.png is {'missing' if name in wanted else 'the picture of no scene'}"
    size = sum(file.stat().st_size for file in PICTURES.glob("*.png"))
    if size > MOST_BYTES:
        yield f"docs/images/scenes: {size} bytes, at most {MOST_BYTES}"


def main(arguments):
    all_scenes = scenes()
    if arguments == ["--check"]:
        found = list(complaints(all_scenes))
        print("\n".join(found) if found else f"gallery: {len(all_scenes)} pictures")
        return 1 if found else 0
    unknown = set(arguments) - {name for name, _, _ in all_scenes}
    if unknown:
        print(f"error: no such scene: {', '.join(sorted(unknown))}", file=sys.stderr)
        return 2
    PICTURES.mkdir(exist_ok=True)
    for name, _, scene in all_scenes:
        if not arguments or name in arguments:
            print(f"drawing {name}", flush=True)
            draw(name, scene)
    PAGE.write_text(page(all_scenes), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
