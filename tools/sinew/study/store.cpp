// The file name is a hash of the identity; the identity inside decides.
#include "sinew/study/rest.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sim/compile/compile.hpp"
#include "sim/core/hash.hpp"
#include "sim/model/links.hpp"
#include "sinew/json.hpp"
#include "sinew/validate.hpp"
#include "sinew/vk/spirv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace sinew::tools::study {

namespace {

namespace fs = std::filesystem;

class Hash {
public:
    void add(std::span<const std::byte> bytes) { value_ = sim::fnv1a(bytes, value_); }
    void addText(const std::string& text) { add(std::as_bytes(std::span(text))); }
    template <typename... Values> void addValues(const Values&... values) {
        (add(std::as_bytes(std::span(&values, 1))), ...);
    }
    std::string text() const { return fmt::format("{:016x}", value_); }

private:
    std::uint64_t value_ = sim::fnv1a({});
};

void addBodies(Hash& hash, const sim::Scene& scene) {
    for (const sim::Particle& p : scene.particles)
        hash.addValues(p.position, p.velocity, p.inverseMass, p.contactOffset, p.radius, p.surface);
    if (std::ranges::any_of(scene.particles,
                            &sim::Particle::keepsRest)) // else it is the hash of a scene from before there
                                                        // were rest distances
        for (const sim::Particle& p : scene.particles) hash.addValues(p.keepsRest);
    sim::forEachKind(scene, [&]<typename Link>(const std::vector<Link>& links) {
        for (const Link& link : links) {
            for (const std::uint32_t end : sim::LinkTraits<Link>::ends(link)) hash.addValues(end);
            for (const float value : sim::LinkTraits<Link>::rest(link)) hash.addValues(value);
            hash.addValues(link.compliance);
        }
    });
    for (const sim::Attachment& a : scene.attachments)
        hash.addValues(a.particle, a.anchor, a.compliance, a.maxForce, a.maxSpeed);
    for (const sim::Tether& t : scene.tethers) hash.addValues(t.particle, t.anchor, t.length);
    for (const sim::FixedConstraint& f : scene.fixed) hash.addValues(f.particle);
    for (const sim::Grid& g : scene.grids) hash.addValues(g.volumeStiffness, g.recoveryPressure);
}

void addWhatTouches(Hash& hash, const sim::Scene& scene) {
    for (const sim::Plane& p : scene.planes) hash.addValues(p.normal, p.offset, p.friction, p.restitution);
    for (const sim::Collider& c : scene.colliders) {
        hash.addValues(c.shape, c.radius, c.halfLength, c.halfExtents, c.margin, c.friction, c.staticFriction,
                       c.restitution, c.pose, c.pathEnd);
        for (const sim::Keyframe& k : c.path) hash.addValues(k.time, k.pose);
    }
    for (const sim::Face& f : scene.faces) hash.addValues(f.particles, f.thickness, f.isSolid);
    const sim::ContactSettings& contacts = scene.contacts;
    hash.addValues(contacts.friction, contacts.restitution, contacts.recoverySpeed);
    for (const sim::Surface& s : contacts.surfaces) hash.addValues(s.friction, s.restitution);
}

std::string hashOf(const sim::Scene& scene) {
    Hash hash;
    hash.addValues(scene.gravity, scene.dt, scene.damping, scene.dampingTime);
    addBodies(hash, scene);
    addWhatTouches(hash, scene);
    return hash.text();
}

std::string hashOf(const sim::StepProgram& program) {
    Hash hash;
    for (const sim::KernelUse& kernel : program.kernels) {
        hash.add(std::as_bytes(std::span<const std::uint32_t>(vk::wordsOf(*kernel.code))));
        for (const auto& [id, value] : kernel.constants) hash.addValues(id, value);
    }
    for (const sim::BufferSpec& buffer : program.buffers) {
        hash.addValues(buffer.count, buffer.stride);
        hash.add(buffer.initial);
    }
    for (const sim::Pass& pass : program[sim::List::step]) {
        hash.addValues(pass.kind, pass.kernel, pass.items, pass.value, hasBarrier({}, pass));
        for (const sim::BufferUse& use : pass.uses) hash.addValues(use.buffer.index, use.binding);
        hash.add(pass.push);
    }
    return hash.text();
}

Json toJson(const sim::Settings& settings) {
    return {{"solver", sim::solverName(settings.solver)},
            {"substeps", settings.substeps},
            {"iterations", settings.iterations},
            {"omega", settings.omega},
            {"theta", settings.theta},
            {"levels", settings.levels},
            {"sharp_clamp", settings.hasSharpClamp},
            {"weight", settings.weight},
            {"over_relaxation", settings.overRelaxation},
            {"warm_start", settings.warmStart}};
}

/// Null if the file is missing, damaged, or has another identity.
Json read(const fs::path& file, const std::string& identity) {
    std::ifstream stream(file);
    const Json json = Json::parse(stream, nullptr, false);
    if (!json.is_object() || json.value("identity", "") != identity) return nullptr;
    return json;
}

std::optional<double> valueOf(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

std::string text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write(const fs::path& file, const Json& json) {
    mesh::writeWhole(file, [&](std::ostream& stream) { stream << dump(json); });
}

} // namespace

std::string identityOf(const StudyScene& scene, const sim::Settings& settings,
                       const sim::StepProgram& program, const vk::DeviceDescription& device) {
    return text({{"version", SINEW_VERSION},
                 {"device", device.name},
                 {"driver", device.driver},
                 {"scene", hashOf(scene.loaded.scene)},
                 {"frames", scene.frames},
                 {"settings", toJson(settings)},
                 {"program", hashOf(program)}});
}

std::string identityOfTruth(const StudyScene& scene, const vk::DeviceDescription& device) {
    Json json{{"version", SINEW_VERSION},
              {"truth", hashOf(scene.loaded.scene)},
              {"frames", scene.frames},
              {"perturbation", perturbation}};
    const sim::Settings settings{.solver = sim::Solver::split, .substeps = truthSubsteps};
    if (isOfContacts(scene.loaded.scene) && sim::validate(scene.loaded.scene, settings).empty()) {
        json["run"] = identityOf(scene, settings, sim::compile(scene.loaded.scene, settings), device);
    }
    return text(json);
}

std::string identityOfRest(const StudyScene& scene, const sim::Settings& settings,
                           const sim::StepProgram& program, const vk::DeviceDescription& device) {
    return text({{"rest", restLength}, {"run", identityOf(scene, settings, program, device)}});
}

Store::Store(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
        throw app::Failure(app::outputFailed, "cannot write: " + folder_.string() + ": " + error.message() +
                                                  ": choose another folder");
}

fs::path Store::fileOf(const std::string& identity) const {
    Hash hash;
    hash.addText(identity);
    return folder_ / (hash.text() + ".json");
}

void Store::merge(const fs::path& folder) const {
    std::error_code error;
    const auto entries = fs::directory_iterator(folder, error);
    if (error)
        throw app::Failure(app::badInput, "cannot merge: " + folder.string() + ": " + error.message() +
                                              ": name the output folder of a study");
    for (const fs::directory_entry& entry : entries) {
        if (entry.path().extension() != ".json") continue;
        fs::copy_file(entry.path(), folder_ / entry.path().filename(), fs::copy_options::skip_existing,
                      error);
        if (error)
            throw app::Failure(app::outputFailed,
                               "cannot write: " + folder_.string() + ": " + error.message());
    }
}

bool Store::load(Trial& trial) const {
    const Json json = read(fileOf(trial.identity), trial.identity);
    if (json.is_null()) return false;
    try {
        trial.isDiverged = json.at("diverged").get<bool>();
        trial.hasDeviceClock = json.at("device_clock").get<bool>();
        trial.frameRms = json.at("frame_rms").get<std::vector<double>>();
        trial.frameMax = json.at("frame_max").get<std::vector<double>>();
        trial.frameMs = json.at("frame_ms").get<std::vector<double>>();
        trial.repeats.clear();
        for (const Json& r : json.at("repeats"))
            trial.repeats.push_back({r.at(0).get<std::size_t>(), r.at(1).get<double>()});
    } catch (const Json::exception&) {
        return false;
    }
    std::size_t timed = 0;
    for (const Repeat& r : trial.repeats) timed += r.frames;
    trial.isRun = !trial.frameMs.empty() && timed == trial.frameMs.size();
    return trial.isRun;
}

void Store::keep(const Trial& trial) const {
    Json repeats = Json::array();
    for (const Repeat& r : trial.repeats) repeats.push_back(Json::array({r.frames, r.load}));
    write(fileOf(trial.identity), {{"identity", trial.identity},
                                   {"diverged", trial.isDiverged},
                                   {"device_clock", trial.hasDeviceClock},
                                   {"frame_rms", trial.frameRms},
                                   {"frame_max", trial.frameMax},
                                   {"frame_ms", trial.frameMs},
                                   {"repeats", std::move(repeats)}});
}

bool Store::load(RestRun& run) const {
    const Json json = read(fileOf(run.identity), run.identity);
    if (json.is_null()) return false;
    try {
        run.isDiverged = json.at("diverged").get<bool>();
        for (const Json& s : json.at("samples"))
            run.samples.push_back({.step = s.at(0).get<std::uint64_t>(),
                                   .time = s.at(1).get<double>(),
                                   .kineticEnergy = s.at(2).get<double>(),
                                   .penetrationMax = valueOf(s.at(3)),
                                   .penetrationRms = valueOf(s.at(4))});
    } catch (const Json::exception&) {
        run.samples.clear();
        return false;
    }
    return run.isRun = true;
}

void Store::keep(const RestRun& run) const {
    Json samples = Json::array();
    for (const Sample& s : run.samples)
        samples.push_back(Json::array(
            {s.step, s.time, s.kineticEnergy, orNull(s.penetrationMax), orNull(s.penetrationRms)}));
    write(fileOf(run.identity),
          {{"identity", run.identity}, {"diverged", run.isDiverged}, {"samples", std::move(samples)}});
}

std::optional<Truth> Store::loadTruth(const std::string& identity) const {
    const Json json = read(fileOf(identity), identity);
    if (json.is_null()) return {};
    try {
        return Truth{.bodySize = json.at("body_size").get<double>(),
                     .h = json.at("h").get<double>(),
                     .selfDifference = json.at("self_difference").get<double>(),
                     .growth = json.at("growth").get<std::vector<double>>(),
                     .halving = json.at("halving").get<std::vector<double>>(),
                     .motion = json.at("motion").get<std::vector<double>>(),
                     .frames = {}};
    } catch (const Json::exception&) {
        return {};
    }
}

void Store::keepTruth(const std::string& identity, const Truth& truth) const {
    write(fileOf(identity), {{"identity", identity},
                             {"body_size", truth.bodySize},
                             {"h", truth.h},
                             {"self_difference", truth.selfDifference},
                             {"growth", truth.growth},
                             {"halving", truth.halving},
                             {"motion", truth.motion}});
}

} // namespace sinew::tools::study
