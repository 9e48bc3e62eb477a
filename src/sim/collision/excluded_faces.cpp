// The points of a linked body that may not touch its faces, from the scene at rest: links keep apart what is
// so near there.
#include "sim/collision/contact_lists.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/collision/vectors.hpp"
#include "sim/lattice/depths.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/model/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sinew::sim::collision::face_contacts {

namespace {

constexpr double nearness = 1.05;

double distance(const Vector& p, const std::array<Vector, 3>& x) {
    const Vector ab = minus(x[1], x[0]), ac = minus(x[2], x[0]), ap = minus(p, x[0]), n = cross(ab, ac);
    const double nn = dot(n, n), b = dot(cross(ap, ac), n), c = dot(cross(ab, ap), n);
    if (nn > 0 && b >= 0 && c >= 0 && b + c <= nn) return std::abs(dot(ap, n)) / std::sqrt(nn);
    return std::sqrt(std::min(
        {squaredToSegment(p, x[0], x[1]), squaredToSegment(p, x[1], x[2]), squaredToSegment(p, x[2], x[0])}));
}

// Whether a point is within `reach` of the bounding box of three others.
bool isInBox(const Vector& p, const std::array<Vector, 3>& x, double reach) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({x[0][axis], x[1][axis], x[2][axis]});
        if (p[axis] < low - reach || p[axis] > high + reach) return false;
    }
    return true;
}

using Cell = std::array<std::int64_t, 3>;

// The points of one linked body, in cells as wide as the reach of a face.
class Points {
public:
    Points(const Scene& scene, std::span<const float> radii) : scene_(scene), radii_(radii) {}

    void add(std::uint32_t i) {
        members_.push_back(i);
        widest_ = std::max(widest_, double{radii_[i]});
    }

    // For faces with boxes at most `extent` wide, and at most `thickness` thick.
    void sort(double extent, double thickness) {
        edge_ = std::max(extent + 2 * nearness * (thickness + widest_), 1e-30);
        for (const std::uint32_t i : members_)
            cells_[cellOf(toVector(scene_.particles[i].position))].push_back(i);
    }

    void addNear(const layout::ContactFace& face, std::vector<std::uint32_t>& near) const {
        const std::array<std::uint32_t, 3> corners{face.a, face.b, face.c};
        std::array<Vector, 3> x;
        for (int c = 0; c < 3; ++c) x[c] = toVector(scene_.particles[corners[c]].position);
        const Cell home = cellOf(x[0]);
        for (std::int64_t n = 0; n < 27; ++n) {
            const auto found =
                cells_.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const std::uint32_t i : found->second) {
                if (std::ranges::find(corners, i) != corners.end()) continue;
                const double reach = nearness * (double{radii_[i]} + double{face.thickness});
                const Vector p = toVector(scene_.particles[i].position);
                if (isInBox(p, x, reach) && distance(p, x) < reach) near.push_back(i);
            }
        }
    }

private:
    Cell cellOf(const Vector& x) const {
        const auto index = [this](double value) {
            return static_cast<std::int64_t>(std::floor(value / edge_));
        };
        return {index(x[0]), index(x[1]), index(x[2])};
    }

    const Scene& scene_;
    std::span<const float> radii_;
    std::vector<std::uint32_t> members_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
    double widest_ = 0, edge_ = 1;
};

// The particles of one voxel body, and the initial links between them.
class Nodes {
public:
    Nodes(const Grid& grid, std::span<const float> radii) : grid_(grid), first_(grid.firstParticle) {
        particle_.resize(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2]);
        for (std::uint32_t n = 0; n < grid.node.size(); ++n) {
            particle_[grid.node[n]] = first_ + n;
            const auto at = lattice::coordinates(grid, grid.node[n]);
            links_.push_back(lattice::linksAt(grid, at));
            isInside_.push_back(lattice::isInside(lattice::fillAround(grid, at)));
            widest_ = std::max(widest_, radii[first_ + n]);
        }
    }

    bool has(std::uint32_t i) const { return i >= first_ && i - first_ < links_.size(); }

    void addLinked(std::uint32_t i, std::vector<std::uint32_t>& linked) const {
        const auto at = lattice::coordinates(grid_, grid_.node[i - first_]);
        for (std::uint32_t bit = 0; bit < lattice::directionCount; ++bit) {
            if ((links_[i - first_] >> bit & 1) == 0) continue;
            const auto [x, y, z] = lattice::directionOf(bit);
            linked.push_back(
                particle_[at[0] + static_cast<std::uint32_t>(x) +
                          grid_.nodes[0] * (at[1] + static_cast<std::uint32_t>(y) +
                                            grid_.nodes[1] * (at[2] + static_cast<std::uint32_t>(z)))]);
        }
    }

    // Whether all points nearer to a face than `reach` are linked to one of its corners.
    bool isDeep(const layout::ContactFace& face, double reach) const {
        const auto deep = [&](std::uint32_t i) { return isInside_[i - first_]; };
        return reach < leastUnlinked(grid_.kinds) * double{grid_.restLength[0]} && deep(face.a) &&
               deep(face.b) && deep(face.c);
    }

    // Whether points joined to a face only by diagonals are beyond contact distance.
    bool areDiagonalsApart(const layout::ContactFace& face) const {
        const double reach = nearness * (double{widest_} + double{face.thickness});
        return reach < leastUnlinked(1) * double{grid_.restLength[0]};
    }

    const Grid& grid() const { return grid_; }

private:
    const Grid& grid_;
    std::uint32_t first_;
    std::vector<std::uint32_t> particle_, links_; // by node; by particle
    std::vector<bool> isInside_;
    float widest_ = 0; // [m]
};

std::vector<Nodes> bodiesOfVoxels(const Scene& scene, std::span<const float> radii) {
    std::vector<Nodes> bodies;
    for (const Grid& grid : scene.grids)
        if (!lattice::isSheet(grid)) bodies.emplace_back(grid, radii);
    return bodies;
}

double extentOf(const Scene& scene, const layout::ContactFace& face) {
    const Vector a = toVector(scene.particles[face.a].position);
    double extent = 0;
    for (const std::uint32_t corner : {face.b, face.c}) {
        const Vector d = minus(toVector(scene.particles[corner].position), a);
        extent = std::max(extent, std::sqrt(dot(d, d)));
    }
    return extent;
}

// A linked body with faces: its points in cells, and the size and thickness of its faces.
struct Body {
    Points points;
    double extent = 0, thickness = 0;
};

std::map<std::uint32_t, Body> bodiesWithFaces(const Scene& scene, std::span<const layout::ContactFace> faces,
                                              std::span<const float> radii,
                                              std::span<const std::uint32_t> bodyOf) {
    std::map<std::uint32_t, Body> bodies;
    for (const layout::ContactFace& face : faces) {
        Body& body = bodies.try_emplace(bodyOf[face.a], Body{Points(scene, radii)}).first->second;
        body.extent = std::max(body.extent, extentOf(scene, face));
        body.thickness = std::max(body.thickness, double{face.thickness});
    }
    for (std::uint32_t i = 0; i < bodyOf.size(); ++i)
        if (const auto found = bodies.find(bodyOf[i]); found != bodies.end() && radii[i] >= 0)
            found->second.points.add(i);
    for (auto& [first, body] : bodies) body.points.sort(body.extent, body.thickness);
    return bodies;
}

const Nodes* nodesOf(std::span<const Nodes> voxels, const layout::ContactFace& face) {
    const auto found = std::ranges::find_if(
        voxels, [&](const Nodes& each) { return each.has(face.a) && each.has(face.b) && each.has(face.c); });
    return found == voxels.end() ? nullptr : &*found;
}

// Particles with an initial link to a corner, ascending, possibly repeated.
std::vector<std::uint32_t> linkedTo(const Nodes& nodes, const layout::ContactFace& face) {
    std::vector<std::uint32_t> linked;
    for (const std::uint32_t corner : {face.a, face.b, face.c}) nodes.addLinked(corner, linked);
    std::ranges::sort(linked);
    return linked;
}

} // namespace

double leastUnlinked(std::uint32_t kinds) {
    return std::sqrt(kinds == 1 ? 1.5 : kinds + 1.0);
}

std::vector<std::uint32_t> excludedPoints(const Scene& scene, std::span<const std::uint32_t> bodyOf,
                                          std::span<const layout::ContactFace> faces,
                                          std::span<const float> radii, const StateLayout& layout,
                                          std::span<const CutRun> runs) {
    const std::map<std::uint32_t, Body> bodies = bodiesWithFaces(scene, faces, radii, bodyOf);
    const std::vector<Nodes> voxels = bodiesOfVoxels(scene, radii);
    const float widest = radii.empty() ? 0.0f : *std::ranges::max_element(radii);
    std::vector<std::uint32_t> result(faces.size() + 1), near;
    std::vector<bool> feels(runs.size(), true);
    std::vector<std::size_t> marks; // words with a run, to be replaced by the index of its strides
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const layout::ContactFace& face = faces[f];
        result[f] = static_cast<std::uint32_t>(result.size());
        const Nodes* nodes = nodesOf(voxels, face);
        const auto run = std::ranges::find_if(runs, [&](const CutRun& each) {
            return nodes && nodes->grid().isCuttable && layout.slot[face.a] - each.first < each.count;
        });
        const bool goesByLinks = run != runs.end();
        near.clear();
        if (!goesByLinks || !nodes->isDeep(face, nearness * (double{widest} + double{face.thickness})))
            bodies.at(bodyOf[face.a]).points.addNear(face, near);
        if (goesByLinks) {
            const std::vector<std::uint32_t> linked = linkedTo(*nodes, face);
            std::erase_if(near, [&](std::uint32_t i) { return std::ranges::binary_search(linked, i); });
        }
        for (std::uint32_t& i : near) i = layout.slot[i];
        std::ranges::sort(near);
        near.erase(std::unique(near.begin(), near.end()), near.end());
        result.insert(result.end(), near.begin(), near.end());
        if (!goesByLinks) continue;
        const auto r = static_cast<std::size_t>(run - runs.begin());
        feels[r] = feels[r] && nodes->areDiagonalsApart(face);
        marks.push_back(result.size());
        result.push_back(static_cast<std::uint32_t>(run - runs.begin()));
    }
    result[faces.size()] = static_cast<std::uint32_t>(result.size());
    const std::size_t strides = result.size();
    for (std::size_t r = 0; r < runs.size(); ++r)
        result.insert(result.end(), {runs[r].rowStride, runs[r].sliceStride, feels[r] ? 1u : 0u});
    for (const std::size_t word : marks)
        result[word] = EXCLUDED_LINKED | static_cast<std::uint32_t>(strides + 3 * result[word]);
    return result;
}

} // namespace sinew::sim::collision::face_contacts
