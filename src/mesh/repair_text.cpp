// The report of repair() in sentences.
#include "mesh/repair.hpp"

#include "sim/core/counted.hpp"

#include <cstdio>

namespace sinew::mesh {
namespace {

using sim::counted;

const char* wasOrWere(std::size_t count) {
    return count == 1 ? " was " : " were ";
}

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

} // namespace

std::vector<std::string> sentencesOf(const Repairs& report) {
    std::vector<std::string> sentences;
    const auto say = [&](std::size_t count, const char* one, const char* many, const std::string& what) {
        if (count > 0) sentences.push_back(counted(count, one, many) + wasOrWere(count) + what);
    };
    say(report.joinedVertices, "vertex", "vertices",
        "joined with another one nearer than " + shortNumber(report.tolerance) + " in units of the file");
    say(report.splitEdges, "edge", "edges", "split at T-junctions");
    say(report.removedTriangles, "triangle", "triangles",
        "removed: degenerate, duplicate, sticking out or within the volume");
    say(report.closedHoles, "hole", "holes",
        "closed: " + counted(report.holeEdges, "edge", "edges") + ", " +
            counted(report.holeTriangles, "new triangle", "new triangles"));
    say(report.turnedTriangles, "triangle", "triangles", "reversed to agree with their neighbours");
    say(report.turnedParts, "closed part", "closed parts", "inside out and reversed");
    return sentences;
}

std::string openText(const Repairs& report) {
    std::string text = counted(report.openEdges, "boundary edge", "boundary edges");
    if (report.openHoles == 0) return text;
    const OpenHole& hole = report.largest;
    return text + " around " + counted(report.openHoles, "hole") + ", the largest with " +
           counted(hole.edges, "edge") + " and a rim of " + shortNumber(hole.rim) +
           " in units of the file around (" + shortNumber(double{hole.middle.x}) + ", " +
           shortNumber(double{hole.middle.y}) + ", " + shortNumber(double{hole.middle.z}) + ")";
}

} // namespace sinew::mesh
