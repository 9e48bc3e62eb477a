// Tests every triangle and every ball: a click is rare, and a hundred thousand triangles take a millisecond
// or two.
#include "viewer/hands/pick.hpp"

#include "sim/compile/compile.hpp"

#include <algorithm>
#include <cmath>
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
class SkinPicker {
public:
    SkinPicker(const sim::Scene& scene, const Ray& ray, const SeenState& state, const Seen& seen)
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

bool isRemoved(std::span<const std::uint32_t> pieces, std::uint32_t particle) {
    return !pieces.empty() && pieces[particle] == REMOVED_PIECE;
}

std::optional<Pick> pick(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                         const SeenState& state, Among among, const std::optional<Opened>& opened) {
    const Seen seen = seenOf(ray, opened);
    Nearest nearest;
    if (!state.vertices.empty()) {
        SkinPicker skins(scene, ray, state, seen);
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

sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle) {
    const auto holds = [&](const sim::Body& body) {
        return particle - body.firstParticle < body.particleCount;
    };
    const auto found = std::ranges::find_if(scene.bodies, holds);
    return found == scene.bodies.end() ? sim::Body{} : *found;
}

float holdRadius(const sim::Scene& scene, std::uint32_t particle) {
    float next = none;
    for (const sim::DistanceConstraint& link : scene.distances)
        if ((link.a == particle || link.b == particle) && link.restLength > 0)
            next = std::min(next, link.restLength);
    if (next == none) return 0; // a single particle
    Box box;
    for (const sim::Body& body : scene.bodies)
        if (particle - body.firstParticle < body.particleCount)
            for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
                const sim::Vec3& x = scene.particles[i].position;
                box.extend(Vector3(x.x, x.y, x.z));
            }
    const float size = box.isEmpty() ? 0 : box.diagonal().norm();
    return std::max(size / 8, 1.5f * next);
}

} // namespace sinew::viewer
