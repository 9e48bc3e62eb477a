// A link over two nodes dies with either unit link under it.
#include "sim/cutting/cut_lists.hpp"

#include "common/layout.h"
#include "kernels.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/model/links.hpp"

#include <algorithm>
#include <optional>

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// A link of the masks: its owner and bit.
struct Link {
    std::uint32_t owner = 0, bit = 0;
};

struct Way {
    int x = 0, z = 0;
};

Way wayBetween(const CutRun& run, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t a = from - run.first, b = to - run.first, stride = run.sliceStride;
    return {static_cast<int>(b % stride) - static_cast<int>(a % stride),
            static_cast<int>(b / stride) - static_cast<int>(a / stride)};
}

std::optional<Link> linkBetween(const CutRun& run, std::uint32_t from, std::uint32_t to) {
    const Way way = wayBetween(run, from, to);
    for (std::uint32_t bit = lattice::firstOwned; bit < lattice::directionCount; ++bit) {
        const auto [x, y, z] = lattice::directionOf(bit);
        if (y != 0) continue;
        if (way.x == x && way.z == z) return Link{from, bit};
        if (way.x == -x && way.z == -z) return Link{to, bit};
    }
    return std::nullopt;
}

const CutRun* runOf(const CuttingBuffers& cutting, const Listed& one) {
    for (const CutRun& run : cutting.runs) {
        const auto isIn = [&](std::uint32_t slot) {
            return slot >= run.first && slot - run.first < run.count;
        };
        if (run.rowStride == 0 && std::all_of(one.slots.begin(), one.slots.begin() + one.count, isIn))
            return &run;
    }
    return nullptr;
}

// None if the element is no link along a sheet.
std::optional<layout::CutTie> tieOf(const CuttingBuffers& cutting, Listed one) {
    const CutRun* run = runOf(cutting, one);
    if (run == nullptr) return std::nullopt;
    if (one.count == 2) {
        const Way way = wayBetween(*run, one.slots[0], one.slots[1]);
        if (way.x % 2 == 0 && way.z % 2 == 0) { // over a node
            one.slots[2] = one.slots[1];
            one.slots[1] = (one.slots[0] + one.slots[2]) / 2;
            one.count = 3;
        }
    }
    const auto first = linkBetween(*run, one.slots[0], one.slots[1]);
    const auto second = one.count == 3 ? linkBetween(*run, one.slots[1], one.slots[2]) : first;
    if (!first || !second) return std::nullopt;
    return layout::CutTie{one.element, one.stiffness, first->owner, second->owner,
                          first->bit | second->bit << 8};
}

// An update of a list.
struct ListFilter {
    BufferId list, ties; // layout::CutTie
    std::uint32_t count = 0;
    bool areBends = false;
};

struct ListFilters {
    std::vector<ListFilter> all;
};

void addDispatch(ProgramBuilder& program, const ListFilter& filter) {
    program.dispatch(filter.areBends ? k::partBends : k::disableCutLinks, filter.count,
                     {program.program().cutting.links, filter.ties, filter.list},
                     layout::CountPush{filter.count});
}

} // namespace

bool isListed(const Scene& scene, const Settings& settings, std::uint32_t g,
              std::span<const std::uint32_t> computed) {
    const Grid& grid = scene.grids[g];
    if (!grid.isCuttable || settings.solver != Solver::split || !lattice::isSheet(grid) ||
        grid.node.size() != std::size_t{grid.nodes[0]} * grid.nodes[2])
        return false;
    return !std::ranges::binary_search(computed, g);
}

std::string tiedPast(const Scene& scene, const Grid& sheet) {
    const auto has = [&](std::uint32_t i) { return i - sheet.firstParticle < sheet.node.size(); };
    // Distance of nodes in x and z: 1 is a link of the mask, 2 leads over one node.
    const auto isTie = [&](std::uint32_t a, std::uint32_t b, bool mayLeap) {
        if (!has(a) || !has(b)) return false;
        const auto from = lattice::coordinates(sheet, sheet.node[a - sheet.firstParticle]),
                   to = lattice::coordinates(sheet, sheet.node[b - sheet.firstParticle]);
        const auto apart = [&](std::size_t axis) {
            return std::abs(static_cast<int>(to[axis]) - static_cast<int>(from[axis]));
        };
        const int x = apart(0), z = apart(2);
        return std::max(x, z) == 1 || (mayLeap && std::max(x, z) == 2 && x % 2 == 0 && z % 2 == 0);
    };
    // Only a link with two ends may lead over a node.
    const auto isLost = [&](const auto& ends) {
        if (std::ranges::none_of(ends, has)) return false;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            if (!isTie(ends[i], ends[i + 1], ends.size() == 2)) return true;
        return false;
    };
    std::string tied;
    forEachKind(scene, [&]<typename Link>(const std::vector<Link>& links) {
        for (std::size_t c = 0; tied.empty() && c < links.size(); ++c)
            if (isLost(LinkTraits<Link>::ends(links[c])))
                tied = std::string(LinkTraits<Link>::name) + "[" + std::to_string(c) + "]";
    });
    return tied;
}

bool haveLists(const StepProgram& program, std::uint32_t listed) {
    return std::ranges::any_of(program.cutting.runs, [&](const CutRun& run) { return run.first < listed; });
}

void addListFilter(Build& build, BufferId list, std::span<const Listed> all, bool areBends) {
    ProgramBuilder& program = build.program;
    CuttingBuffers& cutting = program.program().cutting;
    std::vector<layout::CutTie> ties;
    for (const Listed& one : all)
        if (const auto tie = tieOf(cutting, one)) ties.push_back(*tie);
    if (ties.empty()) return;
    cutting.topology.push_back(list);
    program.addToState(list, list);
    const BufferId uploaded = program.upload(areBends ? "cut.bends" : "cut.listed", ties);
    cutting.lists.push_back(list);
    ListFilters* filters = build.find<ListFilters>();
    if (!filters) filters = &build.keep(ListFilters{});
    const ListFilter& filter = filters->all.emplace_back(
        ListFilter{list, uploaded, static_cast<std::uint32_t>(ties.size()), areBends});
    program.into(List::refresh, [&] { addDispatch(program, filter); });
    program.only(When::cut, [&] { addDispatch(program, filter); });
}

void addListFilters(Build& build) {
    const ListFilters* filters = build.find<ListFilters>();
    if (!filters) return;
    for (const ListFilter& filter : filters->all)
        build.program.only(When::cut, [&] { addDispatch(build.program, filter); });
}

} // namespace sinew::sim::cutting
