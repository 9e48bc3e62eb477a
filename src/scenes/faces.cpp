#include "scenes/faces.hpp"

#include "scenes/bodies.hpp"
#include "sinew/bodies.hpp"

#include <algorithm>

namespace sinew::scenes {

void FaceChoices::add(LoadedScene& loaded, const Section& body, std::size_t first) {
    sim::Scene& scene = loaded.scene;
    const bool isAsked = body.has("faces") && body.flag("faces");
    if (isAsked && !isColliding(loaded, body)) refuseUntouching(loaded, body, "faces");
    if (isAsked && first == scene.grids.size())
        body.fail("faces", "is not possible so far from the origin", "move the body nearer to it");
    for (std::size_t g = first; g < scene.grids.size(); ++g)
        if (isAsked)
            sim::addSurfaceFaces(scene, scene.grids[g]);
        else if (!body.has("faces"))
            open_.push_back(static_cast<std::uint32_t>(g));
}

void FaceChoices::settle(LoadedScene& loaded) const {
    for (const std::uint32_t g : sim::gridsWithHoles(loaded.scene))
        if (std::ranges::binary_search(open_, g)) sim::addSurfaceFaces(loaded.scene, loaded.scene.grids[g]);
}

} // namespace sinew::scenes
