// Every rule works on one list of terms (stiffness/terms.hpp): a solver adds a row to the table here, a
// constraint a loop there.
#include "sinew/substeps.hpp"

#include "sim/collision/loads.hpp"
#include "sim/core/complaints.hpp"
#include "sim/core/counted.hpp"
#include "sim/model/links.hpp"
#include "sim/model/touching.hpp"
#include "sim/stiffness/folds.hpp"
#include "sim/stiffness/level_choice.hpp"
#include "sim/stiffness/shares.hpp"
#include "sim/stiffness/terms.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sinew::sim {

namespace {

using stiffness::canMove;
using stiffness::clampOfLink;
using stiffness::Load;
using stiffness::loadOf;
using stiffness::splitOfBend;
using stiffness::Term;
using stiffness::Terms;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-6; // of float32 inverse masses and compliances

// How a solver bounds stiffness: k_eff / k at h, and the longest h at which the part of the error that
// depends on h is within a tolerance. A rigid term has the stiffness at which its load stretches it by the
// tolerance; for it k_max(h), the largest stiffness of a substep, is used.
struct Model {
    Solver solver;
    double (*reached)(const Term&, double h);
    double (*longest)(const Term&, double tolerance);
};

double reachedBySplit(const Term& term, double h) {
    return std::min(1.0, term.clamp / (term.stiffness * h * h));
}
double longestOfSplit(const Term& term, double tolerance) {
    const double wanted = (term.isRigid ? 1 : (1 - tolerance) * term.own) * term.stiffness;
    return std::sqrt(term.clamp / wanted);
}
// Each sweep adds the same share of the force that is still missing, if others pull the link back to its old
// length.
double reachedBySweeps(const Term& term, double h) {
    const double ofSweep = term.sweepShare / (1 + h * h * term.inverseMass * term.stiffness);
    return stiffness::shareAfter(ofSweep, term.sweeps);
}
// Whether some h brings an elastic term within the tolerance.
bool isReachable(const Term& term, double tolerance) {
    return term.share() > 1 - tolerance + rounding;
}
// The longest h within the tolerance; if there is none, within the tolerance of what the shares allow.
double longestOfSweeps(const Term& term, double tolerance) {
    const double wanted = (1 - tolerance) * (isReachable(term, tolerance) ? 1 : term.share());
    const double ofSweep = stiffness::shareAfter(wanted, 1.0 / term.sweeps);
    const double excess = term.isRigid ? term.share() : term.sweepShare / ofSweep - 1;
    return std::sqrt(excess / (term.inverseMass * term.stiffness));
}

constexpr Model models[] = {
    {Solver::split, reachedBySplit, longestOfSplit},
    {Solver::jacobi, reachedBySweeps, longestOfSweeps},
    {Solver::gaussSeidel, reachedBySweeps, longestOfSweeps},
};

const Model& modelOf(Solver solver) {
    const auto found = std::ranges::find(models, solver, &Model::solver);
    return found == std::end(models) ? models[0] : *found;
}

std::uint32_t countFor(double dt, double h) {
    const double substeps = std::ceil(dt / h * (1 - rounding));
    return static_cast<std::uint32_t>(std::clamp(substeps, 1.0, 4e9));
}

constexpr std::uint32_t nobody = ~0u;

// The longest substep that a rule allows [s], and an end of the constraint that decides it.
struct Limit {
    double longest = infinite;
    std::uint32_t particle = nobody;
    double own = 1; // Term::own
    void lower(double to, const Term& term) {
        if (to < longest) *this = {to, term.particle, term.own};
    }
};

// The longest h at which `split` is stable with the whole dampingTime: the positive root of (1 + 2 theta)
// links h^2 + 2 dampingTime links h = 4 x 0.95; `links` is the largest k D of an elastic term.
Limit longestOfDamping(const Terms& terms) {
    const Settings& settings = terms.settings;
    if (!terms.isSplit() || terms.scene.dampingTime == 0) return {};
    double links = 0; // rigid ones have no damping
    std::uint32_t particle = nobody;
    terms.forEach([&](const Term& term) {
        const double of = term.isRigid ? 0 : term.stiffness * double{settings.omega} / term.clamp;
        if (of <= links) return;
        links = of;
        particle = term.particle;
    });
    const double damping = double{terms.scene.dampingTime} * links;
    const double a = (1 + 2 * double{settings.theta}) * links;
    if (damping == 0) return {};
    return {(std::sqrt(damping * damping + 3.8 * a) - damping) / a, particle};
}

// The longest substeps that each rule allows, computed for settings.substeps.
struct Limits {
    Limit elastic, rigid, damped;
    double share = 1;        // smallest share of an elastic term
    bool isReachable = true; // the tolerance, by some number of substeps
};

constexpr int mostRounds = 6;

Limits limitsOf(const Terms& terms) {
    const Model& model = modelOf(terms.settings.solver);
    const double tolerance{terms.settings.tolerance};
    Limits limits;
    terms.forEach([&](const Term& term) {
        if (!term.isRigid) {
            limits.share = std::min(limits.share, term.share());
            limits.isReachable = limits.isReachable && isReachable(term, tolerance);
        }
        Limit& limit = term.isRigid ? limits.rigid : limits.elastic;
        if (term.stiffness > 0) limit.lower(model.longest(term, tolerance), term);
    });
    limits.damped = longestOfDamping(terms);
    return limits;
}

// Whether particles can rest on each other, or on faces.
bool canTouch(const Scene& scene) {
    return particlesTouch(scene) || facesTouch(scene);
}

// The longest substeps that contacts allow.
struct ContactLimits {
    double loads = infinite, folds = infinite;
};

ContactLimits limitsOfContacts(const Scene& scene, const Load& load) {
    if (!canTouch(scene)) return {};
    const std::vector<std::uint32_t> components = stiffness::componentsOf(scene);
    return {collision::loads::longestSubstep(scene, load.inverseMass, components),
            stiffness::longestSubstepOfFolds(scene, load.inverseMass, components)};
}

// The number of substeps at which elastic terms are within the tolerance; 0 = no number. The shares of
// `split` depend slightly on h, hence a fixed-point iteration.
std::uint32_t neededFor(const Scene& scene, const Settings& settings, const Load& load) {
    Settings tried = settings;
    for (int round = 0; round < mostRounds; ++round) {
        const Limits limits = limitsOf({scene, tried, load});
        if (!limits.isReachable) return 0;
        const std::uint32_t wanted = countFor(double{scene.dt}, limits.elastic.longest);
        if (wanted == tried.substeps) break;
        tried.substeps = wanted;
    }
    return tried.substeps;
}

bool hasOnlyFreeParticles(const Scene& scene) {
    return linkCount(scene) == 0 && scene.attachments.empty() && scene.planes.empty() &&
           scene.colliders.empty() && !canTouch(scene);
}

// Lower limit of the automatic choice.
std::uint32_t fewestFor(const Scene& scene) {
    return canTouch(scene) ? ranges::fewestTouching : ranges::fewestChosen;
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
    budget.omegaBends = stiffness::omegaOfBends(settings);
    for (const BendConstraint& c : scene.bends)
        if (canMove(load, {c.a, c.b, c.c}))
            budget.bends = std::max(budget.bends, splitOfBend(load, c) / double{c.compliance});
    return budget;
}

// Sums stiffness by body.
class StiffnessOfBodies {
public:
    explicit StiffnessOfBodies(const Scene& scene) : bodyOf_(scene.particles.size(), nobody) {
        for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
            const Body& body = scene.bodies[b];
            bodies_.push_back({.name = body.name, .mean = 0});
            std::fill_n(bodyOf_.begin() + body.firstParticle, body.particleCount, b);
        }
    }
    void add(std::uint32_t particle, double reached, bool isSoft) {
        if (bodyOf_[particle] == nobody) return;
        BodyStiffness& body = bodies_[bodyOf_[particle]];
        ++body.elastic;
        body.soft += isSoft;
        body.softest = std::min(body.softest, reached);
        body.mean += reached; // a sum until finish()
    }
    std::vector<BodyStiffness> finish() {
        std::erase_if(bodies_, [](const BodyStiffness& body) { return body.elastic == 0; });
        for (BodyStiffness& body : bodies_) body.mean /= static_cast<double>(body.elastic);
        return std::move(bodies_);
    }

private:
    std::vector<BodyStiffness> bodies_;
    std::vector<std::uint32_t> bodyOf_; // by particle
};

// The number that the strictest rule needs, before the limits.
SubstepChoice choiceOf(const Limits& limits, const ContactLimits& contacts, const Scene& scene) {
    const std::pair<SubstepReason, Limit> rules[] = {{SubstepReason::stiffness, limits.elastic},
                                                     {SubstepReason::weight, limits.rigid},
                                                     {SubstepReason::damping, limits.damped},
                                                     {SubstepReason::contacts, {.longest = contacts.loads}},
                                                     {SubstepReason::folds, {.longest = contacts.folds}}};
    const auto& [reason, limit] =
        *std::ranges::min_element(rules, {}, [](const auto& rule) { return rule.second.longest; });
    return {.wanted = countFor(double{scene.dt}, limit.longest),
            .reason = reason,
            .own = limit.own,
            .share = limits.share,
            .isReachable = limits.isReachable,
            .body = bodyOf(scene, limit.particle)};
}

std::string percentOf(const Settings& settings) {
    return std::to_string(std::lround(100 * double{settings.tolerance})) + " %";
}

// The choice with settings.levels, which are a number.
SubstepChoice chooseFor(const Scene& scene, const Settings& settings) {
    if (settings.substeps > 0)
        return {.substeps = settings.substeps, .wanted = settings.substeps, .levels = settings.levels};
    const std::uint32_t drag = dragSubsteps(scene);
    if (hasOnlyFreeParticles(scene))
        return {.substeps = std::min(drag, ranges::mostChosen),
                .wanted = drag,
                .levels = settings.levels,
                .reason = drag > ranges::mostChosen ? SubstepReason::most
                          : drag > 1                ? SubstepReason::drag
                                                    : SubstepReason::fewest,
                .rule = SubstepReason::drag};
    // The shares of `split` depend slightly on h, so that this is a fixed-point iteration of a few rounds.
    const Load load = loadOf(scene, double{settings.tolerance});
    const std::uint32_t fewest = fewestFor(scene);
    const ContactLimits contacts = limitsOfContacts(scene, load);
    Settings tried = settings;
    tried.substeps = fewest;
    SubstepChoice choice;
    for (int round = 0; round < mostRounds; ++round) {
        choice = choiceOf(limitsOf({scene, tried, load}), contacts, scene);
        const std::uint32_t next = std::clamp(choice.wanted, fewest, ranges::mostChosen);
        if (next == tried.substeps || (round + 2 > mostRounds && next < tried.substeps)) break;
        tried.substeps = next;
    }
    choice.substeps = tried.substeps;
    if (drag > choice.substeps) {
        choice.wanted = std::max(choice.wanted, drag);
        choice.reason = SubstepReason::drag;
        choice.body.clear();
        choice.substeps = std::min(drag, ranges::mostChosen);
    }
    if (choice.wanted < choice.substeps && choice.substeps == fewest) choice.reason = SubstepReason::fewest;
    if (choice.wanted > choice.substeps) choice.rule = std::exchange(choice.reason, SubstepReason::most);
    choice.levels = settings.levels;
    return choice;
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

std::uint32_t dragSubsteps(const Scene& scene) {
    // the error is at most d / 2 + d^2 / 12, d = damping h
    constexpr double most = 2 * dragTolerance * (1 - dragTolerance / 3);
    return countFor(double{scene.dt}, scene.damping > 0 ? most / double{scene.damping} : infinite);
}

SubstepChoice chooseSubsteps(const Scene& scene, const Settings& asked) {
    Settings settings = asked;
    if (settings.levels != autoLevels) return chooseFor(scene, settings);
    settings.levels = stiffness::levelsOfFewSubsteps;
    SubstepChoice choice = chooseFor(scene, settings);
    settings.substeps = choice.substeps;
    choice.levels = stiffness::levelsFor(scene, settings, loadOf(scene));
    if (choice.levels >= stiffness::levelsOfFewSubsteps || asked.substeps > 0) return choice;
    settings = asked;
    settings.levels = choice.levels; // which carry less than those that the substeps were chosen for
    return chooseFor(scene, settings);
}

SubstepChoice contactSubsteps(const Scene& scene) {
    if (!canTouch(scene)) return {};
    const ContactLimits limits = limitsOfContacts(scene, loadOf(scene));
    const double longest = std::min(limits.loads, limits.folds);
    return {.wanted = countFor(double{scene.dt}, longest),
            .rule = limits.folds < limits.loads ? SubstepReason::folds : SubstepReason::contacts};
}

Settings withSubsteps(const Scene& scene, Settings settings) {
    const SubstepChoice choice = chooseSubsteps(scene, settings);
    settings.substeps = choice.substeps;
    settings.levels = choice.levels;
    return settings;
}

Clamp clampOf(const Scene& scene, const Settings& settings) {
    if (settings.solver != Solver::split) return Clamp::none;
    return stiffness::sharesOfMotion(scene, withSubsteps(scene, settings), inverseMasses(scene)).clamp;
}

std::string toText(Clamp clamp) {
    switch (clamp) {
    case Clamp::none:
        return "none";
    case Clamp::sharp:
        return "sharp";
    case Clamp::sumAsked:
        return "sum: as asked";
    case Clamp::sumLevels:
        return "sum: levels";
    case Clamp::sumDamping:
        return "sum: internal damping";
    case Clamp::sumWhole:
        return "sum: nothing is clamped";
    }
    return {};
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
    StiffnessOfBodies bodies(scene);
    terms.forEach([&](const Term& term) {
        if (term.isRigid) return;
        const double reached = model.reached(term, h);
        const bool isSoft = reached < (1 - double{settings.tolerance}) * term.own - rounding;
        ++report.elastic;
        report.clamped += terms.isSplit() && reached < 1 - rounding;
        report.soft += isSoft;
        report.softest = std::min(report.softest, reached);
        bodies.add(term.particle, reached, isSoft);
        sum += reached;
        // `split`: h c D is at most the budget, with a link's c = k dampingTime
        const double most = budget * term.clamp / double{settings.omega} / (term.stiffness * h);
        // `gauss_seidel`: implicit for each link
        const double implicit =
            settings.solver == Solver::gaussSeidel ? h * term.inverseMass * term.stiffness : 0;
        damping += terms.isSplit() ? std::min(double{scene.dampingTime}, most)
                                   : double{scene.dampingTime} / (1 + double{scene.dampingTime} * implicit);
    });
    if (report.elastic == 0) return report;
    report.bodies = bodies.finish();
    report.mean = sum / static_cast<double>(report.elastic);
    report.dampingTime = damping / static_cast<double>(report.elastic);
    report.neededSubsteps = neededFor(scene, settings, load);
    return report;
}

SubstepCure cureOf(const SubstepChoice& choice, const Settings& settings) {
    switch (choice.rule) {
    case SubstepReason::damping:
        return {"would let links damp as much as asked", "a smaller damping_time"};
    case SubstepReason::drag:
        return {"would give terminal speeds right within 5 %", "a smaller damping"};
    case SubstepReason::contacts:
        return {"would let contacts give by no more than 1 % of a radius", "lower heaps or larger radii"};
    case SubstepReason::folds:
        return {"would keep a falling sheet from passing through its own folds",
                "a larger thickness or more damping"};
    default:
        return {"would keep the tolerance of " + percentOf(settings),
                "larger voxels or spacing, or a softer material"};
    }
}

// How much of its stiffness a link must have itself.
std::string byLevels(double own) {
    return own == 1      ? ""
           : own == 0.25 ? ", one level carrying three quarters"
                         : ", levels carrying eight ninths";
}

std::string toText(const Settings& settings) {
    const std::string levels = settings.levels > 0 ? " and " + counted(settings.levels, "level") : "";
    return counted(settings.substeps, "substep") + levels;
}

std::string toText(const SubstepChoice& choice, const Settings& settings) {
    const std::string percent = percentOf(settings);
    if (!choice.isReachable)
        return counted(choice.substeps, "substep") + ": no number of substeps reaches the tolerance of " +
               percent + ", " + counted(settings.iterations, "iteration gives", "iterations give") +
               " a link " + std::to_string(std::lround(100 * choice.share)) +
               " % of its stiffness at most; use weight or iterations";
    const std::string body = choice.body.empty() ? "" : ", body \"" + choice.body + "\" decides";
    std::string why;
    switch (choice.reason) {
    case SubstepReason::asked:
        why = "as asked";
        break;
    case SubstepReason::stiffness:
        why = "no link is more than " + percent + " softer than asked" + byLevels(choice.own) + body;
        break;
    case SubstepReason::weight:
        why = "no rigid link stretches by more than " + percent + " under its load" + body;
        break;
    case SubstepReason::damping:
        why = "links damp as much as asked" + body;
        break;
    case SubstepReason::drag:
        why = "terminal speeds are right within 5 %";
        break;
    case SubstepReason::contacts:
        why = "bodies at rest press contacts in by no more than 1 % of a radius";
        break;
    case SubstepReason::folds:
        why = "no falling sheet passes through its own folds";
        break;
    case SubstepReason::fewest:
        why = "the stiffness alone needs fewer";
        break;
    case SubstepReason::most:
        why = "the most chosen automatically; " + std::to_string(choice.wanted) + " " +
              cureOf(choice, settings).would + body;
        break;
    }
    return counted(choice.substeps, "substep") + ": " + why;
}

} // namespace sinew::sim
