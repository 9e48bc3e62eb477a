// Values of the C interface to those of the core, and back.
#pragma once

#include "capi/sizes.hpp"
#include "sinew/scene.hpp"

#include <cstring>
#include <span>

namespace sinew::capi {

inline sim::Vec3 toVec3(const SinewVec3& v) {
    return {v.x, v.y, v.z};
}
inline SinewVec3 fromVec3(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}
inline sim::Quaternion toQuaternion(const SinewQuaternion& q) {
    return {q.x, q.y, q.z, q.w};
}
inline sim::Pose toPose(const SinewPose& pose) {
    return {toVec3(pose.position), toQuaternion(pose.rotation)};
}
inline std::string nameOr(const char* name, const char* otherwise) {
    return name != nullptr ? name : otherwise;
}
inline sim::ColliderShape toShape(std::uint32_t shape) {
    if (shape > SINEW_BOX) invalidArgument("there is no shape " + std::to_string(shape));
    return static_cast<sim::ColliderShape>(shape);
}

/// Copies `text` into a field of fixed size, cut short between two characters of UTF-8.
template <std::size_t size> void copyText(const std::string& text, char (&field)[size]) {
    std::size_t length = text.size();
    if (length >= size) {
        length = size - 1;
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
    }
    std::memcpy(field, text.data(), length);
    std::memset(field + length, 0, size - length);
}

/// Copies bytes out as two calls of a function do: the first one asks for the size.
void copyOut(std::span<const std::byte> data, std::size_t* size, void* bytes);

sim::Settings toSettings(const SinewSettings* settings);
SinewSettings fromSettings(const sim::Settings& settings);

} // namespace sinew::capi
