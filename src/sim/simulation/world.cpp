// A World compiles the scene of all parts anew for each batch of changes. A thread makes the simulation and
// the tables that carry the state of the one that runs; the thread of the host records the take-over.
#include "sinew/world.hpp"

#include "common/layout.h"
#include "sim/simulation/carrying.hpp"
#include "sim/simulation/simulation_state.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sinew::sim {

namespace {

// Bytes of first contents that one call of recordChanges() copies, where the host does not see the memory of
// the device: a millisecond at 16 GB/s.
constexpr VkDeviceSize fillingOfFrame = 16u << 20;

// The part with all that holds for the whole scene of the base, and among its surroundings.
Scene inSurroundings(const Scene& base, const Scene& part) {
    Scene scene = part;
    scene.gravity = base.gravity;
    scene.dt = base.dt;
    scene.damping = base.damping;
    scene.dampingTime = base.dampingTime;
    scene.debris = base.debris;
    const std::vector<Surface> surfaces = scene.contacts.surfaces;
    scene.contacts = base.contacts;
    scene.contacts.surfaces = surfaces;
    scene.planes.insert(scene.planes.end(), base.planes.begin(), base.planes.end());
    scene.colliders.insert(scene.colliders.end(), base.colliders.begin(), base.colliders.end());
    return scene;
}

// A list of elements in a scene: where a part's elements begin, and their number.
struct ElementList {
    std::uint32_t SceneCounts::*member;
    std::uint32_t offsetBefore = 0, offsetNow = 0; // of the list among others in one index space
};

// The elements of all parts that both scenes have.
template <typename Parts>
void addOrigins(Origin& origins, const Parts& before, const Parts& now, const ElementList& list) {
    for (const auto& placed : now) {
        const auto found =
            std::ranges::find_if(before, [&](const auto& other) { return other.part == placed.part; });
        if (found == before.end()) continue;
        const std::uint32_t from = list.offsetBefore + found->range.first.*list.member,
                            to = list.offsetNow + placed.range.first.*list.member;
        for (std::uint32_t i = 0; i < placed.range.count.*list.member; ++i) origins[to + i] = from + i;
    }
}

template <typename Parts>
Origins originsOf(const Scene& before, const Parts& partsBefore, const Scene& now, const Parts& partsNow,
                  std::uint32_t hostColliders) {
    const auto none = [](std::size_t count) { return Origin(count, NO_ELEMENT); };
    Origins origins{.particles = none(now.particles.size()),
                    .attachments = none(now.attachments.size()),
                    .skins = none(now.skins.size()),
                    .bodies = none(now.bodies.size()),
                    .planes = none(now.planes.size()),
                    .movers = none(hostColliders + now.colliders.size() + now.driven.size())};
    const auto length = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    for (std::uint32_t k = 0; k < hostColliders; ++k) origins.movers[k] = k;
    const auto add = [&](Origin& to, const ElementList& list) {
        addOrigins(to, partsBefore, partsNow, list);
    };
    add(origins.particles, {&SceneCounts::particles});
    add(origins.attachments, {&SceneCounts::attachments});
    add(origins.skins, {&SceneCounts::skins});
    add(origins.bodies, {&SceneCounts::bodies});
    add(origins.planes, {&SceneCounts::planes});
    add(origins.movers, {&SceneCounts::colliders, hostColliders, hostColliders});
    add(origins.movers, {&SceneCounts::driven, hostColliders + length(before.colliders),
                         hostColliders + length(now.colliders)});
    return origins;
}

// A part's scene at its place, with the arrival of its bodies.
SceneCounts place(Scene& scene, const Scene& part, std::uint32_t arrival) {
    const SceneCounts first = append(scene, part);
    for (std::size_t b = first.bodies; b < scene.bodies.size(); ++b) scene.bodies[b].arrival = arrival;
    return first;
}

// The largest number of an arrival.
std::uint32_t lastArrival(const Scene& scene) {
    std::uint32_t last = 0;
    for (const Body& body : scene.bodies) last = std::max(last, body.arrival);
    return last;
}

void requireBodies(const Scene& part) {
    std::vector<bool> isIn(part.particles.size());
    for (const Body& body : part.bodies)
        for (std::uint32_t i = 0; i < body.particleCount; ++i)
            if (body.firstParticle + i < isIn.size()) isIn[body.firstParticle + i] = true;
    const auto found = std::ranges::find(isIn, false);
    if (found != isIn.end())
        throw std::invalid_argument("particle[" + std::to_string(found - isIn.begin()) +
                                    "] of the part belongs to no body");
}

} // namespace

// A simulation that is being made, and, after the take-over, what it replaced.
struct World::Making {
    struct Part {
        PartId id;
        std::uint32_t arrival = 0;
        std::shared_ptr<const Scene> scene;
    };
    std::vector<Placed> arriving; // parts that the simulation that runs does not have
    Settings settings;
    bool hasLost = false; // parts that the simulation that runs has
    bool wakes = false;   // all that sleeps
    // Those of the new simulation; after the take-over, those of the one that it replaced.
    Scene scene;
    std::vector<Placed> placed;
    std::unique_ptr<Simulation> simulation;
    Origins origins;
    std::unique_ptr<Carrying> carrying; // its tables are used by the take-over
    bool isFilled = false;              // all first contents are written, or recorded
    std::future<void> made;             // the thread that runs make()

    void make(const vk::Device& device, const Scene& base, const std::vector<Part>& parts,
              const Simulation& running, const Scene& sceneBefore, const std::vector<Placed>& placedBefore) {
        scene = base;
        placed.push_back({.part = {}, .range = {.first = {}, .count = countsOf(base)}});
        for (const Part& part : parts) {
            const SceneCounts first = place(scene, *part.scene, part.arrival);
            placed.push_back({.part = part.id, .range = {.first = first, .count = countsOf(*part.scene)}});
        }
        simulation = std::make_unique<Simulation>(device, scene, settings);
        isFilled = simulation->fill();
        origins = originsOf(sceneBefore, placedBefore, scene, placed, settings.hostColliders);
        carrying = running.makeCarrying(*simulation, origins);
    }
};

World::World(const vk::Device& device, Scene base, const Settings& settings)
    : device_(device.anchored()), kernels_(device_), asked_(withSubsteps(base, settings)), settings_(asked_),
      choosesSubsteps_(settings.substeps == 0), choosesLevels_(settings.levels == autoLevels),
      base_(std::make_shared<const Scene>(std::move(base))), arrivals_(lastArrival(*base_)),
      rooms_(settings_),
      scene_(*base_), placed_{{.part = {}, .range = {.first = {}, .count = countsOf(*base_)}}},
      simulation_(std::make_unique<Simulation>(device_, scene_, settings_)) {}

World::~World() = default;

const World::Slot* World::slotOf(PartId part) const noexcept {
    if (part.index >= slots_.size()) return nullptr;
    const Slot& slot = slots_[part.index];
    return slot.isWanted && slot.generation == part.generation ? &slot : nullptr;
}

PartId World::add(Scene part) {
    SINEW_ONE_THREAD(simulation_->state_->oneThread);
    const Scene alone = inSurroundings(*base_, part);
    requireNone(validate(alone, asked_));
    requireBodies(part);
    Settings chosen = asked_;
    if (choosesSubsteps_) chosen.substeps = 0;
    if (choosesLevels_) chosen.levels = autoLevels;
    chosen = withSubsteps(alone, chosen);
    auto scene = std::make_shared<const Scene>(std::move(part));
    if (freeSlots_.empty()) {
        freeSlots_.reserve(slots_.size() + 1); // forget() allocates nothing
        slots_.emplace_back();
        freeSlots_.push_back(static_cast<std::uint32_t>(slots_.size() - 1));
    }
    const std::uint32_t index = freeSlots_.back();
    freeSlots_.pop_back();
    Slot& slot = slots_[index];
    slot.isWanted = true;
    slot.arrival = ++arrivals_;
    slot.substeps = chosen.substeps;
    slot.levels = chosen.levels;
    slot.scene = std::move(scene);
    hasChanged_ = true;
    return {index, slot.generation};
}

void World::forget(Slot& slot) noexcept {
    freeSlots_.push_back(static_cast<std::uint32_t>(&slot - slots_.data()));
    ++slot.generation;
    slot.isWanted = false;
    slot.scene.reset();
}

void World::remove(PartId part) {
    SINEW_ONE_THREAD(simulation_->state_->oneThread);
    if (slotOf(part) == nullptr) throw std::invalid_argument("the part is not, or no longer, in the world");
    forget(slots_[part.index]);
    hasChanged_ = true;
}

bool World::contains(PartId part) const noexcept {
    return slotOf(part) != nullptr;
}

std::optional<PartRange> World::find(PartId part) const noexcept {
    for (const Placed& placed : placed_)
        if (placed.part == part && part != PartId{}) return placed.range;
    return std::nullopt;
}

StepStatus World::status(std::uint64_t frame) const noexcept {
    const StepStatus status = simulation_->status(frame);
    if (status.isFinished) return status;
    for (std::size_t k = replaced_.size(); k-- > 0;) {
        const StepStatus before = replaced_[k]->simulation->status(frame);
        if (before.isFinished) return before;
    }
    return status;
}

Events World::events(std::uint64_t frame) const {
    Events events = simulation_->events(frame);
    for (std::size_t k = replaced_.size(); k-- > 0 && !events.isFinished;)
        events = replaced_[k]->simulation->events(frame);
    return events;
}

bool World::observe(const StepStatus& status) {
    SINEW_ONE_THREAD(simulation_->state_->oneThread);
    if (!status.isFinished) return true;
    std::optional<Settings> more;
    if (status.contactRoom >= refusedRoom_) return false;
    if (status.contactRoom > asked_.contactRoom)
        more = rooms_.forContacts(asked_, status.contactRoom);
    else if (rooms_.lackSurface(status.cutSurfaceMissing) && status.cutSurfaceMissing > asked_.cutSurfaceRoom)
        more = rooms_.forSurface(asked_, status.cutSurfaceMissing);
    else
        return status.cutSurfaceMissing == 0 || status.cutSurfaceMissing <= asked_.cutSurfaceRoom;
    if (!more) return false;
    asked_ = *more;
    hasChanged_ = true;
    return true;
}

void World::retry() noexcept {
    hasChanged_ = hasChanged_ || isLeaving_;
}

bool World::isChanging() const noexcept {
    return hasChanged_ || making_ != nullptr;
}

bool World::isMade() const {
    return making_ && (!making_->made.valid() ||
                       making_->made.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

bool World::isReady() const {
    return isMade() && (making_->isFilled || making_->simulation == nullptr);
}

// Parts stay in the order of their arrival, so that sums over contacts keep their order.
void World::begin() {
    auto making = std::make_unique<Making>();
    making->settings = asked_;
    making->settings.substeps = settings_.substeps; // never less than before
    making->settings.levels = settings_.levels;
    std::vector<Making::Part> parts;
    for (std::uint32_t index = 0; index < slots_.size(); ++index) {
        const Slot& slot = slots_[index];
        if (!slot.isWanted) continue;
        parts.push_back({{index, slot.generation}, slot.arrival, slot.scene});
        making->settings.substeps = std::max(making->settings.substeps, slot.substeps);
        making->settings.levels = std::max(making->settings.levels, slot.levels);
    }
    std::ranges::sort(parts, {}, &Making::Part::arrival);
    std::size_t particles = base_->particles.size(), faces = base_->faces.size();
    for (const Making::Part& part : parts) {
        const Scene& scene = *part.scene;
        particles += scene.particles.size();
        faces += scene.faces.size();
        if (find(part.id)) continue;
        making->arriving.push_back({.part = part.id, .range = {}});
        making->wakes =
            making->wakes || !scene.planes.empty() || !scene.colliders.empty() || !scene.driven.empty();
    }
    for (const Placed& placed : placed_)
        making->hasLost = making->hasLost || (placed.part != PartId{} && slotOf(placed.part) == nullptr);
    making->wakes = making->wakes || making->hasLost || making->settings.levels > settings_.levels;
    making->settings.contactRoom = contactRoomFor(particles, faces);
    making->made = std::async(std::launch::async,
                              [&making = *making, &device = device_, base = base_, parts = std::move(parts),
                               &running = *simulation_, &scene = scene_, &placed = placed_] {
                                  making.make(device, *base, parts, running, scene, placed);
                              });
    making_ = std::move(making);
    hasChanged_ = isLeaving_ = false;
}

// Entries of contact lists keep their places in pools: a scene with fewer owners gets longer lists.
std::uint32_t World::contactRoomFor(std::size_t particles, std::size_t faces) const {
    const StepProgram& program = simulation_->program();
    double room = asked_.contactRoom;
    for (const ContactMemory& memory : program.contactMemory) {
        const bool ofEdges = memory.contacts == program.contacts.edgePairs;
        const auto before = static_cast<double>(ofEdges ? scene_.faces.size() : scene_.particles.size());
        const auto now = static_cast<double>(std::max<std::size_t>(ofEdges ? faces : particles, 1));
        const auto countOf = [&](BufferId buffer) {
            return static_cast<double>(program.buffers[buffer.index].count);
        };
        room = std::max(room, std::ceil(countOf(memory.contacts) / countOf(memory.ranges) * before / now));
    }
    return static_cast<std::uint32_t>(
        std::min(room, std::max<double>(asked_.contactRoom, ranges::mostContactRoom)));
}

// The world goes on as it is. Only a failure without other changes says that a room is too large.
void World::giveUp(const Making& making) noexcept {
    for (const Placed& placed : making.arriving)
        if (slotOf(placed.part) != nullptr) forget(slots_[placed.part.index]);
    if (making.arriving.empty() && !making.hasLost) {
        if (asked_.contactRoom > settings_.contactRoom) refusedRoom_ = asked_.contactRoom;
        if (asked_.cutSurfaceRoom > settings_.cutSurfaceRoom) rooms_.refuseSurface();
    }
    asked_.contactRoom = std::min(asked_.contactRoom, settings_.contactRoom);
    asked_.cutSurfaceRoom = std::min(asked_.cutSurfaceRoom, settings_.cutSurfaceRoom);
    hasChanged_ = hasChanged_ || (making.hasLost && !making.arriving.empty());
    isLeaving_ = making.hasLost;
}

void World::release() {
    SINEW_ONE_THREAD(simulation_->state_->oneThread);
    if (replaced_.empty()) return;
    retry(); // there is more memory now
    destroying_ = std::async(std::launch::async, [before = std::move(destroying_),
                                                  replaced = std::exchange(replaced_, {})]() mutable {
        if (before.valid()) before.wait();
        replaced.clear();
    });
}

// Steps that lacked room are recorded anew once a simulation with more room has taken over: none may be in
// flight then.
bool World::mayTakeOver() const noexcept {
    const bool grows = asked_.contactRoom > settings_.contactRoom;
    return simulation_->mayBeCarried() && !(grows && simulation_->oldestInFlight());
}

bool World::recordChanges(VkCommandBuffer commands) {
    SINEW_ONE_THREAD(simulation_->state_->oneThread);
    if (!making_ && hasChanged_) begin();
    if (!isMade()) return false;
    try {
        if (making_->made.valid()) making_->made.get();
    } catch (...) {
        giveUp(*std::exchange(making_, nullptr));
        throw;
    }
    if (!making_->isFilled) making_->isFilled = making_->simulation->recordFilling(commands, fillingOfFrame);
    if (!making_->isFilled || !mayTakeOver()) return false;
    replaced_.reserve(replaced_.size() + 1);
    std::unique_ptr<Making> making = std::move(making_);
    making->simulation->recordCarried(commands, *simulation_, *making->carrying, making->origins,
                                      making->wakes);
    std::swap(scene_, making->scene);
    std::swap(placed_, making->placed);
    std::swap(simulation_, making->simulation);
    settings_ = making->settings;
    rooms_.adopt(settings_);
    replaced_.push_back(std::move(making));
    return true;
}

} // namespace sinew::sim
