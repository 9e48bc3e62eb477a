// There are two tables of excluded pairs: that of the uncut bodies, and the current one.
#include "sim/collision/cut_contacts.hpp"

#include "kernels.hpp"

#include <algorithm>

namespace sinew::sim::collision {

namespace {

namespace k = kernels;
using particle_contacts::Contacts;

layout::CutPush pushOf(const CutRun& run) {
    return {.first = run.first,
            .count = run.count,
            .rowStride = run.rowStride,
            .sliceStride = run.sliceStride,
            .stiffLinks = 0,
            .spacing = 0,
            .run = 0};
}

} // namespace

bool canMeet(const StepProgram& program, const Scene& scene) {
    if (program.cutting.links == BufferId{}) return false;
    return std::ranges::any_of(scene.grids, [&](const Grid& grid) {
        return grid.isCuttable && scene.particles[grid.firstParticle].radius > 0;
    });
}

void addToTopology(ProgramBuilder& program, const Contacts& contacts) {
    if (!contacts.isCuttable()) return;
    CuttingBuffers& cutting = program.program().cutting;
    const BufferId seen = contacts.lists.grid.detected;
    if (std::ranges::find(cutting.contactsSeen, seen) == cutting.contactsSeen.end()) // fragments leave it too
        cutting.contactsSeen.push_back(seen);
    cutting.topology.push_back(contacts.lists.excluded);
    program.addToState(contacts.lists.excluded, contacts.lists.excluded);
}

void addContactFilter(ProgramBuilder& program, const Contacts& contacts) {
    if (!contacts.isCuttable()) return;
    const CuttingBuffers cutting = program.program().cutting;
    program.only(When::cut, [&] {
        for (std::uint32_t r = 0; r < cutting.runs.size(); ++r) {
            layout::CutPush push = pushOf(cutting.runs[r]);
            push.run = r;
            program.dispatchIndirect(k::filterExcluded, {cutting.listedArguments, r, push.count},
                                     {cutting.links, cutting.savedLinks, cutting.listedCounts,
                                      contacts.allExcluded, contacts.lists.excluded,
                                      contacts.lists.grid.bounds, cutting.listed},
                                     push);
        }
    });
}

void addContactOpening(ProgramBuilder& program, const Contacts& contacts) {
    if (!contacts.isCuttable()) return;
    const CuttingBuffers cutting = program.program().cutting;
    program.only(When::cut, [&] {
        for (const CutRun& run : cutting.runs)
            program.dispatch(k::recordCutOverlaps, run.count,
                             {cutting.links, cutting.savedLinks, cutting.places,
                              contacts.lists.pooled.contacts, contacts.lists.pooled.ranges,
                              contacts.lists.pooled.memory->memory},
                             pushOf(run));
    });
}

} // namespace sinew::sim::collision
