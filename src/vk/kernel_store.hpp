// Kernels that several users of a device share, so that each is made once: simulations of one scene in other
// forms, or one after the other, differ in a few of some fifty.
#pragma once

#include "vk/kernel.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace sinew::vk {

/// What a Device has one of (Device::kernels). Any thread.
class KernelStore {
public:
    /// The kernel of this code and these constants, in their order, that somebody has or that is kept, else a
    /// new one. Code is known by where its words are: these must stay there as long as the store, as what is
    /// compiled in does. Must not outlive `device`, whose store this is. Throws as Kernel.
    std::shared_ptr<const Kernel> get(const Device& device, const ShaderCode& code,
                                      std::span<const SpecialisationConstant> constants);

    /// Says that the calling thread has made a pipeline of the device, and how many it has: a thread that
    /// must not wait for compilers can show that it makes none.
    void countPipeline();
    std::size_t pipelinesMade() const;

private:
    friend class KeptKernels;
    void addKeeper();
    void removeKeeper() noexcept;

    using Key = std::pair<const std::uint32_t*, std::vector<std::pair<std::uint32_t, std::uint32_t>>>;
    struct Entry {
        std::weak_ptr<const Kernel> users;
        std::shared_ptr<const Kernel> kept; // while there are keepers
    };
    mutable std::mutex mutex_; // of all that follows
    std::map<std::thread::id, std::size_t> pipelinesOf_;
    std::map<Key, Entry> entries_;
    int keepers_ = 0;
};

/// While one is there, a store keeps what it gives though nobody uses it: between a simulation and the next.
/// Must not outlive the Device. Any thread.
class KeptKernels {
public:
    explicit KeptKernels(const Device& device);
    KeptKernels(const KeptKernels&) = delete;
    KeptKernels& operator=(const KeptKernels&) = delete;
    ~KeptKernels();

private:
    KernelStore& store_;
};

} // namespace sinew::vk
