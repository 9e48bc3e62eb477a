// Cloth sheets: a grid of particles with an edge link to each neighbour in the row and in the column, two
// diagonal links per cell, and optional links over two spacings. Mass is assembled per cell, a quarter to
// each corner, so that the sheet weighs areaDensity x area exactly.
#include "sinew/bodies.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sinew::sim {
namespace {

void check(const ClothSheet& sheet) {
    if (sheet.size[0] < 2 || sheet.size[1] < 2)
        throw std::invalid_argument("cloth \"" + sheet.name + "\": size must be at least 2 x 2 particles");
    if (!(sheet.spacing > 0) || !(sheet.areaDensity > 0))
        throw std::invalid_argument("cloth \"" + sheet.name + "\": spacing and areaDensity must be positive");
    if (!(sheet.skipStiffness >= 0))
        throw std::invalid_argument("cloth \"" + sheet.name + "\": skipStiffness must not be negative");
    if (!(sheet.thickness >= 0))
        throw std::invalid_argument("cloth \"" + sheet.name + "\": thickness must not be negative");
    if (!(sheet.membraneStiffness >= 0))
        throw std::invalid_argument("cloth \"" + sheet.name + "\": membraneStiffness must not be negative");
    if (!(sheet.radius >= 0 && sheet.radius <= sheet.spacing / 2))
        throw std::invalid_argument("cloth \"" + sheet.name +
                                    "\": radius must be from 0 to half of the spacing");
    if (sheet.radius > 0 && sheet.thickness > 0)
        throw std::invalid_argument("cloth \"" + sheet.name +
                                    "\": has both radius and thickness, must have one of the two");
    const std::uint64_t count = std::uint64_t{sheet.size[0]} * sheet.size[1];
    if (count > std::numeric_limits<std::uint32_t>::max() / 8)
        throw std::length_error("cloth \"" + sheet.name + "\": too many particles");
    for (const std::uint32_t pinned : sheet.pinned)
        if (pinned >= count)
            throw std::invalid_argument("cloth \"" + sheet.name + "\": pinned particle " +
                                        std::to_string(pinned) + " is outside the sheet");
}

// Edges k1 and diagonals k2 of a square net give C11 = k1 + k2, C12 = C66 = k2 [N/m]: isotropic at k1 = 2 k2,
// where the stiffness of a free strip is C11 - C12^2 / C11 = 8/3 k2. (Edges on the rim carry as much as those
// inside: a strip of n cells is stiffer by 3 / (4 n).)
ClothSheet withMembrane(ClothSheet sheet) {
    if (sheet.membraneStiffness == 0) return sheet;
    sheet.stretchCompliance = 4 / (3 * sheet.membraneStiffness);
    sheet.shearCompliance = 8 / (3 * sheet.membraneStiffness);
    return sheet;
}

float at(const ClothSheet& sheet, std::uint32_t column, std::uint32_t row, float Vec3::*axis) {
    return static_cast<float>(double{sheet.origin.*axis} +
                              double{sheet.spacing} * column * sheet.right.*axis +
                              double{sheet.spacing} * row * sheet.down.*axis);
}

/// The number of cells beside a particle along one axis, halved: 1 inside a row, 1/2 at its ends.
double half(std::uint32_t index, std::uint32_t size) {
    return index == 0 || index + 1 == size ? 0.5 : 1.0;
}

void addParticles(Scene& scene, const ClothSheet& sheet) {
    const double cellMass = double{sheet.areaDensity} * sheet.spacing * sheet.spacing;
    for (std::uint32_t row = 0; row < sheet.size[1]; ++row)
        for (std::uint32_t column = 0; column < sheet.size[0]; ++column) {
            const double mass = cellMass * half(column, sheet.size[0]) * half(row, sheet.size[1]);
            scene.particles.push_back(
                {.position = {at(sheet, column, row, &Vec3::x), at(sheet, column, row, &Vec3::y),
                              at(sheet, column, row, &Vec3::z)},
                 .velocity = {},
                 .inverseMass = static_cast<float>(1 / mass),
                 .contactOffset = sheet.thickness / 2,
                 .radius = sheet.thickness > 0 ? sheet.thickness / 2 : sheet.radius});
        }
}

void addLinks(Scene& scene, const ClothSheet& sheet, std::uint32_t first) {
    const float edge = sheet.spacing;
    const float diagonal = static_cast<float>(sheet.spacing * std::sqrt(2.0));
    const auto [columns, rows] = sheet.size;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t here = first + column + columns * row;
            if (column + 1 < columns)
                scene.distances.push_back({here, here + 1, edge, sheet.stretchCompliance});
            if (row + 1 < rows)
                scene.distances.push_back({here, here + columns, edge, sheet.stretchCompliance});
            if (column + 1 < columns && row + 1 < rows) {
                scene.distances.push_back({here, here + columns + 1, diagonal, sheet.shearCompliance});
                scene.distances.push_back({here + 1, here + columns, diagonal, sheet.shearCompliance});
            }
        }
}

void addGrid(Scene& scene, const ClothSheet& sheet, std::uint32_t first, std::size_t firstDistance) {
    constexpr std::uint8_t fullCell = 15;
    const auto [columns, rows] = sheet.size;
    Grid grid{.name = sheet.name,
              .nodes = {columns, 1, rows},
              .firstParticle = first,
              .firstDistance = static_cast<std::uint32_t>(firstDistance),
              .distanceCount = static_cast<std::uint32_t>(scene.distances.size() - firstDistance),
              .fill = std::vector<std::uint8_t>(std::size_t{columns - 1} * (rows - 1), fullCell),
              .compliance = {sheet.stretchCompliance, sheet.shearCompliance, 0},
              .restLength = {sheet.spacing, static_cast<float>(sheet.spacing * std::sqrt(2.0)), 0},
              .isCuttable = sheet.isCuttable,
              .tearStrain = sheet.tearStrain,
              .tearsPerStep = sheet.tearsPerStep,
              .toughness = sheet.toughness};
    for (std::uint32_t node = 0; node < columns * rows; ++node) grid.node.push_back(node);
    scene.grids.push_back(std::move(grid));
}

/// Appends the skip links after all others, so that the other links keep their order.
void addSkipLinks(Scene& scene, const ClothSheet& sheet, std::uint32_t first) {
    if (sheet.skipStiffness == 0) return;
    const float compliance = 1 / sheet.skipStiffness;
    const auto [columns, rows] = sheet.size;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t here = first + column + columns * row;
            if (column + 2 < columns)
                scene.distances.push_back({here, here + 2, 2 * sheet.spacing, compliance});
            if (row + 2 < rows)
                scene.distances.push_back({here, here + 2 * columns, 2 * sheet.spacing, compliance});
        }
}

void addBends(Scene& scene, const ClothSheet& sheet, std::uint32_t first) {
    if (sheet.bendingStiffness == 0) return;
    const float compliance = bendComplianceOfPlate(sheet.bendingStiffness, sheet.spacing);
    const auto [columns, rows] = sheet.size;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t here = first + column + columns * row;
            if (column + 2 < columns) scene.bends.push_back({here, here + 1, here + 2, compliance});
            if (row + 2 < rows) scene.bends.push_back({here, here + columns, here + 2 * columns, compliance});
        }
}

/// Every particle has two skin vertices, one on each side, so that each side has its own normals.
Skin makeSkin(const ClothSheet& sheet, std::uint32_t first) {
    Skin skin{.name = sheet.name, .color = sheet.color};
    const auto [columns, rows] = sheet.size;
    const std::uint32_t count = columns * rows;
    for (std::uint32_t vertex = 0; vertex < 2 * count; ++vertex)
        skin.particles.push_back(first + vertex % count);
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = column + columns * row, b = a + 1, c = a + columns, d = c + 1;
            skin.triangles.push_back({a, c, d});
            skin.triangles.push_back({a, d, b});
            skin.triangles.push_back({count + a, count + d, count + c});
            skin.triangles.push_back({count + a, count + b, count + d});
        }
    return skin;
}

void addFaces(Scene& scene, const ClothSheet& sheet, std::uint32_t first) {
    if (sheet.thickness == 0) return;
    const auto [columns, rows] = sheet.size;
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + column + columns * row, b = a + 1, c = a + columns, d = c + 1;
            scene.faces.push_back({{a, c, d}, sheet.thickness / 2});
            scene.faces.push_back({{a, d, b}, sheet.thickness / 2});
        }
}

} // namespace

std::uint32_t addCloth(Scene& scene, const ClothSheet& asked) {
    check(asked);
    const ClothSheet sheet = withMembrane(asked);
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    addParticles(scene, sheet);
    const std::size_t firstDistance = scene.distances.size();
    addLinks(scene, sheet, first);
    addGrid(scene, sheet, first, firstDistance);
    addSkipLinks(scene, sheet, first);
    addBends(scene, sheet, first);
    addFaces(scene, sheet, first);
    for (const std::uint32_t pinned : sheet.pinned) scene.fixed.push_back({first + pinned});
    addTethers(scene, {.first = first,
                       .count = sheet.size[0] * sheet.size[1],
                       .perParticle = sheet.tethers,
                       .length = TetherLength::straight});
    scene.bodies.push_back({sheet.name, first, sheet.size[0] * sheet.size[1], 0});
    scene.skins.push_back(makeSkin(sheet, first));
    return first;
}

} // namespace sinew::sim
