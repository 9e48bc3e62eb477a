// The device is borrowed, so that the functions that make and name pipelines can be wrapped.
#include "support/null_hardware.hpp"

#include "vk/check.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace sinew::test {

namespace {

constexpr const char* statisticsExtension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

// Vulkan's entry points carry no user pointer.
struct Capture {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    PFN_vkCreateComputePipelines create = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;
    std::vector<PipelineFacts> pipelines;
    std::map<VkPipeline, std::size_t> newest; // a handle comes again after its pipeline is destroyed
};
Capture capture;

std::map<std::string, std::uint64_t> readStatistics(VkDevice device, VkPipeline pipeline) {
    const VkPipelineExecutableInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                           .pipeline = pipeline};
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

VKAPI_ATTR VkResult VKAPI_CALL createAndRead(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    std::vector<VkComputePipelineCreateInfo> captured(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : captured)
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result = capture.create(device, cache, count, captured.data(), allocator, pipelines);
    for (std::uint32_t p = 0; result == VK_SUCCESS && p < count; ++p) {
        capture.newest[pipelines[p]] = capture.pipelines.size();
        capture.pipelines.push_back({.kernel = "",
                                     .constants = constantsOf(infos[p].stage.pSpecializationInfo),
                                     .statistics = readStatistics(device, pipelines[p])});
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL readName(VkDevice, const VkDebugUtilsObjectNameInfoEXT* info) {
    if (info->objectType != VK_OBJECT_TYPE_PIPELINE) return VK_SUCCESS;
    for (const auto& [pipeline, index] : capture.newest)
        if (vk::handleValue(pipeline) == info->objectHandle)
            capture.pipelines[index].kernel = info->pObjectName;
    return VK_SUCCESS;
}

PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name) {
    if (std::string_view(name) == "vkCreateComputePipelines")
        return reinterpret_cast<PFN_vkVoidFunction>(&createAndRead);
    if (std::string_view(name) == "vkSetDebugUtilsObjectNameEXT")
        return reinterpret_cast<PFN_vkVoidFunction>(&readName);
    return capture.getDeviceProcAddr(device, name);
}

PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceProcAddr);
    return capture.getInstanceProcAddr(instance, name);
}

/// Sets a variable of the environment for as long as it lives.
class Variable {
public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value.c_str(), 1);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }

private:
    const char* name_;
    std::optional<std::string> before_;
};

/// Path of a driver's description, or an empty path.
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
        anew("MESA_SHADER_CACHE_DISABLE", "true"); // what comes from a cache on disk has no statistics
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
    capture.create = reinterpret_cast<PFN_vkCreateComputePipelines>(
        functions_.vkGetDeviceProcAddr(handle_, "vkCreateComputePipelines"));
    capture.statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        functions_.vkGetDeviceProcAddr(handle_, "vkGetPipelineExecutableStatisticsKHR"));
    const char* names = VK_EXT_DEBUG_UTILS_EXTENSION_NAME; // readName answers for it
    device_.emplace(vk::Device::borrow({.getInstanceProcAddr = instanceProcAddr,
                                        .instance = instance_,
                                        .physicalDevice = physical_,
                                        .device = handle_,
                                        .enabledInstanceExtensions = {&names, 1}}));
}

const std::vector<PipelineFacts>& NullHardware::pipelines() const {
    return capture.pipelines;
}

} // namespace sinew::test
