// Pieces that more than one JSON document of the tools holds.
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

/// Bytes that are no UTF-8 (file names may hold them) are replaced; a line break ends the text.
std::string dump(const Json& json);

} // namespace sinew::tools
