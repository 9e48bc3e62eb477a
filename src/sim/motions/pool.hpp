// Bodies that enter and leave the world (Body::isAbsent): room is reserved for them, and a motion spawns or
// despawns them. An absent body stands in one point far away, with no inverse mass: contacts, fields, grabs
// and sleep leave it out as they leave out what is far and never moves. That place is the state; what follows
// from it is made anew wherever it changes, also by an undone step or a state that was loaded.
//
// A body that two steps have begun absent costs next to nothing: dispatches of lattices have no chunks of
// its, and kernels that may run for listed groups leave its groups out, by its own lists or those of sleep.
//
//   begin  plan_pool, move_pool
//   open   mask_pool, mask_pool_edges      grid by grid of contacts
//          list_pool_chunks                a dispatch of lattices each; gate_pool_chunks if bodies may sleep
//          mark_pool_groups, list_awake    unless bodies may sleep
#pragma once

#include "sim/model/feature.hpp"

#include <optional>

namespace sinew::sim {
class Complaints;
}

namespace sinew::sim::motions {

/// The positions at load: those of absent bodies are ABSENT_PLACE.
std::vector<Vec3> withAbsent(const Scene& scene, std::vector<Vec3> positions);
/// The same of inverse masses: 0.
std::vector<float> withAbsent(const Scene& scene, std::vector<float> inverseMasses);

/// Whether bodies of the scene may be absent; else the functions below add nothing.
bool haveAbsent(const Scene& scene);
/// By body of the scene: whether it may be absent and may be cut.
std::vector<bool> restoredBodies(const Scene& scene);
/// Appends the passes that move bodies.
void addPool(Build& build, BufferId requests, BufferId bodiesOfSlots);
/// Buffers that say which bodies come and go in a step: by slot the body of the scene, by body POOL_SAME ...
/// (motion_layout.h).
struct Changes {
    BufferId bodies, changes;
};
/// None if no body may be absent.
std::optional<Changes> changesOf(const Build& build);
/// Appends the passes over grids of contacts, after these were added.
void addPoolMasks(Build& build);
/// Appends the pass that keeps absent bodies out of a list of chunks, of which `perGroup` are for a work
/// group, and returns the groups of its dispatch. None if this stays as it is.
std::optional<IndirectItems> addPoolChunks(Build& build, BufferId chunks, std::uint32_t perGroup,
                                           std::uint32_t items);
/// Lets passes of substeps run for listed groups, and ends that.
void addPoolGroups(Build& build);
void endPoolGroups(Build& build);

/// Complains about bodies that cannot be absent. The scene must be otherwise valid.
void checkPool(const Scene& scene, const Settings& settings, Complaints& complaints);

} // namespace sinew::sim::motions
