// The order of the steps: seams first, since a joined seam leaves no hole; orientation before holes, since a
// loop needs neighbours with the same orientation.
#include "mesh/repair.hpp"

#include "mesh/disjoint_sets.hpp"
#include "mesh/point_tree.hpp"
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

namespace sinew::mesh {
namespace {

std::size_t faultsOf(const MeshDefects& defects) {
    return defects.boundaryEdges + defects.nonManifoldEdges;
}

/// A mesh with its defects, to which steps are applied on trial.
class Trial {
public:
    Trial(TriangleMesh mesh, const MeshDefects& defects) : mesh_(std::move(mesh)), defects_(defects) {}

    /// Applies `step(mesh, places)`, which changes a mesh and adds a place for each change. Discards the
    /// change unless it leaves fewer faults; else appends the places to `done`, and those of triangles that
    /// became degenerate or duplicates to report.places.removed.
    template <typename Step> bool apply(Repairs& report, Places& done, const Step& step) {
        TriangleMesh changed = mesh_;
        Places places, dropped;
        step(changed, places);
        if (places.empty()) return false;
        MeshDefects defects;
        changed = weld(changed, defects, &dropped);
        if (faultsOf(defects) >= faultsOf(defects_)) return false;
        done.insert(done.end(), places.begin(), places.end());
        report.places.removed.insert(report.places.removed.end(), dropped.begin(), dropped.end());
        mesh_ = std::move(changed);
        defects_ = defects;
        return true;
    }

    TriangleMesh& mesh() { return mesh_; }
    const MeshDefects& defects() const { return defects_; }

private:
    TriangleMesh mesh_;
    MeshDefects defects_;
};

double sizeOf(const TriangleMesh& mesh) {
    const MeshReport report = measure(mesh);
    return (toVector(report.high) - toVector(report.low)).maxCoeff();
}

/// Welding distance. Far from the origin, coordinates are rounded by more than weldTolerance.
double toleranceOf(const TriangleMesh& mesh, double weld) {
    const MeshReport report = measure(mesh);
    const Vector3 low = toVector(report.low), high = toVector(report.high);
    const double farthest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
    return std::max(weld > 0 ? weld : weldTolerance * (high - low).maxCoeff(),
                    weldRoundings * double{std::numeric_limits<float>::epsilon()} * farthest);
}

void stitch(Trial& trial, Repairs& report) {
    const double tolerance = report.tolerance;
    trial.apply(report, report.places.joined,
                [&](TriangleMesh& mesh, Places& places) { joinNear(mesh, tolerance, places); });
    trial.apply(report, report.places.split,
                [&](TriangleMesh& mesh, Places& places) { splitJunctions(mesh, tolerance, places); });
}

/// Number of connected sets of vertices.
std::size_t countSurfaces(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.positions.size());
    std::size_t count = mesh.positions.size();
    for (const auto& [a, b, c] : mesh.triangles)
        for (const std::uint32_t other : {b, c}) {
            if (sets.root(a) == sets.root(other)) continue;
            sets.join(a, other);
            --count;
        }
    return count;
}

enum class Seams { between, all }; ///< between surfaces, or also within one

/// Tries to join vertices at increasing shares of the size, until a quarter of the open edges is closed.
void findWideSeam(const TriangleMesh& mesh, const MeshDefects& defects, Seams which, Repairs& report) {
    constexpr std::size_t mostEdges = 100'000; // a search among more edges takes long
    if (report.seam.weld > 0 || defects.boundaryEdges == 0 || defects.boundaryEdges > mostEdges) return;
    const double size = sizeOf(mesh);
    const std::size_t surfaces = countSurfaces(mesh);
    if (which == Seams::between && surfaces < 2) return;
    for (const double share : {1e-4, 1e-3, 1e-2}) {
        const double digit = std::pow(10, std::floor(std::log10(share * size)));
        Repairs tried{.how = Repair::weld, .tolerance = std::ceil(share * size / digit - 1e-6) * digit};
        if (tried.tolerance <= report.tolerance) continue;
        Trial trial(mesh, defects);
        stitch(trial, tried);
        const std::size_t joined =
            defects.boundaryEdges - std::min(defects.boundaryEdges, trial.defects().boundaryEdges);
        if (4 * joined < defects.boundaryEdges) continue;
        if (which == Seams::between && countSurfaces(trial.mesh()) == surfaces) continue;
        report.seam = {tried.tolerance, joined};
        TriangleMesh both = mesh;
        Places places;
        joinNear(both, tried.tolerance, places, &report.seam.pairs);
        return;
    }
}

void turnTriangles(TriangleMesh& mesh, Places& places) {
    const auto given = mesh.triangles;
    orientNeighbours(mesh);
    for (std::size_t i = 0; i < given.size(); ++i)
        if (mesh.triangles[i] != given[i]) places.push_back(mesh.positions[given[i][0]]);
}

void close(Trial& trial, Repairs& report) {
    if (trial.defects().nonManifoldEdges > 0) // leftovers occur at such edges
        trial.apply(report, report.places.removed, removeLeftovers);
    if (trial.defects().flippedEdges > 0) turnTriangles(trial.mesh(), report.places.turnedTriangles);
    if (trial.defects().boundaryEdges > 0) {
        Repairs tried = report;
        Places rims;
        const auto closing = [&](TriangleMesh& mesh, Places& places) {
            closeHoles(mesh, true, tried);
            for (const ClosedHole& hole : tried.places.holes) places.push_back(hole.place);
        };
        if (trial.apply(tried, rims, closing)) report = std::move(tried);
    }
    turnParts(trial.mesh(), report.places.turnedParts);
}

/// Sets the counts from the numbers of places.
void count(Repairs& report) {
    const RepairPlaces& places = report.places;
    report.joinedVertices = places.joined.size();
    report.splitEdges = places.split.size();
    report.removedTriangles = places.removed.size();
    report.turnedTriangles = places.turnedTriangles.size();
    report.turnedParts = places.turnedParts.size();
    report.closedHoles = places.holes.size();
    for (const ClosedHole& hole : places.holes) {
        report.holeEdges += hole.edges;
        report.holeTriangles += hole.triangles;
    }
}

constexpr Places RepairPlaces::*placeKinds[] = {&RepairPlaces::joined, &RepairPlaces::split,
                                                &RepairPlaces::removed, &RepairPlaces::turnedTriangles,
                                                &RepairPlaces::turnedParts};

bool isBefore(const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Moves places to the nearest vertices of the result, if later steps have joined or removed their vertices.
class Settler {
public:
    Settler(const TriangleMesh& result, double tolerance)
        : mesh_(result), sorted_(result.positions), radius_(std::max(tolerance, 1e-6 * sizeOf(result))) {
        std::ranges::sort(sorted_, isBefore);
    }
    void settle(Vec3& place) {
        if (sorted_.empty() || std::ranges::binary_search(sorted_, place, isBefore)) return;
        if (!tree_) {
            std::vector<std::uint32_t> all(mesh_.positions.size());
            std::iota(all.begin(), all.end(), 0u);
            tree_.emplace(mesh_.positions, all);
        }
        const Vector3 from = toVector(place);
        std::vector<std::uint32_t> near;
        for (double radius = radius_; near.empty() && std::isfinite(radius); radius *= 4)
            tree_->findNear(from, from, radius, near);
        if (near.empty()) return;
        place = mesh_.positions[*std::ranges::min_element(near, {}, [&](std::uint32_t vertex) {
            return (toVector(mesh_.positions[vertex]) - from).squaredNorm();
        })];
    }

private:
    const TriangleMesh& mesh_;
    std::vector<Vec3> sorted_;
    double radius_;
    std::optional<PointTree> tree_;
};

const Vec3& placeOf(const std::array<Vec3, 2>& pair) {
    return pair[0];
}

/// Sorts the places, for the searches of repairsOf().
void sortPlaces(Repairs& report) {
    for (const auto kind : placeKinds) std::ranges::sort(report.places.*kind, isBefore);
    std::ranges::stable_sort(report.places.holes, isBefore, &ClosedHole::place);
    std::ranges::stable_sort(report.seam.pairs, isBefore, placeOf);
}

void settlePlaces(const TriangleMesh& result, Repairs& report) {
    Settler settler(result, report.tolerance);
    for (const auto kind : placeKinds)
        for (Vec3& place : report.places.*kind) settler.settle(place);
    for (ClosedHole& hole : report.places.holes) settler.settle(hole.place);
    for (std::array<Vec3, 2>& pair : report.seam.pairs)
        for (Vec3& place : pair) settler.settle(place);
}

/// Those of sorted `places` that are at one of the sorted `positions`.
template <typename Place, typename Of>
std::vector<Place> among(const std::vector<Vec3>& positions, const std::vector<Place>& places, const Of& of) {
    std::vector<Place> found;
    if (places.empty()) return found;
    for (const Vec3& position : positions) {
        const auto first = std::ranges::lower_bound(places, position, isBefore, of);
        found.insert(found.end(), first,
                     std::ranges::upper_bound(first, places.end(), position, isBefore, of));
    }
    return found;
}

/// The part of a wide seam in sorted `positions`. The part itself may show no seam, if both of its sides were
/// closed.
WideSeam seamIn(const std::vector<Vec3>& positions, const WideSeam& whole) {
    WideSeam seam{.weld = whole.weld, .pairs = among(positions, whole.pairs, placeOf)};
    std::erase_if(seam.pairs, [&](const std::array<Vec3, 2>& pair) {
        return !std::ranges::binary_search(positions, pair[1], isBefore);
    });
    if (seam.pairs.empty()) return {};
    seam.edges = std::max<std::size_t>(1, whole.edges * seam.pairs.size() / whole.pairs.size());
    return seam;
}

} // namespace

const char* nameOf(Repair how) {
    return how == Repair::none ? "none" : how == Repair::weld ? "weld" : "close";
}

std::optional<Repair> findRepair(std::string_view name) {
    for (const Repair how : {Repair::none, Repair::weld, Repair::close})
        if (name == nameOf(how)) return how;
    return {};
}

TriangleMesh repair(TriangleMesh mesh, Repair how, MeshDefects& defects, Repairs& report, double weldWithin) {
    report = {.how = how, .tolerance = toleranceOf(mesh, weldWithin)};
    Trial trial(std::move(mesh), defects);
    if (how != Repair::none && defects.boundaryEdges > 0) stitch(trial, report);
    if (how == Repair::close) findWideSeam(trial.mesh(), trial.defects(), Seams::between, report);
    if (how == Repair::close) close(trial, report);
    count(report);
    if (trial.defects().boundaryEdges > 0) closeHoles(trial.mesh(), false, report);
    if (how != Repair::none) findWideSeam(trial.mesh(), trial.defects(), Seams::all, report);
    TriangleMesh result = std::move(trial.mesh());
    MeshDefects left;
    if (report.isAny()) {
        result = weld(result, left);
        settlePlaces(result, report);
    }
    sortPlaces(report);
    if (!report.isAny()) return result;
    defects.boundaryEdges = left.boundaryEdges;
    defects.nonManifoldEdges = left.nonManifoldEdges;
    defects.flippedEdges = left.flippedEdges;
    return result;
}

Repairs repairsOf(const TriangleMesh& part, const Repairs& whole) {
    std::vector<Vec3> positions = part.positions;
    std::ranges::sort(positions, isBefore);
    const auto same = std::unique(positions.begin(), positions.end(), [](const Vec3& a, const Vec3& b) {
        return !isBefore(a, b) && !isBefore(b, a);
    });
    positions.erase(same, positions.end());
    Repairs report{.how = whole.how, .tolerance = whole.tolerance};
    for (const auto kind : placeKinds)
        report.places.*kind = among(positions, whole.places.*kind, std::identity());
    report.places.holes = among(positions, whole.places.holes, &ClosedHole::place);
    count(report);
    MeshDefects defects;
    TriangleMesh open = weld(part, defects);
    closeHoles(open, false, report);
    if (whole.seam.weld > 0) findWideSeam(open, defects, Seams::all, report);
    if (report.seam.weld == 0) report.seam = seamIn(positions, whole.seam);
    return report;
}

} // namespace sinew::mesh
