// Components by union-find over vertices; cavities by winding numbers.
#include "mesh/components.hpp"

#include "mesh/disjoint_sets.hpp"
#include "mesh/topology.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/vector3.hpp"
#include "sim/core/counted.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <unordered_map>

namespace sinew::mesh {
namespace {

constexpr std::size_t mostHosts = 1000; ///< number of largest components searched for cavities

/// Connected triangles, before cavities are joined with their hosts.
struct Surface {
    std::vector<std::uint32_t> triangles;
    Eigen::AlignedBox3d box;
    double volume = 0; ///< negative if it faces inward
    double area = 0;
    bool isClosed = true;
    std::size_t cavities = 0;
};

void measure(const TriangleMesh& mesh, Surface& surface) {
    for (const std::uint32_t triangle : surface.triangles)
        for (const std::uint32_t vertex : mesh.triangles[triangle])
            surface.box.extend(toVector(mesh.positions[vertex]));
    const Vector3 middle = surface.box.center(); // keeps the estimate for an open surface small
    for (const std::uint32_t triangle : surface.triangles) {
        const auto [a, b, c] = mesh.triangles[triangle];
        const Vector3 x = toVector(mesh.positions[a]) - middle, y = toVector(mesh.positions[b]) - middle,
                      z = toVector(mesh.positions[c]) - middle;
        surface.volume += x.dot(y.cross(z)) / 6;
        surface.area += (y - x).cross(z - x).norm() / 2;
    }
}

std::vector<Surface> surfacesOf(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.positions.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        sets.join(a, b);
        sets.join(b, c);
    }
    std::vector<std::uint32_t> numbers(mesh.positions.size(), noObject);
    std::vector<Surface> surfaces;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        std::uint32_t& number = numbers[sets.root(mesh.triangles[i][0])];
        if (number == noObject) {
            number = static_cast<std::uint32_t>(surfaces.size());
            surfaces.emplace_back();
        }
        surfaces[number].triangles.push_back(i);
    }
    for (Surface& surface : surfaces) measure(mesh, surface);
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        if (sides.size() == 1) surfaces[numbers[sets.root(sides[0].low)]].isClosed = false;
    });
    return surfaces;
}

/// True if the triangles face inward, by more than rounding, or, for an open sheet, by more than slight
/// bending.
bool isInward(const Surface& surface) {
    const double ofSphere = std::pow(surface.area, 1.5) / (6 * std::sqrt(std::numbers::pi));
    return surface.volume < -(surface.isClosed ? 1e-6 : 0.1) * ofSphere;
}

void sortByVolume(std::vector<Surface>& surfaces) {
    std::ranges::stable_sort(surfaces, std::greater{},
                             [](const Surface& one) { return std::abs(one.volume); });
}

TriangleTree treeOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& chosen) {
    std::vector<Vector3> positions;
    TriangleTree::Triangles triangles;
    for (const std::uint32_t triangle : chosen) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const std::uint32_t vertex : mesh.triangles[triangle])
            positions.push_back(toVector(mesh.positions[vertex]));
        triangles.push_back({first, first + 1, first + 2});
    }
    return {positions, triangles};
}

/// Adds every cavity to the smallest surface around it. Surfaces must be sorted by volume.
void joinCavities(const TriangleMesh& mesh, std::vector<Surface>& surfaces) {
    const auto isHost = [](const Surface& surface) { return surface.isClosed && surface.volume > 0; };
    std::vector<std::size_t> hosts;
    for (std::size_t i = 0; i < surfaces.size() && hosts.size() < mostHosts; ++i)
        if (isHost(surfaces[i])) hosts.push_back(i);
    std::ranges::reverse(hosts);
    std::vector<std::unique_ptr<TriangleTree>> trees(surfaces.size());
    for (Surface& cavity : surfaces) {
        if (!cavity.isClosed || !isInward(cavity)) continue; // without volume it is no cavity
        const Vector3 point = toVector(mesh.positions[mesh.triangles[cavity.triangles.front()][0]]);
        const auto around = std::ranges::find_if(hosts, [&](std::size_t host) {
            if (!surfaces[host].box.contains(cavity.box)) return false;
            if (!trees[host])
                trees[host] = std::make_unique<TriangleTree>(treeOf(mesh, surfaces[host].triangles));
            return trees[host]->windingNumber(point) > 0.5;
        });
        if (around == hosts.end()) continue;
        Surface& host = surfaces[*around];
        host.triangles.insert(host.triangles.end(), cavity.triangles.begin(), cavity.triangles.end());
        host.volume += cavity.volume;
        ++host.cavities;
        cavity.triangles.clear();
    }
    std::erase_if(surfaces, [](const Surface& surface) { return surface.triangles.empty(); });
    for (Surface& surface : surfaces) std::ranges::sort(surface.triangles);
}

std::string partName(std::size_t number) {
    return "part " + std::to_string(number);
}

/// Names of components by number; components of a choice keep their earlier numbers.
class PartNames {
public:
    explicit PartNames(const TriangleMesh& mesh) : parts_(mesh.parts) {}

    /// Name of the next component, whose first triangle is `triangle`. If a choice split a part into several
    /// components, its pieces are numbered.
    std::string next(std::uint32_t triangle) {
        ++count_;
        if (parts_.empty()) return partName(count_);
        const std::uint32_t part = parts_[triangle];
        const std::size_t piece = ++pieces_[part];
        return partName(part) + (piece == 1 ? "" : ", piece " + std::to_string(piece));
    }

private:
    const std::vector<std::uint32_t>& parts_;
    std::size_t count_ = 0;
    std::unordered_map<std::uint32_t, std::size_t> pieces_; ///< number of pieces of each part so far
};

/// Number of triangles of each object.
std::vector<std::size_t> sizesOfObjects(const TriangleMesh& mesh) {
    std::vector<std::size_t> sizes(mesh.objectNames.size());
    for (const std::uint32_t object : mesh.objects)
        if (object != noObject) ++sizes[object];
    return sizes;
}

/// The object that contains exactly these triangles; else noObject.
std::uint32_t objectOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                       const std::vector<std::size_t>& sizes) {
    if (mesh.objects.empty()) return noObject;
    const std::uint32_t object = mesh.objects[triangles.front()];
    const bool isOne = object != noObject && sizes[object] == triangles.size() &&
                       std::ranges::all_of(triangles, [&](std::uint32_t triangle) {
                           return mesh.objects[triangle] == object;
                       });
    return isOne ? object : noObject;
}

/// Number of a name such as "part 12"; nothing for any other.
std::optional<std::size_t> partNumber(const std::string& name) {
    const std::string head = "part ";
    std::size_t number = 0;
    if (!name.starts_with(head)) return {};
    const char* last = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data() + head.size(), last, number);
    return error == std::errc{} && end == last ? std::optional(number) : std::nullopt;
}

} // namespace

std::vector<Component> components(const TriangleMesh& given) {
    const TriangleMesh mesh = orient(given);
    std::vector<Surface> surfaces = surfacesOf(mesh);
    sortByVolume(surfaces);
    joinCavities(mesh, surfaces);
    sortByVolume(surfaces);
    const std::vector<std::size_t> sizes = sizesOfObjects(mesh);
    std::vector<Component> result;
    PartNames parts(mesh);
    for (Surface& surface : surfaces) {
        const std::uint32_t object = objectOf(mesh, surface.triangles, sizes);
        const std::string part = parts.next(surface.triangles.front());
        result.push_back({.name = object == noObject ? part : mesh.objectNames[object],
                          .triangles = std::move(surface.triangles),
                          .volume = std::abs(surface.volume),
                          .isClosed = surface.isClosed,
                          .isInward = isInward(surface),
                          .cavities = surface.cavities});
    }
    return result;
}

std::string describe(const Component& component) {
    char volume[48];
    std::snprintf(volume, sizeof volume, "%.3g m^3", component.volume);
    return "\"" + component.name + "\": " + sim::counted(component.triangles.size(), "triangle") + ", " +
           (component.isClosed ? volume : "open") +
           (component.cavities == 0 ? "" : ", " + sim::counted(component.cavities, "cavity", "cavities")) +
           (component.isInward ? ", inside out" : "");
}

std::vector<std::string> names(const TriangleMesh& mesh) {
    std::vector<std::string> all = mesh.objectNames;
    const std::set<std::string_view> objects(mesh.objectNames.begin(), mesh.objectNames.end());
    const std::size_t count = components(mesh).size();
    for (std::size_t i = 1; i <= count; ++i)
        if (std::string name = partName(i); !objects.contains(name)) all.push_back(std::move(name));
    return all;
}

std::optional<TriangleMesh> choose(const TriangleMesh& mesh, const std::vector<std::string>& names,
                                   std::string& unknown) {
    std::map<std::string_view, std::size_t> objects;
    for (std::size_t i = 0; i < mesh.objectNames.size(); ++i) objects[mesh.objectNames[i]] = i;
    const std::vector<Component> all = components(mesh);
    std::vector<bool> isObjectKept(objects.size()), isPartKept(all.size());
    for (const std::string& name : names) {
        const auto object = objects.find(name);
        const std::size_t part = partNumber(name).value_or(0);
        if (object != objects.end()) {
            isObjectKept[object->second] = true;
        } else if (part > 0 && part <= all.size()) {
            isPartKept[part - 1] = true;
        } else {
            unknown = name;
            return {};
        }
    }
    TriangleMesh numbered = mesh;
    numbered.parts.resize(mesh.triangles.size());
    std::vector<bool> isKept(mesh.triangles.size());
    for (std::size_t part = 0; part < all.size(); ++part)
        for (const std::uint32_t triangle : all[part].triangles) {
            const std::uint32_t object = mesh.objects.empty() ? noObject : mesh.objects[triangle];
            isKept[triangle] = isPartKept[part] || (object != noObject && isObjectKept[object]);
            numbered.parts[triangle] = static_cast<std::uint32_t>(part + 1);
        }
    const std::vector<std::size_t> whole = sizesOfObjects(numbered);
    TriangleMesh chosen = keep(numbered, isKept);
    const std::vector<std::size_t> left = sizesOfObjects(chosen);
    for (std::uint32_t& object : chosen.objects) // the rest of an object is no longer that object
        if (object != noObject && left[object] < whole[object]) object = noObject;
    return chosen;
}

TriangleMesh extract(const TriangleMesh& mesh, const Component& component) {
    std::vector<bool> isKept(mesh.triangles.size());
    for (const std::uint32_t triangle : component.triangles) isKept[triangle] = true;
    return keep(mesh, isKept);
}

} // namespace sinew::mesh
