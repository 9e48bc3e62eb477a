// What the schema cannot say about one key alone is checked here: sizes of bodies, directions, pinned
// particles.
#include "scenes/bodies.hpp"

#include "scenes/origin.hpp"
#include "scenes/surface.hpp"
#include "sinew/bodies.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace sinew::scenes {

namespace {

void checkRoom(const LoadedScene& loaded, std::uint64_t particles, const Section& section, const char* key) {
    const std::uint64_t total = loaded.scene.particles.size() + particles;
    if (total > mostParticles)
        section.fail(key, "brings the scene to " + std::to_string(total) + " particles",
                     "at most " + std::to_string(mostParticles) + " are possible");
}

double dot(sim::Vec3 a, sim::Vec3 b) {
    return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
}

struct NamedPins {
    std::string_view name;
    bool (*holds)(std::uint32_t column, std::uint32_t row, std::uint32_t columns, std::uint32_t rows);
};

constexpr NamedPins namedPins[] = {
    {"first_row_start", [](auto c, auto r, auto, auto) { return r == 0 && c == 0; }},
    {"first_row_end", [](auto c, auto r, auto n, auto) { return r == 0 && c + 1 == n; }},
    {"last_row_start", [](auto c, auto r, auto, auto m) { return r + 1 == m && c == 0; }},
    {"last_row_end", [](auto c, auto r, auto n, auto m) { return r + 1 == m && c + 1 == n; }},
    {"first_row", [](auto, auto r, auto, auto) { return r == 0; }},
    {"last_row", [](auto, auto r, auto, auto m) { return r + 1 == m; }},
    {"first_column", [](auto c, auto, auto, auto) { return c == 0; }},
    {"last_column", [](auto c, auto, auto n, auto) { return c + 1 == n; }},
};

std::string pinNames() {
    std::string names;
    for (const NamedPins& pins : namedPins) names += (names.empty() ? "" : ", ") + std::string(pins.name);
    return names;
}

void addNamed(const std::string& name, const Section& cloth, sim::ClothSheet& sheet) {
    const auto found = std::ranges::find(namedPins, name, &NamedPins::name);
    if (found == std::end(namedPins))
        cloth.fail("pinned", "names \"" + name.substr(0, 64) + "\"", "possible are " + pinNames());
    const auto [columns, rows] = sheet.size;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            if (found->holds(column, row, columns, rows)) sheet.pinned.push_back(column + columns * row);
}

void addPins(const Section& cloth, sim::ClothSheet& sheet) {
    for (const Section::Pin& pin : cloth.pins("pinned")) {
        if (!pin.name.empty()) {
            addNamed(pin.name, cloth, sheet);
            continue;
        }
        for (std::size_t axis = 0; axis < 2; ++axis)
            if (pin.at[axis] < 0 || pin.at[axis] >= sheet.size[axis])
                cloth.fail("pinned",
                           "has [" + std::to_string(pin.at[0]) + ", " + std::to_string(pin.at[1]) +
                               "], but the sheet has " + std::to_string(sheet.size[0]) + " columns and " +
                               std::to_string(sheet.size[1]) + " rows",
                           "count from 0");
        sheet.pinned.push_back(static_cast<std::uint32_t>(pin.at[0] + pin.at[1] * sheet.size[0]));
    }
    std::ranges::sort(sheet.pinned);
    sheet.pinned.erase(std::unique(sheet.pinned.begin(), sheet.pinned.end()), sheet.pinned.end());
}

/// A face of a box: the corners whose index along `axis` is the lowest or the highest.
struct NamedFace {
    std::string_view name;
    std::size_t axis;
    bool isHigh;
};
constexpr NamedFace namedFaces[] = {{"low_x", 0, false}, {"high_x", 0, true}, {"low_y", 1, false},
                                    {"high_y", 1, true}, {"low_z", 2, false}, {"high_z", 2, true}};

std::vector<std::uint32_t> particlesOf(const NamedFace& face, const sim::LatticeCorners& corners) {
    std::vector<std::uint32_t> particles;
    const std::uint32_t layer = face.isHigh ? corners.cells[face.axis] : 0;
    std::array<std::uint32_t, 3> at{};
    for (at[2] = 0; at[2] <= corners.cells[2]; ++at[2])
        for (at[1] = 0; at[1] <= corners.cells[1]; ++at[1])
            for (at[0] = 0; at[0] <= corners.cells[0]; ++at[0])
                if (at[face.axis] == layer) particles.push_back(corners.at(at[0], at[1], at[2]));
    return particles;
}

void clampFaces(sim::Scene& scene, const Section& box, const sim::LatticeCorners& corners) {
    std::set<std::uint32_t> held; // faces share edges
    for (const std::string& name : box.names("clamped")) {
        const auto face = std::ranges::find(namedFaces, name, &NamedFace::name);
        if (face == std::end(namedFaces))
            box.fail("clamped", "names \"" + name.substr(0, 64) + "\"",
                     "possible are low_x, high_x, low_y, high_y, low_z, high_z");
        for (const std::uint32_t particle : particlesOf(*face, corners)) held.insert(particle);
    }
    for (const std::uint32_t particle : held) scene.fixed.push_back({particle});
}

/// Of particles that touch others [m]; 0 = they do not.
float radiusOf(const LoadedScene& loaded, const Section& body) {
    const float most = body.number("spacing") / 2;
    if (!isColliding(loaded, body)) {
        if (body.has("radius")) refuseUntouching(loaded, body, "radius");
        return 0;
    }
    const float radius = body.has("radius") ? body.number("radius") : most;
    if (radius > most)
        body.fail("radius", "is more than half of the spacing", "linked particles would overlap at rest");
    return radius;
}

std::uint64_t product(const std::array<std::uint32_t, 3>& counts) {
    return std::uint64_t{counts[0]} * counts[1] * counts[2];
}

void addLoad(sim::Scene& scene, double load, const sim::LatticeCorners& corners) {
    if (load == 0) return;
    const std::vector<std::uint32_t> top = particlesOf({"high_y", 1, true}, corners);
    for (const std::uint32_t i : top) {
        const double mass =
            1 / double{scene.particles[i].inverseMass} + load / static_cast<double>(top.size());
        scene.particles[i].inverseMass = static_cast<float>(1 / mass);
    }
}

/// Where the lowest corners of equal boxes are.
struct BoxRows {
    sim::Vec3 first, pitch;

    sim::Vec3 origin(const std::array<std::uint64_t, 3>& place) const {
        const auto at = [](float low, float step, std::uint64_t i) {
            return static_cast<float>(double{low} + double{step} * static_cast<double>(i));
        };
        return {at(first.x, pitch.x, place[0]), at(first.y, pitch.y, place[1]),
                at(first.z, pitch.z, place[2])};
    }
};

/// The place of a copy along x, y and z.
std::array<std::uint64_t, 3> placeOf(std::uint64_t index, const std::array<std::uint32_t, 3>& copies) {
    const std::uint64_t layer = index / copies[0];
    return {index % copies[0], layer / copies[2], layer % copies[2]};
}

/// Every second copy is darker, as boxes that touch show no seam between equal colors.
sim::Vec3 shadeOf(const sim::Vec3& color, const std::array<std::uint64_t, 3>& place) {
    const float shade = (place[0] + place[1] + place[2]) % 2 == 0 ? 1 : 0.7f;
    return {shade * color.x, shade * color.y, shade * color.z};
}

/// `center` is that of all boxes, `origin` the lowest corner of the first.
BoxRows rowsOf(const Section& box, const sim::Lattice& lattice, const std::array<std::uint32_t, 3>& copies,
               const std::array<double, 3>& origin) {
    const auto side = [&](std::size_t axis) {
        return lattice.spacing * static_cast<float>(lattice.cells[axis]);
    };
    BoxRows rows;
    const auto wide = [&](std::size_t axis) { return side(axis) + 2 * lattice.spacing; };
    rows.pitch = box.has("pitch") ? box.vector("pitch") : sim::Vec3{wide(0), wide(1), wide(2)};
    if (box.has("origin")) {
        rows.first = localPoint(box, "origin", origin);
        return rows;
    }
    const sim::Vec3 center = localPoint(box, "center", origin);
    const auto low = [&](float middle, float pitch, std::size_t axis) {
        return middle - (side(axis) + pitch * static_cast<float>(copies[axis] - 1)) / 2;
    };
    rows.first = {low(center.x, rows.pitch.x, 0), low(center.y, rows.pitch.y, 1),
                  low(center.z, rows.pitch.z, 2)};
    return rows;
}

void addOneBox(LoadedScene& loaded, const Section& box, const sim::Lattice& lattice, const sim::Vec3& color) {
    sim::LatticeCorners corners;
    try {
        corners = sim::addLattice(loaded.scene, lattice);
    } catch (const std::domain_error& error) {
        box.fail(lattice.isCuttable             ? "cuttable"
                 : lattice.poissonRatio > 0.25f ? "poisson_ratio"
                                                : "recovery",
                 std::string("is not possible: ") + error.what(), "move the body nearer to the origin");
    }
    clampFaces(loaded.scene, box, corners);
    addLoad(loaded.scene, double{box.number("load")}, corners);
    sim::addLatticeSkin(loaded.scene, lattice, corners, color);
}

void checkParticleKeys(const Section& section, bool isRandom) {
    if (isRandom && !section.has("size")) section.fail("random", "has no cuboid", "give size");
    for (const char* key : {"count", "spacing", "jitter"})
        if (isRandom && section.has(key))
            section.fail(key, "is given beside random, which has no rows", "leave one of them out");
    if (!isRandom && section.has("size"))
        section.fail("size", "is the cuboid of random particles", "give random, or leave it out");
    if (section.has("mass") && section.has("density"))
        section.fail("density", "is given beside mass", "give mass or density");
}

float massOfBall(const Section& section) {
    const double radius = double{section.number("radius")};
    return static_cast<float>(double{section.number("density")} * 4 / 3 * std::numbers::pi * radius * radius *
                              radius);
}

/// As sim::addParticles refuses it, but for rounding of what the file says.
bool tooNear(const sim::LooseParticles& particles) {
    return double{particles.spacing} < 2 * (double{particles.radius} + double{particles.jitter}) * (1 - 1e-6);
}

} // namespace

void requireUnit(const Section& section, const char* key) {
    const sim::Vec3 direction = section.vector(key);
    const double length = std::sqrt(dot(direction, direction));
    if (!sim::ranges::normalLength.holds(length))
        section.fail(key, "has length " + std::to_string(length), "give a direction of length 1");
}

void refuseUntouching(const LoadedScene& loaded, const Section& body, const char* key) {
    const bool hasContacts = loaded.settings.solver == sim::Solver::split;
    body.fail(key, "is given, but the body touches nothing",
              hasContacts ? "write collides = true" : "only the solver split has contacts");
}

void noteDefaultContacts(LoadedScene& loaded, const Section& body, std::size_t first) {
    if (body.has("collides") || !isColliding(loaded, body)) return;
    for (std::size_t b = first; b < loaded.scene.bodies.size(); ++b)
        loaded.defaults.contacts.push_back(static_cast<std::uint32_t>(b));
}

bool isColliding(const LoadedScene& loaded, const Section& body) {
    if (body.has("collides")) return body.flag("collides");
    return body.flag("cuttable") && loaded.settings.solver == sim::Solver::split;
}

float tearStrainOf(const Section& body) {
    if (body.number("tear") > 0 && !body.flag("cuttable"))
        body.fail("tear", "is given, but the body may not be cut", "add cuttable = true");
    return body.number("tear");
}

float toughnessOf(const Section& body) {
    if (body.number("toughness") > 0 && !body.flag("cuttable"))
        body.fail("toughness", "is given, but the body may not be cut", "add cuttable = true");
    return body.number("toughness");
}

void letBeAbsent(LoadedScene& loaded, const Section& section, std::size_t firstBody) {
    if (!section.flag("absent")) return;
    for (std::size_t b = firstBody; b < loaded.scene.bodies.size(); ++b)
        loaded.scene.bodies[b].isAbsent = true;
    loaded.settings.motions = sim::ranges::mostMotions;
}

void addCloth(LoadedScene& loaded, const Section& cloth) {
    requireUnit(cloth, "right");
    requireUnit(cloth, "down");
    if (std::abs(dot(cloth.vector("right"), cloth.vector("down"))) > 1e-3)
        cloth.fail("down", "is not at right angles to right", "rotate one of them");
    for (const char* key : {"stretch_compliance", "shear_compliance"})
        if (cloth.has(key) && cloth.number("membrane_stiffness") > 0)
            cloth.fail(key, "is given beside membrane_stiffness, which sets it", "leave one of them out");
    for (const char* key : {"collides", "radius"})
        if (cloth.has("thickness") && cloth.has(key))
            cloth.fail("thickness", std::string("is given beside ") + key, "leave one of them out");
    sim::ClothSheet sheet{.name = cloth.text("name"),
                          .origin = localPoint(cloth, "origin", loaded.origin),
                          .right = cloth.vector("right"),
                          .down = cloth.vector("down"),
                          .size = cloth.counts<2>("size"),
                          .spacing = cloth.number("spacing"),
                          .areaDensity = cloth.number("area_density"),
                          .stretchCompliance = cloth.number("stretch_compliance"),
                          .shearCompliance = cloth.number("shear_compliance"),
                          .membraneStiffness = cloth.number("membrane_stiffness"),
                          .skipStiffness = cloth.number("skip_stiffness"),
                          .bendingStiffness = cloth.number("bending_stiffness"),
                          .thickness = cloth.has("thickness") ? cloth.number("thickness") : 0,
                          .tethers = cloth.count("tethers"),
                          .radius = cloth.has("thickness") ? 0 : radiusOf(loaded, cloth),
                          .pinned = {},
                          .isCuttable = cloth.flag("cuttable"),
                          .tearStrain = tearStrainOf(cloth),
                          .tearsPerStep = cloth.count("tears_per_step"),
                          .toughness = toughnessOf(cloth),
                          .color = cloth.vector("color")};
    checkRoom(loaded, std::uint64_t{sheet.size[0]} * sheet.size[1], cloth, "size");
    addPins(cloth, sheet);
    const std::size_t first = loaded.scene.particles.size();
    sim::addCloth(loaded.scene, sheet);
    if (!cloth.has("thickness")) noteDefaultContacts(loaded, cloth, loaded.scene.bodies.size() - 1);
    addSurface(loaded, cloth, first);
    letBeAbsent(loaded, cloth, loaded.scene.bodies.size() - 1);
}

void addChain(LoadedScene& loaded, const Section& section) {
    requireUnit(section, "direction");
    sim::Chain chain{.name = section.text("name"),
                     .origin = section.vector("origin"),
                     .direction = section.vector("direction"),
                     .particles = section.count("particles"),
                     .length = section.number("length"),
                     .mass = section.number("mass"),
                     .endMass = section.has("end_mass") ? section.number("end_mass") : 0,
                     .compliance = section.number("stretch_compliance"),
                     .pinned = {}};
    checkRoom(loaded, chain.particles, section, "particles");
    for (const std::string& end : section.names("pinned")) {
        if (end != "first" && end != "last")
            section.fail("pinned", "names \"" + end.substr(0, 64) + "\"", "possible are first, last");
        chain.pinned.push_back(end == "first" ? 0 : chain.particles - 1);
    }
    sim::addChain(loaded.scene, chain);
}

void addBox(LoadedScene& loaded, const Section& box, FaceChoices& faces) {
    box.requireOneOf("center", "origin");
    const auto particles = box.counts<3>("particles"), copies = box.counts<3>("copies");
    const std::uint64_t each = product(particles), count = product(copies);
    checkRoom(loaded, each > mostParticles ? each : each * std::min(count, mostParticles + 1), box,
              "particles");
    const sim::Lattice lattice{.name = box.text("name"),
                               .cells = {particles[0] - 1, particles[1] - 1, particles[2] - 1},
                               .spacing = box.number("spacing"),
                               .youngModulus = box.number("young_modulus"),
                               .poissonRatio = box.number("poisson_ratio"),
                               .recovery = box.number("recovery"),
                               .density = box.number("density"),
                               .radius = radiusOf(loaded, box),
                               .isCuttable = box.flag("cuttable"),
                               .tearStrain = tearStrainOf(box),
                               .tearsPerStep = box.count("tears_per_step"),
                               .toughness = toughnessOf(box)};
    const BoxRows rows = rowsOf(box, lattice, copies, loaded.origin);
    const std::size_t first = loaded.scene.particles.size(), firstGrid = loaded.scene.grids.size(),
                      firstBody = loaded.scene.bodies.size();
    for (std::uint64_t i = 0; i < count; ++i) {
        sim::Lattice one = lattice;
        const std::array<std::uint64_t, 3> place = placeOf(i, copies);
        one.origin = rows.origin(place);
        if (count > 1) one.name.append(" ").append(std::to_string(i + 1));
        addOneBox(loaded, box, one, shadeOf(box.vector("color"), place));
        noteDefaultContacts(loaded, box, loaded.scene.bodies.size() - 1);
    }
    addSurface(loaded, box, first);
    faces.add(loaded, box, firstGrid);
    letBeAbsent(loaded, box, firstBody);
}

void addParticles(LoadedScene& loaded, const Section& section) {
    const auto count = section.counts<3>("count");
    const bool isRandom = section.has("random");
    checkParticleKeys(section, isRandom);
    sim::LooseParticles particles{.name = section.text("name"),
                                  .center = localPoint(section, "center", loaded.origin),
                                  .count = count,
                                  .spacing = section.has("spacing") ? section.number("spacing") : 0,
                                  .jitter = section.number("jitter"),
                                  .random = isRandom ? section.count("random") : 0,
                                  .size = isRandom ? section.vector("size") : sim::Vec3{},
                                  .seed = section.count("seed"),
                                  .radius = section.number("radius"),
                                  .color = section.vector("color")};
    particles.mass = section.has("mass") ? section.number("mass") : massOfBall(section);
    if (!sim::ranges::inverseMass.holds(1 / double{particles.mass}) || !(particles.mass > 0))
        section.fail("radius", "makes balls of a mass that float32 cannot hold", "give their mass");
    checkRoom(loaded, isRandom ? particles.random : product(count), section, isRandom ? "random" : "count");
    if (!isRandom && section.has("spacing") && tooNear(particles))
        section.fail("spacing", "lets neighbours overlap", "must be at least 2 (radius + jitter)");
    const std::size_t first = loaded.scene.particles.size();
    try {
        sim::addParticles(loaded.scene, particles);
    } catch (const std::domain_error& error) {
        section.fail("random", std::string("cannot be placed: ") + error.what(), "give a larger size");
    }
    addSurface(loaded, section, first);
}

void addPlane(LoadedScene& loaded, const Section& plane) {
    requireUnit(plane, "normal");
    loaded.scene.planes.push_back({.normal = plane.vector("normal"),
                                   .offset = localOffset(plane, loaded.origin),
                                   .friction = plane.number("friction"),
                                   .restitution = plane.number("restitution"),
                                   .staticFriction = staticFrictionOf(plane)});
}

} // namespace sinew::scenes
