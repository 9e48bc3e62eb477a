// The host side: the bodies of particles, and the order of the passes.
#include "sim/collision/body_frames.hpp"

#include "kernels.hpp"
#include "sim/rigid/driven.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace sinew::sim::collision::body_frames {

namespace {

namespace k = kernels;

constexpr std::uint32_t loose = 0, still = 1, firstLinked = 2; // bodies
constexpr std::uint32_t hasHeadingsId = 1;                     // constant_id in expected.glsl
constexpr std::uint32_t sleepsId = 2, checksGroupsId = 3;      // in sum_frames.comp
constexpr std::size_t fewest = 8;                              // particles of a body of its own

// Numbers of the largest components, by their lowest particle.
std::map<std::uint32_t, std::uint32_t> largestOf(std::span<const std::uint32_t> components) {
    std::map<std::uint32_t, std::size_t> sizes;
    for (const std::uint32_t component : components) ++sizes[component];
    std::vector<std::pair<std::size_t, std::uint32_t>> order;
    for (const auto& [component, size] : sizes)
        if (size >= fewest) order.emplace_back(size, component);
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
    order.resize(std::min<std::size_t>(order.size(), FRAME_MOST_BODIES - firstLinked));
    std::map<std::uint32_t, std::uint32_t> bodies;
    for (const auto& [size, component] : order)
        bodies.emplace(component, firstLinked + static_cast<std::uint32_t>(bodies.size()));
    return bodies;
}

// By particle: a moving particle linked to it if it is static, else itself.
std::vector<std::uint32_t> linkedMovers(const Scene& scene, std::span<const float> inverseMass) {
    std::vector<std::uint32_t> mover(scene.particles.size());
    std::iota(mover.begin(), mover.end(), 0u);
    const auto link = [&](std::uint32_t a, std::uint32_t b) {
        if (inverseMass[a] == 0 && inverseMass[b] != 0) mover[a] = b;
        if (inverseMass[b] == 0 && inverseMass[a] != 0) mover[b] = a;
    };
    for (const DistanceConstraint& d : scene.distances) link(d.a, d.b);
    return mover;
}

using AllFrames = std::array<layout::BodyFrame, FRAME_MOST_BODIES>;

std::vector<AllFrames> standingFrames() {
    layout::BodyFrame frame{};
    frame.map[0].x = frame.map[1].y = frame.map[2].z = 1;
    frame.speed.w = -1; // no lists yet
    AllFrames frames;
    frames.fill(frame);
    return {frames};
}

// Slots sorted by body, divided into shares for one invocation each.
struct Shares {
    std::vector<std::uint32_t> members;
    std::vector<layout::FrameChunk> chunks;
    std::vector<layout::FrameBody> bodies;
    std::vector<std::uint32_t> numbers; // of the bodies that have a member, by number in Bodies
};

// Limits of shares: with more of them a step would wait for their sum.
constexpr std::size_t leastShare = 64, mostShares = 256;

Shares sharesOf(const Bodies& bodies, std::span<const float> radii) {
    Shares shares;
    shares.numbers.assign(bodies.kinds.size(), 0);
    std::vector<std::vector<std::uint32_t>> members(bodies.kinds.size());
    for (std::uint32_t i = 0; i < bodies.ofSlots.size(); ++i)
        if (bodies.isMember[i] && radii[i] >= 0) members[bodies.ofSlots[i]].push_back(i);
    const std::size_t share = std::max(leastShare, bodies.ofSlots.size() / mostShares);
    for (std::uint32_t b = 0; b < members.size(); ++b) {
        if (members[b].empty()) continue;
        const auto number = static_cast<std::uint32_t>(shares.bodies.size());
        shares.numbers[b] = number;
        const auto isThere = [&](std::uint32_t slot) { return !bodies.isAbsent[slot]; };
        const auto there = std::ranges::find_if(members[b], isThere);
        const std::uint32_t origin = there == members[b].end() ? members[b].front() : *there;
        layout::FrameBody body{static_cast<std::uint32_t>(shares.chunks.size()), 0, origin, bodies.kinds[b]};
        for (std::size_t first = 0; first < members[b].size(); first += share, ++body.chunks)
            shares.chunks.push_back({static_cast<std::uint32_t>(shares.members.size() + first),
                                     static_cast<std::uint32_t>(std::min(share, members[b].size() - first)),
                                     number, origin});
        shares.members.insert(shares.members.end(), members[b].begin(), members[b].end());
        shares.bodies.push_back(body);
    }
    return shares;
}

} // namespace

bool Bodies::isAlone(std::uint32_t body) {
    return body >= firstLinked;
}

Bodies bodiesOf(const SceneModel& model) {
    const std::vector<float>& inverseMass = model.inverseMass;
    const StateLayout& layout = model.layout;
    const std::vector<bool> isDriven = rigid::driven::areDriven(model.scene);
    const std::vector<std::uint32_t>& components = model.components();
    const std::map<std::uint32_t, std::uint32_t> large = largestOf(components);
    const std::vector<std::uint32_t> movers = linkedMovers(model.scene, inverseMass);
    Bodies bodies{std::vector<std::uint32_t>(layout.count, loose),
                  std::vector<std::uint32_t>(firstLinked + large.size(), FRAME_MOVES),
                  std::vector<bool>(layout.count, false), std::vector<bool>(layout.count, false)};
    bodies.kinds[still] = FRAME_STANDS;
    for (const Body& body : model.scene.bodies)
        for (std::uint32_t i = 0; body.isAbsent && i < body.particleCount; ++i)
            bodies.isAbsent[layout.slot[body.firstParticle + i]] = true;
    for (std::size_t i = 0; i < components.size(); ++i) {
        const std::uint32_t slot = layout.slot[i];
        bodies.isMember[slot] = true;
        const auto found = large.find(components[movers[i]]); // a pin belongs to what hangs on it
        if (found != large.end())
            bodies.ofSlots[slot] = found->second;
        else if (inverseMass[i] == 0 && !isDriven[i])
            bodies.ofSlots[slot] = still;
    }
    return bodies;
}

Frames addStanding(ProgramBuilder& program, const Request& request) {
    const std::string name = request.name;
    std::vector<std::uint32_t> members;
    for (std::uint32_t i = 0; i < request.radii.size(); ++i)
        if (request.radii[i] >= 0) members.push_back(i);
    const auto count = static_cast<std::uint32_t>(members.size());
    return {.push = {.chunks = 0,
                     .bodies = 1,
                     .reach = request.reach,
                     .margin = request.margin,
                     .substeps = request.substeps},
            .frames = program.upload(name + ".frames", standingFrames()),
            .ofSlots = program.scratch<float>(name + ".bodies", request.radii.size()),
            .members = program.upload(name + ".watched", members),
            .memberCount = count};
}

Frames add(ProgramBuilder& program, const Bodies& bodies, const Request& request) {
    const std::string name = request.name;
    const Shares shares = sharesOf(bodies, request.radii);
    const auto count = static_cast<std::uint32_t>(shares.bodies.size());
    if (count == 0) return addStanding(program, request);
    std::vector<float> ofSlots(bodies.ofSlots.size(), FRAME_NONE);
    for (const std::uint32_t slot : shares.members)
        ofSlots[slot] = static_cast<float>(shares.numbers[bodies.ofSlots[slot]]);
    return {.push = {.chunks = static_cast<std::uint32_t>(shares.chunks.size()),
                     .bodies = count,
                     .reach = request.reach,
                     .margin = request.margin,
                     .substeps = request.substeps},
            .frames = program.upload(name + ".frames", standingFrames()),
            .ofSlots = program.upload(name + ".bodies", ofSlots),
            .members = program.upload(name + ".watched", shares.members),
            .memberCount = static_cast<std::uint32_t>(shares.members.size()),
            .chunks = program.upload(name + ".frames.chunks", shares.chunks),
            .bodies = program.upload(name + ".frames.bodies", shares.bodies),
            .partial =
                program.scratch<layout::vec4>(name + ".frames.partial", shares.chunks.size() * FRAME_SUMS),
            .sums = program.scratch<layout::vec4>(name + ".frames.sums", std::size_t{count} * FRAME_SUMS)};
}

void addFit(ProgramBuilder& program, const Frames& frames, const Seen& seen) {
    if (frames.chunks == BufferId{}) return;
    const layout::FramePush& push = frames.push;
    const ProgramBuilder::Constants constants{{hasHeadingsId, push.ahead > 0}};
    ProgramBuilder::Constants summed = constants;
    summed.insert({{sleepsId, seen.weights != unbound}, {checksGroupsId, seen.groups != unbound}});
    program.dispatch(k::sumFrames, push.chunks,
                     {seen.positions, seen.velocities, seen.detected, frames.chunks, frames.members,
                      seen.radii, frames.partial, seen.headings, seen.bounds, seen.weights, seen.groups},
                     push, summed);
    program.dispatch(k::addFrames, push.bodies * FRAME_SUMS, {frames.partial, frames.bodies, frames.sums},
                     push);
    program.dispatch(k::fitFrames, GROUP_ITEMS,
                     {frames.sums, frames.bodies, seen.positions, seen.detected, frames.frames, seen.bounds,
                      seen.step, seen.headings},
                     push, constants);
}

} // namespace sinew::sim::collision::body_frames
