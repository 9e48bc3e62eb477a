// The passes run over all slots of a run, or of a skin, and leave bodies out that neither come nor go.
#include "sim/cutting/restoring.hpp"

#include "kernels.hpp"
#include "sim/events/events.hpp"
#include "sim/motions/pool.hpp"
#include "sim/sleep/sleep.hpp"
#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// constant_ids of restore_links.comp and close_restored.comp
constexpr std::uint32_t hasPullsId = 1, maySleepId = 2, hasLimitsId = 3, hasSurfaceId = 1;

std::optional<motions::Changes> changesOf(const Build& build, const Cut& cut) {
    return cut.replaced == BufferId{} ? std::nullopt : motions::changesOf(build);
}

} // namespace

void addRestoring(Build& build, const Cut& cut) {
    const auto changes = changesOf(build, cut);
    if (!changes) return;
    if (build.particles.events) build.particles.events->changes = changes->changes;
    ProgramBuilder& program = build.program;
    const CuttingBuffers& cutting = cut.buffers;
    const auto& sleep = build.particles.sleep;
    const BufferId pulls = cut.surface ? cut.surface->hung.pulls : BufferId{};
    const bool hasPulls = pulls != BufferId{}, maySleep = sleep != nullptr,
               hasLimits = maySleep && program.program().cutting.debris > 0;
    const std::vector<BufferId> buffers{
        changes->bodies,
        changes->changes,
        cut.whole,
        cutting.links,
        cutting.hits,
        cut.placesBefore,
        cut.replaced,
        cutting.dirty,
        boundIf(hasPulls, pulls),
        cut.particles,
        program.initialOf("cut.whole_pieces", cutting.pieces),
        cutting.pieces,
        maySleep ? program.initialOf("cut.whole_components", sleep->components) : unbound,
        maySleep ? sleep->components : unbound,
        hasLimits ? program.initialOf("sleep.limits.initial", sleep->limits) : unbound,
        hasLimits ? sleep->limits : unbound};
    for (const Run& run : cut.runs)
        program.dispatch(k::restoreLinks, run.push.count, buffers, run.push,
                         {{hasPullsId, hasPulls}, {maySleepId, maySleep}, {hasLimitsId, hasLimits}});
}

void addSkinRestoring(Build& build, const Cut& cut) {
    const auto changes = changesOf(build, cut);
    if (!changes || !cut.surface) return;
    ProgramBuilder& program = build.program;
    const surface::HungSurface& hung = cut.surface->hung;
    for (const surface::HungRange& range : hung.ranges)
        program.dispatch(k::restoreSkin, range.slots.count,
                         {changes->bodies, changes->changes, program.program().status, hung.slots,
                          hung.hanging, hung.slotFlags, hung.hits, hung.moved, hung.rims, hung.placed},
                         range.slots);
}

void addRestored(Build& build, const Cut& cut) {
    const auto changes = changesOf(build, cut);
    if (!changes) return;
    ProgramBuilder& program = build.program;
    const bool hasSurface = cut.surface != nullptr;
    for (const Run& run : cut.runs)
        program.dispatch(k::closeRestored, run.push.count,
                         {changes->bodies, changes->changes, cut.whole, cut.replaced, cut.buffers.links,
                          cut.buffers.hits, program.program().status, cut.work,
                          hasSurface ? cut.surface->near : unbound},
                         run.push, {{hasSurfaceId, hasSurface}});
}

} // namespace sinew::sim::cutting
