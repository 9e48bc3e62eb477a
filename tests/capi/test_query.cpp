// Rays and regions in C.
#include "sinew/sinew_query.h"

#include "capi/support.hpp"

#include <algorithm>

namespace sinew::test {
namespace {

using Query = Owned<SinewQuery, sinewDestroyQuery>;
using World = Owned<SinewWorld, sinewDestroyWorld>;

constexpr SinewQueryRoom room{sizeof(SinewQueryRoom), 2, 10, 2};
constexpr SinewRay down{{0.1f, 3, 0.1f}, {0, -1, 0}, 0, 0};
constexpr SinewRegion around{{0.1f, 0.3f, 0.1f}, {0, 0, 0}, 0.11f, 0}; // a node and its six neighbours

class CApiQuery : public OnDevice {
protected:
    SinewRayHit cast(SinewQuery query, const SinewRay& ray) {
        SinewRayHit hit{};
        hit.size = sizeof hit;
        EXPECT_TRUE(isOk(sinewCastRay(query, &ray, &hit)));
        return hit;
    }
};

} // namespace

TEST_F(CApiQuery, FindsWhatARayMeetsAndWhatARegionHolds) {
    Scene scene;
    makeCube(scene); // two cells of 0.1 m a side, from a height of 0.2 m on
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    Query query;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    ASSERT_TRUE(isOk(sinewCreateQuery(device, scene, &room, &query)));
    SinewRayHit hit{};
    hit.size = sizeof hit;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "no simulation", sinewCastRay(query, &down, &hit)));
    ASSERT_TRUE(isOk(sinewSetQuerySimulation(query, simulation)));
    hit = cast(query, down);
    EXPECT_EQ(hit.isMet, 1u);
    EXPECT_EQ(hit.body, 0u);
    EXPECT_NEAR(hit.distance, 2.6f, 1e-5f);
    EXPECT_NEAR(hit.place.y, 0.4f, 1e-6f);
    SinewRay beside = down;
    beside.origin.x = 2;
    EXPECT_EQ(cast(query, beside).isMet, 0u);
    beside = down;
    beside.length = 2.5f;
    EXPECT_EQ(cast(query, beside).isMet, 0u) << "it ends before the cube";

    std::array<std::uint32_t, 5> particles{};
    std::uint32_t count = 5;
    ASSERT_TRUE(isOk(sinewFindParticles(query, &around, &count, particles.data())));
    EXPECT_EQ(count, 7u);
    EXPECT_TRUE(std::is_sorted(particles.begin(), particles.end()));

    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 10)));
    EXPECT_GT(cast(query, down).distance, 2.65f) << "the cube has fallen";

    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "slot", sinewGetRayHit(query, 2, 0, &hit)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "ray", sinewGetRayHit(query, 0, 2, &hit)));
    ASSERT_TRUE(isOk(sinewDestroySimulation(simulation)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "simulation", sinewCastRay(query, &down, &hit)));
}

TEST_F(CApiQuery, RefusesSimulationsOfOtherScenes) {
    Scene scene, other;
    makeCube(scene);
    makeCube(other, 3);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    Query query;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, other, &settings, &simulation)));
    ASSERT_TRUE(isOk(sinewCreateQuery(device, scene, &room, &query)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_MISMATCH, "64 particles", sinewSetQuerySimulation(query, simulation)));
    SinewQueryRoom none = room;
    none.rays = 0;
    Query empty;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "rays", sinewCreateQuery(device, scene, &none, &empty)));
}

TEST_F(CApiQuery, OfAWorldEndsWithATakeOver) {
    Scene base, cube;
    makeCube(base, 2, 5);
    makeCube(cube);
    const SinewSettings settings = sinewDefaultSettings();
    World world;
    Query before, after;
    SinewPart part;
    ASSERT_TRUE(isOk(sinewCreateWorld(device, base, &settings, &world)));
    ASSERT_TRUE(isOk(sinewCreateWorldQuery(world, &room, &before)));
    EXPECT_EQ(cast(before, down).isMet, 0u) << "the base is above the ray";
    ASSERT_TRUE(isOk(sinewAddPart(world, cube, &part)));
    ASSERT_TRUE(isOk(sinewUpdateWorld(world)));
    SinewRayHit hit{};
    hit.size = sizeof hit;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "simulation", sinewCastRay(before, &down, &hit)));
    ASSERT_TRUE(isOk(sinewCreateWorldQuery(world, &room, &after)));
    hit = cast(after, down);
    EXPECT_EQ(hit.isMet, 1u);
    EXPECT_EQ(hit.body, 1u);
    EXPECT_NEAR(hit.distance, 2.6f, 1e-5f);
}

} // namespace sinew::test
