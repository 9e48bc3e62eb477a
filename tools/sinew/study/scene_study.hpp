// All trials of one scene: loads stored ones, runs the missing ones, and times those on the fronts.
#pragma once

#include "sinew/study/rest.hpp"

namespace sinew::tools::study {

struct SceneResult {
    std::string name;
    std::size_t particles = 0, constraints = 0;
    std::uint32_t frames = 0;
    double dt = 0;             ///< length of a frame [s]
    Truth truth;               ///< without its frames
    std::vector<Trial> trials; ///< trials that have run
    bool isOfContacts = false;
    std::vector<RestRun> rest; ///< runs to rest that have run, for scenes of contacts
    std::vector<std::string>
        notes; ///< sentences: how the scene differs from its file, which trials could not run, and why
};

/// Runs missing trials of a part and prints progress on stderr. Trials of all solvers take turns. After an
/// interruption the result holds what has finished. A trial on the front of all is on that of its part, so
/// that parts leave nothing to time.
SceneResult study(Session& session, const StudyScene& scene, std::uint32_t points, const Store& store,
                  const Shard& shard = {});

/// The error of a trial over the frames before chaos; empty = diverged.
struct TrialError {
    double rms = 0, max = 0; ///< by body size
    std::optional<double>
        ofMotion; ///< rms by that of a body that stays where it started; empty if none moves
    std::size_t frames = 0;
};
std::optional<TrialError> errorOf(const Trial& trial, const Truth& truth);

} // namespace sinew::tools::study
