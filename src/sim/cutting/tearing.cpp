// The buffers and the order of the passes of tearing.
#include "sim/cutting/tearing.hpp"

#include "kernels.hpp"

namespace sinew::sim::cutting {

namespace k = kernels;

std::shared_ptr<Tearing> addTearing(ProgramBuilder& program, const Cut& cut, std::size_t slots) {
    auto tearing = std::make_shared<Tearing>();
    tearing->strains = program.scratch<layout::CellStrain>("tears.strains", slots);
    for (const Run& run : cut.runs) {
        if (run.tearStrain == 0) continue;
        tearing->sheets.push_back({.push = {.first = run.push.first,
                                            .count = run.push.count,
                                            .sliceStride = run.push.sliceStride,
                                            .spacing = run.push.spacing,
                                            .limit = run.tearStrain,
                                            .most = run.tearsPerStep},
                                   .found = program.scratch<std::uint32_t>("tears.found", run.push.count),
                                   .count = program.scratch<layout::TearCount>("tears.count", 1)});
    }
    program.program().cutting.tears = true;
    return tearing;
}

void addTearingPasses(ProgramBuilder& program, const Tearing& tearing, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    for (const TearingSheet& sheet : tearing.sheets) {
        program.fill(sheet.count, 0);
        program.dispatch(k::strainCells, sheet.push.count,
                         {buffers.links, cut.cells, buffers.places, tearing.strains}, sheet.push);
        program.dispatch(k::findTears, sheet.push.count, {tearing.strains, sheet.found, sheet.count},
                         sheet.push);
        program.dispatch(
            k::tearCells, sheet.push.count,
            {buffers.links, buffers.hits, buffers.dirty, tearing.strains, sheet.found, sheet.count},
            sheet.push);
    }
}

} // namespace sinew::sim::cutting
