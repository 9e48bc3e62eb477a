// Checks a Scene and its Settings once and collects sentences. The allowed numbers are in ranges.hpp.
#include "sinew/validate.hpp"

#include "sim/collision/crowding.hpp"
#include "sim/compile/compile.hpp"
#include "sim/core/complaints.hpp"
#include "sim/cutting/cut_lists.hpp"
#include "sim/events/events.hpp"
#include "sim/forces/forces.hpp"
#include "sim/lattice/check_grid.hpp"
#include "sim/levels/levels.hpp"
#include "sim/model/coloring.hpp"
#include "sim/model/grids.hpp"
#include "sim/model/links.hpp"
#include "sim/model/touching.hpp"
#include "sim/motions/pool.hpp"
#include "sim/rigid/check_colliders.hpp"
#include "sim/stiffness/shares.hpp"
#include "sim/surface/check_skins.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <stdexcept>

namespace sinew::sim {

namespace {

struct SettingRow {
    const char* name;
    double (*value)(const Settings&);
    Range range;
};

constexpr SettingRow settingRows[] = {
    {"settings.tolerance", [](const Settings& s) { return double{s.tolerance}; }, ranges::tolerance},
    {"settings.iterations", [](const Settings& s) { return static_cast<double>(s.iterations); },
     ranges::iterations},
    {"settings.omega", [](const Settings& s) { return double{s.omega}; }, ranges::omega},
    {"settings.theta", [](const Settings& s) { return double{s.theta}; }, ranges::theta},
    {"settings.weight", [](const Settings& s) { return double{s.weight}; }, ranges::weight},
    {"settings.overRelaxation", [](const Settings& s) { return double{s.overRelaxation}; },
     ranges::overRelaxation},
    {"settings.warmStart", [](const Settings& s) { return double{s.warmStart}; }, ranges::warmStart},
    {"settings.contactMargin", [](const Settings& s) { return double{s.contactMargin}; },
     ranges::contactMargin},
    {"settings.contactRoom", [](const Settings& s) { return static_cast<double>(s.contactRoom); },
     ranges::contactRoom},
    {"settings.cutSurfaceRoom", [](const Settings& s) { return static_cast<double>(s.cutSurfaceRoom); },
     ranges::cutSurfaceRoom},
    {"settings.framesInFlight", [](const Settings& s) { return 1.0 * s.framesInFlight; },
     ranges::framesInFlight},
    {"settings.outputFrames", [](const Settings& s) { return 1.0 * s.outputFrames; }, ranges::outputFrames},
    {"settings.forms.columns", [](const Settings& s) { return 1.0 * s.forms.columns; }, ranges::columns},
    {"settings.forms.chunk", [](const Settings& s) { return 1.0 * s.forms.chunk; }, ranges::chunk},
};

void checkSolver(Solver solver, Complaints& complaints) {
    Solver known = solver;
    if (!parseSolver(solverName(solver), known) || known != solver)
        complaints.add("settings.solver", "is " + number(static_cast<int>(solver)) + ", which is no solver");
}

std::uint64_t sweepsOf(const Settings& settings, std::uint32_t substeps) {
    return std::uint64_t{substeps} * (settings.solver == Solver::split ? 1 : settings.iterations);
}

// A number of substeps that is still to be chosen is 0 here: checkChosenSweeps checks the chosen one.
void checkSweeps(const Settings& settings, Complaints& complaints) {
    const std::uint64_t sweeps = sweepsOf(settings, settings.substeps);
    if (sweeps > ranges::mostSweeps)
        complaints.add("settings", "substeps x iterations is " + number(sweeps) + ", must be at most " +
                                       number(ranges::mostSweeps));
}

void checkGrabs(const Settings& settings, Complaints& complaints) {
    if (settings.grabs > ranges::mostGrabs)
        complaints.add("settings.grabs",
                       "is " + number(settings.grabs) + ", must be at most " + number(ranges::mostGrabs));
    if (settings.hostColliders > ranges::mostHostColliders)
        complaints.add("settings.hostColliders", "is " + number(settings.hostColliders) +
                                                     ", must be at most " +
                                                     number(ranges::mostHostColliders));
    if (settings.fields > ranges::mostFields)
        complaints.add("settings.fields",
                       "is " + number(settings.fields) + ", must be at most " + number(ranges::mostFields));
    if (settings.motions > ranges::mostMotions)
        complaints.add("settings.motions",
                       "is " + number(settings.motions) + ", must be at most " + number(ranges::mostMotions));
}

void checkOutputUsage(const Settings& settings, Complaints& complaints) {
    if (const std::uint32_t others = settings.outputUsage & ~ranges::outputUsages; others != 0)
        complaints.add("settings.outputUsage",
                       "has bit " + number(std::countr_zero(others)) +
                           " of VkBufferUsageFlags, must have bits 0 to 8, 17 (device "
                           "address) or 19 (input of acceleration structures)");
}

void checkSleep(const Settings& settings, Complaints& complaints) {
    if (settings.solver != Solver::split && settings.sleeps)
        complaints.add("settings.sleeps", std::string("is set, but solver ") + solverName(settings.solver) +
                                              " does not support bodies that sleep: use split");
}

void checkSettings(const Settings& settings, Complaints& complaints) {
    checkSolver(settings.solver, complaints);
    if (settings.substeps > 0 && !ranges::substeps.holds(static_cast<double>(settings.substeps)))
        complaints.add("settings.substeps", "is " + number(settings.substeps) + ", must be " +
                                                toText(ranges::substeps) + ", or 0 for as many as it takes");
    for (const SettingRow& row : settingRows)
        complaints.check(row.value(settings), row.range, [&] { return row.name; });
    const double bound = ranges::omegaBound(double{settings.theta});
    if (settings.solver == Solver::split && double{settings.omega} >= bound)
        complaints.add("settings.omega", "is " + number(settings.omega) +
                                             ", but split is stable only below 4 / (1 + 2 theta) = " +
                                             number(static_cast<float>(bound)));
    checkGrabs(settings, complaints);
    checkOutputUsage(settings, complaints);
    checkSleep(settings, complaints);
    if (complaints.isEmpty()) checkSweeps(settings, complaints);
}

void checkParticles(const Scene& scene, Complaints& complaints) {
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Particle& p = scene.particles[i];
        const auto name = [i](const char* member) {
            return [i, member] { return element("particle", i) + "." + member; };
        };
        complaints.checkFinite(p.position, name("position"));
        complaints.checkFinite(p.velocity, name("velocity"));
        complaints.check(double{p.inverseMass}, ranges::inverseMass, name("inverseMass"));
        complaints.check(double{p.contactOffset}, ranges::finite, name("contactOffset"));
        complaints.check(double{p.radius}, ranges::radius, name("radius"));
        complaints.checkIndex(p.surface, scene.contacts.surfaces.size() + 1, "surfaces, with the scene's own",
                              name("surface"));
    }
}

void checkConstraints(const Scene& scene, Complaints& complaints) {
    const std::size_t count = scene.particles.size();
    for (std::size_t i = 0; i < scene.distances.size(); ++i) {
        const DistanceConstraint& d = scene.distances[i];
        const auto name = [i](const char* member) {
            return [i, member] { return element("distance", i) + member; };
        };
        complaints.checkIndex(d.a, count, "particles", name(".a"));
        complaints.checkIndex(d.b, count, "particles", name(".b"));
        if (d.a == d.b)
            complaints.add(element("distance", i),
                           "particles " + number(d.a) + " and " + number(d.b) + " are the same");
        complaints.check(double{d.restLength}, ranges::restLength, name(".restLength"));
        complaints.check(double{d.compliance}, ranges::compliance, name(".compliance"));
    }
    for (std::size_t i = 0; i < scene.fixed.size(); ++i)
        complaints.checkIndex(scene.fixed[i].particle, count, "particles",
                              [i] { return element("fixed", i) + ".particle"; });
}

void checkBends(const Scene& scene, Complaints& complaints) {
    const std::size_t count = scene.particles.size();
    std::vector<std::uint32_t> bends(count); // by particle
    for (std::size_t i = 0; i < scene.bends.size(); ++i) {
        const BendConstraint& bend = scene.bends[i];
        for (const std::uint32_t end : {bend.a, bend.b, bend.c}) {
            complaints.checkIndex(end, count, "particles", [i] { return element("bend", i); });
            if (end < count && ++bends[end] == ranges::mostBends + 1)
                complaints.add(element("particle", end), "has more than " + number(ranges::mostBends) +
                                                             " bends, the most that a particle may have");
        }
        if (bend.a == bend.b || bend.b == bend.c || bend.c == bend.a)
            complaints.add(element("bend", i), "particles " + number(bend.a) + ", " + number(bend.b) +
                                                   " and " + number(bend.c) + " are not distinct");
        complaints.check(double{bend.compliance}, ranges::compliance,
                         [i] { return element("bend", i) + ".compliance"; });
    }
}

void checkAttachments(const Scene& scene, Complaints& complaints) {
    if (scene.attachments.size() > ranges::mostAttachments)
        complaints.add("attachments", "are " + number(scene.attachments.size()) + ", at most " +
                                          number(ranges::mostAttachments) + " are possible");
    std::vector<bool> isTaken(scene.particles.size());
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        const Attachment& attachment = scene.attachments[i];
        const auto name = [i](const char* member) {
            return [i, member] { return element("attachment", i) + "." + member; };
        };
        complaints.checkIndex(attachment.particle, isTaken.size(), "particles", name("particle"));
        if (attachment.particle < isTaken.size()) {
            if (isTaken[attachment.particle])
                complaints.add(element("attachment", i),
                               "particle " + number(attachment.particle) + " has an attachment already");
            isTaken[attachment.particle] = true;
        }
        complaints.checkFinite(attachment.anchor, name("anchor"));
        complaints.check(double{attachment.compliance}, ranges::compliance, name("compliance"));
        complaints.check(double{attachment.maxForce}, ranges::maxForce, name("maxForce"));
        complaints.check(double{attachment.maxSpeed}, ranges::maxSpeed, name("maxSpeed"));
    }
}

// By particle: whether it never moves; `fixed` may name particles that do not exist.
std::vector<bool> heldParticles(const Scene& scene) {
    std::vector<bool> isHeld(scene.particles.size());
    for (std::size_t i = 0; i < isHeld.size(); ++i) isHeld[i] = scene.particles[i].inverseMass == 0;
    for (const FixedConstraint& fixed : scene.fixed)
        if (fixed.particle < isHeld.size()) isHeld[fixed.particle] = true;
    return isHeld;
}

void checkTethers(const Scene& scene, Complaints& complaints) {
    const std::vector<bool> isHeld = heldParticles(scene);
    for (std::size_t i = 0; i < scene.tethers.size(); ++i) {
        const Tether& tether = scene.tethers[i];
        const auto name = [i](const char* member) {
            return [i, member] { return element("tether", i) + "." + member; };
        };
        complaints.checkIndex(tether.particle, isHeld.size(), "particles", name("particle"));
        complaints.checkIndex(tether.anchor, isHeld.size(), "particles", name("anchor"));
        if (tether.anchor < isHeld.size() && !isHeld[tether.anchor])
            complaints.add(name("anchor")(),
                           "is particle " + number(tether.anchor) + ", which moves: fix it or take another");
        complaints.check(double{tether.length}, ranges::tetherLength, name("length"));
    }
}

void checkPlanes(const Scene& scene, Complaints& complaints) {
    if (scene.planes.size() > ranges::mostPlanes)
        complaints.add("planes", "are " + number(scene.planes.size()) + ", at most " +
                                     number(ranges::mostPlanes) + " are possible");
    for (std::size_t i = 0; i < scene.planes.size(); ++i) {
        const Plane& plane = scene.planes[i];
        const auto name = [i](const char* member) {
            return [i, member] { return element("plane", i) + "." + member; };
        };
        const Vec3& n = plane.normal;
        complaints.check(std::hypot(double{n.x}, double{n.y}, double{n.z}), ranges::normalLength,
                         name("normal: length"));
        complaints.check(double{plane.offset}, ranges::finite, name("offset"));
        complaints.check(double{plane.friction}, ranges::friction, name("friction"));
        complaints.check(double{plane.restitution}, ranges::restitution, name("restitution"));
        complaints.check(double{plane.staticFriction}, ranges::friction, name("staticFriction"));
    }
}

void checkBodies(const Scene& scene, Complaints& complaints) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& body = scene.bodies[i];
        const std::string name = element("body", i) + " \"" + body.name + "\"";
        const std::uint64_t end = std::uint64_t{body.firstParticle} + body.particleCount;
        if (end > scene.particles.size())
            complaints.add(name, "ends at particle " + number(end) + ", but there are " +
                                     number(scene.particles.size()) + " particles");
        complaints.check(double{body.restVolume}, ranges::restVolume, [&] { return name + ".restVolume"; });
        for (const float channel : {body.color.x, body.color.y, body.color.z})
            complaints.check(double{channel}, ranges::color, [&] { return name + ".color"; });
    }
}

void checkSurfaces(const ContactSettings& contacts, Complaints& complaints) {
    const auto check = [&](const std::string& name, const Surface& surface) {
        const auto member = [&](const char* label) { return [&name, label] { return name + label; }; };
        complaints.check(double{surface.friction}, ranges::friction, member(".friction"));
        complaints.check(double{surface.restitution}, ranges::restitution, member(".restitution"));
        complaints.check(double{surface.staticFriction}, ranges::friction, member(".staticFriction"));
    };
    check("scene.contacts", {contacts.friction, contacts.restitution, contacts.staticFriction});
    complaints.check(double{contacts.recoverySpeed}, ranges::recoverySpeed,
                     [] { return "scene.contacts.recoverySpeed"; });
    if (contacts.surfaces.size() > ranges::mostSurfaces)
        complaints.add("scene.contacts.surfaces", "are " + number(contacts.surfaces.size()) + ", at most " +
                                                      number(ranges::mostSurfaces) + " are possible");
    for (std::size_t i = 0; i < contacts.surfaces.size(); ++i)
        check(element("scene.contacts.surfaces", i), contacts.surfaces[i]);
}

void checkFaces(const Scene& scene, Complaints& complaints) {
    if (scene.faces.size() > ranges::mostFaces)
        complaints.add("faces", "are " + number(scene.faces.size()) + ", at most " +
                                    number(ranges::mostFaces) + " are possible");
    for (std::size_t i = 0; i < scene.faces.size(); ++i) {
        const auto [a, b, c] = scene.faces[i].particles;
        for (const std::uint32_t corner : {a, b, c})
            complaints.checkIndex(corner, scene.particles.size(), "particles",
                                  [i] { return element("face", i) + ".particles"; });
        if (a == b || b == c || c == a)
            complaints.add(element("face", i), "particles " + number(a) + ", " + number(b) + " and " +
                                                   number(c) + " are not distinct");
        complaints.check(double{scene.faces[i].thickness}, ranges::radius,
                         [i] { return element("face", i) + ".thickness"; });
    }
}

// Complains about contacts in a scene whose solver does not support them; they are not ignored.
void checkContacts(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (settings.solver == Solver::split) return;
    const auto refuse = [&](const char* what) {
        complaints.add(std::string("solver ") + solverName(settings.solver) + " does not support " + what,
                       "use split");
    };
    if (particlesTouch(scene)) refuse("particles that touch each other (Particle::radius)");
    if (facesTouch(scene)) refuse("particles that touch faces (Scene::faces)");
    if (!scene.driven.empty()) refuse("bodies that are driven (Scene::driven)");
}

// Needs a scene that is otherwise valid: the number follows from its links. Most settings skip the check.
void checkChosenSweeps(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (settings.substeps > 0 || sweepsOf(settings, ranges::mostChosen) <= ranges::mostSweeps) return;
    checkSweeps(withSubsteps(scene, settings), complaints);
}

// Needs a scene that is otherwise valid: coloring trusts the indices of constraints.
void checkColors(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (settings.solver != Solver::gaussSeidel) return;
    const std::vector<float> inverseMass = inverseMasses(scene);
    const std::size_t links = colorByParticles(scene, inverseMass).colorCount(),
                      colors = links + colorBends(scene, inverseMass).colorCount();
    const std::uint64_t passes = std::uint64_t{chooseSubsteps(scene, settings).substeps} *
                                 (settings.iterations * colors + (scene.dampingTime > 0 ? links : 0));
    if (passes > ranges::mostColorPasses)
        complaints.add("settings", "substeps x iterations x " + number(colors) + " colors of constraints" +
                                       (scene.dampingTime > 0 ? ", damping included, is " : " is ") +
                                       number(passes) + " passes of gauss_seidel, must be at most " +
                                       number(ranges::mostColorPasses));
}

// The limit is lower where the warm start of `gauss_seidel` unrolls links of moving particles.
void checkLinks(const Scene& scene, const Settings& settings, Complaints& complaints) {
    const bool isUnrolled = settings.solver == Solver::gaussSeidel && settings.warmStart > 0;
    const std::vector<bool> isHeld = heldParticles(scene);
    const auto mostOf = [&](std::uint32_t end) {
        return isUnrolled && !isHeld[end] ? ranges::mostLinksUnrolled : ranges::mostLinks;
    };
    std::vector<std::uint32_t> links(scene.particles.size());
    for (const DistanceConstraint& constraint : scene.distances)
        for (const std::uint32_t end : {constraint.a, constraint.b})
            if (constraint.a != constraint.b && end < links.size() && ++links[end] == mostOf(end) + 1)
                complaints.add(element("particle", end),
                               "has more than " + number(mostOf(end)) +
                                   " distance constraints, the most this solver takes" +
                                   (mostOf(end) < ranges::mostLinks ? " with a warm start" : ""));
}

std::string nameOf(const Scene& scene, std::size_t grid) {
    return element("grid", grid) + " \"" + scene.grids[grid].name + "\"";
}

// A range that a grid claims. Particles or links claimed by two grids would be placed and computed twice.
struct Claim {
    std::size_t grid;
    std::uint64_t first, count;
};

void checkClaims(const Scene& scene, std::vector<Claim> claims, const char* counted, Complaints& complaints) {
    std::erase_if(claims, [](const Claim& claim) { return claim.count == 0; });
    std::ranges::stable_sort(claims, {}, &Claim::first);
    for (std::size_t i = 1, farthest = 0; i < claims.size(); ++i) {
        const std::uint64_t end = claims[farthest].first + claims[farthest].count;
        if (claims[i].first < end)
            complaints.add(nameOf(scene, claims[i].grid), std::string("shares ") + counted + " with " +
                                                              nameOf(scene, claims[farthest].grid) +
                                                              ", must have its own");
        if (claims[i].first + claims[i].count > end) farthest = i;
    }
}

void checkOverlap(const Scene& scene, Complaints& complaints) {
    std::vector<Claim> particles, distances;
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        particles.push_back({g, grid.firstParticle, grid.node.size()});
        distances.push_back({g, grid.firstDistance, grid.distanceCount});
    }
    checkClaims(scene, std::move(particles), "particles", complaints);
    checkClaims(scene, std::move(distances), "distance constraints", complaints);
}

void checkGrids(const Scene& scene, Complaints& complaints) {
    double nodes = 0;
    for (const Grid& grid : scene.grids)
        nodes += static_cast<double>(grid.nodes[0]) * grid.nodes[1] * grid.nodes[2];
    if (nodes > ranges::mostGridNodes) {
        complaints.add("grids", "have " + number(nodes) + " nodes, at most " + number(ranges::mostGridNodes) +
                                    " are possible");
        return;
    }
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        const auto name = [&](const char* member) {
            return [&, member] { return nameOf(scene, g) + member; };
        };
        // checked first: NaN agrees with no list
        for (const float compliance : grid.compliance)
            complaints.check(double{compliance}, ranges::compliance, name(".compliance"));
        for (const float length : grid.restLength)
            complaints.check(double{length}, ranges::restLength, name(".restLength"));
        complaints.check(double{grid.volumeStiffness}, ranges::pressure, name(".volumeStiffness"));
        complaints.check(double{grid.recoveryPressure}, ranges::pressure, name(".recoveryPressure"));
        if (hasCellVolumes(grid) && grid.restLength[0] == 0)
            complaints.add(name(".restLength")(), "is 0, must be above 0 where cells have volumes");
        if (const auto complaint = lattice::complaintAbout(scene, grid))
            complaints.add(element("grid", g), *complaint);
        if (lattice::isSheet(grid) && hasCellVolumes(grid))
            complaints.add(nameOf(scene, g), "is a sheet, whose cells have no volume");
        complaints.check(double{grid.tearStrain}, ranges::tearStrain, name(".tearStrain"));
        complaints.check(static_cast<double>(grid.tearsPerStep), ranges::tearsPerStep, name(".tearsPerStep"));
        complaints.check(double{grid.toughness}, ranges::toughness, name(".toughness"));
        if (!grid.isCuttable && (grid.tearStrain > 0 || grid.toughness > 0))
            complaints.add(nameOf(scene, g), "tears or is tough, which only a body with isCuttable can");
    }
    checkOverlap(scene, complaints);
}

// The reason why computedGrids() omits a body although solver and forms allow it, and the remedy.
std::string whyNotComputed(const Scene& scene, std::uint32_t g) {
    if (!scene.bends.empty()) {
        std::set<std::string> bodies;
        for (const BendConstraint& bend : scene.bends) bodies.insert(bodyOf(scene, bend.b));
        std::string names;
        for (const std::string& body : bodies) names += (names.empty() ? "" : ", ") + ("\"" + body + "\"");
        return "but " +
               (bodies.contains("")  ? "the scene has"
                : bodies.size() == 1 ? "body " + names + " has"
                                     : "bodies " + names + " have") +
               " a bending stiffness (bends), beside which split does not support that: make it 0";
    }
    if (scene.dampingTime > 0)
        return "but the scene has a damping time (internal damping), beside which split does not support "
               "that: make it 0";
    const Grid& grid = scene.grids[g];
    const auto isOfGrid = [&](std::uint32_t i) { return i - grid.firstParticle < grid.node.size(); };
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& link = scene.distances[c];
        const bool isOwn = c >= grid.firstDistance && c - grid.firstDistance < grid.distanceCount;
        if (!isOwn && (isOfGrid(link.a) || isOfGrid(link.b)))
            return "but " + element("distance", c) + " holds it beside its own links: leave that out";
    }
    return "but split does not support that";
}

// Cuttable links exist only where `split` computes a body. The scene must be otherwise valid.
void checkCutting(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (std::ranges::none_of(scene.grids, &Grid::isCuttable)) return;
    const std::vector<std::uint32_t> computed = computedGrids(scene, settings);
    for (std::uint32_t g = 0; g < scene.grids.size(); ++g) {
        if (!scene.grids[g].isCuttable) continue;
        const std::string may = "may be cut, ";
        if (settings.solver != Solver::split)
            complaints.add(nameOf(scene, g), may + "which solver " + solverName(settings.solver) +
                                                 " does not support: use split");
        else if (cutting::isListed(scene, settings, g, computed)) {
            const std::string tied = cutting::tiedPast(scene, scene.grids[g]);
            if (!tied.empty())
                complaints.add(nameOf(scene, g), may + "but " + tied +
                                                     " leads out of it, or past more than one of its nodes: "
                                                     "leave it out or do not cut the sheet");
        } else if (!settings.forms.usesGrids)
            complaints.add(nameOf(scene, g), may + "which needs settings.forms.usesGrids");
        else if (!std::ranges::binary_search(computed, g))
            complaints.add(nameOf(scene, g), may + whyNotComputed(scene, g));
    }
}

// No list of constraints holds volumes: a scene that cannot compute them is refused, so that they are not
// lost silently. The scene must be otherwise valid.
void checkCellVolumes(const Scene& scene, const Settings& settings, Complaints& complaints) {
    std::vector<std::uint32_t> computed;
    if (std::ranges::any_of(scene.grids, hasCellVolumes)) computed = computedGrids(scene, settings);
    for (std::uint32_t g = 0; g < scene.grids.size(); ++g) {
        if (!hasCellVolumes(scene.grids[g])) continue;
        const std::string has = "has cell volumes (a Poisson ratio above 1/4 or recovery), ";
        if (settings.solver != Solver::split)
            complaints.add(nameOf(scene, g), has + "which solver " + solverName(settings.solver) +
                                                 " does not support: use split");
        else if (!settings.forms.usesGrids)
            complaints.add(nameOf(scene, g), has + "which need settings.forms.usesGrids");
        else if (!std::ranges::binary_search(computed, g))
            complaints.add(nameOf(scene, g), has + whyNotComputed(scene, g));
        if (scene.grids[g].recoveryPressure > 0 && stiffness::recoveryBudget(settings) <= 0)
            complaints.add("settings.omega",
                           "is " + number(settings.omega) + ", but recovery needs it below " +
                               number(static_cast<float>(0.9 * ranges::omegaBound(double{settings.theta}))));
    }
}

} // namespace

bool canRecover(const Scene& scene, const Settings& settings) {
    return settings.solver == Solver::split && settings.forms.usesGrids && linksFitGrids(scene) &&
           scene.dampingTime == 0 && stiffness::recoveryBudget(settings) > 0;
}

std::string toText(const Range& range) {
    const bool hasLow = range.low > -ranges::largest, hasHigh = range.high < ranges::largest;
    // Prints as float32: 0.1f is slightly more than 0.1 and must still read "0.1".
    const auto bound = [](double value) { return number(static_cast<float>(value)); };
    const std::string low = (range.isLowOpen ? "above " : "at least ") + (hasLow ? bound(range.low) : "");
    const std::string high = (range.isHighOpen ? "below " : "at most ") + (hasHigh ? bound(range.high) : "");
    if (hasLow && hasHigh && !range.isLowOpen && !range.isHighOpen)
        return "from " + bound(range.low) + " to " + bound(range.high);
    if (hasLow && hasHigh) return low + " and " + high;
    if (hasLow) return low;
    return hasHigh ? high : "a finite number";
}

std::vector<std::string> validate(const Scene& scene, const Settings& settings) {
    Complaints complaints;
    checkSettings(settings, complaints);
    complaints.check(double{scene.dt}, ranges::dt, [] { return "scene.dt"; });
    complaints.check(double{scene.damping}, ranges::damping, [] { return "scene.damping"; });
    complaints.check(static_cast<double>(scene.debris), ranges::debris, [] { return "scene.debris"; });
    complaints.check(double{scene.dampingTime}, ranges::dampingTime, [] { return "scene.dampingTime"; });
    complaints.checkFinite(scene.gravity, [] { return "scene.gravity"; });
    checkParticles(scene, complaints);
    checkConstraints(scene, complaints);
    checkBends(scene, complaints);
    checkAttachments(scene, complaints);
    checkTethers(scene, complaints);
    checkFaces(scene, complaints);
    if (complaints.isEmpty()) checkContacts(scene, settings, complaints);
    if (complaints.isEmpty()) forces::check(scene, settings, complaints);
    events::check(scene, settings, complaints);
    levels::check(scene, settings, complaints);
    checkLinks(scene, settings, complaints);
    checkSurfaces(scene.contacts, complaints);
    checkPlanes(scene, complaints);
    rigid::checkColliders(scene.colliders, complaints);
    rigid::checkDriven(scene, heldParticles(scene), complaints);
    checkBodies(scene, complaints);
    checkGrids(scene, complaints);
    for (std::size_t i = 0; i < scene.skins.size(); ++i)
        surface::checkSkin(scene.skins[i], element("skin", i), scene.particles.size(), complaints);
    if (complaints.isEmpty()) motions::checkPool(scene, settings, complaints);
    if (complaints.isEmpty()) checkCutting(scene, settings, complaints);
    if (complaints.isEmpty()) checkCellVolumes(scene, settings, complaints);
    if (complaints.isEmpty()) collision::checkCrowding(scene, complaints);
    if (complaints.isEmpty()) checkChosenSweeps(scene, settings, complaints);
    if (complaints.isEmpty()) checkColors(scene, settings, complaints);
    if (complaints.isEmpty() && settings.keepsForces && !scene.particles.empty())
        forces::checkRoom(SceneModel(scene, withSubsteps(scene, settings)), complaints);
    return complaints.finish();
}

std::vector<std::string> validate(const Settings& settings) {
    Complaints complaints;
    checkSettings(settings, complaints);
    return complaints.finish();
}

void requireNone(const std::vector<std::string>& complaints) {
    if (complaints.empty()) return;
    std::string text;
    for (const std::string& complaint : complaints) text += (text.empty() ? "" : "\n") + complaint;
    throw std::invalid_argument(text);
}

} // namespace sinew::sim
