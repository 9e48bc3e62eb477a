// `sinew devices`: the devices, what each lacks, and the one that would be used and why.
#include "app/guard.hpp"
#include "sinew/commands.hpp"
#include "sinew/outputs.hpp"
#include "sinew/vk/device.hpp"
#include "sinew/vk/loader.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace sinew::tools {

namespace {

using vk::DeviceDescription;

std::string version(std::uint32_t api) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(api), VK_API_VERSION_MINOR(api),
                       VK_API_VERSION_PATCH(api));
}

std::string row(const DeviceDescription& device) {
    std::string text = fmt::format("{} {:>3}  {:<15} {:<9} {}", device.isChosen ? "*" : " ", device.index,
                                   device.type, version(device.apiVersion), device.name);
    if (!device.driver.empty()) text += " (" + device.driver + ")";
    text += "\n";
    if (device.storageBuffers < vk::mostStorageBuffers)
        text += fmt::format("        a kernel can bind {} storage buffers: scenes that need more, up to {}, "
                            "are refused\n",
                            device.storageBuffers, vk::mostStorageBuffers);
    for (const std::string& missing : device.missing) text += "        missing: " + missing + "\n";
    return text;
}

std::string reason(const DeviceDescription& chosen, const std::string& wanted) {
    if (!wanted.empty()) return "--device " + wanted + " matches it";
    if (chosen.type == "software")
        return "no GPU has all that is needed; a software device computes on the CPU";
    return "GPUs come before software devices, discrete ones first";
}

std::string listing(const std::vector<DeviceDescription>& devices, const std::string& wanted) {
    std::string text = "  index  type          Vulkan    name (driver)\n";
    for (const DeviceDescription& device : devices) text += row(device);
    const auto chosen = std::ranges::find(devices, true, &DeviceDescription::isChosen);
    if (chosen != devices.end()) text += fmt::format("\n* would be used: {}.\n", reason(*chosen, wanted));
    const bool hasLavapipe = std::ranges::any_of(devices, [](const DeviceDescription& device) {
        return device.name.find("llvmpipe") != std::string::npos;
    });
    if (hasLavapipe)
        text += "\nllvmpipe (lavapipe) runs small scenes faster without helper threads: LP_NUM_THREADS=0 "
                "sinew run "
                "...\n`sinew run` and the viewer measure it and say so.\n";
    return text;
}

int list(const std::string& wanted) {
    const vk::Loader loader;
    const auto devices = vk::listDevices(loader.getInstanceProcAddr(), {.device = wanted});
    TextOutput("-").write(listing(devices, wanted));
    if (std::ranges::any_of(devices, &DeviceDescription::isChosen)) return app::done;
    throw app::Failure(app::noDevice, wanted.empty()
                                          ? "no usable device: see the list: install a Vulkan 1.2 driver"
                                          : "no usable device: --device " + wanted +
                                                ": matches no usable device of the list: use another");
}

} // namespace

void addDevices(CLI::App& app, Chosen& chosen) {
    CLI::App& command =
        *app.add_subcommand("devices", "list Vulkan devices, what each lacks, and which one would be used");
    const auto wanted = std::make_shared<std::string>();
    command.add_option("--device", *wanted, "show what this index or part of a name would choose");
    command.callback([wanted, &chosen] { chosen = [wanted] { return list(*wanted); }; });
}

} // namespace sinew::tools
