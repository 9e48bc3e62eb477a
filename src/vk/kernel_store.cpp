// A map from shader code and constants to kernels.
#include "sinew/vk/kernel_store.hpp"

#include <algorithm>
#include <exception>
#include <future>
#include <utility>

namespace sinew::vk {

std::shared_ptr<const Kernel> KernelStore::get(const Device& device, const ShaderCode& code,
                                               std::span<const SpecialisationConstant> constants) {
    Key key{code.identity(), {}};
    for (const SpecialisationConstant& constant : constants)
        key.second.emplace_back(constant.id, constant.value);
    const auto find = [&]() -> std::shared_ptr<const Kernel> {
        const auto found = entries_.find(key);
        return found == entries_.end() ? nullptr : found->second.users.lock();
    };
    const auto keep = [&](const std::shared_ptr<const Kernel>& kernel) {
        if (keepers_ > 0) entries_.at(key).kept = kernel;
        return kernel;
    };
    {
        const std::scoped_lock lock(mutex_);
        if (const std::shared_ptr<const Kernel> kernel = find()) return keep(kernel);
    }
    auto made = std::make_shared<const Kernel>(device, code, constants); // slow: other threads need not wait
    const std::scoped_lock lock(mutex_);
    if (const std::shared_ptr<const Kernel> kernel = find()) return keep(kernel); // another thread was faster
    std::erase_if(entries_, [](const auto& entry) { return entry.second.users.expired(); });
    entries_[key].users = made;
    return keep(made);
}

std::vector<std::shared_ptr<const Kernel>> KernelStore::getAll(const Device& device,
                                                               std::span<const Request> requests) {
    std::vector<std::shared_ptr<const Kernel>> kernels(requests.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t k; (k = next++) < requests.size();)
            kernels[k] = get(device, *requests[k].code, requests[k].constants);
    };
    std::vector<std::future<std::size_t>> others; // each returns the pipelines that it made
    const std::size_t threads = std::min<std::size_t>(threads_, requests.size());
    try {
        for (std::size_t t = 1; t < threads; ++t)
            others.push_back(std::async(std::launch::async, [&] {
                const std::size_t before = pipelinesMade(); // an identity may be that of an earlier thread
                work();
                return pipelinesMade() - before;
            }));
    } catch (const std::system_error&) { // no more threads: those that run make all
    }
    std::exception_ptr error;
    const auto attempt = [&](const auto& part) {
        try {
            part();
        } catch (...) {
            if (!error) error = std::current_exception();
        }
    };
    attempt(work);
    std::size_t made = 0;
    for (std::future<std::size_t>& other : others) attempt([&] { made += other.get(); });
    const std::scoped_lock lock(mutex_);
    pipelinesOf_[std::this_thread::get_id()] += made;
    if (error) std::rethrow_exception(error);
    return kernels;
}

void KernelStore::countPipeline() {
    const std::scoped_lock lock(mutex_);
    ++pipelinesOf_[std::this_thread::get_id()];
}

std::size_t KernelStore::pipelinesMade() const {
    const std::scoped_lock lock(mutex_);
    const auto found = pipelinesOf_.find(std::this_thread::get_id());
    return found == pipelinesOf_.end() ? 0 : found->second;
}

void KernelStore::addKeeper() {
    const std::scoped_lock lock(mutex_);
    ++keepers_;
}

void KernelStore::removeKeeper() noexcept {
    const std::scoped_lock lock(mutex_);
    if (--keepers_ > 0) return;
    for (auto& [key, entry] : entries_) entry.kept.reset();
}

KeptKernels::KeptKernels(const Device& device) : store_(device.kernels()) {
    store_.addKeeper();
}

KeptKernels::~KeptKernels() {
    store_.removeKeeper();
}

} // namespace sinew::vk
