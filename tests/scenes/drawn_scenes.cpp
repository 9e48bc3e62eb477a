// Draws one to three bodies, and each property of a body, a scene or the settings with its own probability.
#include "scenes/drawn_scenes.hpp"

#include "sinew/bodies.hpp"
#include "sinew/events.hpp"
#include "sinew/validate.hpp"

#include <array>
#include <random>

namespace sinew::test {

using namespace sim;

namespace {

constexpr float spacing = 0.1f, radius = 0.03f;

/// Random draws that are equal in all standard libraries, unlike those of the standard's distributions.
class Lots {
public:
    explicit Lots(std::uint32_t seed) : random_(seed), isPlain_(oneIn(2)) {}
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() >> 8) % count; }
    bool oneIn(std::uint32_t count) { return below(count) == 0; }
    /// Like oneIn(), but never true in half of all scenes: some kernels exist only for simple scenes.
    bool extraIn(std::uint32_t count) { return !isPlain_ && oneIn(count); }

private:
    std::mt19937 random_;
    bool isPlain_;
};

/// Properties shared by all bodies of a scene.
struct Kind {
    float radius = 0; ///< of particles; 0 = no contacts
    bool isCuttable = false, tears = false, hasVolumes = false;
    float height = 0;
};

void addLoose(Scene& scene, Lots&, const Kind& kind) {
    if (kind.radius == 0)
        scene.particles.push_back({.position = {0, kind.height, 0}});
    else
        addParticles(scene, {.center = {0, kind.height, 0}, .count = {2, 2, 2}, .radius = kind.radius});
}

// A chain whose links have one rest length, or a different one each.
void addLinks(Scene& scene, Lots& lots, const Kind& kind) {
    const std::uint32_t first = addChain(scene, {.origin = {0, kind.height, 0},
                                                 .direction = {1, 0, 0},
                                                 .particles = 8,
                                                 .length = 7 * spacing,
                                                 .compliance = lots.oneIn(2) ? 0 : 1e-4f});
    for (std::uint32_t i = first; i < scene.particles.size(); ++i) scene.particles[i].radius = kind.radius;
    if (lots.oneIn(2)) return;
    for (DistanceConstraint& link : scene.distances)
        if (link.a >= first) link.restLength *= 1 + 0.01f * static_cast<float>(link.a - first);
}

// A hub: a few particles have many links and most have one, which is too uneven for equal slots a particle.
void addHub(Scene& scene, Lots&, const Kind& kind) {
    const auto hub = static_cast<std::uint32_t>(scene.particles.size());
    for (std::uint32_t i = 0; i < 40; ++i) {
        scene.particles.push_back(
            {.position = {spacing * static_cast<float>(i), kind.height, 0}, .radius = kind.radius});
        if (i > 0) scene.distances.push_back({hub, hub + i, spacing * static_cast<float>(i), 1e-4f});
    }
}

void addSheet(Scene& scene, Lots& lots, const Kind& kind) {
    const bool isPinned = lots.oneIn(2);
    const float thickness = kind.radius * static_cast<float>(lots.below(3)); // more separates edges, too
    addCloth(scene, {.origin = {0, kind.height, 0},
                     .size = {5, 5},
                     .spacing = spacing,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-4f,
                     .skipStiffness = lots.extraIn(3) ? 100.0f : 0,
                     .bendingStiffness = lots.extraIn(3) ? 1e-3f : 0,
                     .thickness = 1.5f * thickness,
                     .tethers = isPinned && lots.extraIn(2) ? 1u : 0,
                     .radius = 0,
                     .pinned = isPinned ? std::vector<std::uint32_t>{0} : std::vector<std::uint32_t>{},
                     .isCuttable = kind.isCuttable,
                     .tearStrain = kind.tears ? 0.3f : 0});
}

void addVoxels(Scene& scene, Lots& lots, const Kind& kind) {
    const Lattice lattice{.origin = {0, kind.height, 0},
                          .cells = {3, 3, 3},
                          .spacing = spacing,
                          .poissonRatio = kind.hasVolumes && lots.oneIn(2) ? 0.4f : 0.25f,
                          .recovery = kind.hasVolumes && lots.oneIn(2) ? 2.0f : 0,
                          .radius = kind.radius,
                          .hasBodyDiagonals = lots.oneIn(3),
                          .isCuttable = kind.isCuttable,
                          .tearStrain = kind.tears ? 0.3f : 0};
    const LatticeCorners corners = addLattice(scene, lattice);
    if (lots.oneIn(2)) addLatticeSkin(scene, lattice, corners, {});
    if (kind.radius > 0 && lots.oneIn(3)) addSurfaceFaces(scene, scene.grids.back());
}

// Two triangles whose edges cross, because no shipped scene has edge contacts.
void addTriangles(Scene& scene, Lots&, const Kind& kind) {
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (const Vec3& x : {Vec3{-0.9f, 0, 0.02f},
                          {1.1f, 0, -0.03f},
                          {0, -0.5f, 0.1f},
                          {0.1f, 0.1f, -1},
                          {-0.05f, 0.1f, 0.8f},
                          {0, 2.1f, 0}})
        scene.particles.push_back({.position = {x.x, x.y + kind.height, x.z}, .radius = kind.radius});
    for (const std::uint32_t corner : {first, first + 3})
        scene.faces.push_back({{corner, corner + 1, corner + 2}, 0.01f});
}

void addBodies(Scene& scene, Lots& lots, bool isSplit) {
    constexpr std::array add{addLoose, addLinks, addHub, addSheet, addVoxels, addTriangles};
    Kind kind{.radius = isSplit && lots.oneIn(2) ? radius : 0, .isCuttable = isSplit && lots.oneIn(2)};
    kind.hasVolumes = isSplit;
    kind.tears = kind.isCuttable && lots.oneIn(2);
    scene.debris = kind.isCuttable && lots.oneIn(2) ? 4 : 0;
    const bool interlock = lots.oneIn(4);
    const std::uint32_t most = 1 + 2 * lots.below(2);
    for (std::uint32_t bodies = 1 + lots.below(most); bodies > 0; --bodies) {
        add[lots.below(add.size())](scene, lots, kind);
        kind.height += interlock ? 0.15f : 1;
    }
}

void addTouch(Scene& scene, Lots& lots) {
    scene.contacts.friction = scene.contacts.staticFriction = lots.oneIn(2) ? 0.5f : 0;
    scene.contacts.restitution = lots.oneIn(3) ? 0.5f : 0;
    if (lots.oneIn(3)) {
        scene.contacts.surfaces = {{.friction = scene.contacts.friction * 0.5f,
                                    .restitution = lots.oneIn(2) ? scene.contacts.restitution : 0}};
        scene.particles[0].surface = 1;
    }
}

void addWorld(Scene& scene, Lots& lots) {
    if (lots.oneIn(2))
        scene.planes.push_back({.offset = -1, .friction = 0.3f, .restitution = lots.oneIn(2) ? 0.3f : 0});
    addTouch(scene, lots);
    if (lots.extraIn(3))
        scene.colliders.push_back(
            {.radius = 0.2f, .restitution = lots.oneIn(2) ? 0.5f : 0, .pose = {.position = {0, -2, 0}}});
    scene.dampingTime = lots.oneIn(3) ? 1e-3f : 0;
    if (scene.distances.size() > 1 && lots.extraIn(3)) {
        const DistanceConstraint &first = scene.distances[0], &second = scene.distances[1];
        scene.bends.push_back({first.a, first.b, second.b, 1e-3f});
    }
    if (lots.extraIn(3)) scene.attachments.push_back({.particle = 0, .compliance = 1e-3f});
    if (lots.extraIn(4)) {
        scene.fixed.push_back({0});
        scene.tethers.push_back({static_cast<std::uint32_t>(scene.particles.size() - 1), 0, 10});
    }
}

Settings drawSettings(Lots& lots) {
    constexpr std::array solvers{Solver::split, Solver::split, Solver::split, Solver::jacobi,
                                 Solver::gaussSeidel};
    Settings settings{.solver = solvers[lots.below(solvers.size())],
                      .substeps = 3,
                      .iterations = 1,
                      .warmStart = lots.oneIn(2) ? 0.9f : 0,
                      .publishesVelocities = !lots.extraIn(3)};
    settings.forms.usesTexels = lots.oneIn(2);
    settings.forms.usesGrids = !lots.extraIn(3);
    settings.forms.columns = 1 + lots.below(2);
    settings.forms.residentBytes = lots.oneIn(2) ? 32768 : 0;
    settings.grabs = lots.extraIn(2) ? 1 : 0;
    if (settings.solver != Solver::split) {
        settings.iterations = 1 + lots.below(2);
        return settings;
    }
    settings.sleeps = lots.oneIn(2);
    settings.hostColliders = lots.extraIn(2) ? 1 : 0;
    return settings;
}

// Every other body, if it can.
void letBodiesBeAbsent(DrawnScene& drawn) {
    for (std::size_t b = 0; b < drawn.scene.bodies.size(); b += 2) {
        bool& isAbsent = drawn.scene.bodies[b].isAbsent;
        isAbsent = true;
        isAbsent = validate(drawn.scene, drawn.settings).empty();
    }
}

} // namespace

DrawnScene drawScene(std::uint32_t seed) {
    Lots lots(seed);
    DrawnScene drawn{.scene = {}, .settings = drawSettings(lots)};
    drawn.settings.forms.chunk = 16;
    addBodies(drawn.scene, lots, drawn.settings.solver == Solver::split);
    addWorld(drawn.scene, lots);
    drawn.settings.fields = lots.extraIn(3) ? 1 : 0;
    drawn.settings.events = lots.extraIn(2) ? allEvents : 0;
    drawn.settings.motions = lots.extraIn(3) ? 2 : 0;
    const bool mayBeAbsent = drawn.settings.motions > 0 && drawn.settings.solver == Solver::split;
    if (mayBeAbsent && lots.extraIn(3)) letBodiesBeAbsent(drawn);
    return drawn;
}

} // namespace sinew::test
