// The links of the gather of `split`, sorted so that a slot means the same kind of link for every particle:
// regular cloth and lattices then carry one word a link instead of four.
#include "sim/constraints/distance.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::constraints::distance {

namespace {

// A rigid link is so stiff that the clamp of `split` takes over long before, and not stiffer: the padding of
// a particle that never moves is not clamped, and must give 0, not Inf x 0.
float stiffness(const DistanceConstraint& constraint) {
    constexpr float stiffest = 1e20f; // [N/m]
    return constraint.compliance > 0 ? std::min(1 / constraint.compliance, stiffest) : stiffest;
}

// Distinct rest lengths in order of appearance; empty where there are more than a kernel has groups.
std::vector<float> restLengths(const Scene& scene, std::span<const float> inverseMass) {
    std::vector<float> lengths;
    for (const DistanceConstraint& c : scene.distances) {
        if (!canMove(c, inverseMass)) continue;
        if (std::find(lengths.begin(), lengths.end(), c.restLength) != lengths.end()) continue;
        if (lengths.size() == PACKED_GROUPS) return {};
        lengths.push_back(c.restLength);
    }
    return lengths;
}

// How many links of each group a particle has: counts[group * particles + particle].
struct GroupCounts {
    std::vector<float> lengths; // empty = one group of mixed lengths
    std::vector<std::uint32_t> counts;
    std::size_t particles;

    std::size_t groups() const { return std::max<std::size_t>(lengths.size(), 1); }
    std::size_t groupOf(const DistanceConstraint& c) const {
        if (lengths.empty()) return 0;
        return static_cast<std::size_t>(std::find(lengths.begin(), lengths.end(), c.restLength) -
                                        lengths.begin());
    }
    std::uint32_t& at(std::size_t group, std::uint32_t particle) {
        return counts[group * particles + particle];
    }
    std::uint32_t largest(std::size_t group) const {
        const auto first = counts.begin() + static_cast<std::ptrdiff_t>(group * particles);
        return *std::max_element(first, first + static_cast<std::ptrdiff_t>(particles));
    }
};

GroupCounts countByGroup(const Scene& scene, std::span<const float> inverseMass, std::vector<float> lengths) {
    const std::size_t particles = scene.particles.size();
    GroupCounts result{std::move(lengths), {}, particles};
    result.counts.assign(result.groups() * particles, 0);
    for (const DistanceConstraint& c : scene.distances) {
        if (!canMove(c, inverseMass)) continue;
        ++result.at(result.groupOf(c), c.a);
        ++result.at(result.groupOf(c), c.b);
    }
    return result;
}

std::uint32_t slotsOf(const GroupCounts& counts) {
    std::uint32_t slots = 0;
    for (std::size_t group = 0; group < counts.groups(); ++group) slots += counts.largest(group);
    return slots;
}

// By rest length where that costs at most a quarter more slots than the plain list.
GroupCounts chooseGroups(const Scene& scene, std::span<const float> inverseMass) {
    GroupCounts plain = countByGroup(scene, inverseMass, {});
    std::vector<float> lengths = restLengths(scene, inverseMass);
    if (lengths.empty()) return plain;
    GroupCounts grouped = countByGroup(scene, inverseMass, std::move(lengths));
    return 4 * slotsOf(grouped) <= 5 * slotsOf(plain) ? grouped : plain;
}

void fillLinks(const Scene& scene, std::span<const float> inverseMass, const GroupCounts& counts,
               std::vector<LinkGroup>& groups, GatherLinks& result) {
    GroupCounts used = counts;
    std::fill(used.counts.begin(), used.counts.end(), 0);
    for (const DistanceConstraint& c : scene.distances) {
        if (!canMove(c, inverseMass)) continue;
        const std::size_t group = counts.groupOf(c);
        const std::uint32_t first = group == 0 ? 0 : groups[group - 1].endSlot;
        const float k = stiffness(c);
        groups[group].stiffest = std::max(groups[group].stiffest, k);
        result.links[result.element(c.a, first + used.at(group, c.a)++)] = {c.b, c.restLength, k, 0};
        result.links[result.element(c.b, first + used.at(group, c.b)++)] = {c.a, c.restLength, k, 0};
        ++result.count[c.a];
        ++result.count[c.b];
    }
}

} // namespace

GatherLinks gatherLinks(const Scene& scene, std::span<const float> inverseMass) {
    const std::size_t particles = scene.particles.size();
    const GroupCounts counts = chooseGroups(scene, inverseMass);
    std::vector<LinkGroup> groups(counts.groups());
    GatherLinks result;
    for (std::size_t group = 0; group < groups.size(); ++group) {
        result.degree += counts.largest(group);
        groups[group].endSlot = result.degree;
        if (!counts.lengths.empty()) groups[group].restLength = counts.lengths[group];
    }
    result.count.assign(particles, 0);
    result.links.resize(paddedCount(particles) * result.degree);
    for (std::uint32_t i = 0; i < paddedCount(particles); ++i) {
        for (std::uint32_t slot = 0; slot < result.degree; ++slot)
            result.links[result.element(i, slot)].other = i;
    }
    fillLinks(scene, inverseMass, counts, groups, result);
    if (!counts.lengths.empty()) result.groups = std::move(groups);
    return result;
}

PackedLinks pack(const GatherLinks& links) {
    const std::size_t particles = links.count.size();
    if (links.groups.empty() || paddedCount(particles) > std::size_t{1} << PACKED_END_BITS) return {};
    PackedLinks result;
    for (const LinkGroup& group : links.groups) result.units.push_back(group.stiffest / PACKED_CODES);
    result.links.resize(links.links.size());
    for (std::uint32_t i = 0; i < paddedCount(particles); ++i) {
        std::size_t group = 0;
        for (std::uint32_t slot = 0; slot < links.degree; ++slot) {
            if (slot == links.groups[group].endSlot) ++group;
            const layout::SplitLink& link = links.links[links.element(i, slot)];
            const float steps = std::round(link.stiffness / result.units[group]);
            const bool isPadding = link.other == i;
            const bool isExact =
                std::abs(steps * result.units[group] - link.stiffness) <= 2e-7f * link.stiffness;
            if (!isPadding && (steps < 1 || !isExact)) return {};
            const std::uint32_t code = isPadding ? 0 : static_cast<std::uint32_t>(steps) - 1;
            result.links[links.element(i, slot)] = link.other | code << PACKED_END_BITS;
        }
    }
    return result;
}

} // namespace sinew::sim::constraints::distance
