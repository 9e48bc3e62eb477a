// Computes directions and neighbours from grid coordinates.
#include "sim/cutting/cut_body.hpp"

#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/lattice/pieces.hpp"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace sinew::test {

using Eigen::Vector3d;
using namespace sim;

Sweep sweepOf(const CutPlane& plane, double reach, std::size_t quads) {
    const Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u).normalized();
    Sweep sweep;
    for (std::size_t p = 0; p <= quads; ++p) {
        const double part = static_cast<double>(p * p + p) / static_cast<double>(quads * quads + quads);
        const Vector3d middle = plane.point + reach * (2 * part - 1) * u;
        sweep.from.push_back(toFloats(middle - reach * v));
        sweep.to.push_back(toFloats(middle + reach * v));
    }
    return sweep;
}

CutBody::CutBody(const Scene& scene, const Settings& settings)
    : scene_(scene), slots_(stateLayout(scene, settings).slot), runner_(scene, settings) {
    const Grid& grid = scene_.grids.at(0);
    box_ = lattice::place(grid, 0);
    if (lattice::isSheet(grid)) // a listed sheet has no box
        box_.sliceStride = slots_[grid.firstParticle + grid.nodes[0]] - slots_[grid.firstParticle];
    const auto first = lattice::coordinates(grid, grid.node[0]);
    const std::uint32_t shift =
        slots_[grid.firstParticle] - box_.slot(first[0], first[1], first[2]); // other grids have lower slots
    box_.origin += shift;
    particles_.assign(box_.end + shift, NO_PARTICLE);
    for (std::uint32_t i = 0; i < grid.node.size(); ++i)
        particles_[slots_[grid.firstParticle + i]] = grid.firstParticle + i;
}

std::vector<std::uint32_t> CutBody::download(BufferId buffer) const {
    return queue().download<std::uint32_t>(runner_.simulation().view(buffer));
}

std::uint32_t CutBody::neighbour(std::uint32_t slot, std::uint32_t bit) const {
    const auto [x, y, z] = lattice::directionOf(bit);
    return slot + static_cast<std::uint32_t>(x + y * static_cast<int>(box_.rowStride) +
                                             z * static_cast<int>(box_.sliceStride));
}

Vector3d CutBody::at(std::uint32_t particle) const {
    return toVector(scene_.particles[particle].position);
}

std::size_t CutBody::oneSided() const {
    const auto masks = words();
    std::size_t count = 0;
    for (const std::uint32_t slot : slots_)
        for (std::uint32_t bit = 0; bit < lattice::directionCount; ++bit) {
            if ((masks[slot] >> bit & 1) == 0) continue;
            const std::uint32_t other = neighbour(slot, bit);
            count += particles_[other] == NO_PARTICLE || (masks[other] >> (25 - bit) & 1) == 0 ? 1 : 0;
        }
    return count;
}

std::vector<LiveLink> CutBody::links() const {
    const auto masks = words();
    std::vector<LiveLink> links;
    for (std::uint32_t i = 0; i < slots_.size(); ++i)
        for (std::uint32_t bit = lattice::firstOwned; bit < lattice::directionCount; ++bit)
            if ((masks[slots_[i]] >> bit & 1) != 0)
                links.push_back({i, particles_[neighbour(slots_[i], bit)], bit});
    return links;
}

bool CutBody::isAbove(const Vector3d& point, const CutPlane& plane) const {
    const Vector3d shift = spacing() * Vector3d(BLADE_SHIFT_X, BLADE_SHIFT_Y, BLADE_SHIFT_Z);
    return plane.normal.dot(point - plane.point - shift) >= 0;
}

std::size_t CutBody::bridges(const CutPlane& plane) const {
    const auto x = runner_.positions();
    std::size_t count = 0;
    for (const LiveLink& link : links())
        count += isAbove(x[link.a], plane) != isAbove(x[link.b], plane) ? 1 : 0;
    return count;
}

// Searches a path of stiff Kuhn edges between both ends, within the box that the link spans.
bool CutBody::isLoose(const LiveLink& link, const std::vector<std::uint32_t>& masks) const {
    const auto direction = lattice::directionOf(link.bit);
    const std::uint32_t stiff = lattice::stiffLinks(scene_.grids[0]);
    using Step = std::array<int, 3>; // offset from a
    const auto isInBox = [&](const Step& step) {
        for (std::size_t k = 0; k < 3; ++k)
            if (step[k] < std::min(direction[k], 0) || step[k] > std::max(direction[k], 0)) return false;
        return true;
    };
    std::vector<std::pair<std::uint32_t, Step>> reached{{slots_[link.a], Step{}}}; // grows during the loop
    for (std::size_t r = 0; r < reached.size(); ++r)
        for (std::uint32_t bit = 0; bit < lattice::directionCount; ++bit) {
            const auto [slot, from] = reached[r];
            const auto edge = lattice::directionOf(bit);
            if (!lattice::isKuhn(edge) || (masks[slot] & stiff & 1u << bit) == 0) continue;
            const Step to{from[0] + edge[0], from[1] + edge[1], from[2] + edge[2]};
            const std::pair end{neighbour(slot, bit), to};
            if (isInBox(to) && std::ranges::find(reached, end) == reached.end()) reached.push_back(end);
        }
    return std::ranges::none_of(reached, [&](const auto& end) { return end.first == slots_[link.b]; });
}

std::size_t CutBody::looseLinks() const {
    const std::uint32_t stiff = lattice::stiffLinks(scene_.grids[0]);
    const auto masks = words();
    return static_cast<std::size_t>(std::ranges::count_if(links(), [&](const LiveLink& link) {
        const bool isEdge = lattice::isKuhn(lattice::directionOf(link.bit)) && (stiff >> link.bit & 1) != 0;
        return !isEdge && isLoose(link, masks);
    }));
}

std::vector<std::uint32_t> CutBody::expectedPieces() const {
    lattice::PieceFinder finder(particles_.size());
    for (const LiveLink& link : links()) finder.join(slots_[link.a], slots_[link.b]);
    return finder.finish(particles_, scene_.particles.size()).ofParticles;
}

std::vector<std::uint32_t> CutBody::pieces() const {
    return download(runner_.simulation().program().cutting.pieces);
}

std::vector<std::uint32_t> CutBody::pieceSizes() const {
    return download(runner_.simulation().program().cutting.pieceSizes);
}

std::uint32_t CutBody::hit(std::uint32_t particle, std::array<int, 3> direction) const {
    const auto bytes = queue().download<std::uint8_t>(
        runner_.simulation().view(runner_.simulation().program().cutting.hits));
    const int kuhn = direction[0] + 2 * direction[1] + 4 * direction[2] - 1;
    return bytes[sizeof(layout::LinkHits) * slots_[particle] + static_cast<std::size_t>(kuhn)];
}

std::vector<Vector3d> CutBody::bladePlaces() const {
    const StepProgram& program = runner_.simulation().program();
    const auto pulled =
        std::ranges::find(program.buffers, std::string("surface.pulled_places"), &BufferSpec::label);
    return placesIn(pulled == program.buffers.end()
                        ? program.cutting.places
                        : BufferId{static_cast<std::uint32_t>(pulled - program.buffers.begin())});
}

std::vector<Vector3d> CutBody::placesAtCut() const {
    return placesIn(runner_.simulation().program().cutting.places);
}

std::vector<Vector3d> CutBody::placesIn(BufferId buffer) const {
    const auto places = queue().download<std::array<float, 4>>(runner_.simulation().view(buffer));
    std::vector<Vector3d> result;
    for (const std::uint32_t slot : slots_) {
        const auto& [x, y, z, w] = places[slot];
        result.emplace_back(double{x}, double{y}, double{z});
    }
    return result;
}

std::vector<std::uint32_t> CutBody::expectedWholeCells() const {
    std::vector<std::vector<bool>> isLinked(scene_.particles.size(), std::vector<bool>(26));
    for (const LiveLink& link : links()) isLinked[link.a][link.bit] = true;
    Grid whole = scene_.grids[0];
    const auto [nx, ny, nz] = whole.nodes;
    std::size_t cell = 0;
    for (std::uint32_t z = 0; z + 1 < nz; ++z)
        for (std::uint32_t y = 0; y + 1 < ny; ++y)
            for (std::uint32_t x = 0; x + 1 < nx; ++x, ++cell)
                for (std::uint32_t axis = 0; axis < 3 && whole.fill[cell] != 0; ++axis)
                    for (std::uint32_t edge = 0; edge < 4; ++edge) {
                        std::array<std::uint32_t, 3> at{x, y, z};
                        at[(axis + 1) % 3] += edge & 1;
                        at[(axis + 2) % 3] += edge >> 1;
                        std::array<int, 3> direction{};
                        direction[axis] = 1;
                        const auto bit = static_cast<std::size_t>(13 + direction[0] + 3 * direction[1] +
                                                                  9 * direction[2] - 1);
                        if (!isLinked[particleAt(at[0], at[1], at[2])][bit]) whole.fill[cell] = 0;
                    }
    std::vector<std::uint32_t> cells(wholeCells().size());
    lattice::writeCells(whole, box_, cells);
    return cells;
}

} // namespace sinew::test
