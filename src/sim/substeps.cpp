// Every rule works on one list of terms, so that a solver is a row of a table here and a constraint a loop
// that appends.
#include "sim/substeps.hpp"

#include "sim/compile.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/ranges.hpp"
#include "sim/solvers/shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sinew::sim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-6; // of float32 inverse masses and compliances

// What the rules need of a constraint.
struct Term {
    double stiffness = 0;   // [N/m]; of a rigid one what its load asks for, 0 = nothing
    double clamp = 0;       // `split`: k h^2 at most [kg]
    double inverseMass = 0; // sum of w |grad|^2 [1/kg]
    double share = 1;       // `jacobi`: of its correction, after all iterations
    bool isRigid = false;
};

// What a scene is, whatever the number of substeps; of each particle.
struct Load {
    std::vector<float> inverseMass;
    std::vector<std::uint32_t> links, bends; // that can move
    std::vector<double> weights;             // on one of the links that its body hangs on [N]
    std::uint32_t mostConstraints(std::initializer_list<std::uint32_t> ends) const {
        std::uint32_t most = 0;
        for (const std::uint32_t end : ends) most = std::max(most, links[end] + bends[end]);
        return most;
    }
};

bool canMove(const Load& load, std::initializer_list<std::uint32_t> ends) {
    return std::ranges::any_of(ends, [&](std::uint32_t end) { return load.inverseMass[end] > 0; });
}

// k h^2 at most [kg].
double clampOfLink(const solvers::Shares& shares, const Scene& scene, std::size_t link) {
    const DistanceConstraint& c = scene.distances[link];
    return double{shares.ofLinks[link]} * double{std::min(shares.times[c.a], shares.times[c.b])};
}

double splitOfBend(const Load& load, const BendConstraint& c) {
    const auto end = [&](std::uint32_t i) { return load.bends[i] * double{load.inverseMass[i]}; };
    return end(c.a) + 4 * end(c.b) + end(c.c);
}

// What is left of 1 after `iterations` in which the slower end takes a share of each correction.
double shareAfter(const Settings& settings, std::uint32_t mostConstraints) {
    const double weight = settings.weight > 0 ? double{settings.weight} : 1.0 / std::max(1u, mostConstraints);
    const double share = std::min(1.0, double{settings.overRelaxation} * weight);
    return 1 - std::pow(1 - share, settings.iterations);
}

// Which particles hang together, by links.
std::vector<std::uint32_t> componentsOf(const Scene& scene) {
    std::vector<std::uint32_t> parent(scene.particles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const DistanceConstraint& c : scene.distances) parent[root(c.a)] = root(c.b);
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

// The weight on one of the links that a particle's body hangs on [N]; 0 for bodies that hang on nothing.
std::vector<double> hangingWeights(const Scene& scene, const std::vector<float>& inverseMass) {
    const std::vector<std::uint32_t> component = componentsOf(scene);
    std::vector<double> mass(component.size(), 0), holding(component.size(), 0);
    for (std::size_t i = 0; i < component.size(); ++i)
        if (inverseMass[i] > 0) mass[component[i]] += 1 / double{inverseMass[i]};
    for (const DistanceConstraint& c : scene.distances)
        if ((inverseMass[c.a] == 0) != (inverseMass[c.b] == 0)) ++holding[component[c.a]];
    const Vec3& g = scene.gravity;
    const double gravity = std::hypot(double{g.x}, double{g.y}, double{g.z});
    std::vector<double> weights(component.size(), 0);
    for (std::size_t i = 0; i < component.size(); ++i) {
        const std::uint32_t body = component[i];
        if (holding[body] > 0) weights[i] = gravity * mass[body] / holding[body];
    }
    return weights;
}

Load loadOf(const Scene& scene) {
    Load load{.inverseMass = inverseMasses(scene), .links = {}, .bends = {}, .weights = {}};
    load.links.assign(scene.particles.size(), 0);
    load.bends.assign(scene.particles.size(), 0);
    bool hasRigid = false;
    for (const DistanceConstraint& c : scene.distances) {
        if (canMove(load, {c.a, c.b})) ++load.links[c.a], ++load.links[c.b];
        hasRigid = hasRigid || c.compliance == 0;
    }
    for (const BendConstraint& c : scene.bends)
        if (canMove(load, {c.a, c.b, c.c})) ++load.bends[c.a], ++load.bends[c.b], ++load.bends[c.c];
    if (hasRigid) load.weights = hangingWeights(scene, load.inverseMass);
    return load;
}

// How `split` divides the particles; settings.substeps is a number. Other solvers divide nothing.
solvers::Shares sharesFor(const Scene& scene, const Settings& settings, const Load& load) {
    if (settings.solver != Solver::split) return {};
    return solvers::sharesOf(scene, settings, load.inverseMass);
}

// The terms of a scene: millions, so that they are visited and not kept.
struct Terms {
    const Scene& scene;
    const Settings& settings;
    const Load& load;
    solvers::Shares shares = sharesFor(scene, settings, load);

    bool isSplit() const { return settings.solver == Solver::split; }
    double shareAmong(std::initializer_list<std::uint32_t> ends) const {
        return settings.solver == Solver::jacobi ? shareAfter(settings, load.mostConstraints(ends)) : 1;
    }

    template <typename Visit> void forEachLink(const Visit& visit) const {
        for (std::size_t i = 0; i < scene.distances.size(); ++i) {
            const DistanceConstraint& c = scene.distances[i];
            if (!canMove(load, {c.a, c.b})) continue;
            Term term{.clamp = isSplit() ? clampOfLink(shares, scene, i) : 0,
                      .inverseMass = double{load.inverseMass[c.a]} + double{load.inverseMass[c.b]},
                      .share = shareAmong({c.a, c.b}),
                      .isRigid = c.compliance == 0};
            if (!term.isRigid)
                term.stiffness = 1 / double{c.compliance};
            else if (c.restLength > 0)
                term.stiffness = load.weights[c.a] / (double{settings.tolerance} * double{c.restLength});
            visit(term);
        }
    }

    template <typename Visit> void forEachBend(const Visit& visit) const {
        const double omega = solvers::omegaOfBends(settings);
        for (const BendConstraint& c : scene.bends) {
            if (c.compliance == 0 || !canMove(load, {c.a, c.b, c.c})) continue;
            visit(Term{.stiffness = 1 / double{c.compliance},
                       .clamp = omega / splitOfBend(load, c),
                       .inverseMass = double{load.inverseMass[c.a]} + 4 * double{load.inverseMass[c.b]} +
                                      double{load.inverseMass[c.c]},
                       .share = shareAmong({c.a, c.b, c.c})});
        }
    }

    // Cells about their rest volume: k is 0.75 lambda_v a (solvers/shares.hpp). Other solvers have no form
    // for them.
    template <typename Visit> void forEachCell(const Visit& visit) const {
        for (std::size_t g = 0; isSplit() && g < scene.grids.size(); ++g) {
            const Grid& grid = scene.grids[g];
            if (grid.volumeStiffness == 0) continue;
            const double whole = 0.75 * double{grid.volumeStiffness} * double{grid.restLength[0]};
            lattice::forEachCell(grid, [&](const lattice::Cell& cell) {
                float time = shares.times[cell.corners[0]];
                for (const std::uint32_t corner : cell.corners) time = std::min(time, shares.times[corner]);
                visit(Term{.stiffness = cell.fill * whole,
                           .clamp = cell.fill * double{shares.ofCells[g].volume} * double{time}});
            });
        }
    }

    template <typename Visit> void forEach(const Visit& visit) const {
        forEachLink(visit);
        forEachBend(visit);
        forEachCell(visit);
    }
};

// How a solver bounds stiffness: k_eff / k at h, and the longest h at which the part of its error that h
// decides stays within a tolerance. A rigid term has the stiffness at which its load stretches it by the
// tolerance: there k_max(h), the most a substep can be, counts.
struct Model {
    Solver solver;
    double (*reached)(const Term&, double h);
    double (*longest)(const Term&, double tolerance);
};

double reachedBySplit(const Term& term, double h) {
    return std::min(1.0, term.clamp / (term.stiffness * h * h));
}
double longestOfSplit(const Term& term, double tolerance) {
    const double wanted = (term.isRigid ? 1 : 1 - tolerance) * term.stiffness;
    return std::sqrt(term.clamp / wanted);
}
double reachedByCompliance(const Term& term, double h) {
    return 1 / (1 + h * h * term.inverseMass * term.stiffness);
}
double longestOfCompliance(const Term& term, double tolerance) {
    const double excess = term.isRigid ? 1 : tolerance / (1 - tolerance);
    return std::sqrt(excess / (term.inverseMass * term.stiffness));
}
// Whether any h brings an elastic term within the tolerance.
bool isReachable(const Term& term, double tolerance) {
    return term.share > 1 - tolerance + rounding;
}
double reachedByJacobi(const Term& term, double h) {
    return term.share * reachedByCompliance(term, h);
}
// What the shares of all iterations leave of the tolerance is left to h; where they leave none, all of it is.
double longestOfJacobi(const Term& term, double tolerance) {
    if (term.isRigid) return longestOfCompliance(term, tolerance) * std::sqrt(term.share);
    return longestOfCompliance(term,
                               isReachable(term, tolerance) ? 1 - (1 - tolerance) / term.share : tolerance);
}

constexpr Model models[] = {
    {Solver::split, reachedBySplit, longestOfSplit},
    {Solver::jacobi, reachedByJacobi, longestOfJacobi},
    {Solver::gaussSeidel, reachedByCompliance, longestOfCompliance},
};

const Model& modelOf(Solver solver) {
    const auto found = std::ranges::find(models, solver, &Model::solver);
    return found == std::end(models) ? models[0] : *found;
}

std::uint32_t countFor(double dt, double h) {
    const double substeps = std::ceil(dt / h * (1 - rounding));
    return static_cast<std::uint32_t>(std::clamp(substeps, 1.0, 4e9));
}

// The longest h at which `split` bears the whole of dampingTime: the positive root of
// (1 + 2 theta) links h^2 + 2 dampingTime links h = 4 x 0.95; `links` the largest k D of an elastic term.
double longestOfDamping(const Terms& terms) {
    const Settings& settings = terms.settings;
    if (!terms.isSplit() || terms.scene.dampingTime == 0) return infinite;
    double links = 0; // rigid ones have no damping of their own
    terms.forEach([&](const Term& term) {
        if (!term.isRigid) links = std::max(links, term.stiffness * double{settings.omega} / term.clamp);
    });
    const double damping = double{terms.scene.dampingTime} * links;
    const double a = (1 + 2 * double{settings.theta}) * links;
    return damping == 0 ? infinite : (std::sqrt(damping * damping + 3.8 * a) - damping) / a;
}

// The longest substeps that each rule allows [s]; settings.substeps is the number that is tried.
struct Limits {
    double elastic = infinite, rigid = infinite, damped = infinite;
    double share = 1;        // the smallest of an elastic term
    bool isReachable = true; // the tolerance, by some number of substeps
};

constexpr int mostRounds = 6;

Limits limitsOf(const Terms& terms) {
    const Model& model = modelOf(terms.settings.solver);
    const double tolerance{terms.settings.tolerance};
    Limits limits;
    terms.forEach([&](const Term& term) {
        if (!term.isRigid) {
            limits.share = std::min(limits.share, term.share);
            limits.isReachable = limits.isReachable && isReachable(term, tolerance);
        }
        double& longest = term.isRigid ? limits.rigid : limits.elastic;
        if (term.stiffness > 0) longest = std::min(longest, model.longest(term, tolerance));
    });
    limits.damped = longestOfDamping(terms);
    return limits;
}

// With which elastic terms are within the tolerance; 0 = no number. The shares of `split` depend on h a
// little: a fixed point.
std::uint32_t neededFor(const Scene& scene, const Settings& settings, const Load& load) {
    Settings tried = settings;
    for (int round = 0; round < mostRounds; ++round) {
        const Limits limits = limitsOf({scene, tried, load});
        if (!limits.isReachable) return 0;
        const std::uint32_t wanted = countFor(double{scene.dt}, limits.elastic);
        if (wanted == tried.substeps) break;
        tried.substeps = wanted;
    }
    return tried.substeps;
}

bool hasOnlyFreeParticles(const Scene& scene) {
    return scene.distances.empty() && scene.bends.empty() && scene.attachments.empty() &&
           scene.planes.empty();
}

SplitBudget budgetOf(const Terms& terms) {
    const auto& [scene, settings, load, shares] = terms;
    SplitBudget budget{.omegaLinks = double{settings.omega}};
    if (!terms.isSplit()) return budget;
    for (std::size_t i = 0; i < scene.distances.size(); ++i) {
        const DistanceConstraint& c = scene.distances[i];
        if (canMove(load, {c.a, c.b})) // D_c is at most omega / clamp
            budget.links = std::max(budget.links, double{settings.omega} /
                                                      (double{c.compliance} * clampOfLink(shares, scene, i)));
    }
    if (scene.bends.empty()) return budget;
    budget.omegaBends = solvers::omegaOfBends(settings);
    for (const BendConstraint& c : scene.bends)
        if (canMove(load, {c.a, c.b, c.c}))
            budget.bends = std::max(budget.bends, splitOfBend(load, c) / double{c.compliance});
    return budget;
}

} // namespace

SplitBudget splitBudget(const Scene& scene, const Settings& settings) {
    const Load load = loadOf(scene);
    return budgetOf({scene, settings, load});
}

double dampingBudget(const SplitBudget& budget, double theta, double h) {
    const double s =
        std::min(budget.links * h * h, budget.omegaLinks) + std::min(budget.bends * h * h, budget.omegaBends);
    return std::max(0.0, 0.95 * (4 - s * (1 + 2 * theta)) / 2);
}

double jacobiRelaxation(const Scene& scene, const Settings& settings) {
    if (settings.weight == 0) return double{settings.overRelaxation};
    const Load load = loadOf(scene);
    std::uint32_t most = 0;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (load.inverseMass[i] > 0) most = std::max(most, load.mostConstraints({i}));
    return double{settings.overRelaxation} * double{settings.weight} * most;
}

SubstepChoice chooseSubsteps(const Scene& scene, const Settings& settings) {
    if (settings.substeps > 0) return {settings.substeps, settings.substeps, SubstepReason::asked};
    if (hasOnlyFreeParticles(scene)) return {1, 1, SubstepReason::fewest};
    // The shares of `split` depend on h a little, so that this is the fixed point of a few rounds.
    const Load load = loadOf(scene);
    Settings tried = settings;
    tried.substeps = ranges::fewestChosen;
    SubstepChoice choice;
    for (int round = 0; round < mostRounds; ++round) {
        const Limits limits = limitsOf({scene, tried, load});
        const double longest = std::min({limits.elastic, limits.rigid, limits.damped});
        choice.wanted = countFor(double{scene.dt}, longest);
        choice.share = limits.share;
        choice.isReachable = limits.isReachable;
        choice.reason = longest == limits.elastic ? SubstepReason::stiffness
                        : longest == limits.rigid ? SubstepReason::weight
                                                  : SubstepReason::damping;
        const std::uint32_t next = std::clamp(choice.wanted, ranges::fewestChosen, ranges::mostChosen);
        if (next == tried.substeps || (round + 2 > mostRounds && next < tried.substeps)) break;
        tried.substeps = next;
    }
    choice.substeps = tried.substeps;
    if (choice.wanted < choice.substeps && choice.substeps == ranges::fewestChosen)
        choice.reason = SubstepReason::fewest;
    if (choice.wanted > choice.substeps) choice.reason = SubstepReason::most;
    return choice;
}

Settings withSubsteps(const Scene& scene, Settings settings) {
    settings.substeps = chooseSubsteps(scene, settings).substeps;
    return settings;
}

StiffnessReport inspectStiffness(const Scene& scene, const Settings& asked) {
    const Settings settings = withSubsteps(scene, asked);
    const Load load = loadOf(scene);
    const Terms terms{scene, settings, load};
    StiffnessReport report;
    const Model& model = modelOf(settings.solver);
    const double h = double{scene.dt} / settings.substeps;
    const double budget = dampingBudget(budgetOf(terms), double{settings.theta}, h);
    double sum = 0, damping = 0;
    terms.forEach([&](const Term& term) {
        if (term.isRigid) return;
        const double reached = model.reached(term, h);
        ++report.elastic;
        report.clamped += terms.isSplit() && reached < 1 - rounding;
        report.soft += reached < 1 - double{settings.tolerance} - rounding;
        report.softest = std::min(report.softest, reached);
        sum += reached;
        // of a link's c = k dampingTime, h c D is at most the budget
        const double most = budget * term.clamp / double{settings.omega} / (term.stiffness * h);
        // `gauss_seidel`: implicit, link by link
        const double implicit =
            settings.solver == Solver::gaussSeidel ? h * term.inverseMass * term.stiffness : 0;
        damping += terms.isSplit() ? std::min(double{scene.dampingTime}, most)
                                   : double{scene.dampingTime} / (1 + double{scene.dampingTime} * implicit);
    });
    if (report.elastic == 0) return report;
    report.mean = sum / static_cast<double>(report.elastic);
    report.dampingTime = damping / static_cast<double>(report.elastic);
    report.neededSubsteps = neededFor(scene, settings, load);
    return report;
}

std::string toText(const SubstepChoice& choice, const Settings& settings) {
    const std::string percent = std::to_string(std::lround(100 * double{settings.tolerance})) + " %";
    if (!choice.isReachable)
        return std::to_string(choice.substeps) +
               " substeps: no number of substeps reaches the tolerance of " + percent + ", " +
               std::to_string(settings.iterations) + " iterations give a link " +
               std::to_string(std::lround(100 * choice.share)) +
               " % of its stiffness at most; use weight or iterations";
    std::string why;
    switch (choice.reason) {
    case SubstepReason::asked:
        why = "as asked";
        break;
    case SubstepReason::stiffness:
        why = "no link is more than " + percent + " softer than asked";
        break;
    case SubstepReason::weight:
        why = "no rigid link stretches by more than " + percent + " under what hangs on it";
        break;
    case SubstepReason::damping:
        why = "links damp as much as asked";
        break;
    case SubstepReason::fewest:
        why = "fewer would do for the stiffness";
        break;
    case SubstepReason::most:
        why = "the most chosen unasked; " + std::to_string(choice.wanted) + " would keep the tolerance of " +
              percent;
        break;
    }
    return std::to_string(choice.substeps) + " substeps: " + why;
}

} // namespace sinew::sim
