// Tests of mesh components: how they are counted, named, selected and described.
#include "mesh/components.hpp"

#include "mesh/generate.hpp"
#include "meshes.hpp"
#include "support/time_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

TriangleMesh cube(float low, float high) {
    return box({low, low, low}, {high, high, high});
}

/// Assigns the triangles to objects of the given names and sizes, in order.
TriangleMesh withObjects(TriangleMesh mesh, const std::vector<std::pair<std::string, std::size_t>>& objects) {
    for (const auto& [name, size] : objects) {
        mesh.objects.insert(mesh.objects.end(), size,
                            name.empty() ? noObject : static_cast<std::uint32_t>(mesh.objectNames.size()));
        if (!name.empty()) mesh.objectNames.push_back(name);
    }
    return mesh;
}

std::vector<std::string> describeAll(const TriangleMesh& mesh) {
    std::vector<std::string> lines;
    for (const Component& component : components(mesh)) lines.push_back(describe(component));
    return lines;
}

} // namespace

TEST(Components, AreConnectedByVerticesAndSortedByVolume) {
    const TriangleMesh small = cube(0, 1), large = cube(2, 4);
    EXPECT_EQ(
        describeAll(joined(small, large)),
        (std::vector<std::string>{"\"part 1\": 12 triangles, 8 m^3", "\"part 2\": 12 triangles, 1 m^3"}));
    MeshDefects defects;
    EXPECT_EQ(components(weld(joined(small, cube(1, 2)), defects)).size(), 1u) << "they share a corner";
    EXPECT_EQ(components(generate("torus_knot", 16)).size(), 1u);
    EXPECT_TRUE(components(TriangleMesh{}).empty());
    const Component second = components(joined(small, large))[1];
    EXPECT_EQ(inspect(extract(joined(small, large), second)).high.x, 1);
}

TEST(Components, OfAnOpenMeshSaySo) {
    TriangleMesh open = cube(0, 1);
    open.triangles.pop_back();
    const std::vector<std::string> lines = describeAll(joined(open, cube(2, 2.5f)));
    EXPECT_EQ(lines, (std::vector<std::string>{"\"part 1\": 11 triangles, open",
                                               "\"part 2\": 12 triangles, 0.125 m^3"}))
        << "the guess of what a hole leaves open is good enough to sort by";
}

TEST(Components, HoldTheirCavities) {
    TriangleMesh hollow = joined(cube(0, 4), inverted(cube(1, 2)));
    EXPECT_EQ(describeAll(hollow), std::vector<std::string>{"\"part 1\": 24 triangles, 63 m^3, 1 cavity"});
    hollow = joined(hollow, inverted(cube(2.5f, 3.5f)));
    EXPECT_EQ(describeAll(hollow), std::vector<std::string>{"\"part 1\": 36 triangles, 62 m^3, 2 cavities"});

    const TriangleMesh stone = joined(hollow, cube(1.25f, 1.75f)); // the stone lies in the first cavity
    EXPECT_EQ(describeAll(stone), (std::vector<std::string>{"\"part 1\": 36 triangles, 62 m^3, 2 cavities",
                                                            "\"part 2\": 12 triangles, 0.125 m^3"}));
    const TriangleMesh nested = joined(stone, inverted(cube(1.4f, 1.5f)));
    EXPECT_EQ(components(nested)[0].cavities, 2u);
    EXPECT_EQ(components(nested)[1].cavities, 1u) << "goes to the smallest around it";

    EXPECT_EQ(components(joined(cube(0, 4), inverted(cube(5, 6)))).size(), 2u) << "beside, not inside";
    EXPECT_NEAR(components(joined(cube(0, 4), inverted(cube(5, 6))))[1].volume, 1, 1e-6);
    EXPECT_EQ(components(joined(cube(0, 4), cube(1, 2))).size(), 2u) << "turned outward it is a body inside";
    TriangleMesh tube = generate("tube", 16);
    const std::size_t parts = components(tube).size();
    EXPECT_EQ(components(joined(tube, inverted(scaled(cube(-0.5f, 0.5f), 1e-3f)))).size(), parts + 1)
        << "in the middle of a tube, outside of it";
}

// Both sides of a flat square. Its volume is rounding noise, with a sign that depends on the scale.
TEST(Components, WithoutAVolumeAreNoCavitiesAtAnyScale) {
    TriangleMesh square;
    square.positions = {
        {0.31f, 0.17f, 0.43f}, {0.47f, 0.29f, 0.51f}, {0.53f, 0.61f, 0.7f}, {0.37f, 0.49f, 0.62f}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
    for (const float factor : {0.001f, 0.0011f, 0.0015f, 0.002f, 0.004f, 0.01f, 0.1f, 1.0f, 7.0f, 1000.0f}) {
        const std::vector<Component> found = components(scaled(joined(cube(0, 1), square), factor));
        ASSERT_EQ(found.size(), 2u) << factor;
        EXPECT_EQ(found[0].cavities, 0u) << factor;
        EXPECT_FALSE(found[1].isInward) << factor;
    }
}

TEST(Components, AreCalledAsTheirObjectsWhereTheyAreAllOfIt) {
    const TriangleMesh mesh =
        withObjects(joined(joined(cube(0, 1), cube(2, 4)), joined(cube(5, 5.5f), cube(6, 6.25f))),
                    {{"liver", 12}, {"", 12}, {"vessels", 24}});
    EXPECT_EQ(describeAll(mesh),
              (std::vector<std::string>{"\"part 1\": 12 triangles, 8 m^3", "\"liver\": 12 triangles, 1 m^3",
                                        "\"part 3\": 12 triangles, 0.125 m^3",
                                        "\"part 4\": 12 triangles, 0.0156 m^3"}));
    EXPECT_EQ(names(mesh),
              (std::vector<std::string>{"liver", "vessels", "part 1", "part 2", "part 3", "part 4"}));
}

TEST(Components, AreChosenByName) {
    const TriangleMesh mesh =
        withObjects(joined(joined(cube(0, 1), cube(2, 4)), joined(cube(5, 5.5f), cube(6, 6.25f))),
                    {{"liver", 12}, {"", 12}, {"vessels", 24}});
    std::string unknown;
    const auto volume = [&](const std::vector<std::string>& chosen) {
        const auto result = choose(mesh, chosen, unknown);
        return result ? inspect(*result).volume : -1;
    };
    EXPECT_NEAR(volume({"liver"}), 1, 1e-6);
    EXPECT_NEAR(volume({"vessels"}), 0.125 + 0.015625, 1e-6);
    EXPECT_NEAR(volume({"part 1"}), 8, 1e-6);
    EXPECT_NEAR(volume({"part 2"}), 1, 1e-6) << "a number counts those with names, too";
    EXPECT_NEAR(volume({"liver", "part 1", "part 2"}), 9, 1e-6);
    EXPECT_EQ(choose(mesh, {"liver"}, unknown)->objects.size(), 12u);
    EXPECT_TRUE(unknown.empty());
    for (const std::string name : {"Liver", "part 0", "part 5", "part", "part 1x", "part -1", ""}) {
        EXPECT_EQ(volume({"liver", name}), -1) << name;
        EXPECT_EQ(unknown, name);
    }
}

TEST(Components, OfAChoiceKeepTheirNumbers) {
    const TriangleMesh mesh =
        withObjects(joined(joined(cube(0, 1), cube(2, 4)), joined(cube(5, 5.5f), cube(6, 6.25f))),
                    {{"liver", 12}, {"", 12}, {"vessels", 24}});
    std::string unknown;
    EXPECT_EQ(
        describeAll(*choose(mesh, {"part 4", "liver"}, unknown)),
        (std::vector<std::string>{"\"liver\": 12 triangles, 1 m^3", "\"part 4\": 12 triangles, 0.0156 m^3"}));
    EXPECT_EQ(describeAll(*choose(mesh, {"vessels"}, unknown)),
              (std::vector<std::string>{"\"part 3\": 12 triangles, 0.125 m^3",
                                        "\"part 4\": 12 triangles, 0.0156 m^3"}));
    MeshDefects defects;
    const TriangleMesh welded = weld(*choose(mesh, {"part 3"}, unknown), defects);
    EXPECT_EQ(components(welded)[0].name, "part 3") << "through every further step";
}

TEST(Components, OfAChoiceAreCountedAsPiecesWhereItPartsOne) {
    MeshDefects defects; // two cubes, connected by a third one
    const TriangleMesh row =
        weld(joined(joined(cube(0, 1), joined(cube(1, 2), cube(2, 4))), cube(10, 15)), defects);
    TriangleMesh mesh = withObjects(row, {{"ends", 12}, {"middle", 12}, {"", 24}});
    std::fill_n(mesh.objects.begin() + 24, 12, 0u);
    std::string unknown;
    EXPECT_EQ(describeAll(*choose(mesh, {"ends"}, unknown)),
              (std::vector<std::string>{"\"part 2\": 12 triangles, 8 m^3",
                                        "\"part 2, piece 2\": 12 triangles, 1 m^3"}));
}

TEST(Components, AreNamedInTimeThatGrowsAsTheirNumber) {
    TriangleMesh mesh = withObjects(TriangleMesh{}, {});
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        const float x = static_cast<float>(i);
        for (const Vec3 corner : {Vec3{x, 0, 0}, Vec3{x + 0.5f, 0, 0}, Vec3{x, 0.5f, 0}, Vec3{x, 0, 0.5f}})
            mesh.positions.push_back(corner);
        for (const auto& [a, b, c] :
             {std::array{0u, 2u, 1u}, std::array{0u, 1u, 3u}, std::array{1u, 2u, 3u}, std::array{0u, 3u, 2u}})
            mesh.triangles.push_back({4 * i + a, 4 * i + b, 4 * i + c});
    }
    mesh.objects.assign(mesh.triangles.size(), noObject);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        mesh.objectNames.push_back("a long name of an object " + std::to_string(i));
        for (std::uint32_t k = 0; k < 4; ++k) mesh.objects[4 * i + k] = i;
    }
    const sinew::test::ProcessorTime taken;
    const std::vector<std::string> all = names(mesh);
    std::string unknown;
    const auto chosen = choose(mesh, all, unknown);
    const double seconds = taken.seconds();
    EXPECT_EQ(all.size(), 220'000u);
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->triangles.size(), mesh.triangles.size());
    EXPECT_LT(seconds, 20) << "a name against every other takes minutes";
}
