// The buffers of cuttable bodies, and their contents for uncut bodies.
#pragma once

#include "common/layout.h"
#include "sim/cutting/debris_skins.hpp"
#include "sim/model/scene_model.hpp"

#include <array>

namespace sinew::sim::surface {
struct CutSurface;
struct SheetPieces;
} // namespace sinew::sim::surface

namespace sinew::sim::cutting {

/// A CutRun, with further parameters of its passes.
struct Run {
    layout::CutPush push{};
    bool hasVolumes = false;
    float tearStrain = 0;
    std::uint32_t tearsPerStep = 0;
};

struct Tearing;

struct Cut {
    std::vector<Run> runs;
    CuttingBuffers buffers;
    BufferId cells, placesBefore, blade, points, work;
    BufferId nears, nearCounts, nearArguments; // nodes near the blade, in the form of CuttingBuffers::listed
    BufferId bladePlaces;                      // by slot: positions for the blade, mostly buffers.places
    BufferId labels, particles, arguments, groups; // of pieces
    std::array<BufferId, 2> roundArguments; // of even and of odd rounds, by run: no pass writes its own
    BufferId uncutBodies, weights;          // of pieces, if grabs may hold some
    BufferId debrisParticles;               // layout::DebrisParticle; if fragments are removed
    BufferId whole, replaced; // by slot, if bodies that may be absent may be cut: links of the uncut bodies;
                              // layout::ReplacedNode
    DebrisSkins debrisSkins;
    std::shared_ptr<surface::CutSurface> surface; // null if no skin is clipped
    std::shared_ptr<surface::SheetPieces> sheets; // null if there are none
    std::shared_ptr<Tearing> tearing;             // null if nothing tears
    std::uint32_t rounds = 0;
};

/// Work groups of an indirect dispatch over so many items, at least one.
inline std::uint32_t groupsOf(std::uint32_t items) {
    return (items - 1) / GROUP_ITEMS + 1;
}

/// Items of a run's kernels that process a chunk of slots each.
inline std::uint32_t chunksOf(const Run& run) {
    return (run.push.count - 1) / PIECE_CHUNK + 1;
}

/// Words of a bit field with a bit for each of its slots.
inline std::uint32_t wordsOf(const Run& run) {
    return (run.push.first + run.push.count - 1) / 32 - run.push.first / 32 + 1;
}

/// Returns no runs if no body of the scene is cuttable.
Cut addBuffers(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles);

} // namespace sinew::sim::cutting
