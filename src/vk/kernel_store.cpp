// A map from shader code and constants to kernels.
#include "sinew/vk/kernel_store.hpp"

#include <utility>

namespace sinew::vk {

std::shared_ptr<const Kernel> KernelStore::get(const Device& device, const ShaderCode& code,
                                               std::span<const SpecialisationConstant> constants) {
    Key key{code.words.data(), {}};
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
