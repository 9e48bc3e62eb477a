// The cells that a triangle touches, by the separating-axis test of Schwarz and Seidel (2010).
#pragma once

#include "mesh/vector3.hpp"

#include <array>
#include <cstdint>

namespace sinew::mesh {

/// Overlap test of a triangle with unit cells at integer positions: a plane test and three 2-D edge tests per
/// projection, set up once per triangle. Conservative: cells count as closed and are enlarged by 1e-9, so
/// that rounding loses none.
class CellOverlap {
public:
    /// Corners in cell units.
    CellOverlap(const Vector3& a, const Vector3& b, const Vector3& c);

    /// True if the triangle touches the cell with its low corner at `cell`, provided that its bounding box
    /// does.
    bool touches(const Vector3& cell) const;

    /// Cells that the triangle's bounding box touches, before clipping to a grid.
    std::array<Eigen::Array3i, 2> range() const;

private:
    struct EdgeTest {
        double normalU = 0, normalV = 0, offset = 0;
        std::size_t u = 0, v = 0;
    };

    Vector3 low_, high_, normal_;
    double planeNear_ = 0, planeFar_ = 0;
    std::array<EdgeTest, 9> edges_;
};

} // namespace sinew::mesh
