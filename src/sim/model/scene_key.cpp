// FNV-1a over 32-bit words, list by list; the length of a list precedes its elements.
#include "sim/model/scene_key.hpp"

#include "sim/model/links.hpp"

#include <algorithm>
#include <bit>
#include <concepts>

namespace sinew::sim {

namespace {

class Key {
public:
    template <std::unsigned_integral Word> void add(Word word) { value_ = (value_ ^ word) * 0x100000001b3u; }
    void add(bool is) { add(is ? 1u : 0u); }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number + 0.0f)); } // -0 counts as 0
    void add(const Vec3& v) { addAll(v.x, v.y, v.z); }
    void add(const Pose& pose) {
        addAll(pose.position, pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w);
    }
    template <typename... Values> void addAll(const Values&... values) { (add(values), ...); }
    template <typename List, typename Use> void each(const List& list, const Use& use) {
        add(std::uint64_t{list.size()});
        for (const auto& element : list) use(element);
    }
    template <typename List> void all(const List& list) {
        each(list, [this](const auto& element) { this->add(element); });
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Contacts and cuts, which only `split` supports.
void addOfSplit(Key& key, const Scene& scene) {
    key.each(scene.particles, [&](const Particle& p) { key.add(p.radius); });
    if (std::ranges::any_of(scene.particles, &Particle::keepsRest))
        key.each(scene.particles, [&](const Particle& p) { key.add(p.keepsRest); });
    key.each(scene.faces, [&](const Face& face) {
        key.addAll(face.particles[0], face.particles[1], face.particles[2], face.thickness, face.isSolid);
    });
    key.each(scene.grids,
             [&](const Grid& grid) { key.addAll(grid.isCuttable, grid.tearStrain, grid.toughness); });
    key.add(scene.debris);
    if (std::ranges::any_of(scene.bodies, &Body::isAbsent))
        key.each(scene.bodies, [&](const Body& body) {
            key.addAll(body.firstParticle, body.particleCount, body.isAbsent);
        });
}

void addLinks(Key& key, const Scene& scene) {
    key.each(scene.particles,
             [&](const Particle& p) { key.addAll(p.position, p.inverseMass, p.contactOffset); });
    forEachKind(scene, [&]<typename Link>(const std::vector<Link>& links) {
        key.each(links, [&](const Link& link) {
            for (const std::uint32_t end : LinkTraits<Link>::ends(link)) key.add(end);
            for (const float value : LinkTraits<Link>::rest(link)) key.add(value);
        });
    });
    key.each(scene.attachments, [&](const Attachment& a) { key.add(a.particle); });
    key.each(scene.tethers, [&](const Tether& t) { key.addAll(t.particle, t.anchor, t.length); });
    key.each(scene.fixed, [&](const FixedConstraint& f) { key.add(f.particle); });
}

void addPath(Key& key, const std::vector<Keyframe>& path, PathEnd end) {
    key.each(path, [&](const Keyframe& frame) { key.addAll(frame.time, frame.pose); });
    key.add(end == PathEnd::loop);
}

void addSurroundings(Key& key, const Scene& scene) {
    key.each(scene.planes, [&](const Plane& plane) { key.addAll(plane.normal, plane.offset); });
    key.each(scene.colliders, [&](const Collider& c) {
        key.addAll(static_cast<std::uint32_t>(c.shape), c.radius, c.halfLength, c.halfExtents, c.margin,
                   c.pose);
        addPath(key, c.path, c.pathEnd);
    });
    key.each(scene.driven, [&](const DrivenBody& body) {
        key.addAll(body.firstParticle, body.particleCount);
        key.all(body.particles);
        addPath(key, body.path, body.pathEnd);
    });
}

void addBodies(Key& key, const Scene& scene) {
    key.each(scene.grids, [&](const Grid& grid) {
        key.all(grid.nodes);
        key.all(grid.node);
        key.all(grid.fill);
        key.addAll(grid.firstParticle, grid.kinds);
    });
    key.each(scene.skins, [&](const Skin& skin) {
        key.addAll(std::uint64_t{skin.triangles.size()}, std::uint64_t{skin.vertexCount()},
                   std::uint64_t{skin.anchors.size()});
        for (const TextureCorners& corners : skin.textureCoordinates) // none = the same key as before
            for (const TexturePoint& at : corners) key.addAll(at.u, at.v);
    });
}

} // namespace

SceneKey sceneKey(const Scene& scene) {
    Key key;
    addLinks(key, scene);
    addSurroundings(key, scene);
    addBodies(key, scene);
    const std::uint64_t ofAnySolver = key.value();
    addOfSplit(key, scene);
    return {ofAnySolver, key.value()};
}

} // namespace sinew::sim
