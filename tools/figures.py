#!/usr/bin/env python3
"""Draws the figures of the documentation: docs/images/*.svg.

  tools/figures.py            writes the files
  tools/figures.py --check    fails if a committed file differs from the output of this script
"""
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs" / "images"
WIDTH = 800  # of every figure [px]; text has at least 12 px

INK, LINE, PAPER, QUIET = "#1f2933", "#52606d", "#ffffff", "#4a5763"
BLUE, GREEN, YELLOW, RED, GREY, VIOLET = "#d9e8f7", "#dcf0df", "#fbeec7", "#f8d9d6", "#eceff2", "#e8e0f5"
CUT = "#c0392b"


def number(value):
    return f"{value:.2f}".rstrip("0").rstrip(".")


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


class Figure:
    """A list of SVG elements on a background of its own, readable on light and dark pages."""

    def __init__(self, height, title):
        self.height, self.title, self.parts = height, title, []

    def add(self, element):
        self.parts.append(element)

    def text(self, x, y, text, size=13, anchor="middle", color=INK, weight="normal", mono=False):
        family = "DejaVu Sans Mono, Consolas, monospace" if mono else "DejaVu Sans, Verdana, sans-serif"
        self.add(f'<text x="{number(x)}" y="{number(y)}" font-size="{size}" text-anchor="{anchor}" fill="{color}" '
                 f'font-weight="{weight}" font-family="{family}">{escape(text)}</text>')

    def lines(self, x, y, lines, size=13, anchor="middle", color=INK, mono=False):
        """Lines of text centred at the height y; a line that begins with * is bold."""
        step = size * 1.3
        top = y - step * (len(lines) - 1) / 2 + size * 0.36
        for i, line in enumerate(lines):
            isBold = line.startswith("*")
            self.text(x, top + i * step, line.lstrip("*"), size, anchor, color, "bold" if isBold else "normal",
                      mono and not isBold)

    def rectangle(self, x, y, w, h, fill=PAPER, stroke=LINE, dash="", radius=5, width=1.2):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<rect x="{number(x)}" y="{number(y)}" width="{number(w)}" height="{number(h)}" rx="{radius}" '
                 f'fill="{fill}" stroke="{stroke}" stroke-width="{number(width)}"{dashed}/>')

    def box(self, x, y, w, h, lines, fill=PAPER, size=13, dash="", mono=False):
        self.rectangle(x, y, w, h, fill, dash=dash)
        self.lines(x + w / 2, y + h / 2, lines, size, mono=mono)

    def line(self, points, color=LINE, width=1.4, arrow=False, dash=""):
        path = "M" + " L".join(f"{number(x)},{number(y)}" for x, y in points)
        head = f' marker-end="url(#{"cut" if color == CUT else "head"})"' if arrow else ""
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<path d="{path}" fill="none" stroke="{color}" stroke-width="{number(width)}"{head}{dashed}/>')

    def arrow(self, *points, color=LINE, dash=""):
        self.line(points, color, arrow=True, dash=dash)

    def polygon(self, points, fill, stroke="none", opacity=1.0):
        path = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        self.add(f'<polygon points="{path}" fill="{fill}" stroke="{stroke}" fill-opacity="{number(opacity)}"/>')

    def dot(self, x, y, r, fill):
        self.add(f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(r)}" fill="{fill}"/>')

    def svg(self):
        heads = "".join(
            f'<marker id="{name}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
            f'orient="auto"><path d="M0,0.5 L8,4 L0,7.5 z" fill="{color}"/></marker>\n'
            for name, color in (("head", LINE), ("cut", CUT)))
        paper = (f'<rect x="0.5" y="0.5" width="{WIDTH - 1}" height="{self.height - 1}" rx="8" fill="{PAPER}" '
                 f'stroke="#c3ccd5"/>')
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" width="{WIDTH}" '
                f'height="{self.height}" role="img">\n<title>{escape(self.title)}</title>\n<defs>{heads}</defs>\n'
                f'{paper}\n' + "\n".join(self.parts) + "\n</svg>\n")


def layers():
    """Folders and the allowed includes between them (tools/check_layers.py)."""
    f = Figure(532, "Folders of the repository, each may include those below it")
    f.text(24, 28, "programs", 12, "start", QUIET)
    f.box(24, 36, 240, 62, ["*apps/viewer", "window, tools, layers, renderer"], YELLOW)
    f.box(280, 36, 240, 62, ["*tools/sinew", "run, describe, mesh, bench, study"], YELLOW)
    f.box(536, 36, 240, 62, ["*tests", "mirrors src; cases, hard cases"], YELLOW)
    f.text(24, 132, "between programs and core", 12, "start", QUIET)
    f.box(24, 140, 364, 62, ["*src/scenes", "scene files (TOML) become Scene and Settings"], GREEN)
    f.box(412, 140, 364, 62, ["*src/app", "exit codes, signals, progress, take-over"], GREEN)
    f.box(24, 234, 752, 62, ["*src/mesh", "import, repair, voxels, skins, export; only mesh/gpu sees Vulkan"], GREEN)
    f.text(24, 330, "core: all that an engine embeds", 12, "start", QUIET)
    f.box(24, 338, 364, 76, ["*src/sim", "scene, compile, step program, solvers,", "contacts, cutting, skins, façade"], BLUE)
    f.box(412, 338, 364, 76, ["*shaders/glsl", "SPIR-V embedded in sim, mesh/gpu, viewer;", "layout.h is shared between C++ and GLSL"], VIOLET)
    f.box(24, 446, 752, 62, ["*src/vk", "device, memory, kernels read from SPIR-V, commands, barriers; no physics"], BLUE)
    for x, y in ((230, 138), (400, 232), (656, 138)):
        f.arrow((x, 98), (x, y))
    for x in (206, 594):
        f.arrow((x, 202), (x, 232))
    f.arrow((300, 296), (300, 336))
    f.arrow((206, 414), (206, 444))
    f.arrow((412, 376), (390, 376))
    f.text(776, 525, "An arrow: may include. tools/check_layers.py holds them.", 12, "end", QUIET)
    return f


def step():
    """Phases of a step, the loop of substeps, and the buffers between them."""
    f = Figure(690, "One step: phases, substeps and buffers")
    f.text(24, 30, "host", 12, "start", QUIET)
    f.box(24, 38, 230, 48, ["*Simulation::record", "dt, gravity, blade, grabs ..."], YELLOW)
    f.box(24, 112, 230, 48, ["*begin", "step parameters, status = 0"], BLUE)
    f.box(24, 186, 230, 66, ["*cut", "only with a blade, or where", "something may tear"], RED, dash="5 3")
    f.rectangle(24, 280, 452, 250, GREY)
    f.text(36, 300, "solve: one turn a substep (solver split)", 13, "start", weight="bold")
    f.box(40, 312, 200, 50, ["*links, then driven particles", "gather_lattice, gather_split"], BLUE, 12)
    f.box(40, 384, 200, 50, ["*contacts", "faces, edges, pairs"], BLUE, 12)
    f.box(40, 456, 200, 50, ["*planes", "in the kernel before, exact"], BLUE, 12)
    f.box(262, 456, 200, 50, ["*attachments, grabs, tethers", "projections after contacts"], BLUE, 12)
    f.box(262, 384, 200, 50, ["*stops, colliders", "exact; end the substep"], BLUE, 12)
    f.arrow((140, 362), (140, 382))
    f.arrow((140, 434), (140, 454))
    f.arrow((240, 481), (260, 481))
    f.arrow((362, 456), (362, 436))
    f.line([(362, 384), (362, 337), (240, 337)], arrow=True)
    f.text(372, 352, "next substep", 12, "start", QUIET)
    f.box(24, 556, 230, 66, ["*publish", "check finite; copy, or undo;", "pieces, surface of cuts"], BLUE)
    f.box(290, 556, 186, 66, ["*skin (when drawn)", "vertices and normals", "from public positions"], GREEN, 12)
    f.text(36, 656, "All passes of a step are one list. The host records it without a wait; barriers are planned from", 12,
           "start", QUIET)
    f.text(36, 673, "what each kernel reads and writes. Dashed: recorded only when needed.", 12, "start", QUIET)
    for a, b in ((86, 110), (160, 184), (252, 278), (530, 554)):
        f.arrow((139, a), (139, b))
    x, w = 540, 236
    f.text(x, 30, "buffers", 12, "start", QUIET)
    rows = [(38, 48, ["*host data of the step", "parameters, targets, blade"]),
            (112, 48, ["*step, status", "one element each"]),
            (186, 66, ["*link masks", "a bit a link, cleared by", "integer atomics; links read it"]),
            (312, 66, ["*state.positions, next_positions", "alternate; end in the first", "state.velocities"]),
            (396, 50, ["*links, cells, chunks", "constant in a step"]),
            (464, 50, ["*contact lists, memory", "made again when incomplete"]),
            (556, 30, ["*positions, velocities (public)"]),
            (594, 30, ["*skin vertices, indices"])]
    for y, h, lines in rows:
        f.box(x, y, w, h, lines, PAPER, 12)
    f.arrow((254, 62), (538, 62))
    f.arrow((254, 136), (538, 136))
    f.arrow((254, 219), (538, 219))
    f.line([(580, 252), (580, 268), (440, 268), (440, 279)], arrow=True)
    f.line([(538, 345), (478, 345)], arrow=True)
    f.line([(476, 362), (536, 362)], arrow=True)
    f.arrow((538, 421), (478, 421))
    f.arrow((478, 489), (538, 489))
    f.line([(254, 566), (270, 566), (270, 546), (510, 546), (510, 568), (538, 568)], arrow=True)
    f.line([(538, 577), (478, 577)], arrow=True)
    f.arrow((476, 609), (538, 609))
    return f


def contacts():
    """The passes of contacts in one substep (docs/contacts.md, "One substep")."""
    f = Figure(674, "Contacts in one substep")
    f.box(24, 24, 752, 40, ["*links of the substep: predicted positions and velocities"], GREY)
    columns = [(120, 116, "*watch"), (252, 92, "*plan"), (360, 156, "*lists"), (532, 244, "*solve")]
    heads = ["did a particle stray?", "how many groups", "only if incomplete", "only groups with candidates"]
    for (x, w, name), head in zip(columns, heads):
        f.lines(x + w / 2, 98, [name, head], 12)
    rows = [("faces", "point", "triangle", 120, ["check_surface_lists"], "touch, share, press, gather"),
            ("edges", "edge", "edge", 240, ["check_surface_lists"], "touch, share, press, gather"),
            ("pairs", "particle", "particle", 360, ["finish_without_contacts", "or check_pair_lists"], "count_contacts, gather_contacts")]
    solving = {"faces": ["which, on which side", "parts of a particle sum to 1", "impulses and friction",
                         "each end sums its own, in order"],
               "edges": ["which, on which side", "parts of an end sum to 1", "impulses and friction",
                         "each end sums its own, in order"],
               "pairs": ["how many touch a particle", "its mass over that number", "impulses, friction, planes",
                         "the substep of a particle ends"]}
    for name, a, b, y, watch, solve in rows:
        f.rectangle(24, y, 752, 106, PAPER, "#c3ccd5")
        f.lines(70, y + 53, ["*" + name, a, "and", b], 12)
        f.box(104, y + 18, 150, 70, watch, BLUE, 10, mono=True)
        f.box(270, y + 18, 74, 70, ["plan_grid"], BLUE, 10, mono=True)
        f.box(360, y + 8, 156, 90, ["bounds, cells", "search of the grid", "sort; carry memory"], GREEN, 12, "5 3")
        f.rectangle(532, y + 8, 232, 90, BLUE)
        f.text(648, y + 26, solve, 12, weight="bold")
        f.lines(648, y + 63, solving[name], 12)
        f.arrow((254, y + 53), (268, y + 53))
        f.arrow((344, y + 53), (358, y + 53))
        f.arrow((516, y + 53), (530, y + 53))
    for a, b in ((64, 82), (226, 238), (346, 358), (466, 486)):
        f.arrow((400, a), (400, b))
    tail = [(24, 148, ["*bounces", "where something", "rebounds"], "5 3"),
            (196, 172, ["*attachments,", "*grabs, tethers"], "5 3"),
            (392, 172, ["*separations,", "*stop_at_faces,", "*impact zones"], "5 3"),
            (588, 188, ["*rigid colliders", "exact, one after another"], "5 3")]
    for x, w, lines, dash in tail:
        f.box(x, 488, w, 66, lines, GREY, 12, dash)
    for x in (172, 368, 564):
        f.arrow((x, 521), (x + 22, 521))
    f.box(24, 576, 752, 40, ["*state after the substep: positions, velocities, memory of contacts"], GREY)
    f.arrow((682, 554), (682, 574))
    f.text(24, 641, "Faces and edges change predicted positions where they stand. Pairs end the substep; without pairs "
           "finish_after_surfaces does.", 12, "start", QUIET)
    f.text(24, 658, "Dashed passes have no work groups, or are not in the program, where they are not needed.", 12,
           "start", QUIET)
    return f


# A small lattice in the plane and a blade that passes between its nodes.
COLUMNS, ROWS, CELL = 5, 4, 34
BLADE = [(2.28, -0.62), (2.52, 3.62)]  # in cells


def isCut(a, b):
    (x0, y0), (x1, y1) = BLADE

    def side(p):
        return (x1 - x0) * (p[1] - y0) - (y1 - y0) * (p[0] - x0) > 0

    return side(a) != side(b)


def linksOfLattice():
    for y in range(ROWS):
        for x in range(COLUMNS):
            for dx, dy in ((1, 0), (0, 1), (1, 1), (-1, 1)):
                if 0 <= x + dx < COLUMNS and y + dy < ROWS:
                    yield (x, y), (x + dx, y + dy)


def cutting():
    """From the blade of a step to the drawn skin."""
    f = Figure(458, "A cut: blade, links, pieces, skin")
    names = [("1 blade", "the edge sweeps a strip of quads"), ("2 links", "bits of links that it meets are cleared"),
             ("3 pieces", "components by live links"), ("4 skin", "clipped, with an inner surface")]
    places = [(62, 84), (462, 84), (62, 292), (462, 292)]
    for (left, top), (name, what), panel in zip(places, names, range(4)):
        f.rectangle(left - 38, top - 60, 352, 184, PAPER, "#c3ccd5")
        f.text(left - 26, top - 40, name, 14, "start", weight="bold")
        f.text(left - 14 + 9 * len(name), top - 40, what, 12, "start", QUIET)
        gap = 13 if panel == 3 else 0

        def at(p):
            isRight = not isCut((COLUMNS, p[1]), p)
            return left + p[0] * CELL + (gap if isRight else -gap), top + p[1] * CELL

        if panel == 3:
            for isRight in (False, True):
                nodes = [(x, y) for y in range(ROWS) for x in range(COLUMNS)
                         if (not isCut((COLUMNS, y), (x, y))) == isRight]
                edge = 0.28 * CELL
                outer = COLUMNS - 1 if isRight else 0
                sign = 1 if isRight else -1
                far = [(at((outer, y))[0] + sign * edge, at((outer, y))[1]) for y in (0, ROWS - 1)]
                (x0, y0), (x1, y1) = BLADE
                near = []
                for y in (0, ROWS - 1):
                    t = (y - y0) / (y1 - y0)
                    near.append((left + (x0 + t * (x1 - x0)) * CELL + sign * gap, top + y * CELL))
                outline = [(far[0][0], far[0][1] - edge), (near[0][0], near[0][1] - edge),
                           (near[1][0], near[1][1] + edge), (far[1][0], far[1][1] + edge)]
                f.polygon(outline, GREEN if isRight else BLUE)
                f.line([outline[1], outline[0], outline[3], outline[2]], LINE, 2)
                f.line([outline[1], outline[2]], CUT, 2.4)
        for a, b in linksOfLattice():
            dead = isCut(a, b)
            if panel == 3 or (dead and panel == 2):
                continue
            if dead and panel == 1:
                f.line([at(a), at(b)], CUT, 1.2, dash="3 3")
            else:
                f.line([at(a), at(b)], "#9aa5b1" if panel < 2 else LINE, 1.2)
        for y in range(ROWS):
            for x in range(COLUMNS):
                isRight = not isCut((COLUMNS, y), (x, y))
                color = INK if panel < 2 else ("#2d7a3a" if isRight else "#2b6cb0")
                f.dot(*at((x, y)), 4 if panel != 3 else 2.6, color)
        (x0, y0), (x1, y1) = BLADE
        if panel < 2:
            f.line([(left + x0 * CELL, top + y0 * CELL), (left + x1 * CELL, top + y1 * CELL)], CUT, 2.4)
    notes = [["Step::blade: two", "poly-lines [m]", "", "find_near_links:", "nodes near it", "", "blade_hit.glsl:", "exact signs"],
             ["cut_links: both", "ends, by integer", "atomics", "", "remove_loose_links:", "links that hold", "nothing die too"],
             ["union_pieces and", "shorten_pieces, until", "no label changes", "", "contacts, sleep,", "grabs and tethers", "follow"],
             ["marching tetra-", "hedra on dead", "links: inside", "", "pieces of the", "skin beside it;", "snap_rims_to_blade", "pulls the rims"]]
    for (left, top), lines in zip(places, notes):
        f.lines(left + 174, top + 50, lines, 12, "start", QUIET)
    for a, b in (((376, 116), (422, 116)), ((376, 324), (422, 324))):
        f.arrow(a, b)
    f.line([(600, 208), (600, 219), (200, 219), (200, 230)], arrow=True)
    f.text(24, 440, "Particles stay whole: a cut clears bits and splits what is drawn. A step that is undone puts the "
           "bits back.", 12, "start", QUIET)
    return f


def curves(f, left, title, xAxis, yAxis, lines, isLog=False, names=(10, 78)):
    """A plot 300 px wide. An axis is (label, values of its ticks); a line is (color, name, points). The names stand below
    each other from `names` on."""
    (xName, xTicks), (yName, yTicks) = xAxis, yAxis
    bottom, w, h = 250, 300, 190
    yScale = math.log10 if isLog else float
    low, high = yScale(yTicks[0]), yScale(yTicks[-1])

    def at(x, y):
        return (left + w * (x - xTicks[0]) / (xTicks[-1] - xTicks[0]), bottom - h * (yScale(y) - low) / (high - low))

    f.text(left, 28, title, 13, "start", weight="bold")
    f.text(left, 48, yName, 12, "start", QUIET)
    for x in xTicks:
        f.text(at(x, yTicks[0])[0], bottom + 18, number(x), 12, color=QUIET)
    f.text(left + w, bottom + 36, xName, 12, "end", QUIET)
    for y in yTicks:
        f.line([(left, at(xTicks[0], y)[1]), (left + w, at(xTicks[0], y)[1])], "#c3ccd5", 1)
        f.text(left - 6, at(xTicks[0], y)[1] + 4, f"{y:g}", 12, "end", QUIET)
    for row, (color, name, points) in enumerate(lines):
        f.line([at(x, min(max(y, yTicks[0]), yTicks[-1])) for x, y in points], color, 1.8)
        f.text(left + names[0], names[1] + 16 * row, name, 12, "start", color)


def knot():
    """A rope in a knot that is pulled on until its strands no longer keep apart (docs/accuracy.md)."""
    f = Figure(300, "A rope of voxels in an overhand knot, pulled at both ends")
    stretch = [1.036, 1.061, 1.138, 1.267, 1.381, 1.509, 1.645, 1.785, 1.936, 2.076]
    tension = [51, 96, 195, 400, 546, 774, 978, 1282, 1609, 1864]
    edges = {24: [0, 0, 0, 0, 0, 4, 33, 51, 63, 116], 32: [0, 0, 0, 0, 0, 10, 16, 59, 60, 98],
             48: [0, 0, 0, 0, 0, 6, 23, 45, 89, 103], 64: [0, 0, 0, 0, 0, 0, 23, 71, 71, 101]}
    xAxis = ("length of the rope / length at rest", [1, 1.4, 1.8, 2.2])
    curves(f, 70, "Tension, 64 substeps", xAxis, ("N", [0, 500, 1000, 1500, 2000]),
           [("#1f5f9e", "", list(zip(stretch, tension)))])
    curves(f, 450, "Edges through faces", xAxis, ("", [0, 40, 80, 120]),
           [(color, f"{substeps} substeps", list(zip(stretch, edges[substeps])))
            for color, substeps in zip(("#c0392b", "#b7791f", "#2f855a", "#1f5f9e"), edges)])
    return f


def tremor():
    """A heap that trembles for ever, and the same with shares that do not jump (docs/accuracy.md)."""
    f = Figure(300, "pile_8000 with two laws of shares")
    creeping = [0.9679, 0.9679, 0.9691, 0.9706, 0.9712, 0.9723, 0.9738, 0.9753, 0.9763, 0.9778, 0.9788, 0.9795,
                0.9799, 0.9809, 0.9817, 0.9819, 0.9823, 0.9829, 0.9832, 0.9835, 0.9838]
    resting = [(10 / 3, 0.9891), (10, 0.9892), (50 / 3, 0.9891), (25, 0.9891), (30, 0.9892), (140 / 3, 0.9892)]
    whole = [6.6e-4, 1.2e-3, 1.4e-3, 1.1e-3, 8.4e-4, 7.8e-4, 6.5e-4, 7.1e-4, 9.2e-4, 8.7e-4, 6.0e-4, 6.0e-4,
             4.9e-4, 4.2e-4, 9.1e-4]
    even = [8.9e-4, 1.3e-4, 4.9e-6, 1.9e-7, 9.8e-8, 9.0e-8, 9.5e-8, 9.2e-8, 7.6e-8, 7.4e-8, 7.6e-8, 6.7e-8, 6.1e-8,
            5.1e-8, 4.8e-8]
    names = ("whole counts of contacts", "a count without jumps")
    colors = ("#c0392b", "#1f5f9e")
    curves(f, 70, "Overlap of touching balls, RMS", ("s", [0, 100, 200, 300, 400]),
           ("mm", [0.965, 0.970, 0.975, 0.980, 0.985, 0.990, 0.995]),
           [(colors[0], names[0], [(max(50 / 3 * n, 10 / 3), y) for n, y in enumerate(creeping)]),
            (colors[1], names[1], resting)], names=(120, 205))
    curves(f, 450, "Kinetic energy from frame 3,000 on", ("s", [50, 52, 54, 56, 58, 60]),
           ("J", [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2]),
           [(color, name, [(50 + (1 + 2 * n) / 3, y) for n, y in enumerate(values)])
            for color, name, values in zip(colors, names, (whole, even))], isLog=True, names=(120, 140))
    return f


FIGURES = {"layers.svg": layers, "step.svg": step, "contacts.svg": contacts, "cutting.svg": cutting,
           "knot.svg": knot, "tremor.svg": tremor}


def main():
    isCheck = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not isCheck:
        print(__doc__, file=sys.stderr)
        return 2
    differing = []
    for name, draw in FIGURES.items():
        text = draw().svg()
        path = FOLDER / name
        if not isCheck:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            differing.append(name)
    for name in differing:
        print(f"docs/images/{name} is not what tools/figures.py draws: run it", file=sys.stderr)
    if isCheck and not differing:
        print(f"figures: {len(FIGURES)} files, all as drawn")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
