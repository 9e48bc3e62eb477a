// Stubs for a build without peers.
#include "sinew/peers/compare.hpp"

#include "app/guard.hpp"

namespace sinew::tools {

void requirePeers() {
    throw app::Failure(app::wrongUsage,
                       "cannot compare: --peers: this program was built without Bullet: install "
                       "libbullet-dev, configure with -DSINEW_BENCH_PEERS=ON and build again");
}

Json comparePeers(const PeerOptions&, Session&) {
    requirePeers();
    return {};
}

ClutterEntrant bulletClutter(const sim::Scene&, std::uint32_t, std::uint32_t) {
    requirePeers();
    return {};
}

std::string peersTable(const Json&) {
    return {};
}

} // namespace sinew::tools
