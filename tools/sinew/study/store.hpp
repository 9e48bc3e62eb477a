// Finished trials on disk, one file each, so that an interrupted study continues, and a new solver costs only
// its own runs.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/study/trial.hpp"

#include <filesystem>

namespace sinew::tools::study {

/// Everything that a trial's result depends on, as one line of JSON: program version, device and driver,
/// scene (a hash of its physics), frames, settings, and a hash of the compiled step, kernels included.
std::string identityOf(const StudyScene& scene, const sim::Settings& settings,
                       const sim::StepProgram& program, const vk::DeviceDescription& device);
/// Identity of the truth; includes the device only for scenes of contacts.
std::string identityOfTruth(const StudyScene& scene, const vk::DeviceDescription& device);
std::string identityOfRest(const StudyScene& scene, const sim::Settings& settings,
                           const sim::StepProgram& program, const vk::DeviceDescription& device);

class Store {
public:
    /// Creates the folder. Throws app::Failure (outputFailed) on failure.
    explicit Store(std::filesystem::path folder);

    /// Copies the files of another store that this one lacks. Throws app::Failure if there is no such folder
    /// (badInput) or a copy fails.
    void merge(const std::filesystem::path& folder) const;

    /// Fills in the stored result for trial.identity; false if there is none. Ignores an unreadable file, or
    /// one with another identity.
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
