// All trials of one scene: those that are kept already, those that must run, and the timing of those that
// matter.
#pragma once

#include "sinew/study/rest.hpp"

namespace sinew::tools::study {

struct SceneResult {
    std::string name;
    std::size_t particles = 0, constraints = 0;
    std::uint32_t frames = 0;
    double dt = 0;             ///< length of a frame [s]
    Truth truth;               ///< without its frames
    std::vector<Trial> trials; ///< that have run
    bool isOfContacts = false;
    std::vector<RestRun> rest; ///< of contacts, those that have run
    std::vector<std::string>
        notes; ///< sentences: how the scene differs from its file, what could not run, and why
};

/// Runs what is missing and says on stderr how far it is. Trials of all solvers take turns. After an
/// interruption the result holds what has been finished.
SceneResult study(Session& session, const StudyScene& scene, std::uint32_t points, const Store& store);

/// The error of a trial over the frames that chaos leaves comparable; empty = diverged.
struct TrialError {
    double rms = 0, max = 0; ///< by body size
    std::size_t frames = 0;
};
std::optional<TrialError> errorOf(const Trial& trial, const Truth& truth);

} // namespace sinew::tools::study
