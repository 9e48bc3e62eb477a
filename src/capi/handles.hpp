// Handles of the C interface: numbers with a generation, in one table of the process, so that a destroyed or
// foreign handle is detected and no call uses an object that another thread uses or destroys.
#pragma once

#include "sinew/sinew.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace sinew::capi {

/// A failure of a call, with its result and the sentence of sinewLastError().
struct Failed {
    SinewResult result;
    std::string sentence;
};

enum class Kind { device, scene, simulation, state, world, query };
const char* nameOf(Kind kind) noexcept;

enum class Access {
    read, ///< several threads may read
    write ///< one thread, and no reader
};

/// An object behind a handle.
class Object {
public:
    explicit Object(Kind kind) : kind_(kind) {}
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    virtual ~Object() = default;

private:
    friend class Table;
    const Kind kind_;
    std::atomic<int> users_ = 0; ///< readers, or -1 while it is written; grows under the mutex of the table
    // Guarded by the mutex of the table:
    std::size_t dependents_ = 0;  ///< objects that were made with this one and exist
    Object* parent_ = nullptr;    ///< that this one is a dependent of
    std::uint64_t companion_ = 0; ///< handle of an object that is destroyed with this one alone; 0 = none
    bool isCompanion_ = false;
};

/// Adds an object and returns its handle. `parent`, if not null, must not be destroyed before it.
std::uint64_t addObject(std::unique_ptr<Object> object, Object* parent = nullptr);
/// The same with a companion, which has a handle of its own and is destroyed before `object`, by no other
/// call.
std::uint64_t addObject(std::unique_ptr<Object> object, Object* parent, std::unique_ptr<Object> companion);
/// Handle of the companion of an object.
std::uint64_t companionOf(const Object& object) noexcept;
/// Gives the companion a new handle: the former one is stale. Both objects must be in use by this call.
void renewCompanion(Object& object) noexcept;
/// Throws Failed with SINEW_ERROR_INVALID_HANDLE or SINEW_ERROR_IN_USE.
Object& acquire(std::uint64_t id, Kind kind, Access access);
void release(Object& object, Access access) noexcept;
/// Destroys the object. Throws as acquire(), and if dependents exist.
void destroyObject(std::uint64_t id, Kind kind);

/// An object in use by this call. `T` names its `kind`.
template <typename T> class Use {
public:
    Use(std::uint64_t id, Access access)
        : object_(static_cast<T&>(acquire(id, T::kind, access))), access_(access) {}
    ~Use() { release(object_, access_); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

    T& operator*() const noexcept { return object_; }
    T* operator->() const noexcept { return &object_; }

private:
    T& object_;
    Access access_;
};

} // namespace sinew::capi
