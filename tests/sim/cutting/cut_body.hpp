// A body that may be cut, on the shared device, with its links read back and looked at one by one: what
// kernels do in bits is done here over particles and in double.
#pragma once

#include "sim/lattice/placement.hpp"
#include "sim/program.hpp"
#include "sim/runner.hpp"

namespace sinew::test {

/// A link between particles, in the direction of a bit of the masks.
struct LiveLink {
    std::uint32_t a = 0, b = 0, bit = 0;
};

/// A plane through `point`.
struct CutPlane {
    Eigen::Vector3d point, normal;
};

/// The poly-lines of a blade, which a sim::Blade refers to.
struct Sweep {
    std::vector<sim::Vec3> from, to;
    bool isCarried = false;
    sim::Blade blade() const { return {.from = from, .to = to, .isCarried = isCarried}; }
};

/// A part of a plane that reaches `reach` beyond its point to all sides, swept in one step as `quads` quads
/// of unequal width.
Sweep sweepOf(const CutPlane& plane, double reach, std::size_t quads = 1);

class CutBody {
public:
    /// The only grid of `scene`, which must be cuttable.
    explicit CutBody(const sim::Scene& scene, const sim::Settings& settings = {.substeps = 2});

    Runner& runner() { return runner_; }
    sim::Status cut(const Sweep& sweep) { return runner_.cut(sweep.blade()); }

    /// Bits by slot, as the device has them.
    std::vector<std::uint32_t> words() const {
        return download(runner_.simulation().program().cutting.links);
    }
    /// Bits that do not agree with the other end's.
    std::size_t oneSided() const;
    std::vector<LiveLink> links() const;
    /// The plane is moved as a blade in it is (BLADE_SHIFT).
    bool isAbove(const Eigen::Vector3d& point, const CutPlane& plane) const;
    /// Live links from one side to the other.
    std::size_t bridges(const CutPlane& plane) const;
    /// Live links that no edges of tetrahedra within their own square or cell stand in for.
    std::size_t looseLinks() const;
    /// Connected components by the live links, and the same from the device: lowest particle of each one's
    /// piece.
    std::vector<std::uint32_t> expectedPieces() const;
    std::vector<std::uint32_t> pieces() const;
    std::vector<std::uint32_t> pieceSizes() const;
    /// Bytes 0 to 255 of the link that a particle owns in the direction of a Kuhn edge.
    std::uint32_t hit(std::uint32_t particle, std::array<int, 3> direction) const;
    /// Fill of the cells around each node that have all their edges; where cells have volumes.
    std::vector<std::uint32_t> wholeCells() const {
        return download(runner_.simulation().program().cutting.wholeCells);
    }
    std::vector<std::uint32_t> expectedWholeCells() const;

    /// Where the newest blade saw each particle [m]: those outside of the skin of a mesh just below it.
    std::vector<Eigen::Vector3d> bladePlaces() const;
    /// Where all particles themselves were then [m].
    std::vector<Eigen::Vector3d> placesAtCut() const;

    std::uint32_t particleAt(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return particles_[box_.slot(x, y, z)];
    }
    Eigen::Vector3d at(std::uint32_t particle) const; ///< where the scene has it
    double spacing() const { return double{scene_.grids[0].restLength[0]}; }
    const sim::Scene& scene() const { return scene_; }

private:
    std::vector<std::uint32_t> download(sim::BufferId buffer) const;
    std::vector<Eigen::Vector3d> placesIn(sim::BufferId buffer) const; // which is by slot
    std::uint32_t neighbour(std::uint32_t slot, std::uint32_t bit) const;
    bool isLoose(const LiveLink& link, const std::vector<std::uint32_t>& masks) const;

    sim::Scene scene_;
    sim::lattice::Box box_;
    std::vector<std::uint32_t> particles_, slots_; // by slot; by particle
    mutable Runner runner_;
};

} // namespace sinew::test
