// Tests the README's embedding example on a device that the host made, with no optional feature enabled.
#include "embedding/soft_bodies.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

namespace sinew::test {
namespace {

std::string read(const char* file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(Embedding, StepsInAForeignDeviceWithoutAMessage) {
    HostDevice host;
    std::vector<std::array<float, 4>> positions;
    {
        SoftBodies bodies(host.handles());
        const vk::BufferView view = bodies.simulation.positions();
        vk::Buffer readback(bodies.device, {.name = "readback",
                                            .count = view.size / view.stride,
                                            .stride = view.stride,
                                            .kind = vk::MemoryKind::readback});
        for (std::uint64_t frame = 0; frame < 10; ++frame) {
            host.submit([&](VkCommandBuffer commands) { bodies.recordFrame(commands, frame); });
        }
        host.submit([&](VkCommandBuffer buffer) {
            vk::Commands commands(bodies.device, buffer);
            commands.copy(view, readback.view());
            commands.hostBarrier();
        });
        positions.resize(view.size / view.stride);
        std::memcpy(positions.data(), readback.mapped(), view.size);
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
    ASSERT_EQ(positions.size(), 13u * 13 * 13);
    // Ten steps of 1/60 s of free fall from rest, above the floor: -g t^2 / 2 = -0.136 m.
    const float fallen = -0.5f * 9.81f * (10.0f / 60) * (10.0f / 60);
    EXPECT_NEAR(positions.back()[1], std::max(0.24f + fallen, -0.1f), 0.02f);
    EXPECT_GE(positions.front()[1], -0.1f - 1e-5f);
}

TEST(Embedding, PublicStateMayBeBoundAsVertices) {
    HostDevice host;
    const auto bind = reinterpret_cast<PFN_vkCmdBindVertexBuffers>(host.original("vkCmdBindVertexBuffers"));
    {
        SoftBodies bodies(host.handles());
        host.submit([&](VkCommandBuffer commands) {
            bodies.recordFrame(commands, 0);
            for (const vk::BufferView& view : {bodies.simulation.positions(), bodies.simulation.velocities()})
                bind(commands, 0, 1, &view.buffer, &view.offset);
        });
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(Embedding, IsQuotedByTheReadme) {
    const std::string example = read(SINEW_SOURCE_FOLDER "/tests/embedding/soft_bodies.hpp");
    const std::string quoted = example.substr(example.find("\n#include") + 1);
    EXPECT_NE(read(SINEW_SOURCE_FOLDER "/README.md").find("```cpp\n" + quoted + "```\n"), std::string::npos)
        << "README.md must quote tests/embedding/soft_bodies.hpp from its first include on, and nothing else";
}

} // namespace
} // namespace sinew::test
