// One function per part of the report, in the order of docs/report.md.
#include "sinew/report.hpp"

#include "sim/compile/compile.hpp"
#include "sim/core/counted.hpp"
#include "sinew/json.hpp"
#include "sinew/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace sinew::tools {

namespace {

/// Labels in the order of their first appearance.
std::vector<std::string> distinctPasses(const sim::StepProgram& program) {
    std::vector<std::string> labels;
    std::set<std::string> seen;
    for (const sim::Pass& pass : program[sim::List::step])
        if (seen.insert(pass.label).second) labels.push_back(pass.label);
    return labels;
}

Json stepJson(const RunRecord& record) {
    const sim::StepProgram& program = record.program;
    const sim::PassCounts counts = sim::countPasses(program, sim::plainStep); // without a blade
    return {{"dispatches", counts.dispatches},
            {"barriers", counts.barriers},
            {"declared_bytes", sim::declaredBytes(program)},
            {"sweeps", program.sweeps},
            {"record_ms", record.recordMs}};
}

Json frameJson(const std::optional<Statistics>& frame) {
    if (!frame) return {{"p50", nullptr}, {"p99", nullptr}, {"mean", nullptr}, {"stddev", nullptr}};
    return {{"p50", frame->p50}, {"p99", frame->p99}, {"mean", frame->mean}, {"stddev", frame->stddev}};
}

Json phaseJson(const RunRecord& record) {
    Json phases = Json::object();
    for (std::size_t i = 0; i < record.phaseMs.size(); ++i) { // a step may have several spans of one name
        Json& ms = phases[record.phases[i]];
        ms = (ms.is_null() ? 0.0 : ms.get<double>()) + record.phaseMs[i];
    }
    return phases;
}

Json bodiesJson(const sim::Scene& scene) {
    Json bodies = Json::array();
    for (const sim::Body& body : scene.bodies)
        bodies.push_back({{"name", body.name},
                          {"first_particle", body.firstParticle},
                          {"particles", body.particleCount},
                          {"rest_volume", body.restVolume > 0 ? Json(body.restVolume) : Json(nullptr)}});
    return bodies;
}

const char* nameOf(mesh::Shown shown) {
    switch (shown) {
    case mesh::Shown::wrapped:
        return "wrapped";
    case mesh::Shown::voxels:
        return "voxels";
    default:
        return "mesh";
    }
}

Json meshesJson(const std::vector<scenes::MeshSummary>& summaries) {
    Json meshes = Json::array();
    for (const scenes::MeshSummary& mesh : summaries)
        meshes.push_back({{"body", mesh.body},
                          {"file", mesh.file},
                          {"boundary_edges", mesh.surface.defects.boundaryEdges},
                          {"non_manifold_edges", mesh.surface.defects.nonManifoldEdges},
                          {"repair", toJson(mesh.repairs)},
                          {"hull_voxels", mesh.voxels.hullCount},
                          {"core_voxels", mesh.voxels.coreCount},
                          {"doubtful_voxels", mesh.voxels.doubtful},
                          {"shown", nameOf(mesh.shown)}});
    return meshes;
}

Json stiffnessJson(const scenes::LoadedScene& loaded) {
    const sim::StiffnessReport report = sim::inspectStiffness(loaded.scene, loaded.settings);
    if (report.elastic == 0) return nullptr;
    const auto links = static_cast<double>(report.elastic);
    return {{"elastic_links", report.elastic},
            {"clamped_links", report.clamped},
            {"clamp_fraction", static_cast<double>(report.clamped) / links},
            {"soft_links", report.soft},
            {"softest", report.softest},
            {"mean", report.mean},
            {"needed_substeps", report.neededSubsteps > 0 ? Json(report.neededSubsteps) : Json(nullptr)},
            {"damping_time", report.dampingTime}};
}

Json choiceJson(const RunRecord& record) {
    const scenes::LoadedScene& loaded = record.loaded;
    constexpr const char* reasons[] = {"asked",    "stiffness", "weight", "damping", "drag",
                                       "contacts", "folds",     "fewest", "most"};
    const char* reason = reasons[static_cast<std::size_t>(loaded.substeps.reason)];
    return {{"reason", record.isForError ? "error" : reason},
            {"wanted", loaded.substeps.wanted},
            {"tolerance", loaded.settings.tolerance}};
}

Json estimateJson(const std::optional<ErrorEstimate>& estimate) {
    if (!estimate) return nullptr;
    return {{"of_motion", orNull(estimate->ofMotion)},
            {"of_body", orNull(estimate->ofBody)},
            {"order", orNull(estimate->order)},
            {"difference", estimate->difference},
            {"steps", estimate->steps},
            {"substeps", estimate->substeps}};
}

Json divergenceJson(const std::optional<Divergence>& divergence, double dt) {
    if (!divergence) return nullptr;
    return {{"step", divergence->step},
            {"cause", divergence->isCrowded ? "crowded" : "not finite"},
            {"time", static_cast<double>(divergence->step) * dt},
            {"body", divergence->body},
            {"particle", divergence->particle},
            {"particles", divergence->count}};
}

// Names of bodies whose movable particles all sleep.
Json sleepJson(const RunRecord& record) {
    const std::vector<bool>& isAsleep = record.state.isAsleep;
    if (isAsleep.empty()) return nullptr;
    const std::vector<float> inverseMass = sim::inverseMasses(record.loaded.scene);
    std::size_t bodies = 0;
    for (const sim::Body& body : record.loaded.scene.bodies) {
        std::size_t movable = 0, asleep = 0;
        for (std::size_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
            movable += inverseMass[i] > 0 ? 1 : 0;
            asleep += isAsleep[i] ? 1 : 0;
        }
        bodies += movable > 0 && asleep == movable ? 1 : 0;
    }
    return {{"particles", std::ranges::count(isAsleep, true)}, {"bodies", bodies}};
}

Json overflowJson(const RunRecord& record) {
    Json overflow = Json::object(); // empty: no list of fixed size is in use
    const sim::ContactRoom& contacts = record.contactRoom;
    const sim::ContactBuffers& lists = record.program.contacts;
    if (lists.pairs != sim::BufferId{} || lists.facePairs != sim::BufferId{})
        overflow["contacts"] = {{"room", contacts.room},
                                {"needed", contacts.needed > 0 ? Json(contacts.needed) : Json(nullptr)},
                                {"grown", contacts.grown},
                                {"slowed", record.slowed},
                                {"calm_steps", record.lists.calm},
                                {"repeated_steps", record.lists.repeated}};
    const sim::SurfaceRoom& surface = record.surfaceRoom;
    if (record.program.cutting.counts != sim::BufferId{})
        overflow["cut_surface"] = {{"needed", surface.needed > 0 ? Json(surface.needed) : Json(nullptr)},
                                   {"grown", surface.grown}};
    return overflow;
}

Json cutJson(const RunRecord& record) {
    if (record.program.cutting.counts == sim::BufferId{}) return nullptr;
    const CutFigures& cuts = record.cuts;
    return {{"blades", record.loaded.blades.size()},
            {"links", cuts.links},
            {"pieces", record.skins.count.pieces},
            {"fragments", record.skins.count.fragments},
            {"debris",
             {{"pieces", cuts.debris}, {"particles", cuts.debrisParticles}, {"mass", cuts.debrisMass}}}};
}

Json vectorOver(const sim::Vec3& v, float dt) {
    return {v.x / dt, v.y / dt, v.z / dt};
}

// Force and torque: an impulse divided by the length of the step.
Json forceJson(const sim::Impulse& impulse, float dt) {
    return {{"force", vectorOver(impulse.linear, dt)}, {"torque", vectorOver(impulse.angular, dt)}};
}

Json forcesJson(const std::vector<sim::Impulse>& impulses, float dt) {
    Json list = Json::array();
    for (const sim::Impulse& impulse : impulses) list.push_back(forceJson(impulse, dt));
    return list;
}

Json forcesJson(const RunRecord& record) {
    const sim::Impulses& forces = record.forces;
    if (!forces.isFinished) return nullptr;
    const sim::Scene& scene = record.loaded.scene;
    Json bodies = Json::array(), holds = Json::array();
    for (std::size_t b = 0; b < forces.bodies.size(); ++b) {
        const sim::BodyImpulses& body = forces.bodies[b];
        bodies.push_back({{"name", scene.bodies[b].name},
                          {"contacts", forceJson(body.contacts, scene.dt)},
                          {"planes", forceJson(body.planes, scene.dt)},
                          {"colliders", forceJson(body.colliders, scene.dt)},
                          {"holds", forceJson(body.holds, scene.dt)}});
    }
    for (std::size_t h = 0; h < forces.holds.size(); ++h)
        holds.push_back(
            {{"name", scene.holds[h].name}, {"force", vectorOver(forces.holds[h].linear, scene.dt)}});
    return {{"bodies", bodies},
            {"planes", forcesJson(forces.planes, scene.dt)},
            {"colliders", forcesJson(forces.colliders, scene.dt)},
            {"holds", holds},
            {"blade", forces.blade.empty() ? Json() : vectorOver(forces.blade.front().linear, scene.dt)}};
}

} // namespace

Json toJson(const Errors& errors) {
    return {{"strain_rms", orNull(errors.strainRms)},
            {"strain_max", orNull(errors.strainMax)},
            {"volume", orNull(errors.volume)},
            {"momentum", orNull(errors.momentum)},
            {"penetration_max", orNull(errors.penetrationMax)},
            {"penetration_rms", orNull(errors.penetrationRms)},
            {"edges_through_faces", orNull(errors.crossings)}};
}

Json toJson(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

Json toJson(const mesh::Repairs& repairs) {
    const Json largest{{"edges", repairs.largest.edges},
                       {"length", repairs.largest.rim},
                       {"middle", toJson(repairs.largest.middle)}};
    const Json seam{{"weld", repairs.seam.weld}, {"edges", repairs.seam.edges}};
    return {{"how", mesh::nameOf(repairs.how)},
            {"tolerance", repairs.tolerance},
            {"joined_vertices", repairs.joinedVertices},
            {"split_edges", repairs.splitEdges},
            {"removed_triangles", repairs.removedTriangles},
            {"closed_holes", repairs.closedHoles},
            {"closed_hole_edges", repairs.holeEdges},
            {"new_triangles", repairs.holeTriangles},
            {"turned_triangles", repairs.turnedTriangles},
            {"turned_parts", repairs.turnedParts},
            {"open_edges", repairs.openEdges},
            {"open_holes", repairs.openHoles},
            {"largest_hole", repairs.openHoles > 0 ? largest : Json(nullptr)},
            {"wide_seam", repairs.seam.weld > 0 ? seam : Json(nullptr)}};
}

std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string toJson(const RunRecord& record) {
    const sim::Scene& scene = record.loaded.scene;
    const sim::Settings& settings = record.loaded.settings;
    Json json{{"schema", reportSchema}, {"scene", scene.name}};
    json["device"] = {
        {"name", record.device.name}, {"driver", record.device.driver}, {"type", record.device.type}};
    json["solver"] = sim::solverName(settings.solver);
    json["substeps"] = settings.substeps;
    json["levels"] = settings.levels;
    json["sharp_clamp"] = settings.hasSharpClamp;
    const sim::Clamp clamp = sim::clampOf(scene, settings);
    json["clamp"] = clamp == sim::Clamp::none ? Json(nullptr) : Json(sim::toText(clamp));
    json["substep_choice"] = choiceJson(record);
    json["iterations"] = settings.solver == sim::Solver::split ? 1 : settings.iterations;
    json["reversed"] = settings.isReversed;
    json["forms"] = {{"texels", settings.forms.usesTexels},
                     {"grids", settings.forms.usesGrids},
                     {"columns", settings.forms.columns},
                     {"chunk", settings.forms.chunk},
                     {"resident_bytes", settings.forms.residentBytes},
                     {"source", app::toText(record.formSource)}};
    json["dt"] = scene.dt;
    json["velocity_age"] =
        settings.solver == sim::Solver::split ? double{scene.dt} / settings.substeps / 2 : 0.0;
    json["origin"] = record.loaded.origin;
    json["particles"] = record.program.particleCount;
    json["constraints"] = record.program.constraintCount;
    json["bodies"] = bodiesJson(scene);
    json["meshes"] = meshesJson(record.loaded.meshes);
    json["passes"] = distinctPasses(record.program);
    json["skipped"] = record.program.skipped;
    json["step"] = stepJson(record);
    json["frames"] = record.frames;
    json["frames_wanted"] = record.wantedFrames;
    json["interrupted"] = record.isInterrupted;
    json["frame_ms"] = frameJson(summarise(record.frameMs));
    json["phase_ms"] = phaseJson(record);
    json["error"] = toJson(measure(scene, record.state, record.skins.whole, record.frames));
    json["error_estimate"] = estimateJson(record.estimate);
    json["stiffness"] = stiffnessJson(record.loaded);
    json["finite"] = !record.divergence || record.divergence->isCrowded;
    json["divergence"] = divergenceJson(record.divergence, double{scene.dt});
    json["cut"] = cutJson(record);
    json["forces"] = forcesJson(record);
    json["overflow"] = overflowJson(record);
    json["sleeping"] = sleepJson(record);
    json["state_hash"] = fmt::format("{:016x}", stateHash(record.state));
    json["peak_memory_mib"] = peakResidentMib();
    json["validation"] = record.hasValidation;
    json["validation_messages"] = record.validationMessages;
    json["warnings"] = record.loaded.warnings;
    json["notes"] = record.loaded.notes;
    return dump(json);
}

std::string stiffnessText(const scenes::LoadedScene& loaded) {
    std::string text = sim::toText(loaded.substeps, loaded.settings) + "\n";
    if (const sim::Clamp clamp = sim::clampOf(loaded.scene, loaded.settings); clamp != sim::Clamp::none)
        text += "clamp: " + sim::toText(clamp) + "\n";
    const sim::StiffnessReport report = sim::inspectStiffness(loaded.scene, loaded.settings);
    if (report.elastic == 0) return text;
    text += fmt::format(
        "stiffness: {:.3g} % of the requested one on average, {:.3g} % at least, {} of {} links clamped "
        "({:.3g} %)\n",
        100 * report.mean, 100 * report.softest, report.clamped, report.elastic,
        100 * static_cast<double>(report.clamped) / static_cast<double>(report.elastic));
    if (loaded.scene.dampingTime > 0)
        text += fmt::format("internal damping: {:.3g} s of {:.3g} s on average\n", report.dampingTime,
                            double{loaded.scene.dampingTime});
    return text;
}

std::string errorText(const std::optional<ErrorEstimate>& estimate) {
    return "error of these substeps: " +
           (estimate ? toText(*estimate) : "not measured, `sinew run --error` does") + "\n";
}

// Text on removed fragments.
std::string debrisText(const CutFigures& cuts) {
    if (cuts.debris == 0) return {};
    return fmt::format(", {} removed with {}, {:.3g} kg", cuts.debris,
                       sim::counted(cuts.debrisParticles, "particle"), cuts.debrisMass);
}

std::string toText(const RunRecord& record) {
    const sim::Settings& settings = record.loaded.settings;
    std::string text = fmt::format("{}: {}, {}, {} with {}, on {} ({})\n", record.loaded.scene.name,
                                   sim::counted(record.program.particleCount, "particle"),
                                   sim::counted(record.program.constraintCount, "constraint"),
                                   sim::solverName(settings.solver), sim::toText(settings),
                                   record.device.name, record.device.type);
    if (const auto frame = summarise(record.frameMs))
        text += fmt::format("{}: {:.2f} ms each (median), {:.2f} ms at most in 99 %\n",
                            sim::counted(record.frames, "step"), frame->p50, frame->p99);
    if (record.formSource != app::FormSource::usual)
        text += fmt::format("forms of kernels: {} ({})\n", app::toText(settings.forms),
                            app::toText(record.formSource));
    text += stiffnessText(record.loaded) + errorText(record.estimate);
    const Errors errors = measure(record.loaded.scene, record.state, record.skins.whole, record.frames);
    if (errors.strainRms)
        text += fmt::format("strain: {:.3g} % rms, {:.3g} % at most\n", 100 * *errors.strainRms,
                            100 * *errors.strainMax);
    if (errors.volume)
        text += fmt::format("volume: {:+.3g} %{}\n", 100 * *errors.volume,
                            *errors.volume < -1 ? ", inside out" : "");
    if (errors.penetrationMax)
        text += fmt::format("deepest penetration: {:.3g} mm\n", 1000 * *errors.penetrationMax);
    if (errors.penetrationRms)
        text += fmt::format("overlap of touching particles: {:.3g} mm rms\n", 1000 * *errors.penetrationRms);
    if (errors.crossings)
        text += fmt::format("surfaces: {} through a face\n", sim::counted(*errors.crossings, "edge"));
    if (record.contactRoom.grown > 0)
        text += fmt::format("room for contacts: grown {}, to {}\n",
                            sim::counted(record.contactRoom.grown, "time"), record.contactRoom.room);
    if (record.lists.calm > 0)
        text += fmt::format("contacts: {} needed lists in the first substep at most; repeated: {}\n",
                            sim::counted(record.lists.calm, "step"), record.lists.repeated);
    if (record.surfaceRoom.grown > 0)
        text += fmt::format("room for the surface of cuts: grown {}, {} triangles were needed\n",
                            sim::counted(record.surfaceRoom.grown, "time"), record.surfaceRoom.needed);
    if (const Json sleeping = sleepJson(record); !sleeping.is_null())
        text += fmt::format(
            "asleep: {}, {}\n", sim::counted(sleeping["particles"].get<std::size_t>(), "particle"),
            sim::counted(sleeping["bodies"].get<std::size_t>(), "whole body", "whole bodies"));
    if (record.program.cutting.counts != sim::BufferId{})
        text += fmt::format("cut: {}, {}{}\n", sim::counted(record.cuts.links, "link"),
                            app::toText(record.skins.count), debrisText(record.cuts));
    text += fmt::format("state hash: {:016x}\n", stateHash(record.state));
    if (record.hasValidation)
        text += fmt::format("validation: {}\n", sim::counted(record.validationMessages.size(), "message"));
    return text;
}

} // namespace sinew::tools
