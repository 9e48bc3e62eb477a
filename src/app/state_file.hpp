// A simulation between two steps as a file, to go on from in another run.
#pragma once

#include "sinew/material.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <filesystem>
#include <optional>

namespace sinew::app {

/// From where it was looked at.
struct SavedView {
    sim::Vec3 target;      ///< that the eye turns around [m]
    float distance = 0;    ///< of the eye [m]
    float azimuth = 0;     ///< likewise, around y, 0 = on the +z side [rad]
    float elevation = 0;   ///< likewise, above the target's level [rad]
    float fieldOfView = 0; ///< vertical [rad]
};

/// What is saved: how to come to an equal simulation, and its state.
struct SavedRun {
    std::string scene;                 ///< file, absolute; or the name of a built-in one
    sim::Settings settings;            ///< solver, substeps, rooms and completed forms alone
    std::uint64_t key = 0;             ///< sim::Simulation::stateKey()
    std::uint64_t played = 0;          ///< steps of the time in which blades cut by themselves
    sim::Material material;            ///< that the scene was turned to
    sim::Vec3 gravity;                 ///< likewise [m/s^2]
    std::optional<bool> hasSharpClamp; ///< of `settings`; empty: not known, as in files of older versions
    sim::SavedState host;
    std::vector<std::byte> bytes;  ///< sim::Simulation::stateSize()
    std::optional<SavedView> view; ///< nothing: not known, as in files of older versions
    std::uint64_t fileHash = 0;    ///< of all that the file has that it was read from
};

/// The state of a simulation of `settings` whose steps have all been submitted to `queue`; waits for that.
/// The caller fills in the members before `host`, but for settings and key, and those after `bytes`.
/// Throws vk::Error.
SavedRun saveRun(const vk::Device& device, const sim::Simulation& simulation, const sim::Settings& settings,
                 vk::Queue& queue);

/// Puts a simulation of the same scene, settings and material into that state, instead of
/// Simulation::recordReset(). `queue` as above. Throws Failure (badInput) where the state is of another
/// simulation, and vk::Error.
void loadRun(const vk::Device& device, sim::Simulation& simulation, const SavedRun& run, vk::Queue& queue);

/// `settings` of the scene as the state was saved with.
sim::Settings withRun(sim::Settings settings, const SavedRun& run);

/// Gives `settings` room for grabs and one host collider, which a window needs. A state fits simulations with
/// the same room only, so programs that write states for each other all call this.
void addRoomForUser(sim::Settings& settings);

/// As mesh::writeWhole.
void writeRun(const std::filesystem::path& file, const SavedRun& run);

/// Throws Failure (badInput) where there is no such file, it is none of ours, cut short or changed.
SavedRun readRun(const std::filesystem::path& file);

/// What such files are called: ".state".
bool isRunFile(const std::filesystem::path& file);

} // namespace sinew::app
