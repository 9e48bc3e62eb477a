// A chain of threads: each waits until the simulation of the one before is destroyed.
#include "sinew/successor.hpp"

#include <chrono>
#include <utility>

namespace sinew::sim {

namespace {

Successor::Made make(const vk::Device& device, const SuccessorRequest& request, const std::stop_token& stop) {
    Successor::Made made{.scene = {}, .settings = request.settings, .simulation = nullptr};
    if (stop.stop_requested()) return made; // nobody takes it
    made.scene = request.scene();
    made.simulation = std::make_unique<Simulation>(device, made.scene, made.settings);
    return made;
}

} // namespace

Successor::~Successor() {
    drop();
}

void Successor::request(SuccessorRequest request) {
    drop();
    stop_ = {};
    making_ =
        std::async(std::launch::async, [&device = request.device.anchored(), request = std::move(request),
                                        before = std::move(destroying_), stop = stop_.get_token()]() mutable {
            if (before.valid()) before.wait();
            return make(device, request, stop);
        });
}

bool Successor::isReady() const {
    return making_.valid() && making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Successor::Made Successor::take() {
    return std::exchange(making_, {}).get();
}

void Successor::drop() {
    if (!making_.valid()) return;
    stop_.request_stop();
    destroying_ = std::async(std::launch::async, [made = std::move(making_)]() mutable {
        made.wait();
        made = {};
    });
}

} // namespace sinew::sim
