// The whole surface of a cut body, read back and joined at its points: the rest of its skin, the pieces
// beside the cut and the inside, at rest and as drawn.
#pragma once

#include "sim/core/hash.hpp"
#include "sim/cutting/cut_body.hpp"

#include <map>

namespace sinew::test {

class ClosedSurface {
public:
    enum class Part { skin, outside, inside };
    struct Triangle {
        std::array<std::uint32_t, 3> points{}; ///< indices into rest() and drawn()
        std::array<Eigen::Vector3d, 3> normals;
        Part part = Part::skin;
    };

    /// The body must have one grid and one skin. Records the skin list first.
    explicit ClosedSurface(CutBody& body);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Eigen::Vector3d>& rest() const { return rest_; }
    const std::vector<Eigen::Vector3d>& drawn() const { return drawn_; }

    /// Number of directed edges without an opposite one.
    std::size_t openEdges() const;
    /// Edges with more than two triangles.
    std::size_t crowdedEdges() const;
    /// Signed volumes of the connected parts, largest first. Parts below a billionth of a cell only count.
    std::vector<double> volumes(double cell) const;
    double volume() const;
    double area(Part part) const;      ///< at rest
    double drawnArea(Part part) const; ///< as drawn
    /// Section of the enclosed volume at rest with a plane, without a cut.
    struct Section {
        double area = 0, rim = 0; ///< area, and length of the outline
    };
    Section section(const CutPlane& plane) const;
    /// The part of a straight line inside the surface.
    struct Chord {
        double length = 0;
        bool isFromInside = false, isToInside = false; ///< whether its ends are inside
    };
    /// The line runs between points of `places`, which are rest() or drawn().
    Chord chord(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                const std::vector<Eigen::Vector3d>& places) const;
    std::uint64_t hash() const; ///< over the bits of all buffers

private:
    double areaOf(Part part, const std::vector<Eigen::Vector3d>& places) const;
    std::uint32_t pointOf(std::uint32_t key, const Eigen::Vector3d& rest, const Eigen::Vector3d& drawn);
    std::map<std::uint32_t, Eigen::Vector3d> movedVertices(CutBody& body);
    void addSkin(CutBody& body);
    void addCut(CutBody& body);

    std::map<std::uint32_t, std::uint32_t> points_; // by key
    std::vector<Eigen::Vector3d> rest_, drawn_;
    std::vector<Triangle> triangles_;
    std::uint64_t hash_ = sim::fnv1a({});
};

} // namespace sinew::test
