// The links of the gather of `split`, sorted so that a slot has the same kind of link for every particle:
// regular cloth and lattices then need one word a link instead of four.
#include "sim/constraints/distance.hpp"

#include "sim/model/state.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sinew::sim::constraints::distance {

namespace {

// A loop of unknown length costs 1.17 times as much a link as an unrolled slot; a few slots are always cheap.
constexpr double mostPadding = 1.5; // slots for each end of a link
constexpr std::uint32_t fewSlots = 8;

// Distinct rest lengths in order of appearance; empty if there are more than a kernel has groups.
std::vector<float> restLengths(std::span<const GatherLink> links) {
    std::vector<float> lengths;
    for (const GatherLink& link : links) {
        if (std::find(lengths.begin(), lengths.end(), link.restLength) != lengths.end()) continue;
        if (lengths.size() == PACKED_GROUPS) return {};
        lengths.push_back(link.restLength);
    }
    return lengths;
}

// Number of links of each particle in each group: counts[group * particles + particle].
struct GroupCounts {
    std::vector<float> lengths; // empty = one group of mixed lengths
    std::vector<std::uint32_t> counts;
    std::size_t particles;

    std::size_t groups() const { return std::max<std::size_t>(lengths.size(), 1); }
    std::size_t groupOf(const GatherLink& link) const {
        if (lengths.empty()) return 0;
        return static_cast<std::size_t>(std::find(lengths.begin(), lengths.end(), link.restLength) -
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

GroupCounts countByGroup(std::span<const GatherLink> links, std::size_t particles,
                         std::vector<float> lengths) {
    GroupCounts result{std::move(lengths), {}, particles};
    result.counts.assign(result.groups() * particles, 0);
    for (const GatherLink& link : links) {
        ++result.at(result.groupOf(link), link.a);
        ++result.at(result.groupOf(link), link.b);
    }
    return result;
}

std::uint32_t slotsOf(const GroupCounts& counts) {
    std::uint32_t slots = 0;
    for (std::size_t group = 0; group < counts.groups(); ++group) slots += counts.largest(group);
    return slots;
}

// Groups by rest length if that needs at most a quarter more slots than the plain list.
GroupCounts chooseGroups(std::span<const GatherLink> links, std::size_t particles) {
    GroupCounts plain = countByGroup(links, particles, {});
    std::vector<float> lengths = restLengths(links);
    if (lengths.empty()) return plain;
    GroupCounts grouped = countByGroup(links, particles, std::move(lengths));
    return 4 * slotsOf(grouped) <= 5 * slotsOf(plain) ? grouped : plain;
}

void fillLinks(std::span<const GatherLink> links, const GroupCounts& counts, std::vector<LinkGroup>& groups,
               GatherLinks& result) {
    GroupCounts used = counts;
    std::fill(used.counts.begin(), used.counts.end(), 0);
    for (const GatherLink& link : links) {
        const std::size_t group = counts.groupOf(link);
        const std::uint32_t first = group == 0 ? 0 : groups[group - 1].endSlot;
        if (link.stiffness > groups[group].stiffest.stiffness) groups[group].stiffest = link;
        const auto add = [&](std::uint32_t end, std::uint32_t other) {
            result.links[result.element(end, first + used.at(group, end)++)] = {other, link.restLength,
                                                                                link.stiffness, link.share};
        };
        add(link.a, link.b);
        add(link.b, link.a);
    }
}

// The code of a packed link: stiffness and share are both (code + 1) x a unit. Empty if no code fits.
std::optional<std::uint32_t> codeOf(const layout::SplitLink& link, float unit, float shareUnit) {
    const float steps = std::round(link.stiffness / unit);
    const auto isExact = [&](float wanted, float one) {
        return std::abs(steps * one - wanted) <= 4e-7f * wanted;
    };
    if (steps < 1 || !isExact(link.stiffness, unit) || !isExact(link.share, shareUnit)) return std::nullopt;
    return static_cast<std::uint32_t>(steps) - 1;
}

} // namespace

GatherLinks gatherLinks(std::span<const GatherLink> links, std::size_t particles) {
    GatherLinks result{.particles = particles};
    if (links.empty()) return result;
    const GroupCounts counts = chooseGroups(links, particles);
    std::vector<LinkGroup> groups(counts.groups());
    for (std::size_t group = 0; group < groups.size(); ++group) {
        result.degree += counts.largest(group);
        groups[group].endSlot = result.degree;
        if (!counts.lengths.empty()) groups[group].restLength = counts.lengths[group];
    }
    pad(result, result.degree);
    fillLinks(links, counts, groups, result);
    if (!counts.lengths.empty()) result.groups = std::move(groups);
    return result;
}

bool isIrregular(std::span<const GatherLink> links, std::size_t particles) {
    if (links.empty()) return false;
    const std::uint32_t most = countByGroup(links, particles, {}).largest(0);
    const double padded = double(paddedCount(particles)) * most, ends = 2 * double(links.size());
    return most > ranges::mostLinksUnrolled || (most > fewSlots && padded > mostPadding * ends);
}

RangedLinks rangedLinks(std::span<const GatherLink> links, std::size_t particles) {
    GroupCounts used = countByGroup(links, particles, {});
    RangedLinks result{std::vector<layout::SplitLink>(2 * links.size()), {0}};
    for (const std::uint32_t count : used.counts) result.first.push_back(result.first.back() + count);
    result.first.resize(paddedCount(particles) + 1, result.first.back());
    std::fill(used.counts.begin(), used.counts.end(), 0);
    for (const GatherLink& link : links) {
        const auto add = [&](std::uint32_t end, std::uint32_t other) {
            result.links[result.first[end] + used.at(0, end)++] = {other, link.restLength, link.stiffness,
                                                                   link.share};
        };
        add(link.a, link.b);
        add(link.b, link.a);
    }
    return result;
}

void pad(GatherLinks& links, std::uint32_t degree) {
    const std::size_t padded = paddedCount(links.particles);
    links.degree = degree;
    links.links.assign(padded * degree, {});
    for (std::uint32_t i = 0; i < padded; ++i) {
        for (std::uint32_t slot = 0; slot < degree; ++slot) links.links[links.element(i, slot)].other = i;
    }
}

PackedLinks pack(const GatherLinks& links) {
    if (links.groups.empty() || paddedCount(links.particles) > std::size_t{1} << PACKED_END_BITS) return {};
    PackedLinks result;
    for (const LinkGroup& group : links.groups) {
        result.units.push_back(group.stiffest.stiffness / PACKED_CODES);
        result.shares.push_back(group.stiffest.share / PACKED_CODES);
    }
    result.links.resize(links.links.size());
    for (std::uint32_t i = 0; i < paddedCount(links.particles); ++i) {
        std::size_t group = 0;
        for (std::uint32_t slot = 0; slot < links.degree; ++slot) {
            if (slot == links.groups[group].endSlot) ++group;
            const layout::SplitLink& link = links.links[links.element(i, slot)];
            std::uint32_t word = i;
            if (link.other != i) {
                const auto code = codeOf(link, result.units[group], result.shares[group]);
                if (!code) return {};
                word = link.other | *code << PACKED_END_BITS;
            }
            result.links[links.element(i, slot)] = word;
        }
    }
    return result;
}

} // namespace sinew::sim::constraints::distance
