// How much more room a successor gets.
#include "sinew/ranges.hpp"
#include "sinew/rooms.hpp"

#include <gtest/gtest.h>

using namespace sinew::sim;

namespace {

constexpr std::uint32_t most = ranges::mostContactRoom, mostSurface = ranges::mostCutSurfaceRoom;

Settings withRooms(std::uint32_t contacts, std::uint32_t surface) {
    Settings settings{.substeps = 7};
    settings.contactRoom = contacts;
    settings.cutSurfaceRoom = surface;
    return settings;
}

} // namespace

TEST(Rooms, ForContactsAreHalfAsMuchAgainInGranules) {
    const Settings settings = withRooms(4, 500);
    Rooms rooms(settings);
    const std::pair<std::uint32_t, std::uint32_t> cases[] = {
        {5, 8}, {10, 16}, {100, 152}, {most / 2, 3 * most / 4}, {most - 100, most}, {most, most}};
    for (const auto& [needed, room] : cases) {
        const auto next = rooms.forContacts(settings, needed);
        ASSERT_TRUE(next);
        EXPECT_EQ(next->contactRoom, room) << needed;
        EXPECT_EQ(next->cutSurfaceRoom, 500u) << "the other room stays";
        EXPECT_EQ(next->substeps, 7u);
        EXPECT_EQ(rooms.contacts().needed, needed);
    }
    EXPECT_EQ(rooms.contacts().room, 4u) << "until a successor takes over";
    EXPECT_EQ(rooms.contacts().grown, 0u);
}

TEST(Rooms, ForMoreContactsThanThereCanBeAreNone) {
    const Settings settings = withRooms(4, 0);
    Rooms rooms(settings);
    EXPECT_FALSE(rooms.forContacts(settings, most + 1));
    EXPECT_FALSE(rooms.forContacts(settings, ~0u));
    EXPECT_EQ(rooms.contacts().needed, ~0u) << "what was needed is told all the same";
    EXPECT_TRUE(rooms.forContacts(settings, 5));
    EXPECT_EQ(rooms.contacts().needed, ~0u) << "of the largest need";
}

TEST(Rooms, ForTheSurfaceAreHalfAsMuchAgain) {
    const Settings settings = withRooms(4, 0);
    Rooms rooms(settings);
    EXPECT_FALSE(rooms.lackSurface(0));
    EXPECT_TRUE(rooms.lackSurface(1));
    const auto next = rooms.forSurface(settings, 1000);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->cutSurfaceRoom, 1500u);
    EXPECT_EQ(next->contactRoom, 4u) << "the other room stays";
    EXPECT_EQ(rooms.forSurface(settings, mostSurface)->cutSurfaceRoom, mostSurface);
    EXPECT_TRUE(rooms.lackSurface(1));
    EXPECT_FALSE(rooms.forSurface(settings, mostSurface + 1));
    EXPECT_FALSE(rooms.lackSurface(1)) << "there can be no such room";
    EXPECT_TRUE(rooms.surface().isShort);
    EXPECT_EQ(rooms.surface().needed, mostSurface + 1);
}

TEST(Rooms, WithoutMemoryForTheSurfaceLackNone) {
    Rooms rooms(withRooms(4, 0));
    ASSERT_TRUE(rooms.forSurface(withRooms(4, 0), 1000));
    rooms.refuseSurface();
    EXPECT_FALSE(rooms.lackSurface(1000));
    EXPECT_EQ(rooms.surface().room, 0u);
    Rooms elsewhere(withRooms(8, 0));
    elsewhere.continueFrom(rooms, withRooms(8, 0));
    EXPECT_TRUE(elsewhere.lackSurface(1000)) << "another device may have the memory";
}

TEST(Rooms, CountTheSuccessorsThatHadMore) {
    Rooms rooms(withRooms(4, 100));
    rooms.adopt(withRooms(4, 100));
    EXPECT_EQ(rooms.contacts().grown + rooms.surface().grown, 0u);
    rooms.adopt(withRooms(8, 100));
    rooms.adopt(withRooms(16, 200));
    EXPECT_EQ(rooms.contacts().grown, 2u);
    EXPECT_EQ(rooms.surface().grown, 1u);
    EXPECT_EQ(rooms.contacts().room, 16u);
    EXPECT_EQ(rooms.surface().room, 200u);
    Rooms next(withRooms(32, 400));
    next.continueFrom(rooms, withRooms(32, 400));
    EXPECT_EQ(next.contacts().grown, 2u) << "the counts are those of the whole run";
    EXPECT_EQ(next.surface().grown, 1u);
    EXPECT_EQ(next.contacts().room, 32u);
    EXPECT_EQ(next.surface().room, 400u);
}

TEST(Rooms, OfTwoSettingsAreTheLarger) {
    const Settings a = withRooms(4, 300), b = withRooms(8, 100), both = withRoomsOf(a, b);
    EXPECT_EQ(both.contactRoom, 8u);
    EXPECT_EQ(both.cutSurfaceRoom, 300u);
    EXPECT_TRUE(haveRoomsOf(both, a));
    EXPECT_TRUE(haveRoomsOf(both, b));
    EXPECT_FALSE(haveRoomsOf(a, b));
    EXPECT_FALSE(haveRoomsOf(b, a));
}
