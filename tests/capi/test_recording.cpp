// The C interface on a device of a host: the same bits as by the C++ interface, through command buffers of
// the host.
#include "capi/host_handles.hpp"
#include "capi/support.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/sinew_motions.h"
#include "sinew/sinew_query.h"

#include <cstring>
#include <functional>
#include <limits>

namespace sinew::test {
namespace {

// Buffers of the host, each with memory of its own that is mapped.
struct HostBuffers {
    explicit HostBuffers(HostDevice& itsHost) : host(itsHost) {}
    HostDevice& host;
    std::size_t made = 0, freed = 0, refuseFrom = ~std::size_t{0};

    static SinewResult create(void* user, const VkBufferCreateInfo* info, uint32_t, const char* name,
                              SinewBuffer* buffer) {
        auto& self = *static_cast<HostBuffers*>(user);
        if (self.made == self.refuseFrom || name == nullptr) return SINEW_ERROR_OUT_OF_MEMORY;
        ++self.made;
        const vk::DeviceFunctions& functions = self.host.functions();
        const VkDevice device = self.host.handles().device;
        VkMemoryRequirements need;
        if (functions.vkCreateBuffer(device, info, nullptr, &buffer->buffer) < 0)
            return SINEW_ERROR_OUT_OF_MEMORY;
        functions.vkGetBufferMemoryRequirements(device, buffer->buffer, &need);
        const VkMemoryAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                              .allocationSize = need.size,
                                              .memoryTypeIndex = 0}; // lavapipe has one type
        VkDeviceMemory memory = VK_NULL_HANDLE;
        if (functions.vkAllocateMemory(device, &allocation, nullptr, &memory) < 0)
            return SINEW_ERROR_OUT_OF_MEMORY;
        functions.vkBindBufferMemory(device, buffer->buffer, memory, 0);
        functions.vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &buffer->mapped);
        buffer->token = vk::handleValue(memory);
        return SINEW_OK;
    }
    static void destroy(void* user, const SinewBuffer* buffer) {
        auto& self = *static_cast<HostBuffers*>(user);
        ++self.freed;
        const VkDevice device = self.host.handles().device;
        self.host.functions().vkDestroyBuffer(device, buffer->buffer, nullptr);
        self.host.functions().vkFreeMemory(device, reinterpret_cast<VkDeviceMemory>(buffer->token), nullptr);
    }
};

using Positions = std::vector<std::array<float, 4>>;

// Reads a view through a buffer of the host.
Positions read(HostDevice& host, const SinewBufferView& view) {
    const vk::Device device = vk::Device::borrow(host.handles());
    const vk::Buffer copy(
        device,
        {.name = "readback", .count = view.size / 16, .stride = 16, .kind = vk::MemoryKind::readback});
    host.submit([&](VkCommandBuffer buffer) {
        vk::Commands commands(device, buffer);
        commands.copy({view.buffer, view.offset, view.size, view.stride}, copy.view());
        commands.hostBarrier();
    });
    Positions elements(view.size / 16);
    std::memcpy(elements.data(), copy.mapped(), elements.size() * 16);
    return elements;
}

Positions positionsOf(HostDevice& host, SinewSimulation simulation) {
    SinewBufferView view{};
    EXPECT_TRUE(isOk(sinewGetView(simulation, SINEW_POSITIONS, &view)));
    return read(host, view);
}

// A cuttable cube that is grabbed, pushed, blown at and cut, described twice.
struct Example {
    sim::Scene scene;
    sim::Settings settings{.substeps = 8, .grabs = 1, .hostColliders = 1, .fields = 1, .motions = 1};
    Example() {
        sim::Lattice lattice{.name = "cube", .origin = {0, 0.2f, 0}, .cells = {3, 3, 3}, .isCuttable = true};
        const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
        sim::addLatticeSkin(scene, lattice, corners, {0.78f, 0.36f, 0.32f});
        scene.planes.push_back({});
        scene.attachments.push_back({.particle = 0, .anchor = {0, 0.2f, 0}, .compliance = 1e-3f});
    }
    static constexpr std::array<sim::Vec3, 2> bladeFrom{{{0.15f, -1, -1}, {0.15f, -1, 1}}},
        bladeTo{{{0.15f, 1, -1}, {0.15f, 1, 1}}};
};

void makeExample(Scene& scene) {
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    SinewLattice lattice = sinewDefaultLattice();
    lattice.name = "cube";
    lattice.origin.y = 0.2f;
    lattice.cells[0] = lattice.cells[1] = lattice.cells[2] = 3;
    lattice.isCuttable = 1;
    lattice.hasSkin = 1;
    ASSERT_TRUE(isOk(sinewAddLattice(scene, &lattice, nullptr)));
    const SinewPlane plane = sinewDefaultPlane();
    ASSERT_TRUE(isOk(sinewAddPlane(scene, &plane)));
    const SinewAttachment attachment{.particle = 0, .anchor = {0, 0.2f, 0}, .compliance = 1e-3f};
    ASSERT_TRUE(isOk(sinewAddAttachments(scene, 1, &attachment, nullptr)));
}

SinewSettings exampleSettings() {
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 8;
    settings.grabs = settings.hostColliders = settings.fields = settings.motions = 1;
    return settings;
}

constexpr std::uint64_t steps = 12, cutAt = 5;

Positions runByCpp(HostDevice& host) {
    const vk::Device device = vk::Device::borrow(host.handles());
    const Example example;
    sim::Simulation simulation(device, example.scene, example.settings);
    for (std::uint64_t frame = 0; frame < steps; ++frame)
        host.submit([&](VkCommandBuffer commands) {
            const std::array anchors{sim::Vec3{0.1f, 0.3f, 0}};
            const std::array grabs{sim::Grab{.particle = 63, .radius = 0.1f, .target = {0.5f, 0.8f, 0.5f}}};
            const std::array colliders{sim::HostCollider{.shape = sim::ColliderShape::box,
                                                         .halfExtents = {0.1f, 0.1f, 0.1f},
                                                         .pose = {.position = {0.4f, 0.1f, 0.1f}}}};
            const std::array fields{
                sim::ForceField{.kind = sim::FieldKind::wind, .vector = {2, 0, 0}, .strength = 0.6f}};
            const std::array motions{sim::Motion{.kind = sim::MotionKind::impulse,
                                                 .body = 0,
                                                 .center = {0.3f, 0.5f, 0.3f},
                                                 .radius = 0.2f,
                                                 .linear = {1, 0, 0},
                                                 .angular = {0, 0.1f, 0}}};
            sim::Step step{.dt = 0.01f,
                           .gravity = {0, -5, 0},
                           .frame = frame,
                           .anchors = anchors,
                           .grabs = grabs,
                           .hostColliders = colliders,
                           .fields = fields,
                           .motions = motions};
            if (frame == cutAt) step.blade = {.from = Example::bladeFrom, .to = Example::bladeTo};
            if (frame == 0) simulation.recordReset(commands);
            simulation.record(commands, step);
        });
    EXPECT_GT(simulation.status(steps - 1).linksCutInAll, 0u);
    const vk::BufferView view = simulation.positions();
    return read(host,
                {.buffer = view.buffer, .offset = view.offset, .size = view.size, .stride = view.stride});
}

// Records the same steps by the C interface, frames from `first` on.
void stepByC(HostDevice& host, SinewSimulation simulation, std::uint64_t first, std::uint64_t end) {
    for (std::uint64_t frame = first; frame < end; ++frame)
        host.submit([&](VkCommandBuffer commands) {
            const SinewVec3 anchor{0.1f, 0.3f, 0};
            SinewGrab grab = sinewDefaultGrab();
            grab.particle = 63;
            grab.radius = 0.1f;
            grab.target = {0.5f, 0.8f, 0.5f};
            SinewHostCollider collider = sinewDefaultHostCollider();
            collider.shape = SINEW_BOX;
            collider.halfExtents = {0.1f, 0.1f, 0.1f};
            collider.pose.position = {0.4f, 0.1f, 0.1f};
            SinewField field = sinewDefaultField();
            field.kind = SINEW_FIELD_WIND;
            field.vector = {2, 0, 0};
            field.strength = 0.6f;
            SinewMotion motion = sinewDefaultMotion();
            motion.kind = SINEW_MOTION_IMPULSE;
            motion.body = 0;
            motion.center = {0.3f, 0.5f, 0.3f};
            motion.radius = 0.2f;
            motion.linear.x = 1;
            motion.angular.y = 0.1f;
            const SinewVec3 from[] = {{0.15f, -1, -1}, {0.15f, -1, 1}},
                            to[] = {{0.15f, 1, -1}, {0.15f, 1, 1}};
            SinewStep step = sinewDefaultStep();
            step.dt = 0.01f;
            step.gravity = {0, -5, 0};
            step.frame = frame;
            step.anchors = &anchor;
            step.grabs = &grab;
            step.hostColliders = &collider;
            step.fields = &field;
            step.anchorCount = step.grabCount = step.hostColliderCount = step.fieldCount = 1;
            step.motions = &motion;
            step.motionCount = 1;
            step.bladeFrom = from;
            step.bladeTo = to;
            step.bladeCount = frame == cutAt ? 2 : 0;
            EXPECT_TRUE(isOk(sinewRecordStep(simulation, commands, &step)));
        });
}

void reset(HostDevice& host, SinewSimulation simulation) {
    host.submit([&](VkCommandBuffer commands) { EXPECT_TRUE(isOk(sinewRecordReset(simulation, commands))); });
}

// A motion without effect is refused with a sentence, and nothing is recorded.
void expectFaults(HostDevice& host, SinewSimulation simulation) {
    SinewMotion none = sinewDefaultMotion();
    none.body = 0;
    std::array<SinewMotion, 4> motions{none, none, none, none};
    motions[0].kind = 9;
    motions[1].body = 1;
    motions[2].radius = -1;
    motions[3].linear.y = std::numeric_limits<float>::quiet_NaN();
    const char* sentences[] = {"motion 0 is of no known kind", "motion 0 is of a body that does not exist",
                               "motion 0 has a radius", "motion 0 has a number that is not finite"};
    for (std::size_t m = 0; m < motions.size(); ++m)
        host.submit([&](VkCommandBuffer commands) {
            SinewStep step = sinewDefaultStep();
            step.frame = steps;
            step.motions = &motions[m];
            step.motionCount = 1;
            EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, sentences[m],
                                  sinewRecordStep(simulation, commands, &step)));
            step.motions = nullptr;
            EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "motions",
                                  sinewRecordStep(simulation, commands, &step)));
        });
}

// 256 spheres push 256 particles in a row, each its own.
TEST(CApiRecording, TakesAsManyHostCollidersAsAskedFor) {
    constexpr std::uint32_t many = 256;
    HostDevice host;
    const SinewHostDevice handles = handlesOf(host);
    Device device;
    ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    std::vector<SinewParticle> particles(many, SinewParticle{.inverseMass = 1});
    std::vector<SinewHostCollider> colliders(many + 1, sinewDefaultHostCollider());
    for (std::uint32_t c = 0; c < many; ++c) {
        particles[c].position = {0, static_cast<float>(c), 0};
        colliders[c].radius = 0.1f;
    }
    ASSERT_TRUE(isOk(sinewAddParticles(scene, many, particles.data(), nullptr)));
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 4;
    settings.hostColliders = many;
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    reset(host, simulation);
    for (std::uint64_t frame = 0; frame < 10; ++frame)
        host.submit([&](VkCommandBuffer commands) {
            for (std::uint32_t c = 0; c < many; ++c)
                colliders[c].pose.position = {-0.2f + 0.02f * static_cast<float>(frame),
                                              static_cast<float>(c), 0};
            SinewStep step = sinewDefaultStep();
            step.gravity = {};
            step.frame = frame;
            step.hostColliders = colliders.data();
            step.hostColliderCount = frame == 9 ? many + 1 : many;
            EXPECT_TRUE(isOk(sinewRecordStep(simulation, commands, &step)));
        });
    const Positions positions = positionsOf(host, simulation);
    for (std::uint32_t c = 0; c < many; ++c) EXPECT_NEAR(double{positions[c][0]}, 0.08, 1e-4) << c;
    const char* complaint = nullptr;
    ASSERT_TRUE(isOk(sinewNextComplaint(simulation, &complaint)));
    EXPECT_NE(std::string(complaint).find("257 host colliders"), std::string::npos) << complaint;
}

TEST(CApiRecording, GivesTheBitsOfTheCppInterface) {
    HostDevice host;
    const Positions expected = runByCpp(host);
    {
        HostBuffers buffers(host);
        SinewHostDevice handles = handlesOf(host);
        handles.createBuffer = &HostBuffers::create;
        handles.destroyBuffer = &HostBuffers::destroy;
        handles.bufferUser = &buffers;
        {
            Device device;
            ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
            Scene scene;
            makeExample(scene);
            const SinewSettings settings = exampleSettings();
            Simulation simulation;
            buffers.refuseFrom = 5;
            EXPECT_TRUE(failsWith(SINEW_ERROR_OUT_OF_MEMORY, "the host's hook",
                                  sinewCreateSimulation(device, scene, &settings, &simulation)));
            EXPECT_EQ(buffers.freed, buffers.made);
            buffers.refuseFrom = ~std::size_t{0};
            ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
            reset(host, simulation);
            stepByC(host, simulation, 0, steps);
            EXPECT_EQ(positionsOf(host, simulation), expected);

            SinewStatus status{};
            status.size = sizeof status;
            ASSERT_TRUE(isOk(sinewGetStatus(simulation, steps - 1, &status)));
            EXPECT_GT(status.linksCutInAll, 0u);
            EXPECT_EQ(status.pieces, 2u);
            EXPECT_EQ(sinewGetStatus(simulation, 0, &status), SINEW_NOT_READY); // too old
            expectFaults(host, simulation);
            host.submit(
                [&](VkCommandBuffer commands) { EXPECT_TRUE(isOk(sinewRecordSkin(simulation, commands))); });
            SinewSkin skin{};
            skin.size = sizeof skin;
            ASSERT_TRUE(isOk(sinewGetSkin(simulation, 0, &skin)));
            EXPECT_EQ(skin.indexCount, 3u * 2 * 6 * 9);
            EXPECT_EQ(sinewGetSkin(simulation, 1, &skin), SINEW_END);
            for (std::uint32_t output = SINEW_POSITIONS; output < SINEW_FORCE_SUMS; ++output) {
                SinewBufferView view{};
                EXPECT_TRUE(isOk(sinewGetView(simulation, output, &view)));
                EXPECT_EQ(view.size > 0, output != SINEW_PIECE_DRAWS) << output; // those of sheets
            }
            SinewBufferView none{};
            EXPECT_TRUE(
                failsWith(SINEW_ERROR_INVALID_ARGUMENT, "output 16", sinewGetView(simulation, 16, &none)));
            const char* complaint = nullptr;
            EXPECT_EQ(sinewNextComplaint(simulation, &complaint), SINEW_END) << complaint;
        }
        EXPECT_EQ(buffers.freed, buffers.made);
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(CApiRecording, SavedStatesAndTakeOverContinueWithTheSameBits) {
    HostDevice host;
    const Positions expected = runByCpp(host);
    {
        const SinewHostDevice handles = handlesOf(host);
        Device device;
        ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
        Scene scene;
        makeExample(scene);
        SinewSettings settings = exampleSettings();
        Simulation first, second;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &first)));
        settings.contactRoom = 16;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &second)));
        reset(host, first);
        stepByC(host, first, 0, 8);
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(isOk(sinewRecordTakeOver(second, commands, first)));
            EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "itself",
                                  sinewRecordTakeOver(first, commands, first)));
        });
        stepByC(host, second, 8, steps);
        EXPECT_EQ(positionsOf(host, second), expected);

        // Without the grab, which begins anew after a load, a repeated step has equal bits.
        SinewSimulationInfo info{};
        info.size = sizeof info;
        ASSERT_TRUE(isOk(sinewGetSimulationInfo(first, &info)));
        const vk::Device same = vk::Device::borrow(host.handles());
        const vk::Buffer kept(same, {.name = "kept", .count = info.stateSize / 4, .stride = 4});
        SinewBufferView view{.buffer = kept.view().buffer, .offset = 0, .size = info.stateSize, .stride = 4};
        State state;
        SinewStep step = sinewDefaultStep();
        step.frame = 8;
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(isOk(sinewRecordStep(first, commands, &step)));
            EXPECT_TRUE(isOk(sinewRecordSaveState(first, commands, &view, &state)));
            step.frame = 9;
            EXPECT_TRUE(isOk(sinewRecordStep(first, commands, &step)));
        });
        const Positions once = positionsOf(host, first);
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(isOk(sinewRecordLoadState(first, commands, &view, state)));
            step.frame = 10;
            EXPECT_TRUE(isOk(sinewRecordStep(first, commands, &step)));
        });
        EXPECT_EQ(positionsOf(host, first), once);
        --view.size;
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(failsWith(SINEW_ERROR_MISMATCH, "a state has",
                                  sinewRecordLoadState(first, commands, &view, state)));
        });
        Scene other;
        makeCube(other);
        Simulation foreign;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, other, &settings, &foreign)));
        ++view.size;
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(failsWith(SINEW_ERROR_MISMATCH, "another scene",
                                  sinewRecordLoadState(foreign, commands, &view, state)));
            EXPECT_TRUE(failsWith(SINEW_ERROR_MISMATCH, "", sinewRecordTakeOver(foreign, commands, first)));
        });
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(CApiRecording, FramesHaveOutputsOfTheirOwn) {
    HostDevice host;
    {
        const SinewHostDevice handles = handlesOf(host);
        Device device;
        Scene scene;
        Simulation simulation;
        ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
        makeExample(scene);
        SinewSettings settings = exampleSettings();
        settings.outputFrames = 9;
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "outputFrames",
                              sinewCreateSimulation(device, scene, &settings, &simulation)));
        settings.outputFrames = 2;
        settings.outputUsage = VK_BUFFER_USAGE_CONDITIONAL_RENDERING_BIT_EXT;
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "outputUsage",
                              sinewCreateSimulation(device, scene, &settings, &simulation)));
        settings.outputUsage = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
        settings.outputFamilies = 1u << 31;
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "outputFamilies",
                              sinewCreateSimulation(device, scene, &settings, &simulation)));
        settings.outputFamilies = 0;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
        SinewBufferView view{};
        EXPECT_EQ(sinewGetFrameView(simulation, 0, SINEW_POSITIONS, &view), SINEW_NOT_READY);
        EXPECT_EQ(view.size, 0u);
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "output",
                              sinewGetFrameView(simulation, 0, SINEW_FORCE_SUMS, &view)));
        std::vector<Positions> frames;
        for (std::uint64_t frame = 0; frame < 3; ++frame) {
            host.submit([&](VkCommandBuffer commands) {
                if (frame == 0) sinewRecordReset(simulation, commands);
                SinewStep step = sinewDefaultStep();
                step.frame = frame;
                EXPECT_TRUE(isOk(sinewRecordStep(simulation, commands, &step)));
                EXPECT_TRUE(isOk(sinewRecordSkin(simulation, commands)));
            });
            frames.push_back(positionsOf(host, simulation));
            for (std::uint64_t kept = frame > 0 ? frame - 1 : 0; kept <= frame; ++kept) {
                ASSERT_TRUE(isOk(sinewGetFrameView(simulation, kept, SINEW_POSITIONS, &view)));
                EXPECT_EQ(read(host, view), frames[kept]) << "of " << kept << " after " << frame;
                ASSERT_TRUE(isOk(sinewGetFrameView(simulation, kept, SINEW_SKIN_VERTICES, &view)));
                EXPECT_GT(view.size, 0u);
            }
        }
        EXPECT_EQ(sinewGetFrameView(simulation, 0, SINEW_POSITIONS, &view), SINEW_NOT_READY);
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(CApiRecording, ComplainsOfMistakesOnce) {
    HostDevice host;
    {
        const SinewHostDevice handles = handlesOf(host);
        Device device;
        ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
        Scene scene;
        makeCube(scene);
        const SinewSettings settings = sinewDefaultSettings();
        Simulation simulation;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
        std::vector<SinewGrab> grabs(20, sinewDefaultGrab());
        SinewStep step = sinewDefaultStep();
        host.submit([&](VkCommandBuffer commands) {
            EXPECT_TRUE(isOk(sinewRecordStep(simulation, commands, &step))); // before a reset
            EXPECT_TRUE(isOk(sinewRecordReset(simulation, commands)));
            step.grabs = grabs.data();
            step.grabCount = 20;
            step.frame = 1;
            EXPECT_TRUE(isOk(sinewRecordStep(simulation, commands, &step)));
            EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "commands is null",
                                  sinewRecordStep(simulation, nullptr, &step)));
            step.grabs = nullptr; // but there are 20
            EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "grabs is null",
                                  sinewRecordStep(simulation, commands, &step)));
        });
        std::string all;
        const char* sentence = nullptr;
        while (sinewNextComplaint(simulation, &sentence) == SINEW_OK) all += std::string(sentence) + "\n";
        EXPECT_NE(all.find("recordReset"), std::string::npos) << all;
        EXPECT_NE(all.find("grab"), std::string::npos) << all;
        EXPECT_EQ(sentence, nullptr);
        step.grabCount = 0;
        EXPECT_TRUE(failsWith(SINEW_ERROR_UNSUPPORTED, "borrowed", sinewStep(simulation, &step, 1)));
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

} // namespace
} // namespace sinew::test
