// Names that are unknown are answered with those that there are.
#include "scenes/mesh_choice.hpp"

#include "mesh/components.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

constexpr std::size_t mostListed = 10;

std::string quoted(const std::string& text) {
    return "\"" + text.substr(0, 64) + "\"";
}

} // namespace

UnknownObject unknownObject(const mesh::TriangleMesh& mesh, const std::string& file,
                            const std::string& name) {
    if (name.starts_with("part ") && name.find(", piece ") != std::string::npos)
        return {"names " + quoted(name) + ", which only numbers a piece that a choice left of " +
                    quoted(name.substr(0, name.find(", piece "))),
                "choose as before, and have its pieces as bodies by parts = \"apart\""};
    const std::vector<std::string> known = mesh::names(mesh);
    const auto nearest = std::ranges::min_element(
        known, {}, [&](const std::string& other) { return editDistance(name.substr(0, 64), other); });
    const bool isNear =
        2 * editDistance(name.substr(0, 64), *nearest) <= std::max<std::size_t>(name.size(), 2);
    std::string list;
    for (std::size_t i = 0; i < known.size() && i < mostListed; ++i)
        list += (i == 0 ? "" : ", ") + quoted(known[i]);
    if (known.size() > mostListed) list += " and " + std::to_string(known.size() - mostListed) + " more";
    return {"names " + quoted(name) + ", which no object of " + file + " is called",
            (isNear ? "did you mean " + quoted(*nearest) + "? There are " : "there are ") + list};
}

bool chooseObjects(mesh::TriangleMesh& mesh, const Section& section, const std::string& file) {
    if (!section.has("object")) return false;
    if (!section.has("file")) section.fail("object", "is given, but a generated shape has none", "remove it");
    const std::vector<std::string> names = section.names("object");
    if (names.empty()) section.fail("object", "names none", "name some, or leave the key out");
    std::string unknown;
    std::optional<mesh::TriangleMesh> chosen = mesh::choose(mesh, names, unknown);
    if (!chosen) {
        const UnknownObject complaint = unknownObject(mesh, file, unknown);
        section.fail("object", complaint.why, complaint.whatToDo);
    }
    if (chosen->triangles.empty()) section.fail("object", "has no triangles in " + file, "name another");
    mesh = std::move(*chosen);
    return true;
}

} // namespace sinew::scenes
