// Whether lavapipe would compute a scene faster without its threads: measured, not predicted.
#pragma once

#include "sinew/scene.hpp"
#include "sinew/vk/device.hpp"

#include <functional>
#include <optional>
#include <string>

namespace sinew::app {

/// Remembers whether the user has set LP_NUM_THREADS, and sets it to what lavapipe would take otherwise, so
/// that a later change of it only swaps a value. Call first in main(), before there are threads. Without this
/// call adviseOnThreads() says nothing.
void prepareThreadAdvice();

/// The shortest times of equal work [ms].
struct ThreadTimes {
    double threaded = 0, single = 0;
};

/// Takes the time of both in turns, several times; each call returns a time [ms].
ThreadTimes compareThreads(const std::function<double()>& threaded, const std::function<double()>& single);

/// A sentence that names the variable, the gain and the measurement; empty if the gain is below a tenth.
std::optional<std::string> threadAdvice(const ThreadTimes& times);

/// The sentence for a scene on `device`, after trial steps of at most 8 substeps on it and on a second device
/// whose driver has no threads, in this process: lavapipe reads LP_NUM_THREADS when an instance is made.
/// Empty if the device is another one, if the user has set the variable, if the scene has more than 50,000
/// particles (a second simulation takes their memory, and threads pay there), if there is no gain, and at
/// every further call in a process. Nothing may be in flight on the device's queue. Throws what
/// sim::Simulation throws.
std::optional<std::string> adviseOnThreads(const vk::Device& device, const sim::Scene& scene,
                                           const sim::Settings& settings);

} // namespace sinew::app
