// One line a scene: a key, then the forms, newest first. The key is that of the step program in its usual
// form, since trials depend on nothing else.
#include "app/kept_forms.hpp"

#include "app/driver_threads.hpp"
#include "app/kept_pipelines.hpp"
#include "sim/compile/compile.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/ranges.hpp"

#include <cstdio>
#include <cstdlib>
#include <span>
#include <sstream>

namespace sinew::app {

namespace {

constexpr const char* kind = "forms";

std::string timesKey(const vk::DeviceDescription& device) {
    const char* threads = std::getenv(driverThreadsVariable); // of a software device
    return deviceKey(device) + " " + (threads != nullptr ? threads : "-");
}

std::string nameOf(std::uint64_t scene) {
    char name[20];
    std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(scene));
    return name;
}

} // namespace

const char* toText(FormSource source) {
    constexpr const char* texts[] = {"usual", "given", "measured", "remembered"};
    return texts[static_cast<std::size_t>(source)];
}

std::string toText(const sim::Forms& forms) {
    return "columns=" + std::to_string(forms.columns) + ",chunk=" + std::to_string(forms.chunk) +
           ",texels=" + std::to_string(forms.usesTexels) + ",grids=" + std::to_string(forms.usesGrids) +
           ",resident=" + std::to_string(forms.residentBytes);
}

std::optional<sim::Forms> parseForms(const std::string& text) {
    unsigned texels = 0, grids = 0;
    sim::Forms forms;
    if (std::sscanf(text.c_str(), "columns=%u,chunk=%u,texels=%u,grids=%u,resident=%u", &forms.columns,
                    &forms.chunk, &texels, &grids, &forms.residentBytes) != 5)
        return {};
    forms.usesTexels = texels != 0;
    forms.usesGrids = grids != 0;
    const bool isInRange = forms.columns > 0 && sim::ranges::columns.holds(forms.columns) &&
                           forms.chunk > 0 && sim::ranges::chunk.holds(forms.chunk);
    if (!isInRange || toText(forms) != text) return {};
    return forms;
}

std::optional<sim::Forms> KeptForms::find(std::uint64_t scene) const {
    const std::vector<std::byte> bytes = cache_.find(kind, device_);
    std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    const std::string wanted = nameOf(scene);
    for (std::string name, forms; lines >> name >> forms;)
        if (name == wanted) return parseForms(forms);
    return {};
}

std::string KeptForms::linesWithout(std::uint64_t scene, std::size_t count) const {
    const std::vector<std::byte> bytes = cache_.find(kind, device_);
    std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    const std::string left = nameOf(scene);
    std::string all;
    for (std::string name, forms; count > 0 && lines >> name >> forms;) {
        if (name == left) continue;
        all += name + " " + forms + "\n";
        --count;
    }
    return all;
}

void KeptForms::keep(std::uint64_t scene, const sim::Forms& forms) const {
    const std::string lines = nameOf(scene) + " " + toText(forms) + "\n" + linesWithout(scene, most - 1);
    cache_.keep(kind, device_, std::as_bytes(std::span(lines)));
}

FormChoice chooseForms(const vk::Device& device, vk::Queue& queue, const sim::Scene& scene,
                       const sim::Settings& settings, const UserCache& cache) {
    const std::uint64_t key = sim::keyOf(sim::compileFor(device, scene, settings));
    const KeptForms kept(cache, timesKey(device.description()));
    if (const auto forms = kept.find(key)) return {*forms, FormSource::remembered};
    const auto submit = [&](const std::function<void(VkCommandBuffer)>& record) {
        const VkCommandBuffer commands = queue.begin();
        return sim::timed(device, commands, record, [&] { queue.wait(queue.submit(commands)); });
    };
    const sim::Tuning tuning = sim::tune(device, scene, settings, submit);
    if (tuning.trials.empty()) return {tuning.fastest, FormSource::usual};
    kept.keep(key, tuning.fastest);
    return {tuning.fastest, FormSource::measured};
}

} // namespace sinew::app
