// The report of a run as JSON. docs/report.md describes every field; the schema version changes with their
// meaning.
#pragma once

#include "app/kept_forms.hpp"
#include "scenes/load.hpp"
#include "sim/program/program.hpp"
#include "sinew/measure.hpp"
#include "sinew/pilot.hpp"
#include "sinew/runner.hpp"
#include "sinew/statistics.hpp"

#include <string>

namespace sinew::tools {

inline constexpr int reportSchema = 1;

/// The content of a report. Refers to objects of its maker.
struct RunRecord {
    const scenes::LoadedScene& loaded;
    const sim::StepProgram& program;
    const vk::DeviceDescription& device;
    app::FormSource formSource = app::FormSource::usual; ///< of `loaded`
    std::vector<std::string> phases;
    std::vector<double> phaseMs;
    std::vector<double> frameMs;
    double recordMs = 0;
    std::uint64_t wantedFrames = 0, frames = 0; ///< requested; done with a finite state
    std::optional<Divergence> divergence;
    sim::ContactRoom contactRoom;
    sim::SurfaceRoom surfaceRoom;
    std::uint32_t surfaceMissing = 0; ///< at the end
    std::uint64_t slowed = 0;         ///< see Runner::slowed()
    ListFigures lists;
    CutFigures cuts;
    sim::Impulses forces; ///< in the last step
    bool isInterrupted = false;
    State state;
    SkinMeshes skins;
    bool hasValidation = false;
    std::vector<std::string> validationMessages;
    std::optional<ErrorEstimate> estimate; ///< of pilot runs, if there were any
    bool isForError = false;               ///< the substeps were chosen to reach an error
};

std::string toJson(const RunRecord& record);

/// The choice of substeps and the stiffness that they reach, as text.
std::string stiffnessText(const scenes::LoadedScene& loaded);

/// The error that the substeps buy: the estimate, or how to get one.
std::string errorText(const std::optional<ErrorEstimate>& estimate);

/// The report as a few lines of text.
std::string toText(const RunRecord& record);

} // namespace sinew::tools
