// Points in double: distances between a particle and a skin are small relative to their coordinates.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"

namespace sinew::sim::surface {

struct Point {
    double x = 0, y = 0, z = 0;
};

inline Point operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const Point& a, const Point& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point pointOf(const layout::vec4& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}
inline Point pointOf(const Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}
inline Vec3 toVec3(const Point& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

} // namespace sinew::sim::surface
