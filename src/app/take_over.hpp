// Submissions that take the state of one simulation over into another one, for programs that wait for them.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <functional>

namespace sinew::app {

/// Brings states that somebody has saved of `from` over to `to`, which is about to take over. All steps of
/// `from` have finished; `giving` and `taking` are queues of the two devices. All that `to` holds is written
/// over afterwards. Throws nothing.
using Bring = std::function<void(const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
                                 vk::Queue& taking)>;

/// Puts `to` into the state of `from`. `queue` is where all steps of `from` were submitted, on the device of
/// both; waits for it. Throws as Simulation::checkTakeOver, before states are brought and before `to` has
/// changed, and vk::Error.
void takeOver(sim::Simulation& to, const sim::Simulation& from, vk::Queue& queue, const Bring& bring = {});

/// The same by way of host memory, for simulations on two devices. All steps of both have finished. Waits, on
/// queues of its own.
void takeOverByHost(const vk::Device& toDevice, sim::Simulation& to, const vk::Device& fromDevice,
                    const sim::Simulation& from, const Bring& bring = {});

/// Why a simulation stops at `step` for which there can be no room (sim::Rooms::forContacts), and what to do
/// about it.
std::string tooCrowded(std::uint64_t step);

} // namespace sinew::app
