// [[hold]].
#include "scenes/bodies.hpp"
#include "scenes/origin.hpp"
#include "scenes/path.hpp"
#include "scenes/sentences.hpp"

#include "mesh/triangle_tree.hpp"
#include "sinew/holds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace sinew::scenes {

namespace {

/// The shape in which a hold takes particles, and the frame that its path moves.
struct Place {
    sim::Gap gap;
    sim::Pose pose;
    std::string odd = {}; ///< about the size of its mesh, where that is odd
};

struct ShapeKey {
    const char *name, *shape;
    bool isNeeded;
};
constexpr ShapeKey shapeKeys[] = {{"normal", "half_space", true}, {"offset", "half_space", false},
                                  {"file", "mesh", true},         {"within", "mesh", true},
                                  {"object", "mesh", false},      {"unit", "mesh", false},
                                  {"scale", "mesh", false},       {"translation", "mesh", false},
                                  {"repair", "mesh", false},      {"weld", "mesh", false}};

void checkShapeKeys(const Section& hold, const std::string& shape) {
    for (const ShapeKey& key : shapeKeys) {
        if (shape == key.shape && key.isNeeded && !hold.has(key.name))
            hold.fail(key.name, "is missing", "a " + shape + " needs it");
        if (shape != key.shape && hold.has(key.name))
            hold.fail(key.name, "is given", "a " + shape.substr(0, 64) + " has none: remove it");
    }
    const bool isOther = shape == "half_space" || shape == "mesh";
    for (const char* key : {"radius", "length", "size"})
        if (isOther && hold.has(key)) hold.fail(key, "is given", "a " + shape + " has none: remove it");
    if (shape == "half_space" && hold.has("rotation"))
        hold.fail("rotation", "is given", "a half_space is rotated by its normal: remove it");
}

sim::Gap nearMesh(const mesh::TriangleMesh& mesh, float within) {
    std::vector<mesh::Vector3> positions;
    for (const sim::Vec3& x : mesh.positions) positions.push_back(mesh::toVector(x));
    const auto tree = std::make_shared<const mesh::TriangleTree>(positions, mesh.triangles);
    return [tree, within](const sim::Vec3& x) {
        const mesh::Vector3 point = mesh::toVector(x);
        const double distance = tree->distance(point);
        const bool isInside = std::abs(tree->windingNumber(point)) > 0.5;
        return (isInside ? -distance : distance) - double{within};
    };
}

Place placeOf(LoadedScene& loaded, const Section& hold, const Source& source) {
    const std::array<double, 3>& origin = loaded.origin;
    const std::string shape = hold.text("shape");
    checkShapeKeys(hold, shape);
    if (shape == "mesh") {
        const PlacedMesh found = placedMesh(hold, source, origin);
        for (const std::string& note : found.notes)
            loaded.notes.push_back("hold \"" + hold.text("name") + "\", " + found.file + note);
        return {nearMesh(found.mesh, hold.number("within")), {found.middle, rotationOf(hold)}, found.odd};
    }
    const sim::Pose pose{localPoint(hold, "center", origin), rotationOf(hold)};
    if (shape == "half_space") {
        requireUnit(hold, "normal");
        return {
            sim::insideOf(sim::Plane{.normal = hold.vector("normal"), .offset = localOffset(hold, origin)}),
            pose};
    }
    sim::Collider collider{.pose = pose, .path = {}};
    readShape(hold, collider, ", half_space, mesh");
    return {sim::insideOf(collider), pose};
}

/// Whether a body is called so, or is one of the copies of a box that is.
bool isNamed(const sim::Body& body, const std::string& name) {
    if (!body.name.starts_with(name)) return false;
    const std::string rest = body.name.substr(name.size());
    return rest.empty() ||
           (rest.size() > 1 && rest[0] == ' ' &&
            std::all_of(rest.begin() + 1, rest.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

/// For each body whether a name means it: it is called so, or, where none is, it is a component of a mesh
/// that is.
std::vector<bool> meantBy(const std::string& name, const std::vector<sim::Body>& bodies) {
    std::vector<bool> isMeant;
    for (const sim::Body& body : bodies) isMeant.push_back(isNamed(body, name));
    if (std::ranges::find(isMeant, true) != isMeant.end()) return isMeant;
    for (std::size_t b = 0; b < bodies.size(); ++b) isMeant[b] = bodies[b].name.starts_with(name + ".");
    return isMeant;
}

/// Indices of the bodies that a hold names.
std::vector<std::size_t> bodiesOf(const Section& hold, const std::vector<sim::Body>& bodies) {
    std::vector<std::size_t> all;
    const std::vector<std::string> names = hold.names("bodies");
    if (hold.has("bodies") && names.empty())
        hold.fail("bodies", "names no body", "name some, or leave the key out to name all");
    std::vector<bool> isTaken(bodies.size(), names.empty());
    for (const std::string& name : names) {
        const std::vector<bool> isMeant = meantBy(name, bodies);
        for (std::size_t b = 0; b < bodies.size(); ++b)
            if (isMeant[b]) isTaken[b] = true;
        if (std::ranges::find(isMeant, true) != isMeant.end()) continue;
        const auto nearest = std::ranges::min_element(bodies, {}, [&](const sim::Body& body) {
            return editDistance(name.substr(0, 64), body.name.substr(0, 64));
        });
        hold.fail("bodies", "names \"" + name.substr(0, 64) + "\", which is no body",
                  "did you mean \"" + nearest->name + "\"?");
    }
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (isTaken[b]) all.push_back(b);
    return all;
}

struct Taken {
    std::vector<std::uint32_t> particles;
    double gap = INFINITY; ///< of the nearest particle [m]
    std::string nearest;   ///< the body that it is of
};

Taken take(LoadedScene& loaded, const Section& hold, const sim::Gap& gap) {
    Taken taken;
    for (const std::size_t b : bodiesOf(hold, loaded.scene.bodies)) {
        const sim::Body& body = loaded.scene.bodies[b];
        const sim::Selection found = sim::select(loaded.scene, body, gap);
        taken.particles.insert(taken.particles.end(), found.particles.begin(), found.particles.end());
        if (found.particles.empty() && hold.has("bodies"))
            loaded.warnings.push_back("hold \"" + hold.text("name") + "\" takes no particle of body \"" +
                                      body.name + "\", the nearest is " + atLeast(found.gap) +
                                      " m outside of its " + hold.text("shape"));
        if (found.gap >= taken.gap) continue;
        taken.gap = found.gap;
        taken.nearest = body.name;
    }
    return taken;
}

// A forgotten unit puts a body and what is to hold it far apart: no other cure helps then.
std::string cureOfUnits(const LoadedScene& loaded, const std::string& body, const std::string& oddHold) {
    if (!oddHold.empty()) return "first, its mesh " + oddHold + "; then, ";
    for (const MeshSummary& mesh : loaded.meshes)
        if (mesh.body == body && !mesh.odd.empty()) return "first, the body " + mesh.odd + "; then, ";
    return {};
}

// A particle of several holds goes along the path of one: those with a path stand first.
void remember(LoadedScene& loaded, const std::string& name, std::vector<std::uint32_t> particles,
              bool isDriven) {
    std::ranges::sort(particles);
    loaded.holds.insert(isDriven ? loaded.holds.begin() : loaded.holds.end(),
                        sim::NamedHold{name, std::move(particles)});
}

constexpr std::size_t nobody = ~std::size_t{0};

void addHold(LoadedScene& loaded, const Section& hold, const Source& source,
             std::vector<std::string>& drivers, std::vector<std::size_t>& driverOf) {
    const Place place = placeOf(loaded, hold, source);
    Taken taken = take(loaded, hold, place.gap);
    const std::string name = hold.text("name"), shape = hold.text("shape");
    if (taken.particles.empty())
        hold.fail("shape",
                  "of hold \"" + name + "\" takes no particle: the nearest, of body \"" + taken.nearest +
                      "\", is " + atLeast(taken.gap) + " m outside of this " + shape,
                  cureOfUnits(loaded, taken.nearest, place.odd) + "move it there, or " +
                      (shape == "mesh" ? "give a larger within" : "make it larger"));
    Path path = readPath(loaded, hold, place.pose);
    remember(loaded, name, taken.particles, !path.keyframes.empty());
    if (path.keyframes.empty()) {
        sim::hold(loaded.scene, taken.particles);
        return;
    }
    if (path.keyframes.size() == 1)
        hold.fail("keyframe", "is a single one, which defines no motion", "give at least two, or none");
    for (const std::uint32_t particle : taken.particles) {
        if (driverOf[particle] != nobody)
            hold.fail("shape",
                      "of hold \"" + name + "\" takes particles that hold \"" + drivers[driverOf[particle]] +
                          "\" moves along its path",
                      "leave them to one of the two");
        driverOf[particle] = drivers.size();
    }
    drivers.push_back(name);
    sim::drive(loaded.scene, std::move(taken.particles), std::move(path.keyframes), path.end);
}

// Notes which bodies cannot move on their own, since holds have all of their particles, with pins and clamps.
void noteWhole(LoadedScene& loaded) {
    std::vector<bool> isHeld(loaded.scene.particles.size()), isDriven(isHeld);
    for (const sim::FixedConstraint& fixed : loaded.scene.fixed) isHeld[fixed.particle] = true;
    for (const sim::DrivenBody& driven : loaded.scene.driven)
        for (const std::uint32_t particle : driven.particles) isDriven[particle] = true;
    const auto isAny = [](const std::vector<bool>& all, const sim::Body& body, bool is) {
        const auto first = all.begin() + body.firstParticle;
        return std::find(first, first + body.particleCount, is) != first + body.particleCount;
    };
    for (const sim::Body& body : loaded.scene.bodies) {
        if (body.particleCount == 0 || isAny(isHeld, body, false)) continue;
        std::string names;
        for (const sim::NamedHold& hold : loaded.holds) {
            const auto taken = std::ranges::lower_bound(hold.particles, body.firstParticle);
            if (taken != hold.particles.end() && *taken - body.firstParticle < body.particleCount)
                names += (names.empty() ? "" : ", ") + std::string("\"") + hold.name + "\"";
        }
        if (!names.empty())
            loaded.notes.push_back(
                "body \"" + body.name + "\" is held completely by hold " + names +
                (isAny(isDriven, body, true) ? ": it moves only along the path" : ": it cannot move"));
    }
}

} // namespace

void addHolds(LoadedScene& loaded, const Section& top, const Source& source) {
    std::vector<std::string> drivers;
    std::vector<std::size_t> driverOf(loaded.scene.particles.size(), nobody);
    for (const Section& hold : top.list("hold")) addHold(loaded, hold, source, drivers, driverOf);
    noteWhole(loaded);
}

} // namespace sinew::scenes
