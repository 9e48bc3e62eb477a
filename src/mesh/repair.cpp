// The order of the steps: seams first, since a joined seam leaves no hole; sides before holes, since a loop
// needs neighbours that run the same way.
#include "mesh/repair.hpp"

#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <limits>

namespace sinew::mesh {
namespace {

std::size_t faultsOf(const MeshDefects& defects) {
    return defects.boundaryEdges + defects.nonManifoldEdges;
}

/// A mesh with its defects, on which steps are tried.
class Trial {
public:
    Trial(TriangleMesh mesh, const MeshDefects& defects) : mesh_(std::move(mesh)), defects_(defects) {}

    /// `step` changes a mesh and returns how often. Returns 0 and keeps the mesh where that leaves no fewer
    /// faults.
    template <typename Step> std::size_t apply(Repairs& report, const Step& step) {
        TriangleMesh changed = mesh_;
        const std::size_t count = step(changed);
        if (count == 0) return 0;
        MeshDefects defects;
        changed = weld(changed, defects);
        if (faultsOf(defects) >= faultsOf(defects_)) return 0;
        report.removedTriangles += defects.degenerateTriangles + defects.duplicateTriangles;
        mesh_ = std::move(changed);
        defects_ = defects;
        return count;
    }

    TriangleMesh& mesh() { return mesh_; }
    const MeshDefects& defects() const { return defects_; }

private:
    TriangleMesh mesh_;
    MeshDefects defects_;
};

/// Far from the origin the coordinates themselves are rounded by more than weldTolerance.
double toleranceOf(const TriangleMesh& mesh) {
    const MeshReport report = measure(mesh);
    const Vector3 low = toVector(report.low), high = toVector(report.high);
    const double farthest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
    return std::max(weldTolerance * (high - low).maxCoeff(),
                    weldRoundings * double{std::numeric_limits<float>::epsilon()} * farthest);
}

void stitch(Trial& trial, Repairs& report) {
    const double tolerance = report.tolerance;
    report.joinedVertices =
        trial.apply(report, [&](TriangleMesh& mesh) { return joinNear(mesh, tolerance); });
    report.splitEdges =
        trial.apply(report, [&](TriangleMesh& mesh) { return splitJunctions(mesh, tolerance); });
}

void close(Trial& trial, Repairs& report) {
    if (trial.defects().nonManifoldEdges > 0) // leftovers lie at such edges
        report.removedTriangles += trial.apply(report, removeLeftovers);
    if (trial.defects().flippedEdges > 0) report.turnedTriangles = orientNeighbours(trial.mesh());
    if (trial.defects().boundaryEdges > 0) {
        Repairs closed = report;
        const auto closing = [&](TriangleMesh& mesh) {
            closeHoles(mesh, true, closed);
            return closed.closedHoles;
        };
        if (trial.apply(closed, closing) > 0) report = closed;
    }
    report.turnedParts = turnParts(trial.mesh());
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

TriangleMesh repair(TriangleMesh mesh, Repair how, MeshDefects& defects, Repairs& report) {
    report = {.how = how, .tolerance = toleranceOf(mesh)};
    Trial trial(std::move(mesh), defects);
    if (how != Repair::none && defects.boundaryEdges > 0) stitch(trial, report);
    if (how == Repair::close) close(trial, report);
    if (trial.defects().boundaryEdges > 0) closeHoles(trial.mesh(), false, report);
    TriangleMesh result = std::move(trial.mesh());
    if (!report.isAny()) return result;
    MeshDefects left;
    result = weld(result, left);
    defects.boundaryEdges = left.boundaryEdges;
    defects.nonManifoldEdges = left.nonManifoldEdges;
    defects.flippedEdges = left.flippedEdges;
    return result;
}

} // namespace sinew::mesh
