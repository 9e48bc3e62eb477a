// Tests of the choice of a device, and of borrowed devices.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/check.hpp"
#include "vk/choice.hpp"
#include "vk/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

namespace sinew::test {

namespace {

vk::Candidate candidate(std::uint32_t index, const char* name, const char* type,
                        std::vector<std::string> missing = {}) {
    return {.description = {.index = index, .name = name, .type = type, .missing = std::move(missing)}};
}

std::string noDeviceComplaint(const std::function<void()>& make) {
    try {
        make();
    } catch (const vk::Error& error) {
        EXPECT_EQ(error.failure(), vk::Failure::noDevice);
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

void expectPart(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
}

/// Sets an environment variable for the lifetime of the object.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        vk::setVariable(name, value);
    }
    ~Environment() { vk::setVariable(name_, old_ ? old_->c_str() : nullptr); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

TEST(DeviceChoice, PrefersARealGpuToSoftware) {
    const vk::Candidate all[] = {
        candidate(0, "llvmpipe", "software"), candidate(1, "Virtio", "virtual GPU"),
        candidate(2, "Iris", "integrated GPU"), candidate(3, "Big", "discrete GPU"),
        candidate(4, "Bigger", "discrete GPU", {"it has Vulkan 1.1, Sinew needs 1.2"})};
    EXPECT_EQ(vk::choose(all, "").description.name, "Big");
    EXPECT_EQ(vk::choose(std::span(all).first(3), "").description.name, "Iris");
    EXPECT_EQ(vk::choose(std::span(all).first(2), "").description.name, "Virtio");
    EXPECT_EQ(vk::choose(std::span(all).first(1), "").description.name, "llvmpipe");
}

TEST(DeviceChoice, TakesAnIndexOrAPartOfANameInAnyCase) {
    const vk::Candidate all[] = {candidate(0, "llvmpipe (LLVM 15)", "software"),
                                 candidate(1, "Radeon 7900", "discrete GPU"),
                                 candidate(2, "Radeon Vega", "integrated GPU")};
    EXPECT_EQ(vk::choose(all, "0").description.index, 0u);
    EXPECT_EQ(vk::choose(all, "LLVM").description.index, 0u);
    EXPECT_EQ(vk::choose(all, "vega").description.index, 2u);
    EXPECT_EQ(vk::choose(all, "radeon").description.index, 1u);
}

TEST(DeviceChoice, ListsWhatThereIsWhenTheWishCannotBeMet) {
    const vk::Candidate all[] = {candidate(0, "llvmpipe", "software"),
                                 candidate(1, "Old", "discrete GPU", {"it has Vulkan 1.1, Sinew needs 1.2"})};
    for (const char* wish : {"geforce", "7", "old", "1"}) {
        const std::string message = noDeviceComplaint([&] { vk::choose(all, wish); });
        expectPart(message, wish);
        expectPart(message, "0 llvmpipe");
        expectPart(message, "1 Old (it has Vulkan 1.1, Sinew needs 1.2)");
    }
}

TEST(Device, ListHasTheChosenOneAndItsDescription) {
    const auto descriptions = vk::listDevices(device().getInstanceProcAddr(), {});
    ASSERT_FALSE(descriptions.empty());
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < descriptions.size(); ++i) {
        EXPECT_EQ(descriptions[i].index, i);
        EXPECT_FALSE(descriptions[i].name.empty());
        EXPECT_FALSE(descriptions[i].driver.empty());
        if (!descriptions[i].isChosen) continue;
        ++chosen;
        EXPECT_TRUE(descriptions[i].missing.empty());
        EXPECT_EQ(descriptions[i].name, device().description().name);
    }
    EXPECT_EQ(chosen, 1u);
}

TEST(Device, ListMarksNoneForAWishThatCannotBeMet) {
    for (const auto& description :
         vk::listDevices(device().getInstanceProcAddr(), {.device = "no such thing"}))
        EXPECT_FALSE(description.isChosen);
}

TEST(Device, IsCreatedByIndexAndByName) {
    const auto& description = device().description();
    const auto byIndex =
        vk::Device::create(device().getInstanceProcAddr(), {.device = std::to_string(description.index)});
    EXPECT_EQ(byIndex.description().name, description.name);
    const auto byName =
        vk::Device::create(device().getInstanceProcAddr(), {.device = description.name.substr(0, 4)});
    EXPECT_EQ(byName.description().name, description.name);
    EXPECT_TRUE(byName.validationMessages().empty());
}

TEST(Device, RefusesAMissingExtensionByName) {
    expectPart(noDeviceComplaint([] {
                   vk::Device::create(device().getInstanceProcAddr(),
                                      {.instanceExtensions = {"VK_KHR_imaginary"}});
               }),
               "VK_KHR_imaginary");
    expectPart(noDeviceComplaint([] {
                   vk::Device::create(device().getInstanceProcAddr(),
                                      {.deviceExtensions = {"VK_KHR_imagined"}});
               }),
               "it lacks the extension VK_KHR_imagined");
}

TEST(Device, AsksWhetherAQueueFamilyWillDoForAWindow) {
    std::size_t asked = 0;
    const vk::DeviceRequest request{
        .canUseFamily = [&](VkInstance instance, VkPhysicalDevice, std::uint32_t) {
            asked += instance != VK_NULL_HANDLE ? 1 : 0;
            return false;
        }};
    expectPart(noDeviceComplaint([&] { vk::Device::create(device().getInstanceProcAddr(), request); }),
               "window");
    EXPECT_GT(asked, 0u);
}

TEST(Device, WithoutADriverSaysWhatToInstall) {
    const Environment noDriver("VK_ICD_FILENAMES", "/nonexistent.json");
    expectPart(noDeviceComplaint([] { vk::Device::create(device().getInstanceProcAddr(), {}); }),
               "install mesa-vulkan-drivers");
    expectPart(noDeviceComplaint([] { vk::listDevices(device().getInstanceProcAddr(), {}); }),
               "no driver found");
}

namespace {

VkResult VKAPI_CALL noPhysicalDevices(VkInstance, std::uint32_t* count, VkPhysicalDevice*) {
    *count = 0;
    return VK_SUCCESS;
}

VkResult VKAPI_CALL noLayers(std::uint32_t* count, VkLayerProperties*) {
    *count = 0;
    return VK_SUCCESS;
}

VkResult VKAPI_CALL oldVersion(std::uint32_t* version) {
    *version = VK_API_VERSION_1_1;
    return VK_SUCCESS;
}

/// The system's loader with replaced functions.
class ReplacedLoader {
public:
    void replace(const char* name, PFN_vkVoidFunction function) { host_.replace(name, function); }
    /// Replaces a function and stores the former one in `original`.
    template <typename Function> void wrap(const char* name, Function& original, Function replacement) {
        original = reinterpret_cast<Function>(host_.original(name));
        replace(name, reinterpret_cast<PFN_vkVoidFunction>(replacement));
    }
    PFN_vkGetInstanceProcAddr entry() const { return host_.handles().getInstanceProcAddr; }

private:
    HostDevice host_;
};

} // namespace

namespace {

// A driver that supports only a part of Vulkan, with the requests that it received.
struct PortabilityDriver {
    PFN_vkCreateInstance createInstance = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties extensions = nullptr;
    PFN_vkCreateDevice createDevice = nullptr;
    VkInstanceCreateFlags flags = 0;
    bool hasEnabledSubset = false;
};
PortabilityDriver portability;
constexpr const char* subset = "VK_KHR_portability_subset";

VkResult VKAPI_CALL keepFlags(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                              VkInstance* instance) {
    portability.flags = info->flags;
    return portability.createInstance(info, allocator, instance);
}

VkResult VKAPI_CALL addSubset(VkPhysicalDevice device, const char* layer, std::uint32_t* count,
                              VkExtensionProperties* properties) {
    const std::uint32_t room = *count;
    if (properties != nullptr) --*count;
    const VkResult result = portability.extensions(device, layer, count, properties);
    if (properties != nullptr && *count < room) {
        properties[*count] = {};
        std::copy_n(subset, std::string_view(subset).size(), properties[*count].extensionName);
    }
    ++*count;
    return result;
}

VkResult VKAPI_CALL takeSubset(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                               const VkAllocationCallbacks* allocator, VkDevice* device) {
    std::vector<const char*> names(info->ppEnabledExtensionNames,
                                   info->ppEnabledExtensionNames + info->enabledExtensionCount);
    portability.hasEnabledSubset =
        std::erase_if(names, [](const char* name) { return std::string_view(name) == subset; }) == 1;
    VkDeviceCreateInfo without = *info;
    without.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    without.ppEnabledExtensionNames = names.data();
    return portability.createDevice(physical, &without, allocator, device);
}

} // namespace

TEST(Device, OfMoltenVkIsListedAndToldThatItsSubsetWillDo) {
    ReplacedLoader loader;
    portability = {};
    loader.wrap("vkCreateInstance", portability.createInstance, &keepFlags);
    loader.wrap("vkEnumerateDeviceExtensionProperties", portability.extensions, &addSubset);
    loader.wrap("vkCreateDevice", portability.createDevice, &takeSubset);
    const vk::Device created = vk::Device::create(loader.entry(), {});
    EXPECT_NE(portability.flags & VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR, 0u);
    EXPECT_TRUE(portability.hasEnabledSubset);
}

namespace {

PFN_vkGetPhysicalDeviceMemoryProperties trueMemory = nullptr;

void VKAPI_CALL incoherentMemory(VkPhysicalDevice physical, VkPhysicalDeviceMemoryProperties* memory) {
    trueMemory(physical, memory);
    for (std::uint32_t type = 0; type < memory->memoryTypeCount; ++type)
        memory->memoryTypes[type].propertyFlags &=
            ~static_cast<VkMemoryPropertyFlags>(VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
}

} // namespace

// Programs neither flush nor invalidate mapped memory.
TEST(Device, WithoutCoherentMemoryIsRefusedForPrograms) {
    ReplacedLoader loader;
    loader.wrap("vkGetPhysicalDeviceMemoryProperties", trueMemory, &incoherentMemory);
    expectPart(noDeviceComplaint([&] { vk::Device::create(loader.entry(), {}); }),
               "none of its memory is host visible and host coherent");
}

// A host reports whether its own memory is coherent.
TEST(BorrowedDevice, NeedsNoCoherentMemory) {
    HostDevice host;
    trueMemory = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(
        host.original("vkGetPhysicalDeviceMemoryProperties"));
    host.replace("vkGetPhysicalDeviceMemoryProperties",
                 reinterpret_cast<PFN_vkVoidFunction>(&incoherentMemory));
    EXPECT_NO_THROW(vk::Device::borrow(host.handles()));
}

TEST(Device, WithADriverThatFindsNoGpuSaysWhatToInstall) {
    ReplacedLoader loader;
    loader.replace("vkEnumeratePhysicalDevices", reinterpret_cast<PFN_vkVoidFunction>(&noPhysicalDevices));
    expectPart(noDeviceComplaint([&] { vk::Device::create(loader.entry(), {}); }),
               "install mesa-vulkan-drivers");
}

TEST(Device, WithoutTheLayerRefusesToPretendValidation) {
    ReplacedLoader loader;
    loader.replace("vkEnumerateInstanceLayerProperties", reinterpret_cast<PFN_vkVoidFunction>(&noLayers));
    expectPart(noDeviceComplaint([&] { vk::Device::create(loader.entry(), {.hasValidation = true}); }),
               "install vulkan-validationlayers");
    EXPECT_NO_THROW(vk::Device::create(loader.entry(), {}));
}

TEST(Device, NeedsALoaderOfVulkan12) {
    ReplacedLoader loader;
    loader.replace("vkEnumerateInstanceVersion", reinterpret_cast<PFN_vkVoidFunction>(&oldVersion));
    expectPart(noDeviceComplaint([&] { vk::Device::create(loader.entry(), {}); }), "older than 1.2");
    expectPart(noDeviceComplaint([] { vk::Device::create(nullptr, {}); }), "no loader");
}

TEST(Loader, OpensWhatThereIsWithoutAName) {
    EXPECT_NE(vk::Loader().getInstanceProcAddr(), nullptr);
}

TEST(Loader, NamesTheLibraryItCannotOpen) {
    expectPart(noDeviceComplaint([] { vk::Loader("libimaginary.so.1"); }), "libimaginary.so.1");
    expectPart(noDeviceComplaint([] { vk::Loader("libm.so.6"); }), "vkGetInstanceProcAddr");
}

TEST(Device, MayMoveUnderBuffersAndKernels) {
    const auto create = [] {
        return vk::Device::create(device().getInstanceProcAddr(), {.hasValidation = true});
    };
    vk::Device moved = create(), first = create();
    const vk::Kernel kernel(first, kernels::addOne, {});
    const vk::Buffer buffer(first, {.name = "values", .count = 3, .stride = 4});
    const vk::BindingRequest request{&kernel, {buffer.view()}};
    const vk::BindingSets sets(first, {&request, 1});
    moved = std::move(first);
    vk::Queue own(moved);
    const std::uint32_t start[] = {4, 5, 6};
    own.upload(buffer.view(), start, sizeof start);
    VkCommandBuffer handle = own.begin();
    vk::Commands commands(moved, handle);
    commands.beginStep();
    commands.bind(kernel, sets[0]);
    commands.dispatch(1);
    commands.endStep();
    own.submit(handle);
    EXPECT_EQ(own.download<std::uint32_t>(buffer.view()), (std::vector<std::uint32_t>{5, 6, 7}));
    EXPECT_EQ(moved.validationMessages(), std::vector<std::string>{});
}

TEST(Device, MayMoveUnderAQueue) {
    const auto create = [] {
        return vk::Device::create(device().getInstanceProcAddr(), {.hasValidation = true});
    };
    vk::Device moved = create();
    std::optional<vk::Device> first = create();
    const vk::Device* const anchored = &first->anchored();
    vk::Queue own(*first);
    moved = std::move(*first);
    first.reset();
    EXPECT_EQ(&moved.anchored(), anchored);
    const vk::Buffer buffer(moved, {.name = "values", .count = 3, .stride = 4});
    const std::uint32_t values[] = {4, 5, 6};
    own.upload(buffer.view(), values, sizeof values);
    EXPECT_EQ(own.download<std::uint32_t>(buffer.view()), (std::vector<std::uint32_t>{4, 5, 6}));
    EXPECT_EQ(moved.validationMessages(), std::vector<std::string>{});
}

// A device for compute alone, without the functions for drawing, fences and others that the core never calls.
TEST(BorrowedDevice, NeedsNoFunctionThatTheCoreDoesNotCall) {
    HostDevice host;
    for (const char* name :
         {"vkCreateGraphicsPipelines", "vkCmdDraw", "vkCmdDrawIndexedIndirect", "vkCreateImage",
          "vkCreateRenderPass", "vkCmdBeginRenderPass", "vkCreateFence", "vkWaitForFences",
          "vkCmdSetViewport", "vkCmdBlitImage", "vkCreateEvent", "vkCmdExecuteCommands",
          "vkGetBufferDeviceAddress", "vkCmdDrawIndirectCount", "vkTrimCommandPool", "vkResetQueryPool"})
        host.replace(name, nullptr);
    const vk::Device borrowed = vk::Device::borrow(host.handles());
    EXPECT_EQ(borrowed.functions().vkCmdDraw, nullptr);
    EXPECT_NE(borrowed.functions().vkCmdDispatch, nullptr);
    host.replace("vkCmdDispatchIndirect", nullptr);
    expectPart(noDeviceComplaint([&] { vk::Device::borrow(host.handles()); }), "vkCmdDispatchIndirect");
}

TEST(BorrowedDevice, RunsADispatchWithoutAnyFeatureOrAnyMessage) {
    for (const bool hasDebugUtils : {true, false}) {
        HostDevice host({.hasDebugUtils = hasDebugUtils});
        {
            const vk::Device borrowed = vk::Device::borrow(host.handles());
            EXPECT_EQ(borrowed.functions().vkCmdBeginDebugUtilsLabelEXT != nullptr, hasDebugUtils);
            const vk::Kernel kernel(borrowed, kernels::addOne, {});
            const vk::Buffer buffer(
                borrowed, {.name = "values", .count = 65, .stride = 4, .kind = vk::MemoryKind::readback});
            const vk::BindingRequest request{&kernel, {buffer.view()}};
            const vk::BindingSets sets(borrowed, {&request, 1});
            host.submit([&](VkCommandBuffer handle) {
                vk::Commands commands(borrowed, handle);
                commands.beginLabel("step");
                commands.beginStep();
                commands.fill(buffer.view(), 41);
                commands.barrier();
                commands.bind(kernel, sets[0]);
                commands.dispatch(2);
                commands.endStep();
                commands.hostBarrier();
                commands.endLabel();
            });
            const auto* values = reinterpret_cast<const std::uint32_t*>(buffer.mapped());
            EXPECT_EQ(std::vector<std::uint32_t>(values, values + 65), std::vector<std::uint32_t>(65, 42));
            EXPECT_TRUE(borrowed.validationMessages().empty());
        }
        EXPECT_EQ(host.finish(), std::vector<std::string>{}); // there are no leaks either
    }
}

TEST(BorrowedDevice, IsRefusedWithoutHandlesComputeOrVulkan12) {
    HostDevice host;
    EXPECT_THROW(vk::Device::borrow({}), vk::Error);
    vk::HostDevice handles = host.handles();
    handles.apiVersion = VK_API_VERSION_1_1;
    expectPart(noDeviceComplaint([&] { vk::Device::borrow(handles); }), "1.2");
    handles = host.handles();
    handles.queueFamily = 1000;
    expectPart(noDeviceComplaint([&] { vk::Device::borrow(handles); }), "queue family 1000");
    handles = host.handles();
    handles.buffers.create = [](const VkBufferCreateInfo&, vk::MemoryKind, const char*) {
        return vk::BufferAllocation{};
    };
    EXPECT_THROW(vk::Device::borrow(handles), vk::Error);
}

TEST(Failures, AreNamedAfterTheCallItsResultAndTheObject) {
    try {
        vk::check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit", "the queue");
        FAIL() << "nothing was thrown";
    } catch (const vk::Error& error) {
        EXPECT_STREQ(error.what(), "vkQueueSubmit of the queue: VK_ERROR_DEVICE_LOST");
        EXPECT_EQ(error.failure(), vk::Failure::deviceLost);
    }
    EXPECT_NO_THROW(vk::check(VK_NOT_READY, "vkGetEventStatus", "an event"));
}

} // namespace sinew::test
