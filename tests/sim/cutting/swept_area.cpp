// Lines of the way, and what the surface encloses of each.
#include "sim/cutting/swept_area.hpp"

#include "layout.h"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace sinew::test {

using Eigen::Vector3d;

namespace {

constexpr int lines = 200;

struct Lengths {
    double all = 0;                    ///< inside
    bool isFrom = false, isTo = false; ///< its ends are
};

// What a line enters and leaves, also before it begins: a surface need not be of one part.
Lengths lengthInside(const ClosedSurface& surface, const Vector3d& from, const Vector3d& to) {
    const Vector3d way = to - from;
    double share = 0, atStart = 0, atEnd = 0; // windings
    for (const ClosedSurface::Triangle& triangle : surface.triangles()) {
        const Vector3d &a = surface.drawn()[triangle.points[0]], ab = surface.drawn()[triangle.points[1]] - a,
                       ac = surface.drawn()[triangle.points[2]] - a, p = way.cross(ac), start = from - a,
                       q = start.cross(ab);
        const double volume = ab.dot(p);
        if (volume == 0) continue;
        const double u = start.dot(p) / volume, v = way.dot(q) / volume;
        if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
        const double at = ac.dot(q) / volume, turn = volume > 0 ? 1 : -1; // against the normal: it enters
        share += turn * (1 - std::clamp(at, 0.0, 1.0));
        atStart += at < 0 ? turn : 0;
        atEnd += at < 1 ? turn : 0;
    }
    return {share * way.norm(), atStart > 0.5, atEnd > 0.5};
}

void addWay(const ClosedSurface& before, const sim::Blade& blade, CutArea& cut) {
    const std::size_t last = blade.from.size() - 1;
    for (std::size_t p = 0; p < last; ++p) {
        const Vector3d from = toVector(blade.from[p]), edge = toVector(blade.from[p + 1]) - from,
                       way = toVector(blade.to[p]) - from;
        const double width = edge.cross(way).norm() / way.norm() / lines, step = edge.norm() / lines;
        for (int n = 0; n < lines; ++n) {
            const Vector3d start = from + (n + 0.5) / lines * edge;
            const Lengths lengths = lengthInside(before, start, start + way);
            cut.swept += 2 * width * lengths.all;
            cut.front += (lengths.isFrom ? step : 0) + (lengths.isTo ? step : 0);
        }
        if (p == 0) cut.front += lengthInside(before, from, from + way).all;
        if (p + 1 == last) cut.front += lengthInside(before, from + edge, from + edge + way).all;
    }
}

// Draws a body where its newest blade saw it.
class AtCut {
public:
    explicit AtCut(CutBody& body)
        : positions_(body.runner().simulation().view(body.runner().simulation().program().positions)),
          kept_(queue().download<sim::layout::vec4>(positions_)) {
        std::vector<sim::layout::vec4> moved = kept_;
        const std::vector<Vector3d> places = body.placesAtCut();
        for (std::size_t i = 0; i < places.size(); ++i) {
            const sim::Vec3 x = toFloats(places[i]);
            moved[i] = {x.x, x.y, x.z, kept_[i].w};
        }
        queue().upload(positions_, moved.data(), moved.size() * sizeof(sim::layout::vec4));
    }
    ~AtCut() { queue().upload(positions_, kept_.data(), kept_.size() * sizeof(sim::layout::vec4)); }
    AtCut(const AtCut&) = delete;
    AtCut& operator=(const AtCut&) = delete;

private:
    vk::BufferView positions_;
    std::vector<sim::layout::vec4> kept_;
};

} // namespace

CutArea cutArea(CutBody& body, const vk::Buffer& before, const sim::Blade& blade) {
    CutArea cut;
    const AtCut atCut(body);
    const vk::Buffer after = body.runner().saveTopology();
    body.runner().loadTopology(before);
    const ClosedSurface uncut(body);
    body.runner().loadTopology(after);
    addWay(uncut, blade, cut);
    cut.inside = ClosedSurface(body).drawnArea(ClosedSurface::Part::inside) -
                 uncut.drawnArea(ClosedSurface::Part::inside);
    return cut;
}

} // namespace sinew::test
