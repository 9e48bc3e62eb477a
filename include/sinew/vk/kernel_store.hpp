// Kernels shared by several users of a device, so that each is made once: simulations of one scene in
// different forms, or one after another, differ in a few of about fifty kernels.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/kernel.hpp"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace sinew::vk {

/// The kernels of a Device (Device::kernels). Any thread.
class SINEW_API KernelStore {
public:
    /// Returns the kernel for this code and these constants, in their order, if it is in use or kept, else
    /// makes a new one. Code is identified by ShaderCode::identity(): its words or bytes must stay valid as
    /// long as the store, like compiled-in code. Must not outlive `device`, the owner of this store. Throws
    /// as Kernel.
    std::shared_ptr<const Kernel> get(const Device& device, const ShaderCode& code,
                                      std::span<const SpecialisationConstant> constants);

    struct Request {
        const ShaderCode* code = nullptr;
        std::vector<SpecialisationConstant> constants;
    };
    /// get() for each request, in their order. Makes new kernels on useThreads() threads, the calling one
    /// included, which counts their pipelines as its own. Throws the error of one that could not be made.
    std::vector<std::shared_ptr<const Kernel>> getAll(const Device& device,
                                                      std::span<const Request> requests);
    /// The threads of getAll(), at least 1; 1 until it is called: a library starts no threads by itself.
    void useThreads(unsigned count) noexcept { threads_ = count; }

    /// Counts a pipeline made by the calling thread, and returns the count: a thread that must not wait for
    /// compilers can verify that it makes none.
    void countPipeline();
    std::size_t pipelinesMade() const;

private:
    friend class KeptKernels;
    void addKeeper();
    void removeKeeper() noexcept;

    using Key = std::pair<const void*, std::vector<std::pair<std::uint32_t, std::uint32_t>>>;
    struct Entry {
        std::weak_ptr<const Kernel> users;
        std::shared_ptr<const Kernel> kept; // set while there are KeptKernels
    };
    std::atomic<unsigned> threads_ = 1;
    mutable std::mutex mutex_; // guards all following members
    std::map<std::thread::id, std::size_t> pipelinesOf_;
    std::map<Key, Entry> entries_;
    int keepers_ = 0;
};

/// While an instance exists, the store keeps all kernels that it returns, even unused: between a simulation
/// and the next. Must not outlive the Device. Any thread.
class SINEW_API KeptKernels {
public:
    explicit KeptKernels(const Device& device);
    KeptKernels(const KeptKernels&) = delete;
    KeptKernels& operator=(const KeptKernels&) = delete;
    ~KeptKernels();

private:
    KernelStore& store_;
};

} // namespace sinew::vk
