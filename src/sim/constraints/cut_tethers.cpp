// Labels of pieces are their lowest slots.
#include "sim/constraints/cut_tethers.hpp"

#include "kernels.hpp"
#include "sim/program/first_contents.hpp"

#include <algorithm>

namespace sinew::sim::constraints {

void addTetherFilter(ProgramBuilder& program, BufferId list, std::span<const ListedTether> tethers) {
    CuttingBuffers& cutting = program.program().cutting;
    if (cutting.runs.empty()) return;
    const auto labels = firstContents<std::uint32_t>(program, cutting.labels); // of uncut bodies
    const auto mayBeCut = [&](std::uint32_t slot) {
        return std::ranges::any_of(cutting.runs, [&](const CutRun& run) {
            return slot >= run.first && slot - run.first < run.count;
        });
    };
    std::vector<layout::CutTether> parted;
    for (std::uint32_t t = 0; t < tethers.size(); ++t) {
        const auto& [particle, anchor, reach] = tethers[t];
        if (mayBeCut(particle) && mayBeCut(anchor) && labels[particle] == labels[anchor])
            parted.push_back({t, particle, anchor, reach});
    }
    if (parted.empty()) return;
    cutting.topology.push_back(list);
    program.addToState(list, list);
    const BufferId uploaded = program.upload("cut.tethers", parted);
    program.atEnd([&program, uploaded, list, count = static_cast<std::uint32_t>(parted.size())] {
        program.only(When::cut, [&] {
            program.dispatch(kernels::disableCutTethers, count,
                             {program.program().cutting.labels, uploaded, list}, layout::CountPush{count});
        });
    });
}

} // namespace sinew::sim::constraints
