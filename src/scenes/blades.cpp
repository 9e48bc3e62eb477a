// The edge of a blade goes straight from where it is at one time to where it is at the next.
#include "scenes/blades.hpp"

#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::scenes {

namespace {

// Of all blades that come to a step, in the order in which they begin.
std::vector<BladeTurn> turnsOf(std::span<const BladeMotion> motions, double dt) {
    std::vector<BladeTurn> turns;
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const auto& times = motions[m].times;
        const BladeTurn turn{static_cast<std::uint64_t>(times.front() / dt + hairOfStep),
                             static_cast<std::uint64_t>(std::ceil(times.back() / dt - hairOfStep)), m};
        if (turn.first < turn.end) turns.push_back(turn);
    }
    std::ranges::stable_sort(turns, {}, &BladeTurn::first);
    return turns;
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
        section.fail("times", "are not ascending", "sort them");
    const auto lines = section.lines("edges");
    if (lines.size() != motion.times.size())
        section.fail("edges",
                     "are " + std::to_string(lines.size()) + ", but there are " +
                         std::to_string(motion.times.size()) + " times",
                     "give one for each time");
    for (const auto& line : lines) {
        if (line.size() < 2 || line.size() > sim::ranges::mostBladePoints || line.size() != lines[0].size())
            section.fail("edges", "has a line of " + std::to_string(line.size()) + " points",
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
        top.fail(top.has("blade") ? "blade" : "strokes", "has nothing to cut",
                 "give a [[box]], [[mesh]] or [[cloth]] cuttable = true");
    const std::vector<BladeTurn> turns = turnsOf(loaded.blades, double{loaded.scene.dt});
    const auto both = std::ranges::adjacent_find(
        turns, [](const BladeTurn& one, const BladeTurn& next) { return next.first < one.end; });
    if (both == turns.end()) return;
    const auto [one, other] = std::minmax(both->motion, std::next(both)->motion);
    top.fail(top.has("blade") ? "blade" : "strokes",
             std::string("number ")
                 .append(std::to_string(other + 1))
                 .append(" cuts in a step in which number ")
                 .append(std::to_string(one + 1))
                 .append(" does"),
             "let one begin after the other has ended");
}

ScriptedBlades::ScriptedBlades(std::vector<BladeMotion> motions, float dt)
    : motions_(std::move(motions)), turns_(turnsOf(motions_, double{dt})), dt_(double{dt}) {
    for (const BladeMotion& motion : motions_)
        if (motion.edges[0].size() > from_.size()) from_.resize(motion.edges[0].size());
    to_.resize(from_.size());
}

sim::Blade ScriptedBlades::at(std::uint64_t frame) noexcept {
    const auto next = std::ranges::upper_bound(turns_, frame, {}, &BladeTurn::first);
    if (next == turns_.begin() || frame >= std::prev(next)->end) return {};
    const BladeTurn& turn = *std::prev(next);
    const BladeMotion& motion = motions_[turn.motion];
    const std::size_t points = motion.edges[0].size();
    const auto from = std::span(from_).first(points), to = std::span(to_).first(points);
    readEdge(motion, static_cast<double>(frame) * dt_, from);
    readEdge(motion, static_cast<double>(frame + 1) * dt_, to);
    return {.from = from, .to = to, .isCarried = frame > turn.first};
}

} // namespace sinew::scenes
