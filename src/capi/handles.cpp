// The table of handles. It is a global of the process: a handle carries no pointer, so that one that was
// destroyed can be looked up without reading freed memory.
#include "capi/handles.hpp"

#include <mutex>
#include <vector>

namespace sinew::capi {

namespace {

std::uint64_t handleOf(std::uint32_t generation, std::size_t index) {
    return std::uint64_t{generation} << 32 | (index + 1);
}

} // namespace

const char* nameOf(Kind kind) noexcept {
    switch (kind) {
    case Kind::device:
        return "device";
    case Kind::scene:
        return "scene";
    case Kind::simulation:
        return "simulation";
    case Kind::state:
        return "state";
    case Kind::world:
        return "world";
    case Kind::query:
        break;
    }
    return "query";
}

class Table {
public:
    std::uint64_t add(std::unique_ptr<Object> object, Object* parent, std::unique_ptr<Object> companion) {
        const std::lock_guard lock(mutex_);
        reserveTwo();
        if (companion) {
            companion->isCompanion_ = true;
            object->companion_ = place(std::move(companion));
        }
        object->parent_ = parent;
        if (parent != nullptr) ++parent->dependents_;
        return place(std::move(object));
    }

    std::uint64_t companionOf(const Object& object) noexcept {
        const std::lock_guard lock(mutex_);
        return object.companion_;
    }

    void renewCompanion(Object& object) noexcept {
        const std::lock_guard lock(mutex_);
        const std::size_t index = (object.companion_ & 0xffffffff) - 1;
        object.companion_ = handleOf(++slots_[index].generation, index);
    }

    Object& acquire(std::uint64_t id, Kind kind, Access access) {
        const std::lock_guard lock(mutex_);
        Object& object = *find(id, kind).object;
        const int users = object.users_.load(std::memory_order_acquire);
        if (users < 0 || (access == Access::write && users > 0)) throw inUse(kind);
        if (access == Access::write)
            object.users_.store(-1, std::memory_order_relaxed);
        else
            object.users_.fetch_add(1, std::memory_order_relaxed);
        return object;
    }

    // Without the mutex: this is most of what the interface adds to recording.
    static void release(Object& object, Access access) noexcept {
        object.users_.fetch_add(access == Access::write ? 1 : -1, std::memory_order_release);
    }

    void destroy(std::uint64_t id, Kind kind) {
        std::unique_ptr<Object> object, companion;
        {
            const std::lock_guard lock(mutex_);
            Slot& slot = find(id, kind);
            if (slot.object->isCompanion_)
                throw Failed{SINEW_ERROR_IN_USE, "the " + std::string(nameOf(kind)) +
                                                     " belongs to a world, and is destroyed with it"};
            requireUnused(*slot.object);
            Slot* other = nullptr;
            if (const std::uint64_t its = slot.object->companion_) {
                other = &slots_[(its & 0xffffffff) - 1];
                requireUnused(*other->object);
            }
            object = takeOut(slot);
            if (other != nullptr) companion = takeOut(*other);
        }
        Object* parent = object->parent_;
        companion.reset(); // without the lock: a simulation waits for its queue
        object.reset();
        const std::lock_guard lock(mutex_);
        if (parent != nullptr) --parent->dependents_;
    }

private:
    static constexpr std::size_t none = ~std::size_t{0};
    struct Slot {
        std::unique_ptr<Object> object; // null if the slot is free
        std::uint32_t generation = 1;   // of the object, or of the next one
        std::size_t nextFree = none;
    };

    /// Makes two free slots, so that placing objects cannot fail.
    void reserveTwo() {
        while (free_ == none || slots_[free_].nextFree == none) {
            slots_.emplace_back();
            slots_.back().nextFree = free_;
            free_ = slots_.size() - 1;
        }
    }

    std::uint64_t place(std::unique_ptr<Object> object) noexcept {
        const std::size_t index = free_;
        free_ = slots_[index].nextFree;
        slots_[index].object = std::move(object);
        return handleOf(slots_[index].generation, index);
    }

    std::unique_ptr<Object> takeOut(Slot& slot) noexcept {
        ++slot.generation;
        slot.nextFree = free_;
        free_ = static_cast<std::size_t>(&slot - slots_.data());
        return std::move(slot.object);
    }

    static void requireUnused(const Object& object) {
        if (object.users_.load(std::memory_order_acquire) != 0) throw inUse(object.kind_);
        if (const std::size_t count = object.dependents_)
            throw Failed{
                SINEW_ERROR_IN_USE,
                "the " + std::string(nameOf(object.kind_)) + " is still used by " + std::to_string(count) +
                    (count > 1 ? " simulations or worlds" : " simulation or world") + ": destroy them first"};
    }

    static Failed inUse(Kind kind) {
        return {SINEW_ERROR_IN_USE,
                "another thread uses the " + std::string(nameOf(kind)) + ": only one may at a time"};
    }

    static std::string handleOfThe(Kind kind) { return "the handle of the " + std::string(nameOf(kind)); }

    Slot& find(std::uint64_t id, Kind kind) {
        const std::uint64_t index = (id & 0xffffffff) - 1;
        if (id == 0) throw Failed{SINEW_ERROR_INVALID_HANDLE, handleOfThe(kind) + " is null"};
        if (index >= slots_.size() || slots_[index].generation < id >> 32)
            throw Failed{SINEW_ERROR_INVALID_HANDLE, handleOfThe(kind) + " was never given out"};
        Slot& slot = slots_[index];
        if (slot.generation != id >> 32 || !slot.object)
            throw Failed{SINEW_ERROR_INVALID_HANDLE,
                         "the " + std::string(nameOf(kind)) + " was destroyed" +
                             (kind == Kind::simulation ? ", or its world has taken changes over since" : "")};
        if (slot.object->kind_ != kind)
            throw Failed{SINEW_ERROR_INVALID_HANDLE,
                         handleOfThe(kind) + " is that of a " + std::string(nameOf(slot.object->kind_))};
        return slot;
    }

    std::mutex mutex_; // guards all members, and those of Object
    std::vector<Slot> slots_;
    std::size_t free_ = none;
};

namespace {

// Never destroyed, so that objects may be used until the process ends.
Table& table() {
    static Table* const only = new Table;
    return *only;
}

} // namespace

std::uint64_t addObject(std::unique_ptr<Object> object, Object* parent) {
    return table().add(std::move(object), parent, nullptr);
}
std::uint64_t addObject(std::unique_ptr<Object> object, Object* parent, std::unique_ptr<Object> companion) {
    return table().add(std::move(object), parent, std::move(companion));
}
std::uint64_t companionOf(const Object& object) noexcept {
    return table().companionOf(object);
}
void renewCompanion(Object& object) noexcept {
    table().renewCompanion(object);
}
Object& acquire(std::uint64_t id, Kind kind, Access access) {
    return table().acquire(id, kind, access);
}
void release(Object& object, Access access) noexcept {
    Table::release(object, access);
}
void destroyObject(std::uint64_t id, Kind kind) {
    table().destroy(id, kind);
}

} // namespace sinew::capi
