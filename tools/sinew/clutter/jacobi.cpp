// Every ball gathers from its neighbours and writes only itself: two position arrays alternate, with one
// barrier per sweep.
#include "sinew/clutter/jacobi.hpp"

namespace sinew::tools::clutter {

namespace {

constexpr std::uint32_t mostNear = 32; // within 1.1 diameters, about 15 balls of one size fit

} // namespace

Jacobi::Jacobi(Balls balls)
    : balls_(std::move(balls)), before_(balls_.x), other_(balls_.x), near_(balls_.x.size() * mostNear),
      nearCount_(balls_.x.size()), helper_([this] {
          for (;;) {
              turn_.arrive_and_wait();
              if (isEnding_) return;
              work(1);
          }
      }) {}

Jacobi::~Jacobi() {
    isEnding_ = true;
    turn_.arrive_and_wait();
}

void Jacobi::step() {
    turn_.arrive_and_wait();
    work(0);
}

Jacobi::Range Jacobi::rangeOf(std::uint32_t thread) const {
    const std::size_t half = balls_.x.size() / threads;
    return thread + 1 == threads ? Range{thread * half, balls_.x.size()}
                                 : Range{thread * half, (thread + 1) * half};
}

// One thread's part of a step; barriers separate writes from reads of the other thread.
void Jacobi::work(std::uint32_t thread) {
    const Range range = rangeOf(thread);
    for (std::uint32_t substep = 0; substep < balls_.substeps; ++substep) {
        predict(range);
        turn_.arrive_and_wait();
        if (thread == 0) grid_.sort(balls_.x, 2.2f * balls_.radius);
        turn_.arrive_and_wait();
        list(range);
        turn_.arrive_and_wait();
        for (std::uint32_t iteration = 0; iteration < balls_.iterations; ++iteration) {
            const bool isEven = iteration % 2 == 0;
            sweep(range, isEven ? balls_.x : other_, isEven ? other_ : balls_.x);
            turn_.arrive_and_wait();
        }
        if (balls_.iterations % 2 == 1 && thread == 0) balls_.x.swap(other_);
        turn_.arrive_and_wait();
        finish(range);
    }
    turn_.arrive_and_wait();
}

void Jacobi::predict(Range range) {
    const float h = balls_.h();
    for (std::size_t i = range.first; i < range.end; ++i) {
        Vec4 &x = balls_.x[i], &v = balls_.v[i];
        before_[i] = x;
        v[0] += h * balls_.gravity.x, v[1] += h * balls_.gravity.y, v[2] += h * balls_.gravity.z;
        x[0] += h * v[0], x[1] += h * v[1], x[2] += h * v[2];
    }
}

void Jacobi::list(Range range) {
    const float reach = 2.2f * balls_.radius;
    for (auto i = static_cast<std::uint32_t>(range.first); i < range.end; ++i) {
        const Vec4& a = balls_.x[i];
        std::uint32_t count = 0;
        grid_.forEachNear(i, [&](std::uint32_t j) {
            const Vec4& b = balls_.x[j];
            const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
            if (dx * dx + dy * dy + dz * dz < reach * reach && j != i && count < mostNear)
                near_[i * mostNear + count++] = j;
        });
        nearCount_[i] = count;
    }
}

void Jacobi::sweep(Range range, const std::vector<Vec4>& from, std::vector<Vec4>& to) const {
    const float touching = 2 * balls_.radius;
    for (std::size_t i = range.first; i < range.end; ++i) {
        const Vec4 a = from[i], oldA = before_[i];
        float cx = 0, cy = 0, cz = 0, touched = 0;
        for (std::uint32_t k = 0; k < nearCount_[i]; ++k) {
            const std::uint32_t j = near_[i * mostNear + k];
            const Vec4 &b = from[j], &oldB = before_[j];
            const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
            const float square = dx * dx + dy * dy + dz * dz;
            if (square >= touching * touching || square == 0) continue;
            const float length = std::sqrt(square), depth = touching - length, inverse = 1 / length;
            const float nx = dx * inverse, ny = dy * inverse, nz = dz * inverse;
            float sx = a[0] - oldA[0] - b[0] + oldB[0], sy = a[1] - oldA[1] - b[1] + oldB[1],
                  sz = a[2] - oldA[2] - b[2] + oldB[2];
            const float along = sx * nx + sy * ny + sz * nz;
            sx -= along * nx, sy -= along * ny, sz -= along * nz;
            const float reach = balls_.friction * depth, slid = sx * sx + sy * sy + sz * sz;
            const float back = slid <= reach * reach ? 1 : reach / std::sqrt(slid);
            const float ofA = a[3] / (a[3] + b[3]);
            cx += ofA * (depth * nx - back * sx), cy += ofA * (depth * ny - back * sy),
                cz += ofA * (depth * nz - back * sz);
            ++touched;
        }
        // Averaged, with over-relaxation below the proven bound of 4/3.
        const float share = 1.3f / std::max(1.0f, touched);
        Vec4 moved{a[0] + share * cx, a[1] + share * cy, a[2] + share * cz, a[3]};
        projectPlanes(balls_, moved, oldA);
        to[i] = moved;
    }
}

void Jacobi::finish(Range range) {
    const float perSecond = 1 / balls_.h();
    for (std::size_t i = range.first; i < range.end; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            balls_.v[i][axis] = (balls_.x[i][axis] - before_[i][axis]) * perSecond;
}

} // namespace sinew::tools::clutter
