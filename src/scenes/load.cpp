// From a path to a valid scene: tells scenes from meshes, reads the tables, applies the command line,
// validates.
#include "scenes/load.hpp"

#include "scenes/blades.hpp"
#include "scenes/bodies.hpp"
#include "scenes/built_in.hpp"
#include "scenes/check_solver.hpp"
#include "scenes/origin.hpp"
#include "scenes/path.hpp"
#include "scenes/recovery.hpp"
#include "scenes/sentences.hpp"
#include "scenes/surface.hpp"
#include "scenes/untouched.hpp"
#include "sim/compile/compile.hpp"
#include "sim/core/counted.hpp"
#include "sinew/ranges.hpp"
#include "sinew/start.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::scenes {

namespace {

namespace fs = std::filesystem;

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

/// A scene is what is called .toml, or else any text that parses as TOML and says something: an OBJ file of
/// comments parses as well, and says nothing.
bool isScene(const fs::path& path) {
    if (lowerExtension(path) == ".toml") return true;
    try {
        return !parse(readText(path), path.string()).empty();
    } catch (const SceneError&) {
        return false;
    }
}

sim::Solver solverNamed(const std::string& name, const std::string& where) {
    sim::Solver solver{};
    if (sim::parseSolver(name, solver)) return solver;
    std::string names;
    for (const std::string& known : sim::solverNames()) names += (names.empty() ? "" : ", ") + known;
    fail(where, "no solver is called \"" + name.substr(0, 64) + "\"", "possible are " + names);
}

void readSettings(LoadedScene& loaded, const Section& solver, const std::string& where) {
    loaded.settings = {.solver = solverNamed(solver.text("name"), where),
                       .substeps = solver.countOrAuto("substeps").value_or(0),
                       .tolerance = solver.number("tolerance"),
                       .iterations = solver.count("iterations"),
                       .omega = solver.number("omega"),
                       .theta = solver.number("theta"),
                       .levels = solver.countOrAuto("levels").value_or(sim::autoLevels),
                       .hasSharpClamp = solver.flag("sharp_clamp"),
                       .weight = solver.number("weight"),
                       .overRelaxation = solver.number("over_relaxation"),
                       .warmStart = solver.number("warm_start"),
                       .sleeps = solver.flag("sleep")};
}

void readContacts(LoadedScene& loaded, const Section& contacts) {
    loaded.scene.contacts.friction = contacts.number("friction");
    loaded.scene.contacts.restitution = contacts.number("restitution");
    loaded.scene.contacts.staticFriction = staticFrictionOf(contacts);
    loaded.scene.contacts.recoverySpeed = contacts.number("recovery_speed");
    loaded.scene.contacts.takesRecoils = contacts.flag("take_recoils_back");
    loaded.keepsRest = isRestKept(contacts);
    loaded.settings.contactMargin = contacts.number("margin");
    loaded.settings.contactRoom = contacts.count("room");
}

// So many candidates that no buffer of lists exceeds 128 MiB, which every Vulkan device binds: 16 bytes a
// candidate of a particle, at any node of its grid, 20 of one of a point or an edge of faces
// (pooled_lists.cpp).
void leaveRoom(sim::Settings& settings, const sim::Scene& scene) {
    constexpr std::uint64_t most = std::uint64_t{128} << 20, padding = 1024;
    std::uint64_t slots = scene.particles.size() + padding, faces = 0;
    for (const sim::Grid& grid : scene.grids)
        slots += std::uint64_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2] - grid.node.size();
    for (const sim::Face& face : scene.faces) faces += face.isSolid ? 0 : 1;
    const std::uint64_t points = scene.faces.empty() ? 0 : scene.particles.size(),
                        edges = faces + faces * 5 / 9;
    const std::uint64_t each = most / std::max({16 * slots, 20 * points, 20 * edges});
    settings.contactRoom = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(settings.contactRoom, std::max<std::uint64_t>(each, 1)));
}

void apply(const Overrides& overrides, LoadedScene& loaded) {
    sim::Settings& settings = loaded.settings;
    if (overrides.solver) settings.solver = solverNamed(*overrides.solver, "--solver");
    if (overrides.substeps) settings.substeps = *overrides.substeps;
    if (overrides.iterations) settings.iterations = *overrides.iterations;
    if (overrides.levels) settings.levels = *overrides.levels;
    if (overrides.hasSharpClamp) settings.hasSharpClamp = *overrides.hasSharpClamp;
    if (overrides.dt) loaded.scene.dt = *overrides.dt;
    settings.isReversed = overrides.isReversed;
}

// The bodies of all tables [[list]], each as its table says that it begins. Meshes are turned before they are
// filled with voxels.
template <typename Add>
void addBodies(LoadedScene& loaded, const Section& top, std::string_view list, const Add& add) {
    for (const Section& section : top.list(list)) {
        const std::size_t first = loaded.scene.bodies.size();
        add(section);
        const bool isTurned = list == "mesh";
        sim::start(loaded.scene, first,
                   {.velocity = section.vector("velocity"),
                    .spin = section.vector("spin"),
                    .rotation = isTurned ? sim::Quaternion{} : rotationOf(section)});
    }
}

void readBodies(LoadedScene& loaded, const Section& top, const Source& source, std::optional<float> voxel) {
    FaceChoices faces;
    addBodies(loaded, top, "cloth", [&](const Section& cloth) { addCloth(loaded, cloth); });
    addBodies(loaded, top, "chain", [&](const Section& chain) { addChain(loaded, chain); });
    addBodies(loaded, top, "box", [&](const Section& box) { addBox(loaded, box, faces); });
    addBodies(loaded, top, "mesh", [&](const Section& mesh) { addMesh(loaded, mesh, source, voxel, faces); });
    addBodies(loaded, top, "particles", [&](const Section& balls) { addParticles(loaded, balls); });
    if (loaded.scene.bodies.empty())
        fail(source.file, "has no body", "add [[cloth]], [[chain]], [[box]], [[mesh]] or [[particles]]");
    addHolds(loaded, top, source);
    faces.settle(loaded);
    for (const Section& mesh : top.list("mesh_collider")) addMeshCollider(loaded, mesh, source);
    for (const Section& plane : top.list("plane")) addPlane(loaded, plane);
    for (const Section& collider : top.list("collider")) addCollider(loaded, collider);
    for (const Section& blade : top.list("blade")) addBlade(loaded, blade);
    for (const Section& strokes : top.list("strokes")) addStrokes(loaded, strokes);
    checkBlades(loaded, top);
}

// A solver to compare with is asked for from outside and knows no cuts. That must not keep a scene from it
// that is only offered for cutting; one that cuts or tears by itself would be another scene, and is refused.
void leaveWholeAsAsked(const Overrides& overrides, LoadedScene& loaded) {
    if (!overrides.solver || !loaded.blades.empty() || !leaveWhole(loaded.scene, loaded.settings)) return;
    loaded.warnings.push_back("nothing can be cut with solver " + *overrides.solver + ": use split");
}

// Whether a link of the scene holds each particle.
std::vector<bool> linkedParticles(const sim::Scene& scene) {
    std::vector<bool> isLinked(scene.particles.size());
    for (const sim::DistanceConstraint& link : scene.distances) isLinked[link.a] = isLinked[link.b] = true;
    return isLinked;
}

// The longest edge of the box around a linked body, radii included. Free particles are bodies of their own:
// the largest diameter of them [m].
double sizeOf(const sim::Body& body, const sim::Scene& scene, const std::vector<bool>& isLinked) {
    sim::Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    double diameter = 0;
    bool isWhole = false;
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        const sim::Particle& particle = scene.particles[i];
        diameter = std::max(diameter, 2 * double{particle.radius});
        isWhole = isWhole || isLinked[i];
        for (float sim::Vec3::*axis : {&sim::Vec3::x, &sim::Vec3::y, &sim::Vec3::z}) {
            const float value = particle.position.*axis;
            low.*axis = std::min(low.*axis, value);
            high.*axis = std::max(high.*axis, value);
        }
    }
    if (!isWhole) return diameter;
    return double{std::max({high.x - low.x, high.y - low.y, high.z - low.z})} + diameter;
}

// Free particles without a radius have no size.
void warnAboutSizes(LoadedScene& loaded) {
    const std::vector<bool> isLinked = linkedParticles(loaded.scene);
    for (const sim::Body& body : loaded.scene.bodies) {
        const double size = sizeOf(body, loaded.scene, isLinked);
        const char* odd = size > 1000 ? "larger than 1 km" : size < 1e-4 ? "smaller than 0.1 mm" : nullptr;
        if (odd && size > 0)
            loaded.warnings.push_back("body \"" + body.name + "\" is " + odd + ": lengths are in metres");
    }
}

// "dt = 0.0043": steps in which `substeps` are enough where `wanted` would be now; empty where none are so
// short.
std::string shorterSteps(const LoadedScene& loaded, std::uint32_t substeps, std::uint32_t wanted) {
    const double dt = double{loaded.scene.dt} * substeps / wanted;
    return dt < sim::ranges::dt.low ? "" : "dt = " + atMost(dt);
}

// That many, or what to do where they are more than may be asked for.
std::string giveSubsteps(const LoadedScene& loaded, std::uint32_t count) {
    constexpr auto most = static_cast<std::uint32_t>(sim::ranges::substeps.high);
    if (count <= most) return sim::counted(count, "substep");
    const std::string dt = shorterSteps(loaded, most, count);
    return std::to_string(most) + " substeps" + (dt.empty() ? " of far shorter steps" : " with " + dt);
}

// A few links on light corners are no news; half of a body being too soft is. The stiffness of `jacobi` and
// `gauss_seidel` is a model: only a body that is far too soft by it is worth a warning.
constexpr double roughlyKept = 0.5;

std::string softnessText(const sim::BodyStiffness& body, bool hasOthers) {
    return std::to_string(body.soft) + " of " + std::to_string(body.elastic) + " elastic links " +
           (hasOthers ? "of body \"" + body.name + "\" " : "") + "are softer than asked, down to " +
           std::to_string(std::lround(100 * body.softest)) + " %";
}

void warnAboutStiffness(LoadedScene& loaded) {
    constexpr std::size_t mostNamed = 4;
    const sim::Settings& settings = loaded.settings;
    sim::StiffnessReport stiffness = sim::inspectStiffness(loaded.scene, settings);
    const bool isReachable = stiffness.neededSubsteps > 0;
    const bool isRough = isReachable && settings.solver != sim::Solver::split;
    std::vector<sim::BodyStiffness>& bodies = stiffness.bodies;
    std::erase_if(bodies, [&](const sim::BodyStiffness& body) {
        return 2 * body.soft <= body.elastic || (isRough && body.mean > roughlyKept);
    });
    std::ranges::stable_sort(bodies, {}, &sim::BodyStiffness::softest);
    const std::string percent = std::to_string(std::lround(100 * double{settings.tolerance})) + " %";
    const std::string cure = isReachable
                                 ? giveSubsteps(loaded, stiffness.neededSubsteps) +
                                       " would keep all links of the scene within " + percent
                                 : "no number of substeps reaches " + percent + ", use weight or iterations";
    for (std::size_t b = 0; b < bodies.size() && b < mostNamed; ++b)
        loaded.warnings.push_back(softnessText(bodies[b], loaded.scene.bodies.size() > 1) + ": " + cure);
    if (bodies.size() > mostNamed)
        loaded.warnings.push_back("so are most elastic links of " +
                                  sim::counted(bodies.size() - mostNamed, "other body", "other bodies"));
}

// A tenth: some per cent are no news.
void warnAboutDrag(LoadedScene& loaded) {
    const double decay = double{loaded.scene.damping} * double{loaded.scene.dt} / loaded.settings.substeps;
    const double off = loaded.settings.solver == sim::Solver::split ? 1 - decay / std::expm1(decay)
                                                                    : decay / -std::expm1(-decay) - 1;
    const auto isZero = [](const sim::Vec3& g) { return g.x == 0 && g.y == 0 && g.z == 0; };
    if (decay == 0 || off <= 2 * sim::dragTolerance || isZero(loaded.scene.gravity)) return;
    loaded.warnings.push_back(
        "damping is so strong for " + std::to_string(loaded.settings.substeps) +
        " substeps that terminal speeds of bodies are off by " + std::to_string(std::lround(100 * off)) +
        " %: " + giveSubsteps(loaded, sim::dragSubsteps(loaded.scene)) + " keep them within " +
        std::to_string(std::lround(100 * sim::dragTolerance)) + " %");
}

void warnAboutMostSubsteps(LoadedScene& loaded) {
    const sim::SubstepChoice& choice = loaded.substeps;
    if (choice.reason != sim::SubstepReason::most || !choice.isReachable) return;
    const std::string dt = shorterSteps(loaded, choice.substeps, choice.wanted);
    const sim::SubstepCure cure = sim::cureOf(choice, loaded.settings);
    loaded.warnings.push_back("solver.substeps = \"auto\" stops at " + std::to_string(choice.substeps) +
                              ", " + std::to_string(choice.wanted) + " " + cure.would +
                              (choice.body.empty() ? "" : " in body \"" + choice.body + "\"") + ": give " +
                              (choice.wanted <= sim::ranges::substeps.high ? "that number, " : "") +
                              (dt.empty() ? "" : dt + ", ") + cure.otherwise);
}

// Down to half of what contacts ask for is a matter of taste; fewer let them give way, which no report of
// links shows.
void warnAboutContacts(LoadedScene& loaded) {
    if (loaded.substeps.reason != sim::SubstepReason::asked) return;
    const std::uint32_t given = loaded.settings.substeps;
    const sim::SubstepChoice asked = sim::contactSubsteps(loaded.scene);
    if (2 * given >= asked.wanted) return;
    loaded.warnings.push_back(sim::counted(given, "substep is", "substeps are") +
                              " few for these contacts: " + giveSubsteps(loaded, asked.wanted) + " " +
                              sim::cureOf(asked, loaded.settings).would);
}

// Searches go there on purpose, and a lattice bears more than is proven: no reason to refuse.
void warnAboutRelaxation(LoadedScene& loaded) {
    const sim::Settings& settings = loaded.settings;
    if (settings.solver != sim::Solver::jacobi) return;
    const double relaxation = sim::jacobiRelaxation(loaded.scene, settings);
    if (relaxation < sim::ranges::provenRelaxation) return;
    const auto text = [](double value) { return std::to_string(value).substr(0, 5); };
    const std::string bound = ", jacobi is proven stable only below 4/3: it may diverge";
    if (settings.weight > 0)
        loaded.warnings.push_back("solver.over_relaxation x solver.weight x constraints of a particle is " +
                                  text(relaxation) + bound);
    else
        loaded.warnings.push_back("solver.over_relaxation is " + text(relaxation) + bound);
}

void warnAboutSolver(LoadedScene& loaded) {
    if (loaded.settings.solver == sim::Solver::split && loaded.settings.iterations > 1)
        loaded.warnings.push_back("split makes one sweep per substep: iterations are ignored");
    warnAboutRelaxation(loaded);
    warnAboutStiffness(loaded);
    warnAboutMostSubsteps(loaded);
    warnAboutContacts(loaded);
    warnAboutDrag(loaded);
}

// A file that is tried with another solver, asked for from outside, has its own keys for a reason.
void warnOfForeignKeys(LoadedScene& loaded, const Section& solver) {
    static constexpr std::pair<const char*, sim::Solver> ofOne[] = {
        {"omega", sim::Solver::split},
        {"theta", sim::Solver::split},
        {"levels", sim::Solver::split},
        {"sharp_clamp", sim::Solver::split},
        {"weight", sim::Solver::jacobi},
        {"over_relaxation", sim::Solver::jacobi},
        {"warm_start", sim::Solver::gaussSeidel},
    };
    for (const auto& [key, of] : ofOne)
        if (solver.has(key) && of != loaded.settings.solver)
            loaded.warnings.push_back(std::string("solver.") + key + " is ignored by solver " +
                                      sim::solverName(loaded.settings.solver) + ": only " +
                                      sim::solverName(of) + " has it");
}

LoadedScene read(const std::string& text, const Source& source, const Overrides& overrides) {
    const toml::table table = parse(text, source.file);
    const Section top(table, "", "", source.file);
    LoadedScene loaded;
    loaded.scene.name = top.has("name") ? top.text("name") : fs::path(source.file).stem().string();
    loaded.scene.gravity = top.vector("gravity");
    loaded.scene.dt = top.number("dt");
    loaded.scene.damping = top.number("damping");
    loaded.scene.dampingTime = top.number("damping_time");
    const Section solver = top.child("solver");
    readSettings(loaded, solver, source.file);
    if (!solver.has("sharp_clamp")) loaded.settings.hasSharpClamp = overrides.isSharpByDefault;
    readContacts(loaded, top.child("contacts"));
    loaded.settings.keepsForces = top.child("report").flag("forces");
    loaded.scene.debris = top.count("debris");
    loaded.settings.cutSurfaceRoom = top.count("cut_surface_room");
    if (!overrides.solver) warnOfForeignKeys(loaded, top.child("solver"));
    apply(overrides, loaded);
    loaded.origin = originOf(top);
    readBodies(loaded, top, source, overrides.voxel);
    leaveWholeAsAsked(overrides, loaded);
    if (!top.child("contacts").has("room")) leaveRoom(loaded.settings, loaded.scene);
    if (top.has("camera")) {
        const Section camera = top.child("camera");
        loaded.camera = Camera{localPoint(camera, "eye", loaded.origin),
                               localPoint(camera, "target", loaded.origin), camera.number("field_of_view")};
    }
    if (const Section tools = top.child("tools"); tools.has("blade_depth"))
        loaded.bladeDepth = tools.number("blade_depth");
    if (loaded.settings.keepsForces) loaded.scene.holds = loaded.holds;
    requireForms(loaded, source.file);
    requireValid(loaded, source.file);
    loaded.substeps = sim::chooseSubsteps(loaded.scene, loaded.settings);
    loaded.settings.substeps = loaded.substeps.substeps;
    loaded.settings.levels = loaded.substeps.levels;
    warnAboutSizes(loaded);
    warnOfUntouched(loaded, top);
    const std::vector<std::string> ofScene = sim::warnings(loaded.scene);
    loaded.warnings.insert(loaded.warnings.end(), ofScene.begin(), ofScene.end());
    warnAboutSolver(loaded);
    return loaded;
}

LoadedScene readBuiltIn(const std::string& name, const std::optional<fs::path>& mesh,
                        const Overrides& overrides) {
    return read(std::string(builtInText(name)), {name + ".toml (built in)", {}, mesh}, overrides);
}

} // namespace

std::vector<std::string> newWarnings(const LoadedScene& loaded, const sim::Settings& settings) {
    LoadedScene other{.scene = loaded.scene, .settings = settings};
    if (settings.solver == loaded.settings.solver && settings.substeps == loaded.settings.substeps)
        other.substeps = loaded.substeps; // the same choice
    other.warnings = sim::warnings(other.scene);
    warnAboutSolver(other);
    std::erase_if(other.warnings, [&](const std::string& warning) {
        return std::ranges::find(loaded.warnings, warning) != loaded.warnings.end();
    });
    return other.warnings;
}

LoadedScene load(const fs::path& argument, const Overrides& overrides) {
    requireRegularFile(argument);
    if (isScene(argument))
        return read(readText(argument), {argument.string(), argument.parent_path(), {}}, overrides);
    LoadedScene loaded = readBuiltIn("drop_mesh", argument, overrides);
    loaded.scene.name = argument.filename().string();
    return loaded;
}

LoadedScene loadText(const std::string& text, const std::string& name, const Overrides& overrides) {
    return read(text, {name, {}, {}}, overrides);
}

LoadedScene loadBuiltIn(const std::string& name, const Overrides& overrides) {
    return readBuiltIn(name, {}, overrides);
}

} // namespace sinew::scenes
