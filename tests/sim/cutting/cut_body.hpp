// A body that may be cut, on the shared device. Reads its links back and checks each, over particles and in
// double, where kernels use bits.
#pragma once

#include "sim/lattice/placement.hpp"
#include "sim/program/program.hpp"
#include "sim/runner.hpp"

namespace sinew::test {

/// A link between two particles; `bit` is its direction in the masks.
struct LiveLink {
    std::uint32_t a = 0, b = 0, bit = 0;
};

/// A plane through `point`.
struct CutPlane {
    Eigen::Vector3d point, normal;
};

/// Poly-lines of a blade; a sim::Blade refers to them.
struct Sweep {
    std::vector<sim::Vec3> from, to;
    bool isCarried = false;
    sim::Blade blade() const { return {.from = from, .to = to, .isCarried = isCarried}; }
};

/// A square of the plane that extends `reach` beyond its point in all directions, swept in one step as
/// `quads` quads of unequal width.
Sweep sweepOf(const CutPlane& plane, double reach, std::size_t quads = 1);

class CutBody {
public:
    /// The scene must have exactly one grid, which must be cuttable.
    explicit CutBody(const sim::Scene& scene, const sim::Settings& settings = {.substeps = 2});

    Runner& runner() { return runner_; }
    sim::Status cut(const Sweep& sweep) { return runner_.cut(sweep.blade()); }

    /// Link masks by slot, as on the device.
    std::vector<std::uint32_t> words() const {
        return download(runner_.simulation().program().cutting.links);
    }
    /// Number of mask bits without the matching bit of the other end.
    std::size_t oneSided() const;
    std::vector<LiveLink> links() const;
    /// Whether the point is above the plane, which is shifted like a blade (BLADE_SHIFT).
    bool isAbove(const Eigen::Vector3d& point, const CutPlane& plane) const;
    /// Number of live links across the plane.
    std::size_t bridges(const CutPlane& plane) const;
    /// Number of live links that no path of stiff Kuhn edges within their square or cell replaces.
    std::size_t looseLinks() const;
    /// Lowest particle of each particle's connected component: computed here from live links, and read from
    /// the device.
    std::vector<std::uint32_t> expectedPieces() const;
    std::vector<std::uint32_t> pieces() const;
    std::vector<std::uint32_t> pieceSizes() const;
    /// The blade's hit on the link that a particle owns in the direction of a Kuhn edge: its place as a byte,
    /// 0 to 255.
    std::uint32_t hit(std::uint32_t particle, std::array<int, 3> direction) const;
    /// Fill of those cells around each node that have all their edges; only where cells have volumes.
    std::vector<std::uint32_t> wholeCells() const {
        return download(runner_.simulation().program().cutting.wholeCells);
    }
    std::vector<std::uint32_t> expectedWholeCells() const;

    /// Positions at which the newest blade saw the particles [m]: those outside of a mesh's skin lie just
    /// below the skin.
    std::vector<Eigen::Vector3d> bladePlaces() const;
    /// Positions of all particles at that time [m].
    std::vector<Eigen::Vector3d> placesAtCut() const;

    std::uint32_t particleAt(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return particles_[box_.slot(x, y, z)];
    }
    Eigen::Vector3d at(std::uint32_t particle) const; ///< position in the scene
    double spacing() const { return double{scene_.grids[0].restLength[0]}; }
    const sim::Scene& scene() const { return scene_; }

private:
    std::vector<std::uint32_t> download(sim::BufferId buffer) const;
    std::vector<Eigen::Vector3d> placesIn(sim::BufferId buffer) const; // the buffer is by slot
    std::uint32_t neighbour(std::uint32_t slot, std::uint32_t bit) const;
    bool isLoose(const LiveLink& link, const std::vector<std::uint32_t>& masks) const;

    sim::Scene scene_;
    sim::lattice::Box box_;
    std::vector<std::uint32_t> particles_, slots_; // by slot; by particle
    mutable Runner runner_;
};

} // namespace sinew::test
