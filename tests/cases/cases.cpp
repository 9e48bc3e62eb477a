// Predicts the stiffness that each solver reaches, and measures runs.
#include "cases/cases.hpp"

#include "sim/reference/cells.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace sinew::test {

using namespace sim;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Ends {
    double wA = 0, wB = 0; // [1/kg]
    int linksA = 0, linksB = 0;
};

Ends endsOf(const Scene& scene, const DistanceConstraint& link) {
    std::vector<double> w;
    for (const Particle& particle : scene.particles) w.push_back(double{particle.inverseMass});
    for (const FixedConstraint& fixed : scene.fixed) w[fixed.particle] = 0;
    const auto linksOf = [&](std::uint32_t particle) {
        return static_cast<int>(std::ranges::count_if(scene.distances, [&](const DistanceConstraint& c) {
            return (c.a == particle || c.b == particle) && (w[c.a] > 0 || w[c.b] > 0);
        }));
    };
    return {w[link.a], w[link.b], linksOf(link.a), linksOf(link.b)};
}

std::vector<reference::Cell> cellsWithVolume(const Scene& scene) {
    std::vector<reference::Cell> cells = reference::cellsOf(scene);
    std::erase_if(cells, [](const reference::Cell& cell) { return cell.stiffness == 0; });
    return cells;
}

// Stiffness of a full cell for changes of volume near its rest volume: 0.75 lambda_v a [N/m].
double stiffnessOf(const reference::Cell& cell) {
    return 0.75 * cell.stiffness * cell.spacing;
}

// Division of particles among constraints in `split`, computed independently from the formulas in
// solvers/shares.hpp. A constraint of stiffness k gets the share k~ = k / (1 + 2 w h^2 K). K is the largest
// stiffness of its rest length in its grid, or k outside of grids. A particle gets tau = omega / (2 w sum
// k~).
struct Division {
    double softening = 0; // 2 w h^2 [m/N]
    std::vector<double> share, tau;

    Division(const Scene& scene, const Settings& settings) : tau(scene.particles.size(), infinite) {
        std::vector<double> w, sum(scene.particles.size(), 0);
        for (const Particle& particle : scene.particles) w.push_back(double{particle.inverseMass});
        for (const FixedConstraint& fixed : scene.fixed) w[fixed.particle] = 0;
        const double h = double{scene.dt} / settings.substeps;
        const auto moving =
            static_cast<double>(std::ranges::count_if(w, [](double each) { return each > 0; }));
        softening = 2 * h * h * std::accumulate(w.begin(), w.end(), 0.0) / moving;
        for (std::size_t c = 0; c < scene.distances.size(); ++c) {
            const DistanceConstraint& link = scene.distances[c];
            const bool moves = w[link.a] > 0 || w[link.b] > 0;
            share.push_back(moves ? levelled(1 / double{link.compliance}, 1 / leastCompliance(scene, c)) : 0);
            for (const std::uint32_t end : {link.a, link.b}) sum[end] += share[c];
        }
        for (const reference::Cell& cell : cellsWithVolume(scene))
            for (const std::uint32_t corner : cell.corners)
                sum[corner] += cell.fill * levelled(stiffnessOf(cell), stiffnessOf(cell));
        for (std::size_t i = 0; i < w.size(); ++i)
            if (w[i] > 0) tau[i] = double{settings.omega} / (2 * w[i] * sum[i]);
    }

    // The share of a rigid constraint is the limit for k -> infinity.
    double levelled(double k, double stiffest) const {
        return stiffest < infinite ? k / (1 + softening * stiffest) : 1 / softening;
    }

    // Upper bound of k h^2 [kg].
    double clamp(const Scene& scene, std::size_t c) const {
        const double least = std::min(tau[scene.distances[c].a], tau[scene.distances[c].b]);
        return least < infinite ? share[c] * least : infinite;
    }

    // Smallest compliance of the links that have the rest length of link c in its grid.
    static double leastCompliance(const Scene& scene, std::size_t c) {
        const DistanceConstraint& link = scene.distances[c];
        for (const Grid& grid : scene.grids) {
            if (c < grid.firstDistance || c - grid.firstDistance >= grid.distanceCount) continue;
            for (std::uint32_t kind = 0; kind < grid.kinds; ++kind)
                if (grid.restLength[kind] == link.restLength) return double{grid.compliance[kind]};
        }
        return double{link.compliance};
    }
};

} // namespace

Settings accurate(Solver solver, std::uint32_t substeps) {
    Settings settings{.solver = solver, .substeps = substeps, .theta = 0};
    if (solver == Solver::jacobi) settings.weight = 1;
    return settings;
}

double reachedStiffness(const Scene& scene, const Settings& settings, double h, std::size_t c) {
    const DistanceConstraint& link = scene.distances[c];
    const double compliance = double{link.compliance};
    if (settings.solver == Solver::split)
        return std::min(1 / compliance, Division(scene, settings).clamp(scene, c) / (h * h));
    if (settings.solver == Solver::gaussSeidel) return 1 / compliance;
    const Ends ends = endsOf(scene, link);
    const int links = std::max(ends.linksA * (ends.wA > 0), ends.linksB * (ends.wB > 0));
    const double weight = settings.weight > 0 ? double{settings.weight} : 1.0 / links;
    return weight / (h * h * (ends.wA + ends.wB) + compliance);
}

std::vector<double> splitStiffnesses(const Scene& scene, const Settings& settings, double h) {
    const Division division(scene, settings);
    std::vector<double> stiffnesses;
    for (std::size_t c = 0; c < scene.distances.size(); ++c)
        stiffnesses.push_back(
            std::min(1 / double{scene.distances[c].compliance}, division.clamp(scene, c) / (h * h)));
    return stiffnesses;
}

bool isUnclamped(const Scene& scene, const Settings& settings) {
    if (settings.solver != Solver::split) return true;
    const Division division(scene, settings);
    const double h = double{scene.dt} / settings.substeps;
    for (std::size_t c = 0; c < scene.distances.size(); ++c)
        if (h * h / double{scene.distances[c].compliance} > division.clamp(scene, c)) return false;
    constexpr double spare = 1.1; // margin for cells, whose clamp falls as they stretch
    return std::ranges::all_of(cellsWithVolume(scene), [&](const reference::Cell& cell) {
        double least = infinite;
        for (const std::uint32_t corner : cell.corners) least = std::min(least, division.tau[corner]);
        return spare * h * h * stiffnessOf(cell) <=
               division.levelled(stiffnessOf(cell), stiffnessOf(cell)) * least;
    });
}

Eigen::Vector3d Solid::mean(const std::vector<Eigen::Vector3d>& x, Corner low, Corner high) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    for (std::uint32_t k = low[2]; k <= high[2]; ++k)
        for (std::uint32_t j = low[1]; j <= high[1]; ++j)
            for (std::uint32_t i = low[0]; i <= high[0]; ++i, ++count) sum += x[corners.at(i, j, k)];
    return sum / count;
}

void Solid::fix(Corner low, Corner high) {
    for (std::uint32_t k = low[2]; k <= high[2]; ++k)
        for (std::uint32_t j = low[1]; j <= high[1]; ++j)
            for (std::uint32_t i = low[0]; i <= high[0]; ++i) scene.fixed.push_back({corners.at(i, j, k)});
}

std::vector<Eigen::Vector3d> Solid::initial() const {
    std::vector<Eigen::Vector3d> x;
    for (const Particle& particle : scene.particles) x.push_back(toVector(particle.position));
    return x;
}

Solid makeSolid(const char* name, std::array<std::uint32_t, 3> cells, double speed, float poissonRatio) {
    Solid body{.scene = {.name = name, .gravity = {0, 0, 0}}, .corners = {}, .speed = speed};
    const auto origin = [&](std::uint32_t count) { return static_cast<float>(-0.5 * Solid::cell * count); };
    body.corners = addLattice(body.scene, {.origin = {origin(cells[0]), origin(cells[1]), origin(cells[2])},
                                           .cells = cells,
                                           .spacing = static_cast<float>(Solid::cell),
                                           .youngModulus = static_cast<float>(body.modulus()),
                                           .poissonRatio = poissonRatio,
                                           .density = static_cast<float>(Solid::density)});
    return body;
}

CaseRunner::CaseRunner(const Scene& scene, Settings settings)
    : forward_(scene, settings), reversed_(scene, (settings.isReversed = true, settings)) {}

CaseRunner::~CaseRunner() {
    EXPECT_EQ(forward_.stateHash(), reversed_.stateHash()) << "the state depends on the order of invocations";
}

void CaseRunner::step(float dt) {
    EXPECT_EQ(forward_.step(dt).nonFinite, 0u);
    reversed_.step(dt);
}

void CaseRunner::run(int steps) {
    EXPECT_EQ(forward_.run(steps).nonFinite, 0u);
    reversed_.run(steps);
}

void expectWithin(const std::string& what, double measured, double expected, double tolerance) {
    testing::Test::RecordProperty(what, std::to_string(100 * (measured / expected - 1)) + " %");
    EXPECT_NEAR(measured / expected, 1, tolerance) << what << ": " << measured << " instead of " << expected;
}

void Crossings::add(double time, double value) {
    if (lastValue_ * value < 0)
        times_.push_back(lastTime_ + (time - lastTime_) * lastValue_ / (lastValue_ - value));
    lastTime_ = time;
    lastValue_ = value;
}

double Crossings::period() const {
    return 2 * (times_.back() - times_.front()) / static_cast<double>(times_.size() - 1);
}

double ulp(double value) {
    const auto x = static_cast<float>(value);
    return double{std::nextafter(x, std::numeric_limits<float>::infinity())} - double{x};
}

} // namespace sinew::test
