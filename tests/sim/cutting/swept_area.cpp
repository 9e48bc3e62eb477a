// Samples the swept area with lines and compares it with what the surface encloses.
#include "sim/cutting/swept_area.hpp"

#include "common/layout.h"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>

namespace sinew::test {

using Eigen::Vector3d;

namespace {

constexpr int lines = 200;

void addWay(const ClosedSurface& before, const sim::Blade& blade, CutArea& cut) {
    const auto chord = [&](const Vector3d& from, const Vector3d& way) {
        return before.chord(from, from + way, before.drawn());
    };
    const std::size_t last = blade.from.size() - 1;
    for (std::size_t p = 0; p < last; ++p) {
        const Vector3d from = toVector(blade.from[p]), edge = toVector(blade.from[p + 1]) - from,
                       way = toVector(blade.to[p]) - from;
        const double width = edge.cross(way).norm() / way.norm() / lines, step = edge.norm() / lines;
        for (int n = 0; n < lines; ++n) {
            const ClosedSurface::Chord inside = chord(from + (n + 0.5) / lines * edge, way);
            cut.swept += 2 * width * inside.length;
            cut.front += (inside.isFromInside ? step : 0) + (inside.isToInside ? step : 0);
        }
        if (p == 0) cut.front += chord(from, way).length;
        if (p + 1 == last) cut.front += chord(from + edge, way).length;
    }
}

// Draws a body at the positions that its newest blade saw. Avoids a saved state, which may exceed a buffer of
// the device.
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
        upload(moved);
    }
    ~AtCut() { upload(kept_); }
    AtCut(const AtCut&) = delete;
    AtCut& operator=(const AtCut&) = delete;

private:
    void upload(const std::vector<sim::layout::vec4>& positions) const {
        queue().upload(positions_, positions.data(), positions.size() * sizeof(sim::layout::vec4));
    }

    vk::BufferView positions_;
    std::vector<sim::layout::vec4> kept_;
};

} // namespace

CutArea cutArea(CutBody& body, const vk::Buffer& before, const sim::Blade& blade) {
    const AtCut atCut(body);
    const vk::Buffer after = body.runner().saveTopology();
    CutArea cut{.inside = ClosedSurface(body).drawnArea(ClosedSurface::Part::inside)};
    body.runner().loadTopology(before);
    const ClosedSurface uncut(body);
    addWay(uncut, blade, cut);
    cut.inside -= uncut.drawnArea(ClosedSurface::Part::inside);
    body.runner().loadTopology(after);
    return cut;
}

} // namespace sinew::test
