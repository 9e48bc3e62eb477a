// Borrows the device, so that the functions that make and name pipelines can be wrapped.
#include "support/null_hardware.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/spirv.hpp"
#include "vk/environment.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <span>
#include <string_view>

namespace sinew::test {

namespace {

constexpr const char* statisticsExtension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

// Global state of the wrapped Vulkan functions, which have no user pointer.
struct Capture {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    PFN_vkGetBufferMemoryRequirements bufferNeed = nullptr;
    PFN_vkCreateShaderModule createModule = nullptr;
    PFN_vkCreateComputePipelines create = nullptr;
    PFN_vkCreateGraphicsPipelines createGraphics = nullptr;
    PFN_vkGetPipelineExecutablePropertiesKHR properties = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;
    std::set<std::vector<std::uint32_t>> codes; // of all modules
    std::vector<PipelineFacts> pipelines;
    std::multimap<VkPipeline, std::size_t> newest; // the driver reuses the handles of destroyed pipelines
};
Capture capture;

std::map<std::string, std::uint64_t> readStatistics(VkDevice device, VkPipeline pipeline,
                                                    std::uint32_t executable) {
    const VkPipelineExecutableInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                           .pipeline = pipeline,
                                           .executableIndex = executable};
    std::uint32_t count = 0;
    vk::check(capture.statistics(device, &info, &count, nullptr), "vkGetPipelineExecutableStatisticsKHR",
              "a pipeline");
    std::vector<VkPipelineExecutableStatisticKHR> statistics(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    vk::check(capture.statistics(device, &info, &count, statistics.data()),
              "vkGetPipelineExecutableStatisticsKHR", "a pipeline");
    std::map<std::string, std::uint64_t> result;
    for (const VkPipelineExecutableStatisticKHR& statistic : statistics)
        result[statistic.name] = statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR
                                     ? statistic.value.u64
                                     : static_cast<std::uint64_t>(statistic.value.i64);
    return result;
}

std::vector<std::uint32_t> constantsOf(const VkSpecializationInfo* info) {
    std::vector<std::uint32_t> values;
    for (std::uint32_t i = 0; info != nullptr && i < info->mapEntryCount; ++i) {
        std::uint32_t value = 0;
        std::copy_n(static_cast<const std::byte*>(info->pData) + info->pMapEntries[i].offset, sizeof value,
                    reinterpret_cast<std::byte*>(&value));
        values.push_back(value);
    }
    return values;
}

// Reads one entry for each shader of the pipeline.
void read(VkDevice device, VkPipeline pipeline, const std::vector<std::uint32_t>& constants) {
    const VkPipelineInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pipeline = pipeline};
    std::uint32_t count = 0;
    vk::check(capture.properties(device, &info, &count, nullptr), "vkGetPipelineExecutablePropertiesKHR",
              "a pipeline");
    std::vector<VkPipelineExecutablePropertiesKHR> shaders(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
    vk::check(capture.properties(device, &info, &count, shaders.data()),
              "vkGetPipelineExecutablePropertiesKHR", "a pipeline");
    capture.newest.erase(pipeline);
    for (std::uint32_t s = 0; s < count; ++s) {
        capture.newest.emplace(pipeline, capture.pipelines.size());
        capture.pipelines.push_back({.kernel = "",
                                     .shader = shaders[s].name,
                                     .constants = constants,
                                     .statistics = readStatistics(device, pipeline, s)});
    }
}

VKAPI_ATTR VkResult VKAPI_CALL createModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    capture.codes.emplace(info->pCode, info->pCode + info->codeSize / sizeof(std::uint32_t));
    return capture.createModule(device, info, allocator, module);
}

VKAPI_ATTR VkResult VKAPI_CALL createAndRead(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    std::vector<VkComputePipelineCreateInfo> captured(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : captured)
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result = capture.create(device, cache, count, captured.data(), allocator, pipelines);
    for (std::uint32_t p = 0; result == VK_SUCCESS && p < count; ++p)
        read(device, pipelines[p], constantsOf(infos[p].stage.pSpecializationInfo));
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createAndReadGraphics(VkDevice device, VkPipelineCache cache,
                                                     std::uint32_t count,
                                                     const VkGraphicsPipelineCreateInfo* infos,
                                                     const VkAllocationCallbacks* allocator,
                                                     VkPipeline* pipelines) {
    std::vector<VkGraphicsPipelineCreateInfo> captured(infos, infos + count);
    for (VkGraphicsPipelineCreateInfo& info : captured)
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result =
        capture.createGraphics(device, cache, count, captured.data(), allocator, pipelines);
    for (std::uint32_t p = 0; result == VK_SUCCESS && p < count; ++p)
        read(device, pipelines[p], constantsOf(infos[p].pStages[0].pSpecializationInfo));
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL readName(VkDevice, const VkDebugUtilsObjectNameInfoEXT* info) {
    if (info->objectType != VK_OBJECT_TYPE_PIPELINE) return VK_SUCCESS;
    for (const auto& [pipeline, index] : capture.newest)
        if (vk::handleValue(pipeline) == info->objectHandle)
            capture.pipelines[index].kernel = info->pObjectName;
    return VK_SUCCESS;
}

// The driver reports no memory heap and no memory type, but allocates host memory for type 0.
VKAPI_ATTR void VKAPI_CALL readMemory(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* properties) {
    constexpr VkMemoryPropertyFlags ofAll = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                            VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    *properties = {};
    properties->memoryTypes[properties->memoryTypeCount++] = {.propertyFlags = ofAll};
    properties->memoryHeaps[properties->memoryHeapCount++] = {.size = VkDeviceSize{1} << 30,
                                                              .flags = VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

VKAPI_ATTR void VKAPI_CALL readBufferNeed(VkDevice device, VkBuffer buffer, VkMemoryRequirements* need) {
    capture.bufferNeed(device, buffer, need);
    need->memoryTypeBits = 1;
}

// The driver lays out no images, so images, views and descriptors are dummy handles.
template <class Object> const Object nothing = reinterpret_cast<Object>(std::uintptr_t{1});

template <class Object, class Info>
VKAPI_ATTR VkResult VKAPI_CALL makeNothing(VkDevice, const Info*, const VkAllocationCallbacks*,
                                           Object* made) {
    *made = nothing<Object>;
    return VK_SUCCESS;
}

template <class Object>
VKAPI_ATTR void VKAPI_CALL destroyNothing(VkDevice, Object, const VkAllocationCallbacks*) {}

VKAPI_ATTR void VKAPI_CALL readImageNeed(VkDevice, VkImage, VkMemoryRequirements* need) {
    *need = {.size = 4096, .alignment = 4096, .memoryTypeBits = 1};
}

VKAPI_ATTR VkResult VKAPI_CALL bindImage(VkDevice, VkImage, VkDeviceMemory, VkDeviceSize) {
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL writeNothing(VkDevice, std::uint32_t, const VkWriteDescriptorSet*, std::uint32_t,
                                        const VkCopyDescriptorSet*) {}

struct Wrapped {
    std::string_view name;
    PFN_vkVoidFunction function;
};

template <class Function> PFN_vkVoidFunction anyFunction(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

// The wrapper of a function; null if the function is not wrapped.
PFN_vkVoidFunction findWrapped(std::span<const Wrapped> wrapped, std::string_view name) {
    const auto found = std::ranges::find(wrapped, name, &Wrapped::name);
    return found == wrapped.end() ? nullptr : found->function;
}

PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name) {
    static const std::array wrapped{
        Wrapped{"vkCreateShaderModule", anyFunction(&createModule)},
        Wrapped{"vkCreateComputePipelines", anyFunction(&createAndRead)},
        Wrapped{"vkCreateGraphicsPipelines", anyFunction(&createAndReadGraphics)},
        Wrapped{"vkSetDebugUtilsObjectNameEXT", anyFunction(&readName)},
        Wrapped{"vkGetBufferMemoryRequirements", anyFunction(&readBufferNeed)},
        Wrapped{"vkGetImageMemoryRequirements", anyFunction(&readImageNeed)},
        Wrapped{"vkBindImageMemory", anyFunction(&bindImage)},
        Wrapped{"vkUpdateDescriptorSets", anyFunction(&writeNothing)},
        Wrapped{"vkCreateImage", anyFunction(&makeNothing<VkImage, VkImageCreateInfo>)},
        Wrapped{"vkCreateImageView", anyFunction(&makeNothing<VkImageView, VkImageViewCreateInfo>)},
        Wrapped{"vkCreateFramebuffer", anyFunction(&makeNothing<VkFramebuffer, VkFramebufferCreateInfo>)},
        Wrapped{"vkDestroyImage", anyFunction(&destroyNothing<VkImage>)},
        Wrapped{"vkDestroyImageView", anyFunction(&destroyNothing<VkImageView>)},
        Wrapped{"vkDestroyFramebuffer", anyFunction(&destroyNothing<VkFramebuffer>)}};
    const PFN_vkVoidFunction found = findWrapped(wrapped, name);
    return found != nullptr ? found : capture.getDeviceProcAddr(device, name);
}

PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name) {
    static const std::array wrapped{Wrapped{"vkGetDeviceProcAddr", anyFunction(&deviceProcAddr)},
                                    Wrapped{"vkGetPhysicalDeviceMemoryProperties", anyFunction(&readMemory)}};
    const PFN_vkVoidFunction found = findWrapped(wrapped, name);
    return found != nullptr ? found : capture.getInstanceProcAddr(instance, name);
}

/// Sets an environment variable for the lifetime of the object.
class Variable {
public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        vk::setVariable(name, value.c_str());
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { vk::setVariable(name_, before_ ? before_->c_str() : nullptr); }

private:
    const char* name_;
    std::optional<std::string> before_;
};

/// Path of the driver's manifest, or an empty path.
std::string findDriver() {
    for (const char* folder :
         {"/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code none;
        for (const auto& file : std::filesystem::directory_iterator(folder, none))
            if (file.path().filename().string().starts_with("radeon_icd.x86_64")) return file.path().string();
    }
    return "";
}

} // namespace

std::uint64_t PipelineFacts::operator[](const std::string& statistic) const {
    const auto found = statistics.find(statistic);
    return found == statistics.end() ? 0 : found->second;
}

NullHardware::NullHardware() = default;

std::unique_ptr<NullHardware> NullHardware::make(const std::string& family) {
    const std::string driver = findDriver();
    if (driver.empty()) return nullptr;
    const Variable forced("RADV_FORCE_FAMILY", family), only("VK_ICD_FILENAMES", driver),
        anew("MESA_SHADER_CACHE_DISABLE", "true"); // a cached pipeline has no statistics
    std::unique_ptr<NullHardware> hardware(new NullHardware);
    if (!hardware->makeInstance() || !hardware->makeDevice()) return nullptr;
    hardware->borrow();
    return hardware;
}

NullHardware::~NullHardware() {
    device_.reset();
    if (handle_ != VK_NULL_HANDLE)
        reinterpret_cast<PFN_vkDestroyDevice>(functions_.vkGetDeviceProcAddr(handle_, "vkDestroyDevice"))(
            handle_, nullptr);
    if (instance_ != VK_NULL_HANDLE) functions_.vkDestroyInstance(instance_, nullptr);
    capture = {};
}

bool NullHardware::makeInstance() {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application};
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(loader_.getInstanceProcAddr()(nullptr, "vkCreateInstance"));
    if (create(&info, nullptr, &instance_) != VK_SUCCESS) return false;
    functions_ = vk::loadInstanceFunctions(loader_.getInstanceProcAddr(), instance_);
    std::uint32_t count = 1;
    return functions_.vkEnumeratePhysicalDevices(instance_, &count, &physical_) >= 0 && count > 0;
}

bool NullHardware::makeDevice() {
    const VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
        .pipelineExecutableInfo = VK_TRUE};
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &statistics,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = 1,
                                  .ppEnabledExtensionNames = &statisticsExtension};
    return functions_.vkCreateDevice(physical_, &info, nullptr, &handle_) == VK_SUCCESS;
}

void NullHardware::borrow() {
    capture.getInstanceProcAddr = loader_.getInstanceProcAddr();
    capture.getDeviceProcAddr = functions_.vkGetDeviceProcAddr;
    const auto load = [&]<class Function>(Function& function, const char* name) {
        function = reinterpret_cast<Function>(functions_.vkGetDeviceProcAddr(handle_, name));
    };
    load(capture.bufferNeed, "vkGetBufferMemoryRequirements");
    load(capture.createModule, "vkCreateShaderModule");
    load(capture.create, "vkCreateComputePipelines");
    load(capture.createGraphics, "vkCreateGraphicsPipelines");
    load(capture.properties, "vkGetPipelineExecutablePropertiesKHR");
    load(capture.statistics, "vkGetPipelineExecutableStatisticsKHR");
    const char* names = VK_EXT_DEBUG_UTILS_EXTENSION_NAME; // readName implements it
    device_.emplace(vk::Device::borrow({.getInstanceProcAddr = instanceProcAddr,
                                        .instance = instance_,
                                        .physicalDevice = physical_,
                                        .device = handle_,
                                        .enabledInstanceExtensions = {&names, 1}}));
}

bool NullHardware::hasModuleOf(const vk::ShaderCode& code) const {
    return capture.codes.contains(vk::wordsOf(code));
}

const std::vector<PipelineFacts>& NullHardware::pipelines() const {
    return capture.pipelines;
}

} // namespace sinew::test
