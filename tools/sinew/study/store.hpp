// Finished trials on disk, one file each, so that a study that was stopped goes on where it was and a new
// solver costs only its own runs.
#pragma once

#include "sim/program.hpp"
#include "sinew/study/trial.hpp"

#include <filesystem>

namespace sinew::tools::study {

/// What a trial's result depends on, as one line of JSON: program version, device and driver, scene (a hash
/// of its physics), frames, settings, and a hash of the compiled step, kernels included.
std::string identityOf(const StudyScene& scene, const sim::Settings& settings,
                       const sim::StepProgram& program, const vk::DeviceDescription& device);
/// The same for the truth, in which a device has a part only where it is one of contacts.
std::string identityOfTruth(const StudyScene& scene, const vk::DeviceDescription& device);
std::string identityOfRest(const StudyScene& scene, const sim::Settings& settings,
                           const sim::StepProgram& program, const vk::DeviceDescription& device);

class Store {
public:
    /// Makes the folder. Throws app::Failure (outputFailed) where it cannot.
    explicit Store(std::filesystem::path folder);

    /// Fills in what is known of trial.identity; false where that is nothing. A file that cannot be read, or
    /// is not what it says, counts as nothing.
    bool load(Trial& trial) const;
    /// Throws mesh::ExportError.
    void keep(const Trial& trial) const;

    bool load(RestRun& run) const;
    void keep(const RestRun& run) const;

    /// The truth without its frames.
    std::optional<Truth> loadTruth(const std::string& identity) const;
    void keepTruth(const std::string& identity, const Truth& truth) const;

private:
    std::filesystem::path fileOf(const std::string& identity) const;
    std::filesystem::path folder_;
};

} // namespace sinew::tools::study
