// Tests of what a host asks for the buffers of outputs: further usages, and queue families that share them.
#include "sim/world_play.hpp"
#include "sinew/ranges.hpp"
#include "sinew/validate.hpp"
#include "sinew/vk/check.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using test::fallingBox;

namespace {

struct Made {
    VkBufferUsageFlags usage = 0;
    VkSharingMode sharing = VK_SHARING_MODE_MAX_ENUM;
    std::vector<std::uint32_t> families{};
};
std::map<VkBuffer, Made> made;
PFN_vkCreateBuffer createOriginal = nullptr;
PFN_vkGetPhysicalDeviceQueueFamilyProperties familiesOriginal = nullptr;

// Makes an unshared buffer: the device may have one family alone.
VKAPI_ATTR VkResult VKAPI_CALL noteBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                          const VkAllocationCallbacks* calls, VkBuffer* buffer) {
    const std::span families(info->pQueueFamilyIndices, info->queueFamilyIndexCount);
    VkBufferCreateInfo unshared = *info;
    unshared.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    const VkResult result = createOriginal(device, &unshared, calls, buffer);
    made[*buffer] = {info->usage, info->sharingMode, {families.begin(), families.end()}};
    return result;
}

// A device with three families.
VKAPI_ATTR void VKAPI_CALL threeFamilies(VkPhysicalDevice device, std::uint32_t* count,
                                         VkQueueFamilyProperties* families) {
    std::uint32_t first = 1;
    VkQueueFamilyProperties properties{};
    familiesOriginal(device, &first, &properties);
    if (families != nullptr) std::fill_n(families, *count, properties);
    *count = 3;
}

void noteBuffersOf(test::HostDevice& host) {
    made.clear();
    createOriginal = reinterpret_cast<PFN_vkCreateBuffer>(host.original("vkCreateBuffer"));
    familiesOriginal = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        host.original("vkGetPhysicalDeviceQueueFamilyProperties"));
    host.replace("vkCreateBuffer", reinterpret_cast<PFN_vkVoidFunction>(&noteBuffer));
    host.replace("vkGetPhysicalDeviceQueueFamilyProperties",
                 reinterpret_cast<PFN_vkVoidFunction>(&threeFamilies));
}

// The buffers of all public views, those of the two steps included that are kept for drawing.
std::set<VkBuffer> outputsOf(const Simulation& simulation) {
    std::set<VkBuffer> buffers;
    const auto add = [&](std::initializer_list<vk::BufferView> views) {
        for (const vk::BufferView& view : views)
            if (view.size > 0) buffers.insert(view.buffer);
    };
    const auto addSurface = [&](const CutSurface& surface) {
        add({surface.vertices, surface.rest, surface.indices, surface.draws, surface.counts,
             surface.particles, surface.textureCoordinates});
    };
    add({simulation.positions(), simulation.velocities(), simulation.previousPositions(),
         simulation.skinVertices(), simulation.previousSkinVertices(), simulation.skinIndices(),
         simulation.drawnSkins().indices, simulation.pieces(), simulation.pieceSizes(),
         simulation.pieceDraws()});
    addSurface(simulation.cutSurface());
    for (const std::uint64_t frame : {0u, 1u}) {
        const Outputs kept = simulation.outputs(frame);
        add({kept.positions, kept.velocities, kept.skinVertices, kept.skinIndices, kept.pieceDraws});
        addSurface(kept.cutSurface);
    }
    return buffers;
}

Settings usedBy(std::uint32_t usage, std::uint32_t families) {
    return {.substeps = 4,
            .keepsPrevious = true,
            .outputFrames = 2,
            .outputUsage = usage,
            .outputFamilies = families};
}

std::string complaintOf(const vk::Device& device, const Settings& settings) {
    try {
        const Simulation simulation(device, fallingBox(), settings);
    } catch (const vk::Error& error) {
        EXPECT_EQ(error.failure(), vk::Failure::misuse);
        return error.what();
    }
    return "none";
}

// Messages of validation where a host binds positions as indices, and indices of skins as vertices.
std::vector<std::string> messagesOfUse(std::uint32_t usage) {
    test::HostDevice host;
    {
        const vk::Device device = vk::Device::borrow(host.handles());
        Simulation simulation(device, fallingBox(), usedBy(usage, 0));
        const auto bindIndices =
            reinterpret_cast<PFN_vkCmdBindIndexBuffer>(host.original("vkCmdBindIndexBuffer"));
        const auto bindVertices =
            reinterpret_cast<PFN_vkCmdBindVertexBuffers>(host.original("vkCmdBindVertexBuffers"));
        host.submit([&](VkCommandBuffer commands) {
            simulation.recordReset(commands);
            simulation.record(commands, {.dt = 1.0f / 60});
            simulation.recordSkin(commands);
            bindIndices(commands, simulation.positions().buffer, 0, VK_INDEX_TYPE_UINT32);
            const VkBuffer indices = simulation.skinIndices().buffer;
            const VkDeviceSize start = 0;
            bindVertices(commands, 0, 1, &indices, &start);
        });
    }
    return host.finish();
}

} // namespace

TEST(OutputUse, IsThatOfEveryOutputAndOfNothingElse) {
    test::HostDevice host;
    noteBuffersOf(host);
    const vk::Device device = vk::Device::borrow(host.handles());
    for (const bool isShared : {false, true}) {
        made.clear();
        // The device's own family may be named.
        const std::uint32_t families =
            isShared ? 1u << 2 | 1u << host.queueFamily() : 1u << host.queueFamily();
        Simulation simulation(device, fallingBox(),
                              usedBy(VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT, families));
        host.submit([&](VkCommandBuffer commands) {
            simulation.recordReset(commands);
            for (const std::uint64_t frame : {0u, 1u}) {
                simulation.record(commands, {.dt = 1.0f / 60, .frame = frame});
                simulation.recordSkin(commands);
            }
        });
        const std::set<VkBuffer> outputs = outputsOf(simulation);
        EXPECT_GE(outputs.size(), 20u);
        for (const auto& [buffer, one] : made) {
            const bool isOutput = outputs.contains(buffer);
            EXPECT_EQ((one.usage & VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT) != 0, isOutput);
            EXPECT_EQ(one.sharing,
                      isOutput && isShared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE);
            EXPECT_EQ(one.families.size(), isOutput && isShared ? 2u : 0u);
            if (!one.families.empty()) {
                EXPECT_EQ(one.families, (std::vector{host.queueFamily(), 2u}));
            }
        }
    }
}

TEST(OutputUse, LetsAHostBindThemWithoutMessages) {
    EXPECT_EQ(messagesOfUse(VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
              std::vector<std::string>{});
    EXPECT_GE(messagesOfUse(0).size(), 2u) << "without these usages the layer must complain";
}

TEST(OutputUse, IsRefusedWithASentenceWhereItCannotBe) {
    const auto complaint = [](std::uint32_t usage) {
        const std::vector<std::string> found = validate(fallingBox(), usedBy(usage, 0));
        return found.empty() ? std::string("none") : found.front();
    };
    EXPECT_EQ(complaint(ranges::outputUsages), "none");
    EXPECT_EQ(complaint(VK_BUFFER_USAGE_CONDITIONAL_RENDERING_BIT_EXT),
              "settings.outputUsage: has bit 9 of VkBufferUsageFlags, must have bits 0 to 8, 17 (device "
              "address) or "
              "19 (input of acceleration structures)");
    test::HostDevice host;
    noteBuffersOf(host);
    {
        const vk::Device device = vk::Device::borrow(host.handles());
        EXPECT_EQ(complaintOf(device, usedBy(0, 1u << 3)),
                  "settings.outputFamilies: bit 3 is set, the device has 3 queue families");
        const std::string address = complaintOf(device, usedBy(VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, 0));
        EXPECT_NE(address.find("a device address needs memory from the host: set a BufferHook"),
                  std::string::npos)
            << address;
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}
