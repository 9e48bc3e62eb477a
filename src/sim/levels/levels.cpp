// Tables of blocks: those of level 1 of all bodies first, then body by body those of the levels above.
#include "sim/levels/levels.hpp"

#include "kernels.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/levels/blocks.hpp"
#include "sim/stiffness/level_choice.hpp"

#include <algorithm>
#include <functional>

namespace sinew::sim::levels {

namespace {

namespace k = kernels;

// Blocks as the device reads them.
struct Tables {
    std::vector<layout::LevelBlock> blocks;
    std::vector<layout::LevelChild> children;
    std::vector<layout::LevelLink> links;
    std::vector<layout::LevelRange> ranges; // by body and level
    // For cuts, by block: children by corner, and the mask of the links.
    std::vector<std::uint32_t> octants, masks;
};

struct Body {
    std::uint32_t grid = 0;
    bool isCuttable = false;
    std::vector<Level> levels;                     // from that of the particles on
    std::vector<std::uint32_t> first = {NO_BLOCK}; // by level: index of the first block
};

// A link as one of its blocks sees it.
struct Seen {
    std::uint32_t bit = 0;
    layout::LevelLink link;
};

void writeLinks(Tables& tables, const Level& level) {
    const auto first = static_cast<std::uint32_t>(tables.blocks.size());
    std::vector<std::vector<Seen>> links(level.nodes.size());
    for (const Link& link : level.links) {
        const auto add = [&](std::uint32_t from, std::uint32_t to, std::uint32_t bit) {
            links[from].push_back({bit,
                                   {first + to, static_cast<float>(link.length),
                                    static_cast<float>(link.stiffness), static_cast<float>(link.most)}});
        };
        const std::uint32_t bit = *lattice::bitOf(link.step); // links of a grid lead to neighbours
        add(link.a, link.b, bit);
        add(link.b, link.a, lattice::directionCount - 1 - bit);
    }
    for (std::size_t b = 0; b < level.nodes.size(); ++b) {
        std::ranges::sort(links[b], {}, &Seen::bit);
        tables.blocks.push_back({static_cast<float>(level.nodes[b].inverseMass), NO_BLOCK,
                                 static_cast<std::uint32_t>(tables.links.size()),
                                 static_cast<std::uint32_t>(links[b].size())});
        std::uint32_t& mask = tables.masks.emplace_back(0);
        for (const Seen& seen : links[b]) {
            mask |= 1u << seen.bit;
            tables.links.push_back(seen.link);
        }
    }
}

// `indices`: where the device has the nodes of `below`.
void writeChildren(Tables& tables, const Level& level, const Level& below,
                   std::span<const std::uint32_t> indices) {
    const std::size_t first = tables.children.size();
    tables.children.resize(first + level.nodes.size() * LEVEL_CHILDREN);
    tables.octants.resize(tables.children.size(), NO_BLOCK);
    std::vector<std::size_t> written(level.nodes.size(), 0);
    for (std::size_t i = 0; i < below.nodes.size(); ++i) {
        const Node& child = below.nodes[i];
        const std::size_t block = first + child.parent * LEVEL_CHILDREN;
        const auto [x, y, z] = child.place;
        tables.octants[block + (x & 1) + 2 * (y & 1) + 4 * (z & 1)] = indices[i];
        if (child.weight > 0)
            tables.children[block + written[child.parent]++] = {indices[i], static_cast<float>(child.weight)};
    }
    for (std::size_t b = 0; b < level.nodes.size(); ++b) {
        const auto block = tables.children.begin() + static_cast<std::ptrdiff_t>(first + b * LEVEL_CHILDREN);
        std::fill(block + static_cast<std::ptrdiff_t>(written[b]), block + LEVEL_CHILDREN,
                  layout::LevelChild{block->index, 0});
    }
}

// Appends level `l` of a body; `indices` as in writeChildren.
void write(Tables& tables, Body& body, std::size_t l, std::span<const std::uint32_t> indices) {
    body.first.push_back(static_cast<std::uint32_t>(tables.blocks.size()));
    writeLinks(tables, body.levels[l]);
    writeChildren(tables, body.levels[l], body.levels[l - 1], indices);
}

// Appends level `l` > 1 after its children were written.
void writeAbove(Tables& tables, Body& body, std::size_t l) {
    const std::vector<Node>& below = body.levels[l - 1].nodes;
    std::vector<std::uint32_t> indices(below.size());
    const auto first = static_cast<std::uint32_t>(tables.blocks.size());
    for (std::uint32_t i = 0; i < below.size(); ++i) {
        indices[i] = body.first[l - 1] + i;
        tables.blocks[indices[i]].parent = first + below[i].parent;
    }
    write(tables, body, l, indices);
}

std::vector<std::uint32_t> slotsOf(const SceneModel& model, std::uint32_t grid) {
    const Grid& of = model.scene.grids[grid];
    const auto first = model.layout.slot.begin() + of.firstParticle;
    return {first, first + static_cast<std::ptrdiff_t>(of.node.size())};
}

// Writes the blocks of level 1, which is the newest one, by slot. A force on a block moves each child by
// weight x inverse mass: its share of the block's kick.
void writeBlocks(std::span<layout::LevelChild> blockOf, const SceneModel& model, const Body& body) {
    const std::vector<std::uint32_t> slots = slotsOf(model, body.grid);
    const std::vector<Node>&particles = body.levels[0].nodes, &blocks = body.levels[1].nodes;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const double mobility = blocks[particles[i].parent].inverseMass;
        if (mobility > 0)
            blockOf[slots[i]] = {
                body.first[1] + particles[i].parent,
                static_cast<float>(particles[i].weight * particles[i].inverseMass / mobility)};
    }
}

// Cuttable ones first.
std::vector<Body> bodiesOf(const SceneModel& model, const stiffness::Shares& shares) {
    std::vector<Body> bodies;
    if (model.settings.levels == 0) return bodies;
    for (std::uint32_t g = 0; g < model.scene.grids.size(); ++g) {
        std::vector<Level> levels = levelsOf(model.scene, model.settings, g, model.inverseMass, shares);
        if (levels.size() > 1)
            bodies.push_back(
                {.grid = g, .isCuttable = model.scene.grids[g].isCuttable, .levels = std::move(levels)});
    }
    std::ranges::stable_sort(bodies, std::ranges::greater{}, &Body::isCuttable);
    return bodies;
}

// `levels`: the most that a body has.
void writeRanges(Tables& tables, const std::vector<Body>& bodies, std::size_t levels) {
    for (const Body& body : bodies)
        for (std::size_t l = 1; l <= levels; ++l) {
            layout::LevelRange range{};
            if (l < body.levels.size())
                range = {body.first[l], static_cast<std::uint32_t>(body.levels[l].nodes.size())};
            tables.ranges.push_back(range);
        }
}

// The pass that disables block links of cut bodies.
struct Cuts {
    std::uint32_t bodies = 0;
    layout::LevelCutPush push{};
    std::vector<BufferId> buffers;
    void addPass(ProgramBuilder& program) const {
        program.dispatch(k::cutLevels, bodies * LEVEL_GROUP, buffers, push);
    }
};

// `links`: the block links, which the pass writes.
void keepCuts(Build& build, BufferId links, Cuts given) {
    ProgramBuilder& program = build.program;
    CuttingBuffers& cutting = program.program().cutting;
    cutting.topology.push_back(links);
    cutting.lists.push_back(links);
    program.addToState(links, links);
    const Cuts& cuts = build.keep(std::move(given));
    program.into(List::refresh, [&] { cuts.addPass(program); });
    program.only(When::cut, [&] { cuts.addPass(program); });
}

} // namespace

void check(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (settings.levels == autoLevels) return;
    complaints.check(static_cast<double>(settings.levels), ranges::levels, [] { return "settings.levels"; });
    if (settings.levels == 0 || settings.solver != Solver::split) return;
    for (const std::string& obstacle : stiffness::obstaclesToLevels(scene, settings))
        complaints.add("settings.levels", "is " + number(settings.levels) + ", but " + obstacle);
}

std::optional<Levels> add(Build& build, const stiffness::Shares& shares) {
    const SceneModel& model = build.model;
    std::vector<Body> bodies = bodiesOf(model, shares);
    if (bodies.empty()) return std::nullopt;
    Tables tables;
    std::vector<layout::LevelChild> blockOf(model.layout.count);
    for (Body& body : bodies) {
        write(tables, body, 1, slotsOf(model, body.grid));
        writeBlocks(blockOf, model, body);
    }
    Levels levels;
    levels.blocks_ = static_cast<std::uint32_t>(tables.blocks.size());
    levels.bodies_ = static_cast<std::uint32_t>(bodies.size());
    for (Body& body : bodies) {
        levels.levels_ = std::max(levels.levels_, static_cast<std::uint32_t>(body.levels.size() - 1));
        for (std::size_t l = 2; l < body.levels.size(); ++l) writeAbove(tables, body, l);
    }
    writeRanges(tables, bodies, levels.levels_);
    ProgramBuilder& program = build.program;
    const auto cuttable = static_cast<std::uint32_t>(std::ranges::count_if(bodies, &Body::isCuttable));
    levels.blockOf_ = program.upload("levels.blocks_of_slots", blockOf);
    if (levels.levels_ > 1 || cuttable > 0) levels.ranges_ = program.upload("levels.ranges", tables.ranges);
    levels.info_ = program.upload("levels.blocks", tables.blocks);
    levels.children_ = program.upload("levels.children", tables.children);
    levels.links_ = program.upload("levels.links", tables.links);
    levels.positions_ = program.scratch<layout::vec4>("levels.positions", tables.blocks.size());
    levels.kicks_ = program.scratch<layout::vec4>("levels.kicks", tables.blocks.size());
    if (cuttable == 0) return levels;
    const CuttingBuffers& cutting = program.program().cutting;
    keepCuts(
        build, levels.links_,
        {.bodies = cuttable,
         .push = {levels.levels_},
         .buffers = {levels.ranges_, program.upload("levels.octants", tables.octants), cutting.links,
                     program.initialOf("levels.whole_nodes", cutting.links),
                     program.upload("levels.masks", tables.masks), levels.info_,
                     program.initialOf("levels.whole_links", levels.links_),
                     program.scratch<std::uint32_t>("levels.open", tables.blocks.size()),
                     program.scratch<std::uint32_t>("levels.live", tables.blocks.size()), levels.links_}});
    return levels;
}

void addCuts(Build& build) {
    if (const Cuts* cuts = build.find<Cuts>())
        build.program.only(When::cut, [&] { cuts->addPass(build.program); });
}

void Levels::addPasses(ProgramBuilder& program, const ParticleBuffers& particles, bool isFirst) const {
    program.dispatch(k::averageBlocks, blocks_, {particles.positions, children_, positions_},
                     layout::CountPush{blocks_});
    if (levels_ > 1)
        program.dispatch(k::solveLevels, bodies_ * LEVEL_GROUP,
                         {ranges_, info_, children_, links_, positions_, kicks_, particles.step},
                         layout::LevelPush{levels_, isFirst ? 1u : 0u});
    program.dispatch(k::kickBlocks, blocks_, {info_, links_, positions_, kicks_, particles.step},
                     layout::LevelPush{blocks_, isFirst ? 1u : 0u});
}

} // namespace sinew::sim::levels
