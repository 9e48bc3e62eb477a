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

// What the constraints of a scene do to its particles.
struct Counts {
    std::vector<float> inverseMass;
    std::vector<std::uint32_t> links, bends; // that can move, of each particle
};

bool canMove(const Counts& counts, std::initializer_list<std::uint32_t> ends) {
    return std::ranges::any_of(ends, [&](std::uint32_t end) { return counts.inverseMass[end] > 0; });
}

Counts count(const Scene& scene) {
    Counts counts{.inverseMass = inverseMasses(scene), .links = {}, .bends = {}};
    counts.links.assign(scene.particles.size(), 0);
    counts.bends.assign(scene.particles.size(), 0);
    for (const DistanceConstraint& c : scene.distances)
        if (canMove(counts, {c.a, c.b})) ++counts.links[c.a], ++counts.links[c.b];
    for (const BendConstraint& c : scene.bends)
        if (canMove(counts, {c.a, c.b, c.c})) ++counts.bends[c.a], ++counts.bends[c.b], ++counts.bends[c.c];
    return counts;
}

// The clamps of `split`, k h^2 at most [kg], of every distance constraint.
std::vector<double> clampsOfLinks(const Scene& scene, const Settings& settings, const Counts& counts) {
    const solvers::Shares shares = solvers::sharesOf(scene, settings, counts.inverseMass);
    std::vector<double> clamps;
    clamps.reserve(shares.ofLinks.size());
    for (std::size_t c = 0; c < shares.ofLinks.size(); ++c) {
        const DistanceConstraint& link = scene.distances[c];
        clamps.push_back(double{shares.ofLinks[c]} *
                         double{std::min(shares.times[link.a], shares.times[link.b])});
    }
    return clamps;
}

// What links leave of the stability bound, and no more than half of what they use.
double omegaOfBends(const Settings& settings) {
    const double left = ranges::omegaBound(double{settings.theta}) - double{settings.omega};
    return std::min(0.9 * left, double{settings.omega} / 2);
}

double splitOfBend(const Counts& counts, const BendConstraint& c) {
    const auto end = [&](std::uint32_t i) { return counts.bends[i] * double{counts.inverseMass[i]}; };
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
std::vector<double> hangingWeights(const Scene& scene, const Counts& counts) {
    const std::vector<std::uint32_t> component = componentsOf(scene);
    std::vector<double> mass(component.size(), 0), holding(component.size(), 0);
    for (std::size_t i = 0; i < component.size(); ++i)
        if (counts.inverseMass[i] > 0) mass[component[i]] += 1 / double{counts.inverseMass[i]};
    for (const DistanceConstraint& c : scene.distances)
        if ((counts.inverseMass[c.a] == 0) != (counts.inverseMass[c.b] == 0)) ++holding[component[c.a]];
    const Vec3& g = scene.gravity;
    const double gravity = std::hypot(double{g.x}, double{g.y}, double{g.z});
    std::vector<double> weights(component.size(), 0);
    for (std::size_t i = 0; i < component.size(); ++i) {
        const std::uint32_t body = component[i];
        if (holding[body] > 0) weights[i] = gravity * mass[body] / holding[body];
    }
    return weights;
}

void addLinks(const Scene& scene, const Settings& settings, const Counts& counts, std::vector<Term>& terms) {
    const std::vector<double> weights = hangingWeights(scene, counts);
    const bool isSplit = settings.solver == Solver::split;
    const std::vector<double> clamps =
        isSplit ? clampsOfLinks(scene, settings, counts) : std::vector<double>();
    for (std::size_t i = 0; i < scene.distances.size(); ++i) {
        const DistanceConstraint& c = scene.distances[i];
        if (!canMove(counts, {c.a, c.b})) continue;
        Term term{.clamp = isSplit ? clamps[i] : 0,
                  .inverseMass = double{counts.inverseMass[c.a]} + double{counts.inverseMass[c.b]},
                  .share = shareAfter(settings, std::max(counts.links[c.a] + counts.bends[c.a],
                                                         counts.links[c.b] + counts.bends[c.b])),
                  .isRigid = c.compliance == 0};
        if (!term.isRigid)
            term.stiffness = 1 / double{c.compliance};
        else if (c.restLength > 0)
            term.stiffness = weights[c.a] / (double{settings.tolerance} * double{c.restLength});
        terms.push_back(term);
    }
}

void addBends(const Scene& scene, const Settings& settings, const Counts& counts, std::vector<Term>& terms) {
    const double omega = omegaOfBends(settings);
    for (const BendConstraint& c : scene.bends) {
        if (c.compliance == 0 || !canMove(counts, {c.a, c.b, c.c})) continue;
        std::uint32_t most = 0;
        for (const std::uint32_t end : {c.a, c.b, c.c})
            most = std::max(most, counts.links[end] + counts.bends[end]);
        terms.push_back({.stiffness = 1 / double{c.compliance},
                         .clamp = omega / splitOfBend(counts, c),
                         .inverseMass = double{counts.inverseMass[c.a]} +
                                        4 * double{counts.inverseMass[c.b]} + double{counts.inverseMass[c.c]},
                         .share = shareAfter(settings, most)});
    }
}

// Cells about their rest volume: k is 0.75 lambda_v a (solvers/shares.hpp). Other solvers have no form for
// them.
void addCells(const Scene& scene, const Settings& settings, const Counts& counts, std::vector<Term>& terms) {
    if (settings.solver != Solver::split || std::ranges::none_of(scene.grids, hasCellVolumes)) return;
    const solvers::Shares shares = solvers::sharesOf(scene, settings, counts.inverseMass);
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        if (grid.volumeStiffness == 0) continue;
        const double whole = 0.75 * double{grid.volumeStiffness} * double{grid.restLength[0]};
        lattice::forEachCell(grid, [&](const lattice::Cell& cell) {
            float time = shares.times[cell.corners[0]];
            for (const std::uint32_t corner : cell.corners) time = std::min(time, shares.times[corner]);
            terms.push_back({.stiffness = cell.fill * whole,
                             .clamp = cell.fill * double{shares.ofCells[g].volume} * double{time}});
        });
    }
}

std::vector<Term> termsOf(const Scene& scene, const Settings& settings) {
    const Counts counts = count(scene);
    std::vector<Term> terms;
    addLinks(scene, settings, counts, terms);
    addBends(scene, settings, counts, terms);
    addCells(scene, settings, counts, terms);
    return terms;
}

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
double reachedByJacobi(const Term& term, double h) {
    return term.share * reachedByCompliance(term, h);
}
double longestOfJacobi(const Term& term, double tolerance) {
    return longestOfCompliance(term, tolerance) * (term.isRigid ? std::sqrt(term.share) : 1);
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
// (1 + 2 theta) links h^2 + 2 dampingTime links h = 4 x 0.95.
double longestOfDamping(const Scene& scene, const Settings& settings, const std::vector<Term>& terms) {
    double links = 0; // rigid ones have no damping of their own
    for (const Term& term : terms)
        if (!term.isRigid) links = std::max(links, term.stiffness * double{settings.omega} / term.clamp);
    const double damping = double{scene.dampingTime} * links, a = (1 + 2 * double{settings.theta}) * links;
    if (settings.solver != Solver::split || damping == 0) return infinite;
    return (std::sqrt(damping * damping + 3.8 * a) - damping) / a;
}

// The longest substeps that each rule allows [s]; settings.substeps is the number that is tried.
struct Limits {
    double elastic = infinite, rigid = infinite, damped = infinite;
};

constexpr int mostRounds = 6;

Limits limitsOf(const Scene& scene, const Settings& settings) {
    const Model& model = modelOf(settings.solver);
    const std::vector<Term> terms = termsOf(scene, settings);
    Limits limits;
    for (const Term& term : terms) {
        double& longest = term.isRigid ? limits.rigid : limits.elastic;
        if (term.stiffness > 0) longest = std::min(longest, model.longest(term, double{settings.tolerance}));
    }
    limits.damped = longestOfDamping(scene, settings, terms);
    return limits;
}

// With which elastic terms are within the tolerance. The shares of `split` depend on h a little: a fixed
// point.
std::uint32_t neededFor(const Scene& scene, const Settings& settings) {
    Settings tried = settings;
    for (int round = 0; round < mostRounds; ++round) {
        const std::uint32_t wanted = countFor(double{scene.dt}, limitsOf(scene, tried).elastic);
        if (wanted == tried.substeps) break;
        tried.substeps = wanted;
    }
    return tried.substeps;
}

bool hasOnlyFreeParticles(const Scene& scene) {
    return scene.distances.empty() && scene.bends.empty() && scene.attachments.empty() &&
           scene.planes.empty();
}

} // namespace

SplitBudget splitBudget(const Scene& scene, const Settings& settings) {
    SplitBudget budget{.omegaLinks = double{settings.omega}};
    if (settings.solver != Solver::split) return budget;
    const Counts counts = count(scene);
    const std::vector<double> clamps = clampsOfLinks(scene, settings, counts);
    for (std::size_t i = 0; i < scene.distances.size(); ++i) {
        const DistanceConstraint& c = scene.distances[i];
        if (canMove(counts, {c.a, c.b})) // D_c is at most omega / clamp
            budget.links =
                std::max(budget.links, double{settings.omega} / (double{c.compliance} * clamps[i]));
    }
    if (scene.bends.empty()) return budget;
    budget.omegaBends = omegaOfBends(settings);
    for (const BendConstraint& c : scene.bends)
        if (canMove(counts, {c.a, c.b, c.c}))
            budget.bends = std::max(budget.bends, splitOfBend(counts, c) / double{c.compliance});
    return budget;
}

double dampingBudget(const SplitBudget& budget, double theta, double h) {
    const double s =
        std::min(budget.links * h * h, budget.omegaLinks) + std::min(budget.bends * h * h, budget.omegaBends);
    return std::max(0.0, 0.95 * (4 - s * (1 + 2 * theta)) / 2);
}

SubstepChoice chooseSubsteps(const Scene& scene, const Settings& settings) {
    if (settings.substeps > 0) return {settings.substeps, settings.substeps, SubstepReason::asked};
    if (hasOnlyFreeParticles(scene)) return {1, 1, SubstepReason::fewest};
    // The shares of `split` depend on h a little, so that this is the fixed point of a few rounds.
    Settings tried = settings;
    tried.substeps = ranges::fewestChosen;
    SubstepChoice choice;
    for (int round = 0; round < mostRounds; ++round) {
        const Limits limits = limitsOf(scene, tried);
        const double longest = std::min({limits.elastic, limits.rigid, limits.damped});
        choice.wanted = countFor(double{scene.dt}, longest);
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
    StiffnessReport report;
    const Model& model = modelOf(settings.solver);
    const double h = double{scene.dt} / settings.substeps;
    const bool isSplit = settings.solver == Solver::split;
    const double budget = dampingBudget(splitBudget(scene, settings), double{settings.theta}, h);
    double sum = 0, damping = 0;
    for (const Term& term : termsOf(scene, settings)) {
        if (term.isRigid) continue;
        const double reached = model.reached(term, h);
        ++report.elastic;
        report.clamped += isSplit && reached < 1 - rounding;
        report.soft += reached < 1 - double{settings.tolerance} - rounding;
        report.softest = std::min(report.softest, reached);
        sum += reached;
        // of a link's c = k dampingTime, h c D is at most the budget
        const double most = budget * term.clamp / double{settings.omega} / (term.stiffness * h);
        damping += isSplit ? std::min(double{scene.dampingTime}, most) : double{scene.dampingTime};
    }
    if (report.elastic == 0) return report;
    report.mean = sum / static_cast<double>(report.elastic);
    report.dampingTime = damping / static_cast<double>(report.elastic);
    report.neededSubsteps = neededFor(scene, settings);
    return report;
}

std::string toText(const SubstepChoice& choice, const Settings& settings) {
    const std::string percent = std::to_string(std::lround(100 * double{settings.tolerance})) + " %";
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
