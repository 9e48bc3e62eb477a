// Closing of holes: open edges are traced to loops without repeated vertices, and small loops get a patch.
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <Eigen/Geometry>
#include <map>

namespace sinew::mesh {
namespace {

/// An open edge in the direction of a patch's side.
struct Step {
    std::uint32_t from = 0, to = 0, triangle = 0;
};

class Tracer {
public:
    explicit Tracer(const TriangleMesh& mesh) {
        for (const OpenEdge& edge : findOpenEdges(mesh))
            steps_.push_back({edge.to, edge.from, edge.triangle});
        std::ranges::sort(steps_, {}, [](const Step& step) { return std::pair{step.from, step.to}; });
        isUsed_.resize(steps_.size());
        skipped_.resize(steps_.size());
    }
    std::size_t openEdges() const { return steps_.size(); }

    /// Traces loops of open edges. A loop ends as soon as a vertex is repeated, so loops that touch in a
    /// vertex are separated there.
    std::vector<Loop> trace() {
        std::vector<Loop> loops;
        for (std::size_t seed = 0; seed < steps_.size(); ++seed)
            if (!isUsed_[seed]) walk(seed, loops);
        return loops;
    }

private:
    void walk(std::size_t seed, std::vector<Loop>& loops) {
        std::vector<std::size_t> path{seed};
        std::map<std::uint32_t, std::size_t> places{{steps_[seed].from, 0}}; // index on the path, by vertex
        isUsed_[seed] = true;
        while (!path.empty()) {
            const std::uint32_t vertex = steps_[path.back()].to;
            if (const auto place = places.find(vertex); place != places.end()) {
                cut(place->second, path, places, loops);
                continue;
            }
            const std::size_t next = nextFrom(vertex);
            if (next == steps_.size()) { // neighbours have opposite orientations: no loop
                places.erase(steps_[path.back()].from);
                path.pop_back();
                continue;
            }
            places[vertex] = path.size();
            path.push_back(next);
            isUsed_[next] = true;
        }
    }

    void cut(std::size_t first, std::vector<std::size_t>& path, std::map<std::uint32_t, std::size_t>& places,
             std::vector<Loop>& loops) const {
        Loop loop;
        for (std::size_t i = first; i < path.size(); ++i) {
            loop.vertices.push_back(steps_[path[i]].from);
            loop.rim.push_back(steps_[path[i]].triangle);
            places.erase(steps_[path[i]].from);
        }
        path.resize(first);
        if (loop.vertices.size() >= 3) loops.push_back(std::move(loop));
    }

    std::size_t nextFrom(std::uint32_t vertex) {
        const auto step = std::ranges::lower_bound(steps_, vertex, {}, &Step::from);
        const auto first = static_cast<std::size_t>(step - steps_.begin());
        if (first == steps_.size()) return first;
        std::size_t index = first + skipped_[first];
        while (index < steps_.size() && steps_[index].from == vertex && isUsed_[index]) ++index;
        skipped_[first] = index - first;
        return index < steps_.size() && steps_[index].from == vertex ? index : steps_.size();
    }

    std::vector<Step> steps_;
    std::vector<bool> isUsed_;
    std::vector<std::size_t> skipped_; ///< at the first step of a vertex: number of its used steps
};

OpenHole describe(const TriangleMesh& mesh, const Loop& loop) {
    Vector3 sum = Vector3::Zero();
    OpenHole hole{.edges = loop.vertices.size()};
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        const Vector3 point = toVector(mesh.positions[loop.vertices[i]]);
        sum += point;
        hole.rim += (toVector(mesh.positions[loop.vertices[(i + 1) % loop.vertices.size()]]) - point).norm();
    }
    hole.middle = toVec3(sum / static_cast<double>(loop.vertices.size()));
    return hole;
}

/// The parts of a mesh, relative to which the size of a hole is measured.
class Surroundings {
public:
    explicit Surroundings(const TriangleMesh& mesh) {
        std::size_t count = 0;
        numbers_ = numberParts(mesh, count, Across::edges);
        parts_.resize(count);
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            Part& part = parts_[numbers_[i]];
            ++part.triangles;
            for (const std::uint32_t vertex : mesh.triangles[i])
                part.box.extend(toVector(mesh.positions[vertex]));
        }
    }

    struct Scale {
        double boxEdges = 0;      ///< sum of the twelve edges of the box [units of the mesh]
        bool isExempting = false; ///< a hole of three edges may be of any size
    };
    /// Measures all parts along the rim of `loop` together.
    Scale scaleOf(const Loop& loop) const {
        Part whole;
        std::set<std::uint32_t> seen;
        for (const std::uint32_t triangle : loop.rim) {
            if (!seen.insert(numbers_[triangle]).second) continue;
            const Part& part = parts_[numbers_[triangle]];
            whole.triangles += part.triangles;
            whole.box.extend(part.box);
        }
        return {4 * whole.box.sizes().sum(), whole.triangles > 3};
    }

private:
    struct Part {
        std::size_t triangles = 0;
        Eigen::AlignedBox3d box;
    };
    std::vector<std::uint32_t> numbers_;
    std::vector<Part> parts_;
};

bool isShort(const OpenHole& hole, const Surroundings::Scale& scale) {
    return hole.rim <= smallRim * scale.boxEdges || (hole.edges == 3 && scale.isExempting);
}

/// All edges between vertices of `loops`.
TakenEdges edgesBetween(const TriangleMesh& mesh, const std::vector<Loop>& loops) {
    std::vector<bool> isOnLoop(mesh.positions.size());
    for (const Loop& loop : loops)
        for (const std::uint32_t vertex : loop.vertices) isOnLoop[vertex] = true;
    std::vector<VertexPair> edges;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
            if (isOnLoop[a] && isOnLoop[b]) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    return TakenEdges(std::move(edges));
}

/// Texture coordinates of a patch's vertex: those that a triangle of the rim has there. The centre of a fan
/// has their mean.
sim::TexturePoint texturePointOf(const TriangleMesh& mesh, const Loop& loop, std::uint32_t vertex) {
    sim::TexturePoint sum;
    float count = 0;
    for (const std::uint32_t triangle : loop.rim)
        for (std::size_t n = 0; n < 3; ++n) {
            const sim::TexturePoint& at = mesh.textureCoordinates[triangle][n];
            if (mesh.triangles[triangle][n] == vertex) return at;
            sum = {sum.u + at.u, sum.v + at.v};
            ++count;
        }
    return {sum.u / count, sum.v / count};
}

void addPatch(TriangleMesh& mesh, const Loop& loop, const Patch& patch, TakenEdges& taken) {
    if (patch.center) mesh.positions.push_back(*patch.center);
    for (const auto& triangle : patch.triangles) {
        mesh.triangles.push_back(triangle);
        if (!mesh.objects.empty()) mesh.objects.push_back(mesh.objects[loop.rim.front()]);
        if (!mesh.parts.empty()) mesh.parts.push_back(mesh.parts[loop.rim.front()]);
        if (!mesh.textureCoordinates.empty())
            mesh.textureCoordinates.push_back({texturePointOf(mesh, loop, triangle[0]),
                                               texturePointOf(mesh, loop, triangle[1]),
                                               texturePointOf(mesh, loop, triangle[2])});
        for (std::size_t i = 0; i < 3; ++i) taken.add(triangle[i], triangle[(i + 1) % 3]);
    }
}

} // namespace

void closeHoles(TriangleMesh& mesh, bool closes, Repairs& report) {
    Tracer tracer(mesh);
    report.openEdges = tracer.openEdges();
    report.openHoles = 0;
    report.largest = {};
    const std::vector<Loop> loops = tracer.trace();
    const Surroundings surroundings(mesh);
    TakenEdges taken = edgesBetween(mesh, closes ? loops : std::vector<Loop>{});
    for (const Loop& loop : loops) {
        const OpenHole hole = describe(mesh, loop);
        const Surroundings::Scale scale = surroundings.scaleOf(loop);
        const Patch patch = closes && isShort(hole, scale) ? makePatch(mesh, loop, taken) : Patch{};
        const bool isSmall = hole.rim <= tinyRim * scale.boxEdges || patch.bend <= largestBend;
        if (isSmall && !patch.triangles.empty()) {
            addPatch(mesh, loop, patch, taken);
            report.places.holes.push_back(
                {mesh.positions[loop.vertices.front()], hole.edges, patch.triangles.size()});
            report.openEdges -= hole.edges;
        } else {
            ++report.openHoles;
            if (hole.rim > report.largest.rim) report.largest = hole;
        }
    }
}

} // namespace sinew::mesh
