// Sizes of structs of hosts, which may have been compiled with the headers of another version: theirs are
// then shorter or longer than ours.
#pragma once

#include "capi/call.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace sinew::capi {

/// Sizes of T in headers of earlier versions, each the offset of the first member that it lacks. A new member
/// begins where the struct ended, not in its padding, and its offset is added here: tests/capi/check_abi.py
/// checks both.
template <typename T> inline constexpr std::array<std::uint32_t, 0> formerSizes{};
template <>
inline constexpr std::array<std::uint32_t, 1> formerSizes<SinewHostDevice>{
    offsetof(SinewHostDevice, allocation)};
template <>
inline constexpr std::array<std::uint32_t, 1> formerSizes<SinewCloth>{offsetof(SinewCloth, toughness)};
template <>
inline constexpr std::array<std::uint32_t, 2> formerSizes<SinewMesh>{offsetof(SinewMesh, toughness),
                                                                     offsetof(SinewMesh, textureCoordinates)};
template <>
inline constexpr std::array<std::uint32_t, 3> formerSizes<SinewSettings>{
    offsetof(SinewSettings, hasSharpClamp), offsetof(SinewSettings, outputFrames),
    offsetof(SinewSettings, outputUsage)};

/// Throws unless `size` is `known`, one of `former`, or larger than `known` and at most that of a page.
void requireSize(const char* type, std::uint32_t size, std::size_t known,
                 std::span<const std::uint32_t> former);
/// Throws unless all bytes that a larger struct has behind `known` are 0.
void requireZeros(const char* type, const void* pointer, std::uint32_t size, std::size_t known);

/// The size that a host set in a struct, after a check. The rest of the struct is not read.
template <typename T> std::uint32_t sizeOf(const T* pointer, const char* type) {
    requireNotNull(pointer, type);
    std::uint32_t size;
    std::memcpy(&size, pointer, sizeof size);
    requireSize(type, size, sizeof(T), formerSizes<T>);
    return size;
}

/// A copy of the description of a host. Members that the host's header lacks have the values of `defaults()`,
/// which is called only then.
template <typename T, typename Defaults>
T described(const T* pointer, const char* type, Defaults&& defaults) {
    const std::uint32_t size = sizeOf(pointer, type);
    requireZeros(type, pointer, size, sizeof(T));
    T description = size < sizeof(T) ? defaults() : T{};
    std::memcpy(&description, pointer, std::min<std::size_t>(size, sizeof(T)));
    description.size = sizeof(T);
    return description;
}

template <typename T> T described(const T* pointer, const char* type) {
    return described(pointer, type, [] { return T{}; });
}

/// Copies `from` into a struct of `size` bytes: a shorter one gets its first members, a longer one zeros
/// behind ours.
template <typename T> void copyTo(void* to, std::uint32_t size, T from) {
    from.size = size;
    std::memset(to, 0, size);
    std::memcpy(to, &from, std::min<std::size_t>(size, sizeof(T)));
}

/// A struct of a host that receives a result. The constructor checks its size.
template <typename T> class Result {
public:
    Result(T* to, const char* type) : to_(to), size_(sizeOf(to, type)) {}
    void give(const T& result) const { copyTo(to_, size_, result); }

private:
    T* to_;
    std::uint32_t size_;
};

// Descriptions with their default values.
SinewDeviceRequest defaultDeviceRequest();
SinewHostDevice defaultHostDevice();
SinewPlane defaultPlane();
SinewCollider defaultCollider();
SinewCloth defaultCloth();
SinewLattice defaultLattice();
SinewMesh defaultMesh();
SinewSettings defaultSettings();
SinewStep defaultStep();

} // namespace sinew::capi
