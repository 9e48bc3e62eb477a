// Tests a shipped scene with faces in which cuts leave a lobe that lies on its own cut surface: it must not
// enter the body.
#include "scenes/blades.hpp"
#include "scenes/load.hpp"
#include "sim/cutting/cut_gaps.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

using namespace sinew;

TEST(Lobes, OfAnIncisedOrganDoNotEnterIt) {
    double without = -9, withFaces = -9;
    for (const bool hasFaces : {false, true}) {
        scenes::Overrides overrides;
        overrides.voxel = 0.03f;
        scenes::LoadedScene loaded =
            scenes::load(SINEW_SOURCE_FOLDER "/scenes/organ_incision.toml", overrides);
        sim::Scene& scene = loaded.scene;
        const double voxel = double{scene.grids[0].restLength[0]};
        for (sim::Particle& particle : scene.particles) particle.radius = static_cast<float>(voxel / 2);
        scene.faces.clear();
        if (hasFaces) sim::addSurfaceFaces(scene, scene.grids[0]);
        loaded.settings.substeps = 16;
        loaded.settings.contactRoom = 64;
        test::CutBody body(scene, loaded.settings);
        scenes::ScriptedBlades blades(loaded.blades, scene.dt);
        double parting = -9, most = -9, end = -9;
        std::size_t cut = 0;
        std::uint64_t lastCut = 0;
        for (std::uint64_t frame = 0; frame < 220; ++frame) {
            const sim::Status status = body.runner().cut(blades.at(frame));
            ASSERT_EQ(status.nonFinite, 0u);
            ASSERT_EQ(status.contactRoom, 0u);
            cut += status.linksCut;
            if (status.linksCut > 0) lastCut = frame;
            if (cut == 0 || (frame % 10 != 0 && frame >= lastCut + 8)) continue;
            std::set<std::array<std::uint32_t, 2>> links;
            for (const test::LiveLink& link : body.links()) {
                links.insert({link.a, link.b});
                links.insert({link.b, link.a});
            }
            const auto areApart = [&](std::uint32_t i, const test::Triangle& t) {
                return std::ranges::none_of(t, [&](std::uint32_t c) {
                    return c == i || links.contains({i, c});
                });
            };
            end = test::deepest(voxel, body.runner().positions(), surfaceOf(body), areApart);
            double& worst = frame < lastCut + 12 ? parting : most;
            worst = std::max(worst, end);
        }
        std::printf("%s faces: at most %.3f voxels nearer than touching, %.3f within 0.2 s of a cut, %.3f at "
                    "the end\n",
                    hasFaces ? "with" : "without", most, parting, end);
        EXPECT_GT(cut, 100u);
        EXPECT_GT(end, -0.1) << "the lobe lies on its wound";
        (hasFaces ? withFaces : without) = most;
        if (hasFaces) {
            EXPECT_LT(most, 0.1);
            EXPECT_LT(parting, 0.25) << "what was pressed together when it was cut parts slowly";
            EXPECT_LT(end, 0.05);
        } else {
            EXPECT_GT(std::max(most, parting), 0.1) << "particles alone let it in";
        }
    }
    EXPECT_LT(withFaces, without);
}
