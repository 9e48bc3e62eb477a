// The host side of patches: which sheets have them, and which faces are whose.
#include "sim/collision/sheet_patches.hpp"

#include "kernels.hpp"
#include "sim/collision/vectors.hpp"
#include "sim/lattice/placement.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace sinew::sim::collision::sheet_patches {

namespace {

namespace k = kernels;

constexpr std::uint32_t squares = PATCH_SQUARES, region = PATCH_REGION;

struct Node {
    std::uint32_t x, y;
};

std::optional<Node> nodeAt(const Sheet& sheet, std::uint32_t slot) {
    const std::uint32_t place = slot - sheet.first, x = place % sheet.stride, y = place / sheet.stride;
    if (slot < sheet.first || x >= sheet.nodesX || y >= sheet.nodesY) return std::nullopt;
    return Node{x, y};
}

// Whether slots and places at rest of all nodes follow from those of the first, and edges of squares are as
// long as `spacing`.
bool isRegular(const Scene& scene, const Grid& grid, const StateLayout& layout, const Sheet& sheet) {
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return toVector(scene.particles[grid.firstParticle + x + sheet.nodesX * y].position);
    };
    const Vector first = at(0, 0), right = minus(at(1, 0), first), down = minus(at(0, 1), first);
    const double spacing = sheet.spacing, fine = 1e-4 * spacing;
    if (std::abs(std::sqrt(dot(right, right)) - spacing) > fine ||
        std::abs(std::sqrt(dot(down, down)) - spacing) > fine || std::abs(dot(right, down)) > fine * spacing)
        return false;
    for (std::uint32_t y = 0; y < sheet.nodesY; ++y)
        for (std::uint32_t x = 0; x < sheet.nodesX; ++x) {
            Vector off = minus(at(x, y), first);
            for (std::size_t axis = 0; axis < 3; ++axis) off[axis] -= x * right[axis] + y * down[axis];
            if (dot(off, off) > fine * fine) return false;
            if (layout.slot[grid.firstParticle + x + sheet.nodesX * y] != sheet.first + x + sheet.stride * y)
                return false;
        }
    return true;
}

// The shortest distance, in spacings, of a node and a triangle of a flat sheet that is at least `least`.
double nearestFrom(double least) {
    const std::array<Vector, 3> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    double nearest = 1e30;
    for (int x = -4; x <= 4; ++x)
        for (int y = -4; y <= 4; ++y) {
            const Vector p{double(x), double(y), 0};
            const double distance = std::sqrt(std::min({squaredToSegment(p, corners[0], corners[1]),
                                                        squaredToSegment(p, corners[1], corners[2]),
                                                        squaredToSegment(p, corners[2], corners[0])}));
            if (distance >= least) nearest = std::min(nearest, distance);
        }
    return nearest;
}

// Whether a face with a corner in a sheet is half of one of its squares: then it is in one triangle of the
// grid.
bool isHalfOfASquare(const Sheet& sheet, const layout::ContactFace& face) {
    Node low{~0u, ~0u}, high{0, 0};
    for (const std::uint32_t corner : {face.a, face.b, face.c}) {
        const std::optional<Node> node = nodeAt(sheet, corner);
        if (!node) return false;
        low = {std::min(low.x, node->x), std::min(low.y, node->y)};
        high = {std::max(high.x, node->x), std::max(high.y, node->y)};
    }
    return high.x - low.x == 1 && high.y - low.y == 1;
}

// The thickness of the faces of a sheet; nothing if they differ, or if one is no half of a square.
std::optional<float> thicknessOf(const Sheet& sheet, std::span<const layout::ContactFace> faces) {
    std::optional<float> thickness;
    for (const layout::ContactFace& face : faces) {
        if (!nodeAt(sheet, face.a) && !nodeAt(sheet, face.b) && !nodeAt(sheet, face.c)) continue;
        if (!isHalfOfASquare(sheet, face)) return std::nullopt;
        if (thickness && *thickness != std::abs(face.thickness)) return std::nullopt;
        thickness = std::abs(face.thickness);
    }
    return thickness;
}

bool haveOneRadius(const Sheet& sheet, std::span<const float> radii) {
    for (std::uint32_t y = 0; y < sheet.nodesY; ++y)
        for (std::uint32_t x = 0; x < sheet.nodesX; ++x)
            if (radii[sheet.first + x + sheet.stride * y] != radii[sheet.first]) return false;
    return radii[sheet.first] >= 0;
}

constexpr float mostReach = 1.5f; // in spacings: beyond it shapes say too little

std::optional<Sheet> sheetOf(const Scene& scene, const Grid& grid, const StateLayout& layout,
                             std::span<const float> radii, std::span<const layout::ContactFace> faces) {
    const std::uint32_t nodesX = grid.nodes[0], nodesY = grid.nodes[2];
    if (!lattice::isSheet(grid) || std::min(nodesX, nodesY) < region) return std::nullopt;
    if (grid.node.size() != std::size_t{nodesX} * nodesY) return std::nullopt;
    const std::uint32_t first = layout.slot[grid.firstParticle];
    Sheet sheet{.first = first,
                .stride = layout.slot[grid.firstParticle + nodesX] - first,
                .nodesX = nodesX,
                .nodesY = nodesY,
                .spacing = grid.restLength[0]};
    if (sheet.stride < nodesX || !isRegular(scene, grid, layout, sheet) || !haveOneRadius(sheet, radii))
        return std::nullopt;
    const std::optional<float> thickness = thicknessOf(sheet, faces);
    if (!thickness) return std::nullopt;
    sheet.thickness = *thickness;
    sheet.reach = *thickness + radii[first];
    if (!(sheet.reach > 0 && sheet.reach < mostReach * sheet.spacing)) return std::nullopt;
    constexpr double excluded = 1.05 * (1 - 1e-4); // pairs nearer than that never touch (excluded_faces.cpp)
    sheet.nearest =
        static_cast<float>(nearestFrom(excluded * sheet.reach / sheet.spacing) * double{sheet.spacing});
    return sheet;
}

// The nodes of a pair of faces, from the first to the last.
struct Extent {
    Node low{~0u, ~0u}, high{0, 0};
};

std::optional<Extent> extentOf(const Sheet& sheet, const FacePair& pair,
                               std::span<const layout::ContactFace> faces) {
    Extent extent;
    for (const std::uint32_t f : pair) {
        if (f >= faces.size()) continue;
        for (const std::uint32_t corner : {faces[f].a, faces[f].b, faces[f].c}) {
            const std::optional<Node> node = nodeAt(sheet, corner);
            if (!node) return std::nullopt;
            extent.low = {std::min(extent.low.x, node->x), std::min(extent.low.y, node->y)};
            extent.high = {std::max(extent.high.x, node->x), std::max(extent.high.y, node->y)};
        }
    }
    return extent;
}

// The patch of a pair: sheet, row and column; nothing if the pair is in more than one.
struct Place {
    std::size_t sheet = 0;
    std::uint32_t row = 0, column = 0;
    auto operator<=>(const Place&) const = default;
};

std::optional<Place> placeOf(std::span<const Sheet> sheets, const FacePair& pair,
                             std::span<const layout::ContactFace> faces) {
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        const std::optional<Extent> extent = extentOf(sheets[s], pair, faces);
        if (!extent) continue;
        const Place place{s, extent->low.y / squares, extent->low.x / squares};
        if (extent->high.x > squares * (place.column + 1) || extent->high.y > squares * (place.row + 1))
            return std::nullopt;
        return place;
    }
    return std::nullopt;
}

layout::SheetPatch patchOf(const Sheet& sheet, const Place& place) {
    const std::uint32_t x = squares * place.column, y = squares * place.row;
    const auto regionFrom = [](std::uint32_t first, std::uint32_t nodes) {
        return std::min(first - std::min(first, 1u), nodes - region);
    };
    const std::uint32_t regionX = regionFrom(x, sheet.nodesX), regionY = regionFrom(y, sheet.nodesY);
    const std::uint32_t nodesX = std::min(squares + 1, sheet.nodesX - x),
                        nodesY = std::min(squares + 1, sheet.nodesY - y);
    return {.first = sheet.first + regionX + sheet.stride * regionY,
            .stride = sheet.stride,
            .nodes = (x - regionX) | (y - regionY) << 8 | nodesX << 16 | nodesY << 24,
            .pairs = 0,
            .pairCount = 0,
            .spacing = sheet.spacing,
            .reach = sheet.reach,
            .nearest = sheet.nearest};
}

} // namespace

std::vector<Sheet> sheetsOf(const Scene& scene, const StateLayout& layout, std::span<const float> radii,
                            std::span<const layout::ContactFace> faces) {
    std::vector<Sheet> sheets;
    for (const Grid& grid : scene.grids)
        if (const std::optional<Sheet> sheet = sheetOf(scene, grid, layout, radii, faces))
            sheets.push_back(*sheet);
    return sheets;
}

std::vector<layout::SheetPatch> sortIntoPatches(std::vector<FacePair>& pairs, std::span<const Sheet> sheets,
                                                std::span<const layout::ContactFace> faces) {
    std::vector<FacePair> sorted;
    std::map<Place, std::vector<FacePair>> ofPatches;
    for (const FacePair& pair : pairs)
        if (const std::optional<Place> place = placeOf(sheets, pair, faces))
            ofPatches[*place].push_back(pair);
        else
            sorted.push_back(pair);
    std::vector<layout::SheetPatch> patches;
    for (const auto& [place, own] : ofPatches) {
        layout::SheetPatch patch = patchOf(sheets[place.sheet], place);
        patch.pairs = static_cast<std::uint32_t>(sorted.size());
        patch.pairCount = static_cast<std::uint32_t>(own.size());
        sorted.insert(sorted.end(), own.begin(), own.end());
        patches.push_back(patch);
    }
    pairs = std::move(sorted);
    return patches;
}

Patches add(ProgramBuilder& program, std::span<const layout::SheetPatch> patches, float thickness,
            bool isShared) {
    if (patches.empty()) return {};
    return {.count = static_cast<std::uint32_t>(patches.size()),
            .parts = isShared ? region - 1 : 1,
            .thickness = thickness,
            .table = program.upload("faces.patches", patches),
            .alone = program.scratch<std::uint32_t>("faces.patches.alone", patches.size())};
}

void addCheck(ProgramBuilder& program, const Patches& patches, const hash_grid::Grid& grid,
              const hash_grid::Moved& moved) {
    if (patches.count == 0) return;
    constexpr std::uint32_t partsId = 1; // constant_id in check_patches.comp
    program.dispatch(
        k::checkPatches, patches.parts * patches.count,
        {moved.positions, moved.velocities, moved.step, patches.table, patches.alone, grid.bounds}, grid.push,
        {{partsId, patches.parts}});
}

void addSearch(ProgramBuilder& program, const Patches& patches, const hash_grid::Grid& grid,
               const hash_grid::Moved& moved, const Searching& searching) {
    if (patches.count == 0) return;
    const layout::FaceFindPush& push = searching.push;
    program.dispatchIndirect(k::searchPatches, grid.patches,
                             {moved.positions, moved.velocities, searching.radii, grid.headings, grid.sorted,
                              grid.starts, moved.step, grid.bounds, patches.table, patches.alone,
                              searching.points, grid.searching.arguments},
                             layout::SearchPatchesPush{.points = push.points,
                                                       .patches = patches.count,
                                                       .cells = push.cells,
                                                       .loose = push.loose,
                                                       .thickness = patches.thickness,
                                                       .margin = push.margin});
}

} // namespace sinew::sim::collision::sheet_patches
