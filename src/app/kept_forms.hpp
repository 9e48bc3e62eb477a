// Kernel forms of scenes that were measured as fastest, kept between runs in the user's cache folder for each
// device, version of its driver and set of kernels.
#pragma once

#include "app/user_cache.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace sinew::app {

/// How the forms of a run were chosen.
enum class FormSource { usual, given, measured, remembered };
const char* toText(FormSource source);

/// Forms by scene, at most `most`; the one kept longest ago goes first.
class KeptForms {
public:
    static constexpr std::size_t most = 256;

    /// `device`: key of the device (deviceKey()), and whatever else changes times.
    KeptForms(const UserCache& cache, std::string device) : cache_(cache), device_(std::move(device)) {}

    std::optional<sim::Forms> find(std::uint64_t scene) const;
    void keep(std::uint64_t scene, const sim::Forms& forms) const;

private:
    std::string linesWithout(std::uint64_t scene, std::size_t count) const;
    const UserCache& cache_;
    std::string device_;
};

struct FormChoice {
    sim::Forms forms;
    FormSource source = FormSource::usual;
};

/// The forms kept for this scene, solver and device; else those that sim::tuned() measures, which are then
/// kept. `usual` where there is no choice. Nothing may be in flight on `queue`. Throws what sim::tune()
/// throws.
FormChoice chooseForms(const vk::Device& device, vk::Queue& queue, const sim::Scene& scene,
                       const sim::Settings& settings, const UserCache& cache = {});

/// "columns=1,chunk=1,texels=0,grids=1,resident=0", as `sinew run --forms` takes it.
std::string toText(const sim::Forms& forms);
/// Reads toText(); empty if it is not such a text, or a value is out of its range.
std::optional<sim::Forms> parseForms(const std::string& text);

} // namespace sinew::app
