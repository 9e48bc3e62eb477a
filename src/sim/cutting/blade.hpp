// The blade and ray of a step in the form that kernels read. Host only; never allocates.
#pragma once

#include "common/layout.h"
#include "sinew/ranges.hpp"
#include "sinew/step.hpp"

#include <array>
#include <span>

namespace sinew::sim::cutting {

class BladeWords {
public:
    /// Reads `step`, which takes `dt` [s]; returns whether it cuts anything. A blade with too many points,
    /// poly-lines of unequal length or non-finite numbers is ignored.
    bool read(const Step& step, float dt) noexcept;
    /// Whether the last step that was read has a blade, not only a ray.
    bool hasQuads() const noexcept { return head_.quads > 0; }

    std::span<const std::byte> head() const noexcept { return std::as_bytes(std::span(&head_, 1)); }
    std::span<const std::byte> points() const noexcept {
        return std::as_bytes(std::span(points_).first(2 * (head_.quads + std::size_t{1})));
    }

private:
    bool readBlade(const Blade& blade) noexcept;
    bool readRay(const RayCut& ray) noexcept;

    layout::BladeHead head_{};
    std::array<layout::vec4, 2 * ranges::mostBladePoints> points_{};
};

} // namespace sinew::sim::cutting
