// The host side of contacts with faces: the participants, and the order of the passes.
#include "sim/collision/face_contacts.hpp"

#include "common/rest_slack.h"
#include "kernels.hpp"
#include "sim/collision/contact_lists.hpp"
#include "sim/collision/cut_contacts.hpp"
#include "sim/collision/cut_faces.hpp"
#include "sim/collision/debris_contacts.hpp"
#include "sim/forces/forces.hpp"
#include "sim/lattice/squares.hpp"
#include "sim/sleep/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sinew::sim::collision::face_contacts {

namespace {

namespace k = kernels;

bool moves(const Face& face, const std::vector<float>& inverseMass) {
    return std::ranges::any_of(face.particles, [&](std::uint32_t i) { return inverseMass[i] > 0; });
}

// The median of all values that are not below 0.
float median(std::vector<float> values) {
    std::erase_if(values, [](float value) { return value < 0; });
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Faces between particles: faces of sheets and then of solids with a moving corner, faces that a cut may
// expose, and static or driven faces.
struct Faces {
    std::vector<layout::ContactFace> faces;
    std::vector<float> extents; ///< below 0 for faces that a cut may expose
    std::vector<bool> isOfCells;
    std::uint32_t sheets = 0, moving = 0;
    std::uint32_t firstInner = 0; ///< of those that a cut may expose; all from here up to `moving` are
};

float extentOf(const Scene& scene, const Face& face) {
    float extent = 0;
    for (int c = 0; c < 3; ++c) {
        const Vec3 &a = scene.particles[face.particles[c]].position,
                   &b = scene.particles[face.particles[(c + 1) % 3]].position;
        extent = std::max({extent, std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
    }
    return extent;
}

using Corners = std::array<std::uint32_t, 3>;

Corners fromLowest(Corners corners) {
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    return corners;
}

// Faces of cuttable voxel bodies, each between two of their cells or beside one.
struct CellFaces {
    std::set<Corners> outer; ///< of the scene, starting at the lowest corner
    std::vector<Face> inner; ///< of bodies with outer faces
};

CellFaces cellFacesOf(const Scene& scene) {
    std::set<Corners> solid;
    for (const Face& face : scene.faces)
        if (face.isSolid) solid.insert(fromLowest(face.particles));
    CellFaces result;
    for (const Grid& grid : scene.grids) {
        if (!grid.isCuttable || lattice::isSheet(grid) || solid.empty()) continue;
        std::vector<Face> squares;
        lattice::appendSquares(squares, grid, 0, lattice::Squares::outer);
        const std::size_t before = result.outer.size();
        for (const Face& face : squares)
            if (const Corners corners = fromLowest(face.particles); solid.contains(corners))
                result.outer.insert(corners);
        if (result.outer.size() == before) continue;
        const float thickness = scene.particles[grid.firstParticle].radius;
        lattice::appendSquares(result.inner, grid, thickness, lattice::Squares::inner);
    }
    return result;
}

Faces facesOf(const Scene& scene, const std::vector<float>& inverseMass, bool canBeCut) {
    enum class Kind : std::uint8_t { sheet, solid, still };
    const auto kindOf = [&](const Face& face) {
        if (!moves(face, inverseMass)) return Kind::still;
        return face.isSolid ? Kind::solid : Kind::sheet;
    };
    Faces faces;
    const CellFaces cells = canBeCut ? cellFacesOf(scene) : CellFaces{};
    const auto addOne = [&](const Face& face, float extent, bool isOfCells) {
        const auto [a, b, c] = face.particles;
        faces.faces.push_back({a, b, c, face.thickness});
        faces.extents.push_back(extent);
        faces.isOfCells.push_back(isOfCells);
    };
    const auto add = [&](Kind kind) {
        for (const Face& face : scene.faces)
            if (kindOf(face) == kind)
                addOne(face, extentOf(scene, face),
                       face.isSolid && cells.outer.contains(fromLowest(face.particles)));
        return static_cast<std::uint32_t>(faces.faces.size());
    };
    faces.sheets = add(Kind::sheet);
    faces.firstInner = add(Kind::solid);
    for (const Face& face : cells.inner) addOne(face, -1, true);
    faces.moving = static_cast<std::uint32_t>(faces.faces.size());
    add(Kind::still);
    return faces;
}

// A static or driven particle can touch only moving faces: without such faces it is not a point of contact
// lists.
std::vector<float> pointRadii(const Scene& scene, const std::vector<float>& inverseMass, const Faces& faces) {
    std::vector<float> radii;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const float radius = scene.particles[i].radius;
        radii.push_back(radius > 0 && (inverseMass[i] > 0 || faces.moving > 0) ? radius : -1);
    }
    return radii;
}

bool keepRest(const Scene& scene) {
    return std::ranges::any_of(scene.particles, &Particle::keepsRest);
}

// Listing distance beyond contact for pairs that keep their rest distance. Points behind a solid face that
// keep it are held at up to twice the reach behind the face.
float heldBeyond(const Scene& scene, const Faces& faces, std::span<const float> radii) {
    if (!keepRest(scene)) return 0;
    const auto thickest = [&](std::uint32_t first, std::size_t end) {
        float thickness = 0;
        for (std::size_t f = first; f < end; ++f)
            thickness = std::max(thickness, std::abs(faces.faces[f].thickness));
        return thickness;
    };
    const float radius = std::max(0.0f, std::ranges::max(radii));
    const float solid = faces.sheets < faces.moving ? thickest(faces.sheets, faces.moving) + radius : 0;
    return std::max(solid, 2 * REST_SLACK * (thickest(0, faces.faces.size()) + radius));
}

// If forces are kept, static corners of moving faces count too.
row_contacts::Corners cornersOf(const Faces& faces, const std::vector<float>& inverseMass,
                                const StateLayout& layout, bool keepsForces) {
    const auto around = [&](std::uint32_t first, std::uint32_t end) {
        std::vector<std::vector<std::uint32_t>> entries(layout.count);
        for (std::uint32_t f = first; f < end; ++f) {
            const layout::ContactFace& face = faces.faces[f];
            const Corners corners{face.a, face.b, face.c};
            for (std::uint32_t c = 0; c < 3; ++c)
                if (keepsForces || inverseMass[corners[c]] > 0)
                    entries[layout.slot[corners[c]]].push_back(4 * f + c);
        }
        return entries;
    };
    return row_contacts::cornersOf(around(0, faces.firstInner), around(faces.firstInner, faces.moving));
}

face_lists::Lists addLists(ProgramBuilder& program, const SceneModel& model, Faces faces) {
    const Scene& scene = model.scene;
    const StateLayout& layout = model.layout;
    const std::vector<float>& inverseMass = model.inverseMass;
    const std::vector<float> byParticle = pointRadii(scene, inverseMass, faces);
    const CuttingBuffers& cutting = program.program().cutting;
    const bool hasInner = faces.firstInner < faces.moving;
    const std::vector<std::uint32_t> exclusions =
        excludedPoints(scene, model.linkedBodies(), faces.faces, byParticle, layout,
                       hasInner ? cutting.runs : std::vector<CutRun>{});
    const float beyond = heldBeyond(scene, faces, byParticle);
    std::vector<float> radii(layout.count, -1), masses(layout.count, 0), wide;
    for (std::size_t i = 0; i < byParticle.size(); ++i) {
        radii[layout.slot[i]] = byParticle[i];
        masses[layout.slot[i]] = inverseMass[i];
        if (byParticle[i] > 0 && inverseMass[i] > 0) wide.push_back(byParticle[i]);
    }
    for (layout::ContactFace& face : faces.faces)
        for (std::uint32_t* corner : {&face.a, &face.b, &face.c}) *corner = layout.slot[*corner];
    const body_frames::Bodies bodies = body_frames::bodiesOf(model);
    // Lists of thin cloth with coarse faces may last longer than its radius allows: an eighth of a face adds
    // few candidates.
    const float length = std::max(median(wide), median(faces.extents) / 8);
    const std::vector<sheet_patches::Sheet> sheets =
        beyond > 0 ? std::vector<sheet_patches::Sheet>{}
                   : sheet_patches::sheetsOf(scene, layout, radii, faces.faces);
    face_lists::Lists lists = face_lists::add(program, {.radii = radii,
                                                        .inverseMasses = masses,
                                                        .faces = faces.faces,
                                                        .moving = faces.moving,
                                                        .extents = faces.extents,
                                                        .exclusions = exclusions,
                                                        .sheets = sheets,
                                                        .sharesPatches = model.settings.forms.chunk == 1,
                                                        .liveLinks = hasInner ? cutting.links : BufferId{},
                                                        .margin = model.settings.contactMargin * length,
                                                        .beyond = beyond,
                                                        .capacity = model.settings.contactRoom,
                                                        .bodies = &bodies,
                                                        .substeps = model.settings.substeps});
    collision::letDebrisLeave(program, lists.grid.radii, lists.grid);
    collision::letDebrisLeave(program, lists.grid.watched, lists.grid);
    collision::letDebrisLeave(program, lists.radii, lists.grid);
    return lists;
}

void addListUpdate(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                   bool isFirst) {
    const face_lists::Lists& lists = contacts.lists;
    if (isFirst) face_lists::addFit(program, lists, predicted);
    face_lists::addListCheck(program, lists, predicted);
    face_lists::addLists(program, lists, predicted);
}

// Slots of moving particles with a radius, ascending.
std::vector<std::uint32_t> movingPoints(const SceneModel& model) {
    std::vector<std::uint32_t> points;
    for (std::uint32_t i = 0; i < model.scene.particles.size(); ++i)
        if (model.scene.particles[i].radius > 0 && model.moves(i)) points.push_back(model.layout.slot[i]);
    std::ranges::sort(points);
    return points;
}

// By face: its row, and the slot that moments are about.
std::vector<std::array<std::uint32_t, 2>> stopRowsOf(const Faces& faces, const forces::Stops& stops,
                                                     const StateLayout& layout) {
    std::vector<std::array<std::uint32_t, 2>> rows(faces.faces.size(), {0, 0});
    for (std::size_t f = faces.moving; f < faces.faces.size(); ++f) {
        const std::uint32_t row = stops.ofParticle[faces.faces[f].a];
        rows[f] = {row, layout.slot[stops.rows[row].origin]};
    }
    return rows;
}

ProgramBuilder::Constants touchConstants(const Contacts& contacts, bool isFirst) {
    // constant_ids in find_face_contacts.comp
    constexpr std::uint32_t firstInnerId = 3, hasSolidId = 4, hasZonesId = 5;
    ProgramBuilder::Constants constants = row_contacts::restConstants(contacts.rows.keepsRest, isFirst);
    if (contacts.hasInner()) constants[firstInnerId] = contacts.firstInner;
    constants[hasSolidId] = contacts.hasSolid();
    constants[hasZonesId] = contacts.zones.exist();
    constants.merge(contacts.separations.constants());
    constants.merge(contacts.rows.touched.constants());
    return constants;
}

// Appends the pass that lists points which may touch a face.
void addPoints(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted) {
    constexpr std::uint32_t keepsRestId = 1, hasZonesId = 5; // constant_ids in find_points.comp
    const row_contacts::Rows& rows = contacts.rows;
    ProgramBuilder::Constants constants = rows.touched.constants();
    constants[keepsRestId] = rows.keepsRest;
    constants[hasZonesId] = contacts.zones.exist();
    row_contacts::addOverParticles(
        program, rows, k::findPoints,
        {predicted.positions, predicted.velocities, rows.shapes, rows.lists.contacts, rows.lists.ranges,
         rows.lists.memory->memory, rows.directions, predicted.step, contacts.zones.finding,
         contacts.zones.solving, contacts.zones.meeting, rows.touched.points, rows.touched.lists},
        constants);
}

// Faces beyond which a loose point is tested with those of its list alone.
constexpr std::uint32_t mostSearched = 10000;

// Motion in a substep up to which nothing can pass: a part of the smallest distance at which two touch.
float quickOf(const Scene& scene, const Faces& faces) {
    float radius = std::numeric_limits<float>::max(), thickness = radius;
    for (const Particle& particle : scene.particles)
        if (particle.radius > 0) radius = std::min(radius, particle.radius);
    for (const layout::ContactFace& face : faces.faces)
        thickness = std::min(thickness, std::abs(face.thickness));
    return 0.25f * (radius + thickness);
}

row_contacts::Rows addRows(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles,
                           const Faces& faces, const face_lists::Lists& lists) {
    const Scene& scene = model.scene;
    const layout::FaceFindPush& find = lists.push;
    row_contacts::Rows rows{.kind = &row_contacts::faces,
                            .lists = lists.pooled,
                            .shapes = lists.faces,
                            .elements = lists.grid.entries,
                            .bounds = lists.grid.bounds,
                            .particles = {lists.grid.touchingParticles, lists.touching},
                            .touched = lists.grid.touched,
                            .surfaces = surfaces::addTable(program, scene, model.layout, "faces.surface"),
                            .keepsRest = keepRest(scene)};
    rows.push = {.count = find.points,
                 .surfaces = rows.surfaces.count,
                 .recoverySpeed = scene.contacts.recoverySpeed,
                 .moving = find.moving,
                 .sheets = faces.sheets};
    rows.push.quick = quickOf(scene, faces);
    rows.marks = rows.keepsRest || faces.sheets < faces.moving
                     ? program.upload("faces.marks", contact_lists::linkedMarks(model))
                     : rows.surfaces.ofParticles;
    row_contacts::add(program, rows,
                      cornersOf(faces, model.inverseMass, model.layout, model.settings.keepsForces),
                      particles);
    return rows;
}

// Whether a scene has more than one sheet.
bool haveSeveral(std::span<const std::uint32_t> sheetsOfSlots) {
    std::uint32_t first = 0;
    for (const std::uint32_t sheet : sheetsOfSlots) {
        if (first == 0) first = sheet;
        if (sheet != 0 && sheet != first) return true;
    }
    return false;
}

// The points and faces of impact zones. Loose points have no links, and are no corner of a face; corners of
// sheets start zones with other sheets.
impact_zones::Request zonesOf(const Scene& scene, const StateLayout& layout, const Faces& faces,
                              const face_lists::Lists& lists, const separations::Separations& sheets) {
    impact_zones::Request request{.slots = layout.count,
                                  .moving = faces.moving,
                                  .sheets = faces.sheets,
                                  .large = lists.push.large,
                                  .room = lists.pooled.room,
                                  .loose = std::vector<float>(layout.count, 0)};
    const float sign = faces.moving > mostSearched ? -1.f : 1.f;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        if (scene.particles[i].inverseMass > 0 && scene.particles[i].radius > 0)
            request.loose[layout.slot[i]] = sign * scene.particles[i].radius;
    for (const Face& face : scene.faces)
        for (const std::uint32_t i : face.particles) request.loose[layout.slot[i]] = 0;
    for (const DistanceConstraint& link : scene.distances)
        request.loose[layout.slot[link.a]] = request.loose[layout.slot[link.b]] = 0;
    request.areBetweenSheets = haveSeveral(sheets.ofSlots);
    if (request.areBetweenSheets)
        for (std::size_t i = 0; i < scene.particles.size(); ++i)
            if (const std::uint32_t slot = layout.slot[i]; sheets.ofSlots[slot] != 0)
                request.loose[slot] = sign * scene.particles[i].radius;
    return request;
}

void addStopBuffers(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles,
                    const Faces& faces, Contacts& contacts) {
    const StateLayout& layout = model.layout;
    contacts.linkedPositions = program.scratch<layout::vec4>("faces.positions", positionCount(layout));
    contacts.linkedVelocities = program.scratch<layout::vec4>("faces.velocities", layout.count);
    const std::vector<std::uint32_t> points = movingPoints(model);
    contacts.movingPoints = program.upload("faces.moving_points", points);
    contacts.movingPointCount = static_cast<std::uint32_t>(points.size());
    if (particles.forces && !particles.forces->stops.rows.empty())
        contacts.stopRows =
            program.upload("faces.stop_rows", stopRowsOf(faces, particles.forces->stops, layout));
}

} // namespace

Contacts add(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles) {
    const bool canBeCut = program.program().cutting.links != BufferId{};
    const Faces faces = facesOf(model.scene, model.inverseMass, canBeCut);
    Contacts contacts{.lists = addLists(program, model, faces),
                      .faces = static_cast<std::uint32_t>(faces.faces.size()),
                      .firstInner = faces.firstInner,
                      .isOfCells = faces.isOfCells};
    contacts.lists.grid.touched = row_contacts::addTouched(
        program, "faces", static_cast<std::uint32_t>(model.layout.count), contacts.lists.pooled.room);
    contacts.rows = addRows(program, model, particles, faces, contacts.lists);
    ContactBuffers& shown = program.program().contacts;
    shown.faces = contacts.lists.faces;
    shown.facePairs = contacts.lists.pooled.contacts;
    shown.faceLists = contacts.lists.pooled.ranges;
    if (std::ranges::find(faces.isOfCells, true) != faces.isOfCells.end())
        contacts.opened = program.scratch<std::uint32_t>("faces.opened", faces.faces.size());
    contacts.separations = separations::add(program, model, std::span(faces.faces).first(faces.sheets),
                                            contacts.lists.grid.frames);
    contacts.zones = impact_zones::add(
        program, zonesOf(model.scene, model.layout, faces, contacts.lists, contacts.separations));
    contacts.rows.touching = {contacts.zones.finding, contacts.zones.meeting, contacts.separations.sheets,
                              contacts.rows.touched.arguments};
    if (contacts.hasStops()) addStopBuffers(program, model, particles, faces, contacts);
    // Without static or driven faces no kernel reads the first two.
    const bool hasRows = contacts.stopRows != BufferId{};
    contacts.rows.forceRows = {hasRows ? contacts.stopRows : contacts.lists.pooled.ranges,
                               hasRows ? contacts.linkedPositions : contacts.rows.weights,
                               contacts.lists.pooled.contacts};
    return contacts;
}

void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst) {
    addListUpdate(program, contacts, predicted, isFirst);
    if (isFirst) collision::addFaceOpening(program, contacts, predicted);
    if (contacts.hasStops()) {
        program.copy(predicted.positions, contacts.linkedPositions);
        program.copy(predicted.velocities, contacts.linkedVelocities);
    }
    addPoints(program, contacts, predicted);
    row_contacts::addPasses(program, contacts.rows, predicted, touchConstants(contacts, isFirst));
}

void addStops(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state,
              StopKind kind) {
    if (!contacts.hasStops() || contacts.movingPointCount == 0) return;
    const face_lists::Lists& lists = contacts.lists;
    const layout::StopPush push{contacts.movingPointCount, contacts.rows.push.moving, contacts.faces};
    std::vector<BufferId> buffers{contacts.linkedPositions,
                                  contacts.linkedVelocities,
                                  lists.faces,
                                  lists.pooled.contacts,
                                  lists.pooled.ranges,
                                  lists.radii,
                                  lists.excluded,
                                  state.positions,
                                  state.velocities,
                                  state.step,
                                  lists.pooled.memory->memory};
    ProgramBuilder::Constants constants = remainderConstants(state.layout);
    constexpr std::uint32_t onlyPassingId = 1; // constant_id in face_stop.glsl
    constants[onlyPassingId] = kind == StopKind::passing;
    constants.merge(receivedConstants(state));
    buffers.push_back(state.received);
    forces::bindTo(state, &forces::Forces::ofStops, buffers, constants);
    buffers.insert(buffers.end(), {boundIf(state.forces != nullptr, contacts.stopRows),
                                   boundIf(state.forces != nullptr, contacts.linkedPositions)});
    buffers.push_back(contacts.movingPoints);
    program.dispatch(k::stopAtFaces, push.count, buffers, push, constants);
}

void addZones(ProgramBuilder& program, const Contacts& contacts,
              const std::optional<impact_zones::FoundEdges>& edges, const ParticleBuffers& predicted,
              const ParticleBuffers& state) {
    const row_contacts::Rows& rows = contacts.rows;
    impact_zones::addPasses(program, contacts.zones,
                            {.faces = rows.shapes,
                             .contacts = rows.lists.contacts,
                             .lists = rows.lists.ranges,
                             .searched = contacts.lists.searched,
                             .large = contacts.lists.large,
                             .groups = rows.particles.listed,
                             .sheets = contacts.separations.sheets,
                             .constants = contacts.separations.constants()},
                            edges, predicted, state);
}

} // namespace sinew::sim::collision::face_contacts
