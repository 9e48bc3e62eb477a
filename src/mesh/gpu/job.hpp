// A device job in a few submissions, each a list of passes with planned barriers, whose later parts depend on
// counts computed on the device: the set-up counterpart of a step program.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/vk/queue.hpp"

#include <map>

namespace sinew::mesh::gpu {

/// Pipelines, made on first use and kept.
class Kernels {
public:
    Kernels(const vk::Device& device, bool isReversed)
        : device_(device.anchored()), isReversed_(isReversed) {}
    const vk::Kernel& operator[](const vk::ShaderCode& code);

private:
    const vk::Device& device_;
    bool isReversed_;
    std::map<const vk::ShaderCode*, vk::Kernel> kernels_;
};

/// Owns its buffers. The constructor's arguments must outlive it. All calls may throw vk::Error.
class Job {
public:
    using BufferId = sim::BufferId;
    Job(const vk::Device& device, vk::Queue& queue, Kernels& kernels)
        : device_(device.anchored()), queue_(queue), kernels_(kernels) {}

    template <typename T> BufferId upload(const std::string& label, std::span<const T> elements) {
        const BufferId id = add(label, elements.size(), sizeof(T));
        queue_.upload(view(id), elements.data(), elements.size_bytes());
        return id;
    }
    /// Contents undefined.
    template <typename T> BufferId scratch(const std::string& label, std::uint64_t count) {
        return add(label, count, sizeof(T));
    }

    void fill(BufferId buffer, std::uint32_t value);
    /// Dispatches one invocation an item. Sets `first` and `count` of `Push`: items beyond the device's
    /// largest group count are dispatched in several parts. Records nothing for no items.
    template <typename Push>
    void dispatch(const vk::ShaderCode& code, std::uint64_t items, std::initializer_list<BufferId> buffers,
                  Push push) {
        for (std::uint64_t done = 0; done < items; done += push.count) {
            push.first = static_cast<std::uint32_t>(done);
            push.count = static_cast<std::uint32_t>(std::min(items - done, mostItems(code)));
            dispatchBytes(code, push.count, buffers, std::as_bytes(std::span(&push, 1)));
        }
    }
    /// Submits what was recorded since the last call and waits for it.
    void run();
    /// Contents of a buffer; valid after run().
    template <typename T> std::vector<T> download(BufferId buffer) {
        return queue_.download<T>(view(buffer));
    }
    std::uint64_t bytes() const; ///< total size of all buffers

private:
    BufferId add(const std::string& label, std::uint64_t count, std::uint32_t stride);
    vk::BufferView view(BufferId buffer) const { return buffers_[buffer.index].view(); }
    std::uint64_t mostItems(const vk::ShaderCode& code);
    void dispatchBytes(const vk::ShaderCode& code, std::uint32_t items,
                       std::initializer_list<BufferId> buffers, std::span<const std::byte> push);
    void record(vk::Commands& commands, const vk::BindingSets* sets) const;

    const vk::Device& device_;
    vk::Queue& queue_;
    Kernels& kernels_;
    std::vector<vk::Buffer> buffers_;
    std::vector<sim::Pass> passes_;
    std::vector<vk::BindingRequest> requests_; ///< bindings of the dispatches, in order
};

} // namespace sinew::mesh::gpu
