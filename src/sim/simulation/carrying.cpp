// Tables of indices are made on the host, one for each kind of element; the entries stay on the device.
#include "sim/simulation/carrying.hpp"

#include "common/layout.h"
#include "kernels.hpp"
#include "sim/program/first_contents.hpp"
#include "sinew/vk/check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

namespace sinew::sim {

namespace {

template <std::size_t n> using Corners = std::vector<std::array<std::uint32_t, n>>;

Corners<3> facesOf(const StepProgram& program) {
    Corners<3> result;
    for (const auto& face : firstContents<layout::ContactFace>(program, program.contacts.faces))
        result.push_back({face.a, face.b, face.c});
    return result;
}

Corners<2> edgesOf(const StepProgram& program) {
    Corners<2> result;
    for (const auto& edge : firstContents<layout::ContactEdge>(program, program.contacts.edges))
        result.push_back({edge.a, edge.b});
    return result;
}

// Slots without a particle have no origin.
Origin slotOrigins(const StepProgram& from, const StepProgram& to, const Origin& particles) {
    Origin origins(to.slotCount, NO_ELEMENT);
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles[i] != NO_ELEMENT) origins[to.slots[i]] = from.slots[particles[i]];
    return origins;
}

// Elements that their corners identify: faces and edges by slots, interlocked bodies by particles. `corners`
// by corner before: the corner now. The n-th of several elements with the same corners was the n-th before.
template <std::size_t n>
Origin cornerOrigins(const Corners<n>& before, const Corners<n>& now,
                     const std::vector<std::uint32_t>& corners) {
    std::map<std::array<std::uint32_t, n>, std::vector<std::uint32_t>> places;
    for (auto e = static_cast<std::uint32_t>(now.size()); e-- > 0;) places[now[e]].push_back(e);
    Origin origins(now.size(), NO_ELEMENT);
    for (std::uint32_t e = 0; e < before.size(); ++e) {
        std::array<std::uint32_t, n> moved{};
        std::ranges::transform(before[e], moved.begin(), [&](std::uint32_t corner) {
            return corner < corners.size() ? corners[corner] : NO_ELEMENT;
        });
        const auto found = places.find(moved);
        if (found == places.end() || found->second.empty()) continue;
        origins[found->second.back()] = e;
        found->second.pop_back();
    }
    return origins;
}

// Prisms, or vertices, of clipped skins.
struct SpanPart {
    std::uint32_t SkinSpan::*first;
    std::uint32_t SkinSpan::*count;
};

Origin spanOrigins(const StepProgram& from, const StepProgram& to, const Origin& skins,
                   const SpanPart& part) {
    std::size_t count = 0;
    for (const SkinSpan& span : to.skinSpans)
        count = std::max<std::size_t>(count, span.*part.first + span.*part.count);
    Origin origins(count, NO_ELEMENT);
    for (const SkinSpan& span : to.skinSpans) {
        const auto found = std::ranges::find_if(
            from.skinSpans, [&](const SkinSpan& other) { return skins[span.skin] == other.skin; });
        if (found == from.skinSpans.end()) continue;
        for (std::uint32_t i = 0; i < span.*part.count; ++i)
            origins[span.*part.first + i] = (*found).*part.first + i;
    }
    return origins;
}

// By partner of a body, one list after another (EventBuffers): the partner before.
Origin partnerOrigins(const EventBuffers& from, const EventBuffers& to, const Origins& origins) {
    Origin partners;
    std::uint32_t first = 0;
    const auto add = [&](auto begin, std::uint32_t count, std::uint32_t before) {
        for (std::uint32_t i = 0; i < count; ++i, ++begin)
            partners.push_back(*begin < before ? first + *begin : NO_ELEMENT);
        first += before;
    };
    add(origins.bodies.begin(), to.bodies, from.bodies);
    add(origins.planes.begin(), to.planes, from.planes);
    add(origins.movers.begin(), to.hostColliders + to.colliders, from.hostColliders + from.colliders);
    return partners;
}

// By body and partner. Bodies keep their order, so a pair stays in the row of its first body.
Origin pairOrigins(const EventBuffers& from, const EventBuffers& to, const Origins& origins) {
    const std::uint32_t rowBefore = 32 * from.rowWords, row = 32 * to.rowWords;
    if (rowBefore == 0 || row == 0) return {};
    const Origin partners = partnerOrigins(from, to, origins);
    Origin pairs(std::size_t{to.bodies} * row, NO_ELEMENT);
    for (std::uint32_t body = 0; body < to.bodies; ++body)
        for (std::uint32_t p = 0; p < partners.size(); ++p)
            if (origins.bodies[body] != NO_ELEMENT && partners[p] != NO_ELEMENT)
                pairs[std::size_t{body} * row + p] = origins.bodies[body] * rowBefore + partners[p];
    return pairs;
}

Origin identity(std::size_t count) {
    Origin origins(count);
    std::iota(origins.begin(), origins.end(), 0u);
    return origins;
}

// By slot: whether a particle is in it.
std::vector<bool> takenSlots(const StepProgram& program) {
    std::vector<bool> taken(program.slotCount, false);
    for (const std::uint32_t slot : program.slots) taken[slot] = true;
    return taken;
}

// A buffer whose elements move in at most this many runs is carried by copies, else by a kernel: on software
// devices a kernel takes 5 ns a word.
constexpr std::size_t mostRuns = 64;

std::uint32_t groupsOf(const vk::Kernel& kernel, std::uint32_t items) {
    return (items - 1) / kernel.interface().groupSize[0] + 1;
}

// A part of a buffer, from an element on.
vk::BufferView from(vk::BufferView view, std::uint64_t first, std::uint32_t stride) {
    view.offset += first * stride;
    view.size -= first * stride;
    view.stride = vk::BufferView::anyStride;
    return view;
}

} // namespace

// Makes the tables and moves of a Carrying.
class Carrying::Plan {
public:
    Plan(Carrying& made, const vk::Device& device, const CarriedState& before, const CarriedState& now,
         const Origins& origins)
        : made_(made), device_(device), before_(before), now_(now) {
        const auto add = [&](Elements of, Origin origin, std::size_t count) {
            tables_[of] = tableOf(std::move(origin), count);
        };
        const StepProgram &first = before.program, &second = now.program;
        add(Elements::particles, origins.particles, first.particleCount);
        add(Elements::slots, slotOrigins(first, second, origins.particles), first.slotCount);
        tables_[Elements::slots].runs = joined(tables_[Elements::slots].runs);
        add(Elements::attachments, origins.attachments, 0);
        add(Elements::movers, origins.movers, 0);
        add(Elements::bodies, origins.bodies, 0);
        add(Elements::bodyPartners, pairOrigins(first.events, second.events, origins), 0);
        add(Elements::prisms,
            spanOrigins(first, second, origins.skins, {&SkinSpan::firstPrism, &SkinSpan::prisms}), 0);
        add(Elements::skinVertices,
            spanOrigins(first, second, origins.skins, {&SkinSpan::firstVertex, &SkinSpan::vertices}), 0);
        add(Elements::interlocks,
            cornerOrigins(first.interlocks, second.interlocks, tables_[Elements::particles].targets), 0);
        const std::vector<std::uint32_t>& slots = tables_[Elements::slots].targets;
        const Corners<3> faces = facesOf(first);
        faces_ = tableOf(cornerOrigins(faces, facesOf(second), slots), faces.size());
        const Corners<2> edges = edgesOf(first);
        edges_ = tableOf(cornerOrigins(edges, edgesOf(second), slots), edges.size());
    }

    void addAll() {
        const StepProgram &first = before_.program, &second = now_.program;
        addMove(first.positions, second.positions, {.of = Elements::particles});
        addMove(first.velocities, second.velocities, {.of = Elements::particles});
        for (const StateBuffer& buffer : second.stateBuffers)
            if (const StateBuffer* other = counterpart(buffer)) addMove(other->from, buffer.to, buffer.carry);
        for (const ContactMemory& memory : second.contactMemory) addContacts(memory);
        addArrivals();
        if (!requests_.empty()) made_.sets_.emplace_back(device_, requests_);
        if (first.cutting.counts == BufferId{} || second.cutting.counts == BufferId{}) return;
        made_.counts_ = {before_.executor.view(first.cutting.counts),
                         now_.executor.view(second.cutting.counts)};
        // CutCounts::links, linksOfStep
        made_.counts_.from.size = made_.counts_.to.size = 2 * sizeof(std::uint32_t);
    }

private:
    static Table tableOf(Origin origins, std::size_t before) {
        Table table{.origins = std::move(origins),
                    .targets = std::vector<std::uint32_t>(before, NO_ELEMENT),
                    .runs = {},
                    .originsView = {},
                    .targetsView = {}};
        for (std::uint32_t i = 0; i < table.origins.size(); ++i) {
            const std::uint32_t origin = table.origins[i];
            if (origin < before) table.targets[origin] = i;
            if (origin == NO_ELEMENT) continue;
            const bool continues = !table.runs.empty() &&
                                   i == table.runs.back().to + table.runs.back().count &&
                                   origin == table.runs.back().from + table.runs.back().count;
            if (continues)
                ++table.runs.back().count;
            else
                table.runs.push_back({origin, i, 1});
        }
        return table;
    }

    // Runs of slots with those between them that hold no particle on either side: these never change.
    std::vector<Run> joined(const std::vector<Run>& runs) const {
        const std::vector<bool> before = takenSlots(before_.program), now = takenSlots(now_.program);
        const auto isFree = [](const std::vector<bool>& taken, std::uint32_t first, std::uint32_t count) {
            const auto from = taken.begin() + first;
            return std::none_of(from, from + count, [](bool isTaken) { return isTaken; });
        };
        std::vector<Run> result;
        for (const Run& run : runs) {
            if (!result.empty()) {
                Run& last = result.back();
                const std::uint32_t end = last.to + last.count, gap = run.to - end;
                if (run.from == last.from + last.count + gap && isFree(now, end, gap) &&
                    isFree(before, last.from + last.count, gap)) {
                    last.count += gap + run.count;
                    continue;
                }
            }
            result.push_back(run);
        }
        return result;
    }

    const std::string& labelOf(const StepProgram& program, BufferId buffer) const {
        return program.buffers[buffer.index].label;
    }

    // The buffer of the same name before; labels of the state are unique, except for those of lists that cuts
    // change, which are not carried. A saved copy that only this program has starts as the value that it is
    // a copy of.
    const StateBuffer* counterpart(const StateBuffer& buffer) const {
        if (buffer.carry.of == Elements::none) return nullptr;
        const StateBuffer* found = named(labelOf(now_.program, buffer.to));
        for (const StateBuffer& other : now_.program.stateBuffers)
            if (found == nullptr && other.from == buffer.to && other.to != buffer.to)
                found = named(labelOf(now_.program, other.to));
        return found;
    }

    const StateBuffer* named(const std::string& label) const {
        const auto found = std::ranges::find_if(before_.program.stateBuffers, [&](const StateBuffer& other) {
            return labelOf(before_.program, other.to) == label;
        });
        return found == before_.program.stateBuffers.end() ? nullptr : &*found;
    }

    vk::BufferView upload(const std::vector<std::uint32_t>& words) {
        vk::Buffer& buffer =
            made_.tables_.emplace_back(device_, vk::BufferRequest{.name = "carry.table",
                                                                  .count = words.size(),
                                                                  .stride = sizeof(std::uint32_t),
                                                                  .kind = vk::MemoryKind::upload});
        if (!words.empty()) std::memcpy(buffer.mapped(), words.data(), words.size() * sizeof(std::uint32_t));
        buffer.flush();
        return buffer.view();
    }
    vk::BufferView originsOf(Table& table) {
        if (table.originsView.buffer == VK_NULL_HANDLE) table.originsView = upload(table.origins);
        return table.originsView;
    }
    vk::BufferView targetsOf(Table& table) {
        if (table.targetsView.buffer == VK_NULL_HANDLE) table.targetsView = upload(table.targets);
        return table.targetsView;
    }

    template <typename Push>
    void add(const vk::Kernel& kernel, std::uint32_t items, std::vector<vk::BufferView> buffers,
             const Push& push) {
        if (items == 0) return;
        requireGroups(kernel, items);
        requests_.push_back({&kernel, std::move(buffers)});
        std::vector<std::uint32_t> words(sizeof(Push) / sizeof(std::uint32_t));
        std::memcpy(words.data(), &push, sizeof(Push));
        made_.moves_.push_back({&kernel, items, std::move(words)});
    }

    void requireGroups(const vk::Kernel& kernel, std::uint32_t items) const {
        sim::requireGroups(kernel, groupsOf(kernel, items), device_.limits().maxGroupCount);
    }

    // The state and its saved copy.
    void addArrivals() {
        const StepProgram& program = now_.program;
        const auto savedOf = [&](BufferId state) {
            for (const StateBuffer& buffer : program.stateBuffers)
                if (buffer.to == state) return buffer.from;
            return state;
        };
        const std::array<BufferId, 2> state{program.statePositions, program.stateVelocities};
        const std::array<BufferId, 2> saved{savedOf(state[0]), savedOf(state[1])};
        Table& slots = tables_[Elements::slots];
        for (const auto& [positions, velocities] : {state, saved}) {
            if (positions == BufferId{}) continue;
            requireGroups(*made_.ofArrivals_, program.slotCount);
            requests_.push_back({made_.ofArrivals_.get(),
                                 {originsOf(slots), from(now_.executor.view(positions), 0, 0),
                                  from(now_.executor.view(velocities), 0, 0)}});
            made_.arrivals_.push_back({made_.ofArrivals_.get(), program.slotCount, {}});
            if (saved == state) break;
        }
    }

    void addMove(BufferId source, BufferId target, const Carry& carry) {
        const vk::BufferView first = before_.executor.view(source), second = now_.executor.view(target);
        if (first.size == 0 || second.size == 0) return;
        if (carry.of == Elements::one && carry.values == Elements::none) {
            Copy copy{first, second};
            copy.from.size = copy.to.size = std::min(first.size, second.size);
            made_.copies_.push_back(copy);
            return;
        }
        const std::uint32_t stride = second.stride;
        addHalf(from(first, 0, stride), from(second, 0, stride), stride, carry);
        const std::uint32_t before = before_.program.slotCount, now = now_.program.slotCount;
        const bool haveRemainders = carry.of == Elements::slots && first.size == 2ull * before * stride &&
                                    second.size == 2ull * now * stride;
        if (haveRemainders) addHalf(from(first, before, stride), from(second, now, stride), stride, carry);
    }

    // The entries of all elements, without the remainders of positions behind them.
    void addHalf(const vk::BufferView& source, const vk::BufferView& target, std::uint32_t stride,
                 const Carry& carry) {
        if (carry.of == Elements::one && whole_.origins.empty())
            whole_ = tableOf(identity(before_.program.particleCount), 0);
        Table& table = carry.of == Elements::one ? whole_ : tables_[carry.of];
        const std::uint32_t words = stride / static_cast<std::uint32_t>(sizeof(std::uint32_t));
        const auto elements = static_cast<std::uint32_t>(
            std::min<std::uint64_t>({table.origins.size(), target.size / stride,
                                     carry.of == Elements::one ? source.size / stride : ~std::uint64_t{0}}));
        // A buffer of movers is a placeholder while none of them moves.
        const std::uint64_t needed = table.before();
        if (carry.of != Elements::one && source.size < needed * stride) return;
        const bool areIndices = carry.values != Elements::none;
        if (!areIndices && table.runs.size() <= mostRuns) {
            for (const Run& run : table.runs) {
                const std::uint32_t count = run.to < elements ? std::min(run.count, elements - run.to) : 0;
                if (count > 0) addCopy(source, target, {run.from, run.to, count}, stride);
            }
            return;
        }
        Table& values = areIndices ? tables_[carry.values] : table;
        const layout::CarryPush push{.count = elements * words,
                                     .words = words,
                                     .values =
                                         areIndices ? static_cast<std::uint32_t>(values.targets.size()) : 0};
        const vk::BufferView targets = areIndices ? targetsOf(values) : originsOf(table);
        add(*made_.ofElements_, push.count, {originsOf(table), targets, source, target}, push);
    }

    void addCopy(const vk::BufferView& source, const vk::BufferView& target, const Run& run,
                 std::uint32_t stride) {
        Copy copy{from(source, run.from, stride), from(target, run.to, stride)};
        copy.from.size = copy.to.size = std::uint64_t{run.count} * stride;
        made_.copies_.push_back(copy);
    }

    void addContacts(const ContactMemory& now) {
        const ContactBuffers& contacts = now_.program.contacts;
        const bool ofFaces = now.contacts == contacts.facePairs, ofEdges = now.contacts == contacts.edgePairs;
        Table& slots = tables_[Elements::slots];
        Table& owners = ofEdges ? edges_ : slots;
        Table& partners = ofFaces ? faces_ : ofEdges ? edges_ : slots;
        const std::string& label = labelOf(now_.program, now.contacts);
        const auto found =
            std::ranges::find_if(before_.program.contactMemory, [&](const ContactMemory& other) {
                return labelOf(before_.program, other.contacts) == label;
            });
        if (found == before_.program.contactMemory.end()) return;
        addList(owners, partners, {found->ranges, found->contacts, found->memory},
                {now.ranges, now.contacts, now.memory});
        addList(owners, partners, {found->savedRanges, found->savedOthers, found->savedMemory},
                {now.savedRanges, now.savedOthers, now.savedMemory});
    }

    struct ListBuffers {
        BufferId ranges, entries, memory;
    };
    void addList(Table& owners, Table& partners, const ListBuffers& source, const ListBuffers& target) {
        const auto before = [&](BufferId buffer) { return from(before_.executor.view(buffer), 0, 0); };
        const auto now = [&](BufferId buffer) { return from(now_.executor.view(buffer), 0, 0); };
        const auto listed = firstContents<layout::ListRange>(now_.program, target.ranges);
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < listed.size(); ++i) // of the new owners
            if (owners.origins[i] == NO_ELEMENT && listed[i].count > 0)
                first = std::max(first, listed[i].first + listed[i].count);
        const BufferSpec& entries = now_.program.buffers[target.entries.index];
        const layout::CarryContactsPush push{.count = static_cast<std::uint32_t>(owners.origins.size()),
                                             .partners = static_cast<std::uint32_t>(partners.targets.size()),
                                             .words = entries.stride /
                                                      static_cast<std::uint32_t>(sizeof(std::uint32_t)),
                                             .first = first,
                                             .room = static_cast<std::uint32_t>(entries.count)};
        add(*made_.ofContacts_, push.count,
            {originsOf(owners), targetsOf(partners), before(source.ranges), before(source.entries),
             before(source.memory), now(target.ranges), now(target.entries), now(target.memory)},
            push);
    }

    Carrying& made_;
    const vk::Device& device_;
    const CarriedState &before_, &now_;
    std::map<Elements, Table> tables_;
    Table faces_, edges_, whole_;
    std::vector<vk::BindingRequest> requests_;
};

Carrying::Carrying(const vk::Device& device, const CarriedState& from, const CarriedState& to,
                   const Origins& origins)
    : ofElements_(device.kernels().get(device, kernels::carryElements, {})),
      ofContacts_(device.kernels().get(device, kernels::carryContacts, {})),
      ofArrivals_(device.kernels().get(device, kernels::startArrivals, {})) {
    Plan(*this, device, from, to, origins).addAll();
}

void Carrying::record(vk::Commands& commands) const noexcept {
    for (const Copy& copy : copies_) commands.copy(copy.from, copy.to);
    for (std::size_t m = 0; m < moves_.size(); ++m) {
        const Move& move = moves_[m];
        commands.bind(*move.kernel, sets_[0][m]);
        commands.push(*move.kernel, move.push.data(),
                      static_cast<std::uint32_t>(move.push.size() * sizeof(std::uint32_t)));
        commands.dispatch(groupsOf(*move.kernel, move.items));
    }
}

void Carrying::recordArrivals(vk::Commands& commands, const Vec3& halfKick, float thetaH) const noexcept {
    for (std::size_t a = 0; a < arrivals_.size(); ++a) {
        const Move& move = arrivals_[a];
        const layout::ArrivalPush push{
            .halfKick = {halfKick.x, halfKick.y, halfKick.z, 0}, .count = move.items, .thetaH = thetaH};
        commands.bind(*move.kernel, sets_[0][moves_.size() + a]);
        commands.push(*move.kernel, &push, sizeof push);
        commands.dispatch(groupsOf(*move.kernel, move.items));
    }
}

void Carrying::recordCounts(vk::Commands& commands) const noexcept {
    if (counts_.from.size > 0) commands.copy(counts_.from, counts_.to);
}

} // namespace sinew::sim
