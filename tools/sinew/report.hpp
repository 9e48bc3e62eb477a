// The report of a run as JSON. docs/report.md describes every field; its schema version changes with their
// meaning.
#pragma once

#include "scenes/load.hpp"
#include "sim/program.hpp"
#include "sinew/measure.hpp"
#include "sinew/runner.hpp"
#include "sinew/statistics.hpp"

#include <string>

namespace sinew::tools {

inline constexpr int reportSchema = 1;

/// Everything a report is made of. Refers to what its maker owns.
struct RunRecord {
    const scenes::LoadedScene& loaded;
    const sim::StepProgram& program;
    const vk::DeviceDescription& device;
    std::vector<std::string> phases;
    std::vector<double> phaseMs;
    std::vector<double> frameMs;
    double recordMs = 0;
    std::uint64_t wantedFrames = 0, frames = 0; ///< asked for; done with a finite state
    std::optional<Divergence> divergence;
    app::ContactRoom contactRoom;
    app::SurfaceRoom surfaceRoom;
    std::uint32_t surfaceMissing = 0; ///< at the end
    std::uint64_t slowed = 0;         ///< as Runner::slowed()
    ListFigures lists;
    CutFigures cuts;
    sim::Impulses forces; ///< of the last step
    bool isInterrupted = false;
    State state;
    SkinMeshes skins;
    bool hasValidation = false;
    std::vector<std::string> validationMessages;
};

std::string toJson(const RunRecord& record);

/// Why so many substeps, and what stiffness they reach; for people.
std::string stiffnessText(const scenes::LoadedScene& loaded);

/// A few lines for people.
std::string toText(const RunRecord& record);

} // namespace sinew::tools
