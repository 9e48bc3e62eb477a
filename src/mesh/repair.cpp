// The order of the steps: seams first, since a joined seam leaves no hole; sides before holes, since a loop
// needs neighbours that run the same way.
#include "mesh/repair.hpp"

#include "mesh/disjoint_sets.hpp"
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

namespace sinew::mesh {
namespace {

std::size_t faultsOf(const MeshDefects& defects) {
    return defects.boundaryEdges + defects.nonManifoldEdges;
}

/// A mesh with its defects, on which steps are tried.
class Trial {
public:
    Trial(TriangleMesh mesh, const MeshDefects& defects) : mesh_(std::move(mesh)), defects_(defects) {}

    /// `step(mesh, places)` changes a mesh and adds a place for each change. Keeps mesh and report as they
    /// are where it leaves no fewer faults; else appends the places to `done`, and those of the triangles
    /// that became empty or double to report.places.removed.
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

/// Far from the origin the coordinates themselves are rounded by more than weldTolerance.
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

/// Counts groups of vertices that triangles connect.
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

/// Joins what is nearer than ever larger shares of the size, until that closes a good part of the open edges.
void findWideSeam(const TriangleMesh& mesh, const MeshDefects& defects, Seams which, Repairs& report) {
    constexpr std::size_t mostEdges = 100'000; // a search in more of them takes long
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
    if (trial.defects().nonManifoldEdges > 0) // leftovers lie at such edges
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

/// Sets the numbers to those of the places.
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

/// The positions of a mesh, to ask for.
class Positions {
public:
    explicit Positions(const TriangleMesh& mesh) : all_(mesh.positions) { std::ranges::sort(all_, isBefore); }
    bool has(const Vec3& place) const { return std::ranges::binary_search(all_, place, isBefore); }
    Places among(const Places& places) const {
        Places found;
        std::ranges::copy_if(places, std::back_inserter(found),
                             [&](const Vec3& place) { return has(place); });
        return found;
    }

private:
    static bool isBefore(const Vec3& a, const Vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
    std::vector<Vec3> all_;
};

// Lids may have closed it on both sides, so that the part itself shows no seam.
WideSeam seamIn(const Positions& positions, const WideSeam& whole) {
    WideSeam seam{.weld = whole.weld};
    std::ranges::copy_if(whole.pairs, std::back_inserter(seam.pairs), [&](const std::array<Vec3, 2>& pair) {
        return positions.has(pair[0]) && positions.has(pair[1]);
    });
    if (seam.pairs.empty()) return {};
    seam.edges = whole.edges * seam.pairs.size() / whole.pairs.size();
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
    if (!report.isAny()) return result;
    MeshDefects left;
    result = weld(result, left);
    defects.boundaryEdges = left.boundaryEdges;
    defects.nonManifoldEdges = left.nonManifoldEdges;
    defects.flippedEdges = left.flippedEdges;
    return result;
}

Repairs repairsOf(const TriangleMesh& part, const Repairs& whole) {
    const Positions positions(part);
    Repairs report{.how = whole.how, .tolerance = whole.tolerance};
    for (Places RepairPlaces::*kind : {&RepairPlaces::joined, &RepairPlaces::split, &RepairPlaces::removed,
                                       &RepairPlaces::turnedTriangles, &RepairPlaces::turnedParts})
        report.places.*kind = positions.among(whole.places.*kind);
    std::ranges::copy_if(whole.places.holes, std::back_inserter(report.places.holes),
                         [&](const ClosedHole& hole) { return positions.has(hole.place); });
    count(report);
    MeshDefects defects;
    TriangleMesh open = weld(part, defects);
    closeHoles(open, false, report);
    if (whole.seam.weld > 0) findWideSeam(open, defects, Seams::all, report);
    if (report.seam.weld == 0) report.seam = seamIn(positions, whole.seam);
    return report;
}

} // namespace sinew::mesh
