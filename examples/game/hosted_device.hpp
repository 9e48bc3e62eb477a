// A device whose buffers come from the engine's own memory: one allocation for each buffer, and a count of
// the bytes that are in use. An engine calls its allocator in these places, such as VMA.
#pragma once

#include "sinew/vk/check.hpp"
#include "sinew/vk/device.hpp"
#include "sinew/vk/loader.hpp"

#include <map>
#include <stdexcept>

class HostedDevice {
public:
    HostedDevice() : device(sinew::vk::Device::borrow(handles())) {}

    std::uint64_t bytes() const { return bytes_; } ///< of all buffers that exist now

private:
    sinew::vk::Loader loader_;
    sinew::vk::Device engine_ = sinew::vk::Device::create(loader_.getInstanceProcAddr(), {});

    struct Memory {
        VkDeviceMemory handle = VK_NULL_HANDLE;
        VkDeviceSize size = 0;
    };
    std::map<VkBuffer, Memory> memories_;
    std::uint64_t bytes_ = 0;

    sinew::vk::HostDevice handles() {
        return {.getInstanceProcAddr = engine_.getInstanceProcAddr(),
                .instance = engine_.instance(),
                .physicalDevice = engine_.physical(),
                .device = engine_.handle(),
                .queueFamily = engine_.queueFamily(),
                .buffers = {.create = [this](const VkBufferCreateInfo& info, sinew::vk::MemoryKind kind,
                                             const char* name) { return create(info, kind, name); },
                            .destroy = [this](const sinew::vk::BufferAllocation& made) { destroy(made); }}};
    }

    sinew::vk::BufferAllocation create(const VkBufferCreateInfo& info, sinew::vk::MemoryKind kind,
                                       const char* name) {
        const sinew::vk::DeviceFunctions& functions = engine_.functions();
        sinew::vk::BufferAllocation made;
        sinew::vk::check(functions.vkCreateBuffer(engine_.handle(), &info, nullptr, &made.buffer),
                         "vkCreateBuffer", name);
        VkMemoryRequirements need;
        functions.vkGetBufferMemoryRequirements(engine_.handle(), made.buffer, &need);
        Memory memory{.size = need.size};
        const VkMemoryAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .allocationSize = need.size,
                                            .memoryTypeIndex = typeFor(need.memoryTypeBits, kind)};
        sinew::vk::check(functions.vkAllocateMemory(engine_.handle(), &allocate, nullptr, &memory.handle),
                         "vkAllocateMemory", name);
        sinew::vk::check(functions.vkBindBufferMemory(engine_.handle(), made.buffer, memory.handle, 0),
                         "vkBindBufferMemory", name);
        if (kind != sinew::vk::MemoryKind::device) {
            void* mapped = nullptr;
            sinew::vk::check(
                functions.vkMapMemory(engine_.handle(), memory.handle, 0, VK_WHOLE_SIZE, 0, &mapped),
                "vkMapMemory", name);
            made.mapped = static_cast<std::byte*>(mapped);
        }
        memories_[made.buffer] = memory;
        bytes_ += memory.size;
        return made;
    }

    void destroy(const sinew::vk::BufferAllocation& made) {
        const Memory memory = memories_.at(made.buffer);
        memories_.erase(made.buffer);
        bytes_ -= memory.size;
        engine_.functions().vkDestroyBuffer(engine_.handle(), made.buffer, nullptr);
        engine_.functions().vkFreeMemory(engine_.handle(), memory.handle, nullptr);
    }

    std::uint32_t typeFor(std::uint32_t allowed, sinew::vk::MemoryKind kind) const {
        const VkMemoryPropertyFlags wanted =
            kind == sinew::vk::MemoryKind::device
                ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT}
                : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkPhysicalDeviceMemoryProperties types;
        engine_.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(engine_.physical(), &types);
        for (std::uint32_t type = 0; type < types.memoryTypeCount; ++type)
            if ((allowed >> type & 1) != 0 && (types.memoryTypes[type].propertyFlags & wanted) == wanted)
                return type;
        throw std::runtime_error("no memory for a buffer");
    }

public:
    sinew::vk::Device device; ///< to give to Sinew; destroyed before all that it uses
};
