// JSON parts shared by several documents of the tools.
#pragma once

#include "mesh/repair.hpp"
#include "sinew/measure.hpp"

#include <nlohmann/json.hpp>

namespace sinew::tools {

using Json = nlohmann::ordered_json; // fields in the order in which they are documented

template <typename Value> Json orNull(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json toJson(const Errors& errors);
Json toJson(const sim::Vec3& v);
Json toJson(const mesh::Repairs& repairs);

/// Text of a document; ends with a line break. Replaces bytes that are not UTF-8, which file names may
/// contain.
std::string dump(const Json& json);

} // namespace sinew::tools
