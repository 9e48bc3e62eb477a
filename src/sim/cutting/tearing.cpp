// The buffers of tearing, and the order of its passes.
#include "sim/cutting/tearing.hpp"

#include "kernels.hpp"

namespace sinew::sim::cutting {

namespace k = kernels;

constexpr std::uint32_t hasDebrisId = 1; // constant_id in find_tears.comp

std::shared_ptr<Tearing> addTearing(ProgramBuilder& program, const Cut& cut, std::size_t slots) {
    auto tearing = std::make_shared<Tearing>();
    tearing->strains = program.scratch<layout::CellStrain>("tears.strains", slots);
    for (const Run& run : cut.runs) {
        if (run.tearStrain == 0) continue;
        tearing->bodies.push_back({.push = {.first = run.push.first,
                                            .count = run.push.count,
                                            .rowStride = run.push.rowStride,
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

namespace {

void addFinding(ProgramBuilder& program, const Tearing& tearing, const TearingBody& body, const Cut& cut) {
    const bool hasDebris = program.program().cutting.debris > 0;
    program.dispatch(k::findTears, body.push.count,
                     {tearing.strains, body.found, body.count, boundIf(hasDebris, cut.particles),
                      boundIf(hasDebris, cut.buffers.pieces)},
                     body.push, {{hasDebrisId, hasDebris}});
}

} // namespace

void addTearingPasses(ProgramBuilder& program, const Tearing& tearing, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    for (const TearingBody& body : tearing.bodies) {
        const bool isSheet = body.push.rowStride == 0;
        program.fill(body.count, 0);
        program.dispatch(isSheet ? k::strainCells : k::strainVoxels, body.push.count,
                         {buffers.links, cut.cells, buffers.places, tearing.strains}, body.push);
        addFinding(program, tearing, body, cut);
        program.dispatch(
            isSheet ? k::tearCells : k::tearVoxels, body.push.count,
            {buffers.links, buffers.hits, buffers.dirty, tearing.strains, body.found, body.count}, body.push);
    }
}

} // namespace sinew::sim::cutting
