// The edge of a blade goes straight from where it is at one time to where it is at the next.
#include "scenes/blades.hpp"

#include "sim/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::scenes {

namespace {

struct Frames {
    std::uint64_t first = 0, end = 0;
};

// Steps that a blade is on its way in. A hair of rounding in a time is no step.
Frames framesOf(const BladeMotion& motion, double dt) {
    constexpr double hair = 1e-4; // nine digits of a time and of dt leave 1e-6
    return {static_cast<std::uint64_t>(motion.times.front() / dt + hair),
            static_cast<std::uint64_t>(std::ceil(motion.times.back() / dt - hair))};
}

float between(float a, float b, double part) {
    return static_cast<float>(double{a} + part * (double{b} - double{a}));
}

void readEdge(const BladeMotion& motion, double time, std::span<sim::Vec3> edge) {
    const auto& times = motion.times;
    std::size_t next = 1;
    while (next + 1 < times.size() && times[next] < time) ++next;
    const double part = std::clamp((time - times[next - 1]) / (times[next] - times[next - 1]), 0.0, 1.0);
    const std::vector<sim::Vec3>&a = motion.edges[next - 1], &b = motion.edges[next];
    for (std::size_t p = 0; p < edge.size(); ++p)
        edge[p] = {between(a[p].x, b[p].x, part), between(a[p].y, b[p].y, part),
                   between(a[p].z, b[p].z, part)};
}

} // namespace

void addBlade(LoadedScene& loaded, const Section& section) {
    BladeMotion motion{.name = section.text("name"), .times = section.numbers("times"), .edges = {}};
    if (motion.times.size() < 2)
        section.fail("times", "has " + std::to_string(motion.times.size()), "give at least two");
    if (!std::ranges::is_sorted(motion.times, std::less_equal<>()))
        section.fail("times", "do not grow from one to the next", "sort them");
    const auto lines = section.lines("edges");
    if (lines.size() != motion.times.size())
        section.fail("edges",
                     "are " + std::to_string(lines.size()) + ", but there are " +
                         std::to_string(motion.times.size()) + " times",
                     "give one for each time");
    for (const auto& line : lines) {
        if (line.size() < 2 || line.size() > sim::ranges::mostBladePoints || line.size() != lines[0].size())
            section.fail("edges", "has one of " + std::to_string(line.size()) + " points",
                         "give all of them equally many, from 2 to " +
                             std::to_string(sim::ranges::mostBladePoints));
        std::vector<sim::Vec3>& edge = motion.edges.emplace_back();
        for (const auto& point : line)
            edge.push_back({static_cast<float>(point[0] - loaded.origin[0]),
                            static_cast<float>(point[1] - loaded.origin[1]),
                            static_cast<float>(point[2] - loaded.origin[2])});
    }
    loaded.blades.push_back(std::move(motion));
}

void checkBlades(const LoadedScene& loaded, const Section& top) {
    if (loaded.blades.empty()) return;
    if (std::ranges::none_of(loaded.scene.grids, &sim::Grid::isCuttable))
        top.fail("blade", "has nothing to cut", "give a [[box]], [[mesh]] or [[cloth]] cuttable = true");
    const double dt = double{loaded.scene.dt};
    for (std::size_t b = 0; b < loaded.blades.size(); ++b)
        for (std::size_t other = 0; other < b; ++other) {
            const Frames one = framesOf(loaded.blades[b], dt), two = framesOf(loaded.blades[other], dt);
            if (one.first < two.end && two.first < one.end)
                top.fail("blade",
                         std::string("number ")
                             .append(std::to_string(b + 1))
                             .append(" cuts in a step in which number ")
                             .append(std::to_string(other + 1))
                             .append(" does"),
                         "let one begin after the other has ended");
        }
}

ScriptedBlades::ScriptedBlades(std::vector<BladeMotion> motions, float dt)
    : motions_(std::move(motions)), dt_(double{dt}) {
    for (const BladeMotion& motion : motions_)
        if (motion.edges[0].size() > from_.size()) from_.resize(motion.edges[0].size());
    to_.resize(from_.size());
}

sim::Blade ScriptedBlades::at(std::uint64_t frame) noexcept {
    for (const BladeMotion& motion : motions_) {
        const Frames frames = framesOf(motion, dt_);
        if (frame < frames.first || frame >= frames.end) continue;
        const std::size_t points = motion.edges[0].size();
        const auto from = std::span(from_).first(points), to = std::span(to_).first(points);
        readEdge(motion, static_cast<double>(frame) * dt_, from);
        readEdge(motion, static_cast<double>(frame + 1) * dt_, to);
        return {.from = from, .to = to, .isCarried = frame > frames.first};
    }
    return {};
}

} // namespace sinew::scenes
