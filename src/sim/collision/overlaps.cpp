// The search of the device, done once on the host: by cells for most particles, one by one for large ones.
#include "sim/collision/overlaps.hpp"

#include "common/rest_slack.h"
#include "sim/collision/hash_grid.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::overlaps {

namespace {

struct Place {
    std::array<std::int64_t, 3> cell; // z, y, x: rows of x are adjacent
    std::uint32_t slot;
    bool operator<(const Place& other) const { return cell < other.cell; }
};

bool isExcluded(const contact_lists::Exclusions& exclusions, std::uint32_t i, std::uint32_t j) {
    if (exclusions.empty()) return false;
    const auto [first, second] = std::minmax(i, j);
    return std::binary_search(exclusions.begin() + exclusions[first],
                              exclusions.begin() + exclusions[first + 1], second);
}

class Search {
public:
    explicit Search(const Request& request)
        : request_(request), most_(hash_grid::largestInGrid(request.radii)), found_(request.radii.size()) {
        for (std::uint32_t i = 0; i < request.radii.size(); ++i) {
            if (request.radii[i] < 0) continue;
            if (request.radii[i] > most_)
                large_.push_back(i);
            else
                places_.push_back({cellOf(i), i});
        }
        std::sort(places_.begin(), places_.end());
    }

    Overlaps run() {
        for (const Place& place : places_) searchAround(place);
        for (const std::uint32_t large : large_) {
            for (const Place& place : places_) {
                add(large, place.slot);
                add(place.slot, large);
            }
            for (const std::uint32_t other : large_) add(large, other);
        }
        std::size_t pairs = 0;
        for (std::vector<Overlap>& list : found_) {
            std::ranges::sort(list, {}, &Overlap::other);
            pairs += list.size();
        }
        return pairs > 0 ? std::move(found_) : Overlaps{};
    }

private:
    std::array<std::int64_t, 3> cellOf(std::uint32_t i) const {
        const double edge = std::max(2 * double{most_}, 1e-30);
        const auto index = [edge](float value) {
            return static_cast<std::int64_t>(std::clamp(std::floor(double{value} / edge), -9e18, 9e18));
        };
        const auto& x = request_.positions[i];
        return {index(x[2]), index(x[1]), index(x[0])};
    }

    void searchAround(const Place& place) {
        for (int row = 0; row < 9; ++row) {
            const Place first{{place.cell[0] + row / 3 - 1, place.cell[1] + row % 3 - 1, place.cell[2] - 1},
                              0};
            const Place last{{first.cell[0], first.cell[1], place.cell[2] + 1}, 0};
            for (auto at = std::lower_bound(places_.begin(), places_.end(), first);
                 at != places_.end() && !(last < *at) && found_[place.slot].size() <= request_.limit; ++at)
                add(place.slot, at->slot);
        }
    }

    void add(std::uint32_t i, std::uint32_t j) {
        const auto &a = request_.positions[i], &b = request_.positions[j];
        const double distance =
            std::hypot(double{a[0]} - double{b[0]}, double{a[1]} - double{b[1]}, double{a[2]} - double{b[2]});
        const double reach = double{request_.radii[i]} + double{request_.radii[j]}, depth = reach - distance;
        const bool isKept =
            !request_.keepsRest.empty() && (request_.keepsRest[i] | request_.keepsRest[j]) != 0;
        if (!request_.arrivals.empty() && request_.arrivals[i] != request_.arrivals[j]) return;
        if (i == j || depth <= (isKept ? -double{REST_SLACK} / 2 * reach : double{request_.least})) return;
        if (request_.inverseMasses[i] == 0 && request_.inverseMasses[j] == 0) return;
        if (!isExcluded(request_.exclusions, i, j))
            found_[i].push_back({j, static_cast<float>(depth), isKept});
    }

    const Request& request_;
    float most_;
    std::vector<std::uint32_t> large_;
    std::vector<Place> places_;
    Overlaps found_;
};

} // namespace

Overlaps find(const Request& request) {
    return Search(request).run();
}

void forget(Overlaps& overlaps, float least) {
    std::size_t pairs = 0;
    for (std::vector<Overlap>& list : overlaps) {
        std::erase_if(list,
                      [least](const Overlap& overlap) { return !overlap.isKept && overlap.depth <= least; });
        pairs += list.size();
    }
    if (pairs == 0) overlaps.clear();
}

bool haveKept(const Overlaps& overlaps) {
    return std::ranges::any_of(overlaps,
                               [](const auto& list) { return std::ranges::any_of(list, &Overlap::isKept); });
}

bool haveParting(const Overlaps& overlaps) {
    return std::ranges::any_of(overlaps,
                               [](const auto& list) { return !std::ranges::all_of(list, &Overlap::isKept); });
}

std::uint32_t mostPartners(const Overlaps& overlaps) {
    std::size_t most = 0;
    for (const std::vector<Overlap>& list : overlaps) most = std::max(most, list.size());
    return static_cast<std::uint32_t>(most);
}

} // namespace sinew::sim::collision::overlaps
