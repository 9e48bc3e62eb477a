// The straightforward way: all triangles and all balls.
#include "host_pick.hpp"

#include "sim/compile/compile.hpp"
#include "support/device.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace sinew::viewer {

namespace {

constexpr float none = std::numeric_limits<float>::infinity();

Vector3 placeOf(const sim::layout::vec4& v) {
    return {v.x, v.y, v.z};
}

// The visible range of a ray; `isOpened`: from `from` on it is behind a section plane.
struct Seen {
    float from = 0, to = none;
    bool isOpened = false;
};

Seen seenOf(const Ray& ray, const std::optional<Opened>& opened) {
    if (!opened) return {};
    const Section& section = opened->section;
    const float height = section.normal.dot(ray.origin) - section.offset;
    const float approach = -section.normal.dot(ray.direction);
    if (height <= 0) return {.to = approach < 0 ? height / approach : none};
    return {.from = approach > 0 ? height / approach : none, .isOpened = true};
}

// Distance along the ray at which it meets the triangle from either side (Moller and Trumbore 1997); `none`
// on a miss. `isBack`: met from behind.
float meetsTriangle(const Ray& ray, const Vector3& a, const Vector3& b, const Vector3& c, bool& isBack) {
    const Vector3 ab = b - a, ac = c - a, p = ray.direction.cross(ac);
    const float volume = ab.dot(p);
    if (volume == 0) return none;
    isBack = volume < 0;
    const Vector3 from = ray.origin - a, q = from.cross(ab);
    const float u = from.dot(p) / volume, v = ray.direction.dot(q) / volume, t = ac.dot(q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : none;
}

float meetsBall(const Ray& ray, const Vector3& center, float radius, const Seen& seen) {
    const Vector3 from = ray.origin - center;
    const float along = -from.dot(ray.direction);
    const float apart = (from + along * ray.direction).squaredNorm();
    if (!(apart <= radius * radius)) return none;
    const float half = std::sqrt(radius * radius - apart), t = along - half;
    if (seen.isOpened && t <= seen.from && along + half > seen.from) return seen.from;
    return t > seen.from && t <= seen.to ? t : none;
}

// Adds all particles that hold the corners of a skin triangle; in a cut state only the anchors of the
// corners, since the cell of a corner may be cut apart.
void addHolders(const sim::Skin& skin, const SeenCuts::Triangle& triangle, bool isCut,
                std::vector<std::uint32_t>& holders) {
    for (const std::uint32_t corner : triangle)
        if (skin.cells.empty())
            holders.push_back(skin.particles[corner]);
        else if (isCut && !skin.anchors.empty())
            holders.push_back(skin.anchors[corner]);
        else
            holders.insert(holders.end(), skin.cells[corner].particles.begin(),
                           skin.cells[corner].particles.end());
}

struct Nearest {
    float distance = none;
    std::vector<std::uint32_t> holders;
};

// Adds all particles of the skin's body: the opened inside lies between them.
void addBody(const sim::Scene& scene, const sim::Skin& skin, std::vector<std::uint32_t>& holders) {
    const std::uint32_t one = skin.cells.empty() ? skin.particles[0] : skin.cells[0].particles[0];
    for (const sim::Body& body : scene.bodies)
        if (one - body.firstParticle < body.particleCount)
            for (std::uint32_t i = 0; i < body.particleCount; ++i) holders.push_back(body.firstParticle + i);
}

// Tests skins and the surface of cuts, which are closed together if the skin is closed.
class SkinTest {
public:
    SkinTest(const sim::Scene& scene, const Ray& ray, const SeenState& state, const Seen& seen)
        : scene_(scene), ray_(ray), state_(state), seen_(seen), windings_(scene.skins.size()),
          hasDebris_(std::ranges::count(state.pieces, REMOVED_PIECE) > 0) {}

    void look(Nearest& nearest) {
        Place place;
        std::size_t before = 0; // triangles
        for (place.skin = 0; place.skin < scene_.skins.size(); ++place.skin) {
            const sim::Skin& skin = scene_.skins[place.skin];
            place.areOfAll = state_.cuts.has_value();
            if (place.areOfAll)
                lookAt(place, state_.cuts->skins.subspan(before, skin.triangles.size()), nearest);
            else
                lookAt(place,
                       state_.isWhole && !skin.wholeTriangles.empty() ? skin.wholeTriangles : skin.triangles,
                       nearest);
            place.firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
            before += skin.triangles.size();
        }
        if (state_.cuts) lookAtCuts(*state_.cuts, nearest);
    }

    // Hit at the section plane, if the ray enters a body there.
    void lookInside(const std::vector<bool>& isClosed, Nearest& nearest) const {
        for (std::size_t s = 0; s < windings_.size(); ++s) {
            if (windings_[s] == 0 || !isClosed[s]) continue;
            nearest = {seen_.from, {}};
            addBody(scene_, scene_.skins[s], nearest.holders);
        }
    }

private:
    struct Place {
        std::uint32_t skin = 0, firstVertex = 0;
        bool areOfAll = false; // indices refer to vertices of all skins, not of this one
    };
    void lookAt(const Place& place, std::span<const SeenCuts::Triangle> triangles, Nearest& nearest) {
        const std::uint32_t own = place.areOfAll ? place.firstVertex : 0, all = place.firstVertex - own;
        for (const auto& [a, b, c] : triangles) {
            const auto corner = [&](std::uint32_t i) { return placeOf(state_.vertices[all + i].position); };
            if (isGone(scene_.skins[place.skin], {a - own, b - own, c - own})) continue;
            if (meets(place.skin, corner(a), corner(b), corner(c), nearest))
                addHolders(scene_.skins[place.skin], {a - own, b - own, c - own}, state_.cuts.has_value(),
                           nearest.holders);
        }
    }

    // Whether a triangle is removed: a clipped skin follows its anchors, a stretched one every particle it
    // depends on (sim/cutting/debris_skins).
    bool isGone(const sim::Skin& skin, const SeenCuts::Triangle& triangle) const {
        if (!hasDebris_) return false;
        return std::ranges::any_of(triangle, [&](std::uint32_t corner) {
            if (skin.cells.empty()) return isRemoved(state_.pieces, skin.particles[corner]);
            if (!skin.anchors.empty() && state_.cuts) return isRemoved(state_.pieces, skin.anchors[corner]);
            const sim::CellEmbedding& cell = skin.cells[corner];
            for (std::size_t k = 0; k < cell.particles.size(); ++k)
                if (cell.share(k) > 0 && isRemoved(state_.pieces, cell.particles[k])) return true;
            return false;
        });
    }

    void lookAtCuts(const SeenCuts& cuts, Nearest& nearest) {
        for (const SeenCuts::Triangle& triangle : cuts.surface) {
            const auto corner = [&](std::size_t i) { return placeOf(cuts.vertices[triangle[i]].position); };
            const auto s = static_cast<std::uint32_t>(cuts.rest[triangle[0]].rest.w);
            if (!meets(s, corner(0), corner(1), corner(2), nearest)) continue;
            for (const std::uint32_t vertex : triangle) addHoldersOf(s, cuts, vertex, nearest.holders);
        }
    }

    // Adds the holders of a vertex of the surface of cuts.
    void addHoldersOf(std::uint32_t s, const SeenCuts& cuts, std::uint32_t vertex,
                      std::vector<std::uint32_t>& holders) const {
        const std::uint32_t point = cuts.rest[vertex].point;
        if ((point & SURFACE_PARTICLE) != 0) return holders.push_back(point ^ SURFACE_PARTICLE);
        if ((point & SURFACE_SKIN) != 0) {
            const std::uint32_t corner = (point ^ SURFACE_SKIN) - firstVertexOf(s);
            return addHolders(scene_.skins[s], {corner, corner, corner}, true, holders);
        }
        const bool isRim = (point & SURFACE_RIM) != 0;
        const sim::layout::CutVertex& on = cuts.rest[point & (SURFACE_RIM - 1)];
        const std::array<float, 4> shares{on.shares.x, on.shares.y, on.shares.z, on.shares.w};
        for (std::size_t c = 0; c < (isRim ? 2u : 4u); ++c)
            if (shares[c] > 0) holders.push_back(cuts.particles[on.corners[c]]);
    }

    std::uint32_t firstVertexOf(std::uint32_t s) const {
        std::size_t first = 0;
        for (std::uint32_t i = 0; i < s; ++i) first += scene_.skins[i].vertexCount();
        return static_cast<std::uint32_t>(first);
    }

    // Whether the triangle is the nearest hit so far; `nearest` then has no holders yet.
    bool meets(std::uint32_t s, const Vector3& a, const Vector3& b, const Vector3& c, Nearest& nearest) {
        bool isBack = false;
        const float distance = meetsTriangle(ray_, a, b, c, isBack);
        if (distance == none || distance < seen_.from || distance > seen_.to) return false;
        windings_[s] += isBack ? 1 : -1;
        if (distance >= nearest.distance) return false;
        nearest = {distance, {}};
        return true;
    }

    const sim::Scene& scene_;
    const Ray& ray_;
    const SeenState& state_;
    const Seen& seen_;
    std::vector<int> windings_; // by skin: winding number around the entry point at the section
    bool hasDebris_;
};

void lookAtBalls(const BallList& balls, const Ray& ray, const SeenState& state, const Seen& seen,
                 Nearest& nearest) {
    for (const BallRange& range : balls.ranges)
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            if (isRemoved(state.pieces, i)) continue;
            const float distance = meetsBall(ray, placeOf(state.positions[i]), balls.radii[i], seen);
            if (distance < nearest.distance) nearest = {distance, {i}};
        }
}

} // namespace

std::optional<Pick> pickOnHost(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                               const SeenState& state, Among among, const std::optional<Opened>& opened) {
    const Seen seen = seenOf(ray, opened);
    Nearest nearest;
    if (!state.vertices.empty()) {
        SkinTest skins(scene, ray, state, seen);
        skins.look(nearest);
        if (seen.isOpened && seen.from != none) skins.lookInside(opened->isClosed, nearest);
    }
    lookAtBalls(balls, ray, state, seen, nearest);
    if (nearest.distance == none) return std::nullopt;
    const Vector3 point = ray.origin + nearest.distance * ray.direction;
    if (among == Among::moving) {
        const std::vector<float> inverseMass = sim::inverseMasses(scene);
        std::erase_if(nearest.holders, [&](std::uint32_t i) { return inverseMass[i] == 0; });
    }
    std::erase_if(nearest.holders, [&](std::uint32_t i) { return isRemoved(state.pieces, i); });
    if (nearest.holders.empty()) return std::nullopt;
    const auto apart = [&](std::uint32_t i) { return (placeOf(state.positions[i]) - point).squaredNorm(); };
    const std::uint32_t particle =
        *std::ranges::min_element(nearest.holders, {}, [&](std::uint32_t i) { return apart(i); });
    return Pick{particle, point, point - placeOf(state.positions[particle]), nearest.distance};
}

namespace {

template <typename T> std::vector<T> copyOf(const vk::BufferView& view) {
    std::vector<T> all(view.size / sizeof(T));
    if (!all.empty()) test::queue().download(view, all.data(), view.size);
    return all;
}

// Sheets: their pieces are not in the surface of cuts.
bool isSheet(const sim::Scene& scene, const sim::Skin& skin) {
    return !skin.particles.empty() && std::ranges::any_of(scene.grids, [&](const sim::Grid& grid) {
        return skin.particles.front() - grid.firstParticle < grid.node.size() && grid.nodes[1] == 1;
    });
}

} // namespace

StateCopy::StateCopy(const sim::Scene& scene, const sim::Simulation& simulation)
    : positions_(copyOf<sim::layout::vec4>(simulation.positions())),
      vertices_(copyOf<sim::layout::SkinVertex>(simulation.skinVertices())),
      pieces_(copyOf<std::uint32_t>(simulation.pieces())), isWhole_(simulation.drawnSkins().areWhole) {
    const sim::CutSurface surface = simulation.cutSurface();
    if (isWhole_ || surface.vertices.size == 0) return;
    cutVertices_ = copyOf<sim::layout::SkinVertex>(surface.vertices);
    rest_ = copyOf<sim::layout::CutVertex>(surface.rest);
    surface_ = copyOf<std::uint32_t>(surface.indices);
    particles_ = copyOf<std::uint32_t>(surface.particles);
    skins_ = copyOf<std::uint32_t>(simulation.skinIndices());
    const auto counts = copyOf<sim::layout::SurfaceState>(surface.counts)[0];
    triangles_ = counts.inside + std::size_t{counts.outside};
    cutVertexCount_ = counts.points + std::size_t{3} * counts.outside;
    std::size_t index = 0;
    std::uint32_t firstVertex = 0;
    for (const sim::Skin& skin : scene.skins) {
        if (isSheet(scene, skin))
            for (std::size_t t = 0; t < skin.triangles.size(); ++t)
                for (std::size_t c = 0; c < 3; ++c)
                    skins_[index + 3 * t + c] = firstVertex + skin.triangles[t][c];
        index += 3 * skin.triangles.size();
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
}

SeenState StateCopy::seen() const {
    const auto triangles = [](const std::vector<std::uint32_t>& indices, std::size_t count) {
        return std::span(reinterpret_cast<const SeenCuts::Triangle*>(indices.data()), count);
    };
    SeenState seen{.positions = positions_, .vertices = vertices_, .isWhole = isWhole_, .pieces = pieces_};
    if (triangles_ > 0)
        seen.cuts = SeenCuts{.skins = triangles(skins_, skins_.size() / 3),
                             .surface = triangles(surface_, triangles_),
                             .vertices = std::span(cutVertices_).first(cutVertexCount_),
                             .rest = std::span(rest_).first(cutVertexCount_),
                             .particles = particles_};
    return seen;
}

} // namespace sinew::viewer
